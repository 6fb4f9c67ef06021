"""The FMUs of examples/fmu, run by FMPy, against integrate."""

import numpy as np
import pytest
import stickslip as ss

pytestmark = pytest.mark.slow
fmpy = pytest.importorskip("fmpy")
fmi2 = pytest.importorskip("fmpy.fmi2")
FMICallException = pytest.importorskip("fmpy.fmi1").FMICallException

G = ss.STANDARD_GRAVITY
DT = 0.1

# Parameters of an FMU, and the slider that it is.
SLIDERS = {
    "sliding": ("slider", {"mu": 0.1}, ss.Slider(ss.Coulomb(mu=0.1))),
    "spring": (
        "slider",
        {
            "mu": 0.05,
            "mu_static": 0.07,
            "natural_frequency": 3.0,
            "damping_ratio": 0.04,
            "mass": 5.0,
        }
        | {"gap": 0.06, "restitution": 0.6},
        ss.Slider(
            ss.StaticKinetic(mu_static=0.07, mu_kinetic=0.05),
            natural_frequency=3.0,
            damping_ratio=0.04,
            stops=ss.Stops(gap=0.06, restitution=0.6),
        ),
    ),
    "bearing": (
        "bearing",
        {"mu": 0.04, "radius": 1.5, "damping_ratio": 0.03, "mass": 2000.0, "capacity": 0.09},
        ss.FrictionPendulum(
            mu=0.04,
            radius=1.5,
            damping=2 * 0.03 * np.sqrt(G / 1.5),
            stops=ss.Stops(gap=0.09, restitution=0),
        ),
    ),
}


MODELS = ("slider", "bearing", "cart")


@pytest.fixture(scope="module")
def files(beside_source, compile_for_c, run_page):
    for name in ("acceleration", "c_interface", "cart", "integrate"):
        compile_for_c(f"carts/{name}.cpp", beside_source / f"{name}.o")
    folder = run_page("examples/fmu/build.py")
    return {model: folder / f"{model}.fmu" for model in MODELS}


@pytest.fixture
def slave(files, tmp_path):
    """Starts an FMU; returns it, and the value references of its variables."""
    started = []

    def start(model, parameters):
        description = fmpy.read_model_description(files[model])
        of = {v.name: v.valueReference for v in description.modelVariables}
        fmu = fmi2.FMU2Slave(
            guid=description.guid,
            unzipDirectory=fmpy.extract(files[model], tmp_path / f"{model}{len(started)}"),
            modelIdentifier=description.coSimulation.modelIdentifier,
            instanceName="tested",
        )
        fmu.instantiate()
        started.append(fmu)
        fmu.setupExperiment(startTime=0)
        fmu.enterInitializationMode()
        fmu.setReal([of[name] for name in parameters], list(parameters.values()))
        return fmu, of

    yield start
    for fmu in started:
        fmu.freeInstance()


def step(fmu, time, start, end, dt=DT):
    """A step with inputs that are linear in time: their values and derivatives at its start."""
    fmu.setReal([0, 1], start)
    slopes = [(b - a) / dt for a, b in zip(start, end)]
    kinds = fmi2.fmi2ValueReference * 2, fmi2.fmi2Integer * 2, fmi2.fmi2Real * 2
    references, orders, values = (kind(*x) for kind, x in zip(kinds, ((0, 1), (1, 1), slopes)))
    fmu.fmi2SetRealInputDerivatives(fmu.component, references, 2, orders, values)
    fmu.doStep(currentCommunicationPoint=time, communicationStepSize=dt)
    return fmu.getReal([2, 3, 4])


def grounds(record_a):
    """Horizontal and vertical acceleration; the latter lifts the slider off the ground at times."""
    return record_a, 3.2 * np.roll(record_a, 40)


@pytest.mark.parametrize("name", SLIDERS)
def test_linear_inputs_give_what_integrate_gives(slave, record_a, name):
    model, parameters, slider = SLIDERS[name]
    n, vertical = grounds(record_a)
    r = ss.integrate(slider, ss.GroundMotion(n, dt=DT, vertical=vertical))
    assert vertical.min() < -G and r.slips > 10
    assert name == "sliding" or len(r.impacts) > 0
    fmu, _ = slave(model, parameters)
    fmu.exitInitializationMode()
    inputs = list(zip(n, vertical))
    rows = [step(fmu, k * DT, inputs[k], inputs[k + 1]) for k in range(len(n) - 1)]
    x, v, force = np.transpose(rows)
    # Round-off alone, and with a damper the 1e-12 that the interface in C promises.
    assert x == pytest.approx(r.displacement[1:], abs=1e-12 * r.peak)
    assert v == pytest.approx(r.velocity[1:], abs=1e-11 * abs(r.velocity).max())
    mass = parameters.get("mass", 1.0)
    assert force == pytest.approx(mass * r.force[1:], abs=1e-11 * mass * abs(r.force).max())


@pytest.mark.parametrize("name", ["sliding", "spring"])
def test_inputs_without_derivatives_are_constant_within_a_step(files, record_a, name):
    model, parameters, slider = SLIDERS[name]
    n, vertical = grounds(record_a)
    time = DT * np.arange(len(n))
    kinds = [(x, float) for x in ("time", "ground_acceleration", "vertical_acceleration")]
    result = fmpy.simulate_fmu(
        files[model],
        stop_time=time[-1],
        output_interval=DT,
        start_values=parameters,
        input=np.array(list(zip(time, n, vertical)), dtype=kinds),
        output=["displacement", "velocity"],
    )
    ground = ss.GroundMotion(n, dt=DT, vertical=vertical, interpolation="constant")
    r = ss.integrate(slider, ground)
    # FMPy adds up its times, and interpolates the inputs at them: some 1e-14 of the time.
    assert result["displacement"] == pytest.approx(r.displacement, abs=1e-12 * r.peak)
    assert result["velocity"] == pytest.approx(r.velocity, abs=1e-11 * abs(r.velocity).max())


def test_a_step_can_be_repeated(slave, record_a):
    fmu, _ = slave("slider", SLIDERS["spring"][1])
    fmu.exitInitializationMode()
    for k in range(20):
        saved = fmu.getFMUState()
        first = step(fmu, k * DT, (record_a[k], 0), (record_a[k + 1], 0))
        step(fmu, (k + 1) * DT, (5, 0), (-5, 0))
        fmu.setFMUState(saved)
        fmu.freeFMUState(saved)
        assert step(fmu, k * DT, (record_a[k], 0), (record_a[k + 1], 0)) == first


def test_a_cart_moves_as_integrate_moves_it(files, record_a):
    n, t, up = record_a, 0.7 * np.roll(record_a, 30), 0.5 * np.roll(record_a, 11)
    headings, length, width = (0.3, 2.0, -2.5, -0.7), 0.7, 0.5
    supports = [
        ss.SwivelCaster(
            at=(x * length / 2, y * width / 2), heading=h, slip_level=0.08 * G, reach=0.03,
            rolling_mu=0.02,
        )
        for h, (x, y) in zip(headings, [(1, 1), (1, -1), (-1, 1), (-1, -1)])
    ]  # fmt: skip
    supports[3] = ss.Foot(at=supports[3].at, mu=0.15)
    cart = ss.Cart(supports, radius_of_gyration=0.3)
    names = ("ground_acceleration", "vertical_acceleration", "transverse_acceleration")
    time = DT * np.arange(len(n))
    outputs = ["displacement", "transverse_displacement", "yaw", "velocity", "yaw_rate"]
    result = fmpy.simulate_fmu(
        files["cart"],
        stop_time=time[60],
        output_interval=DT,
        start_values={
            **{f"heading_{i + 1}": h for i, h in enumerate(headings)},
            "length": length,
            "width": width,
            "radius_of_gyration": 0.3,
            "side_mu": 0.08,
            "reach": 0.03,
            "rolling_mu": 0.02,
            "locked_4": 1.0,
            "locked_mu": 0.15,
        },
        input=np.array(list(zip(time, n, up, t)), dtype=[(x, float) for x in ("time", *names)]),
        output=outputs,
    )
    ground = ss.GroundMotion(n, dt=DT, transverse=t, vertical=up, interpolation="constant")
    r = ss.integrate(cart, ground)
    assert np.abs(r.yaw).max() > 0.01
    # Feet are exact to 1e-9; FMPy adds up its times.
    for name, is_now in zip(outputs, (*r.displacement.T, r.yaw, r.velocity[:, 0], r.yaw_rate)):
        assert result[name] == pytest.approx(is_now[:61], abs=1e-8), name


@pytest.mark.parametrize("model", MODELS)
def test_the_description_is_valid_and_has_the_start_values_of_the_binary(files, slave, model):
    assert fmpy.validation.validate_fmu(str(files[model])) == []
    fmu, of = slave(model, {})
    for variable in fmpy.read_model_description(files[model]).modelVariables:
        if variable.start is not None:
            assert fmu.getReal([of[variable.name]]) == [float(variable.start)]


def test_errors_say_what_is_wrong(slave, capfd):
    fmu, _ = slave("slider", {"mu": -0.1})
    with pytest.raises(FMICallException):
        fmu.exitInitializationMode()
    fmu, _ = slave("bearing", {"radius": 0.0})
    with pytest.raises(FMICallException):
        fmu.exitInitializationMode()
    for model, wrong in (
        ("slider", {"mass": 0.0}),
        ("cart", {"locked_2": 0.5}),
        ("cart", {"reach": 0.0}),
    ):
        fmu, _ = slave(model, wrong)
        with pytest.raises(FMICallException):
            fmu.exitInitializationMode()
    fmu, of = slave("slider", {})
    fmu.exitInitializationMode()
    for name in "mu", "displacement":
        with pytest.raises(FMICallException):
            fmu.setReal([of[name]], [0.1])
    fmu.setReal([0], [float("nan")])
    with pytest.raises(FMICallException):
        fmu.doStep(currentCommunicationPoint=0, communicationStepSize=DT)
    said = "".join(capfd.readouterr())
    assert "slip_level" in said
    assert "radii" in said
    assert "mass must be positive" in said
    assert "locked must be 0 or 1" in said
    assert "reach" in said
    assert "parameters are fixed" in said
