"""Where members come from: lists of records and sliders, random sliders, sources in Python."""

import math
import pickle
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor

import numpy as np
import pytest
import stickslip as ss
from sources import BLOCK, SHAKING, Delayed, same_bits

CART = ss.Slider(ss.Caster(slip_level=2.0, reach=0.5), natural_frequency=1.3)
DAMPER = ss.ViscousSlider(0.7, natural_frequency=3.0)


def record(i, samples, dt):
    return ss.GroundMotion(np.random.default_rng(i).normal(0, 3, samples), dt=dt)


RECORDS = [record(i, 60 + 17 * i, 0.01 * (1 + i % 3)) for i in range(7)]
ALIKE = [record(i, 128, 0.05) for i in range(9)]
BLOCKS = ss.Random(ss.Coulomb, mu=ss.Lognormal(median=0.1, beta=0.3))
FLOORS = ss.Random(
    ss.Slider, law=BLOCKS, natural_frequency=ss.Normal(mean=2.0, std=0.3, low=1.0, high=3.0)
)


# ---- records


@pytest.mark.parametrize(
    "slider, settle", [(BLOCK, False), (BLOCK, True), (CART, False), (DAMPER, False)]
)
def test_statistics_of_a_list_of_records_are_those_of_the_single_ones(slider, settle):
    n = 100
    e = ss.run_ensemble(slider, RECORDS, members=n, seed=1, settle=settle)
    singles = [
        ss.integrate(slider, RECORDS[i % 7], **({"settle": True} if settle else {}))
        for i in range(n)
    ]
    peaks = np.array([r.peak for r in singles])
    # Round-off; casters by Taylor series.
    assert e.peak == pytest.approx(peaks, rel=1e-10 if slider is CART else 5e-13)
    assert e.residual == pytest.approx([r.residual for r in singles], abs=1e-10 * peaks.max())
    assert e.quantile(0.5).value == np.sort(e.peak)[49]
    assert e.exceedance(float(peaks.mean())).value == (peaks > peaks.mean()).mean()


def test_records_of_different_durations_have_no_statistics_by_time():
    e = ss.run_ensemble(BLOCK, RECORDS, members=70, seed=1)
    assert e.time.shape == (0,)
    assert repr(e) == "<Ensemble: 70 members, seed 1, motions of different durations>"
    for name in (
        *("displacement_mean", "displacement_variance", "covariance", "velocity_mean"),
        *("velocity_variance", "velocity_variance_error", "moments", "stationary"),
        "velocity_spectrum",
    ):
        with pytest.raises(ValueError, match=r"no statistics by time, .* differ in duration; peak"):
            getattr(e, name)
    with pytest.raises(ValueError, match=r"dt must not be given .* got 0.1 s"):
        ss.run_ensemble(BLOCK, RECORDS, members=70, seed=1, dt=0.1)
    assert e.configuration["times"] == 0
    assert e.configuration["velocity_spectrum"] is False


def test_records_of_one_duration_have_statistics_by_time():
    e = ss.run_ensemble(BLOCK, ALIKE, members=9, seed=1)
    x = np.array([ss.integrate(BLOCK, motion).displacement for motion in ALIKE])
    assert e.time == pytest.approx(0.05 * np.arange(128))
    assert e.displacement_mean == pytest.approx(x.mean(0), abs=1e-12 * np.abs(x).max())
    assert e.displacement_variance == pytest.approx(x.var(0, ddof=1), abs=1e-12 * x.var())
    assert e.velocity_spectrum.density.shape == (33,)


def test_one_record_serves_random_sliders():
    e = ss.run_ensemble(BLOCKS, ALIKE[0], members=70, seed=1)
    same = ss.run_ensemble(BLOCKS, [ALIKE[0]], members=70, seed=1)
    assert same_bits(e, same)
    assert len(set(e.peak)) == 70
    single = ss.integrate(BLOCKS.sample(seed=1, member=7), ALIKE[0])
    assert e.peak[7] == pytest.approx(single.peak, rel=5e-13)


def test_drawn_records_are_those_that_sample_tells():
    drawn = ss.Drawn(RECORDS)
    e = ss.run_ensemble(BLOCK, drawn, members=100, seed=3)
    singles = [ss.integrate(BLOCK, drawn.sample(seed=3, member=i)).peak for i in range(100)]
    assert e.peak == pytest.approx(singles, rel=5e-13)
    assert not np.array_equal(e.peak, ss.run_ensemble(BLOCK, RECORDS, members=100, seed=3).peak)
    # Each of 7 is among 4900 within 5 standard errors, but once in 1.7 million seeds.
    places = [RECORDS.index(drawn.sample(seed=3, member=i)) for i in range(4900)]
    assert np.abs(np.bincount(places, minlength=7) - 700).max() < 5 * math.sqrt(4900 * 6 / 49)


def test_lists_of_sliders_and_records_go_side_by_side():
    sliders = [BLOCK, CART, DAMPER, ss.Caster(slip_level=2.0, reach=0.5), ss.Slider(BLOCK, 2.0)]
    e = ss.run_ensemble(sliders, ALIKE[:5], members=70, seed=1)
    singles = [ss.integrate(slider, motion).peak for slider, motion in zip(sliders, ALIKE)]
    assert e.peak == pytest.approx(14 * singles, rel=1e-10)
    drawn = ss.run_ensemble(ss.Drawn(sliders), SHAKING, members=70, seed=1)
    member = ss.Drawn(sliders).sample(seed=1, member=7), SHAKING.sample(seed=1, member=7)
    assert drawn.peak[7] == pytest.approx(ss.integrate(*member).peak, rel=1e-9)


# ---- random sliders


def test_a_random_mu_has_the_median_and_beta_that_were_asked_for():
    n = 20_000
    sliders = (BLOCKS.sample(seed=1, member=i) for i in range(n))
    z = np.log([s.slip_level / ss.STANDARD_GRAVITY / 0.1 for s in sliders]) / 0.3
    # Means of n normal numbers and of their squares: beyond 5 standard errors once in 1.7 million
    # seeds each.
    assert abs(z.mean()) < 5 / math.sqrt(n)
    assert abs((z**2).mean() - 1) < 5 * math.sqrt(2 / n)
    assert abs((z < 0).mean() - 0.5) < 2.5 / math.sqrt(n)


def test_a_draw_is_a_quantile_at_the_members_own_random_numbers():
    mu, wn = ss.Lognormal(0.1, 0.3), ss.Normal(2.0, 0.3, low=1.0, high=3.0)
    even = ss.Random(lambda a, b: ss.Slider(ss.Coulomb(mu=a), b), a=ss.Uniform(0, 1), b=wn)
    for member in range(50):
        floor = FLOORS.sample(seed=2, member=member)
        share = even.sample(seed=2, member=member).law.slip_level / ss.STANDARD_GRAVITY
        level = mu.quantile(share) * ss.STANDARD_GRAVITY
        assert floor.law.slip_level == pytest.approx(level, rel=1e-12)
        assert 1 < floor.natural_frequency < 3
        assert floor.natural_frequency == even.sample(seed=2, member=member).natural_frequency
        fixed = ss.Random(lambda a, b: ss.Slider(ss.Coulomb(mu=a), b), a=0.2, b=wn)
        assert fixed.sample(seed=2, member=member).natural_frequency == floor.natural_frequency


@pytest.mark.parametrize("motions", [RECORDS, ss.Drawn(RECORDS), ALIKE, SHAKING, Delayed()])
@pytest.mark.parametrize(
    "sliders", [BLOCKS, FLOORS, [BLOCK, CART, DAMPER], ss.Drawn([BLOCK, CART])]
)
def test_the_bits_do_not_depend_on_threads_parts_or_resuming(sliders, motions, tmp_path):
    def run(members=200, **more):
        return ss.run_ensemble(sliders, motions, members=members, seed=4, **more)

    whole = run(threads=1)
    assert same_bits(run(threads=2), whole)
    assert same_bits(run(threads=3), whole)
    part = run(128)
    part.merge(run(72, first_member=128))
    assert same_bits(part, whole)
    file = tmp_path / "run.npz"
    run(128, checkpoint=file)
    assert same_bits(run(checkpoint=file), whole)
    assert same_bits(ss.Ensemble.load(file), whole)
    assert same_bits(pickle.loads(pickle.dumps(whole)), whole)


@pytest.mark.parametrize("motions", [RECORDS, ss.Drawn(ALIKE)])
def test_the_bits_are_the_same_in_other_processes(motions):
    whole = ss.run_ensemble(FLOORS, motions, members=500, seed=4)
    for pool in (ProcessPoolExecutor(2), ThreadPoolExecutor(3)):
        with pool as executor:
            assert same_bits(
                ss.run_ensemble(FLOORS, motions, members=500, seed=4, executor=executor), whole
            )


def test_a_source_of_sliders_in_python_is_asked_for_every_member_once():
    class Harder:
        configuration = "harder and harder"

        def sample(self, *, seed, member):
            asked.append((seed, member))
            return ss.Coulomb(slip_level=1.0 + member / 2)

    asked = []
    e = ss.run_ensemble(Harder(), RECORDS, members=70, seed=9, threads=3)
    assert sorted(asked) == [(9, m) for m in range(70)]
    assert e.configuration["slider"] == "harder and harder"
    single = ss.integrate(ss.Coulomb(slip_level=2.0), RECORDS[2])
    assert e.peak[2] == pytest.approx(single.peak, rel=5e-13)


def test_a_source_of_motions_in_python_may_have_no_duration():
    class Own:
        configuration, duration = "own", None

        def sample(self, *, seed, member):
            return RECORDS[member % 7]

    e = ss.run_ensemble(BLOCK, Own(), members=70, seed=1)
    assert np.array_equal(e.peak, ss.run_ensemble(BLOCK, RECORDS, members=70, seed=1).peak)
    assert e.time.size == 0


def test_other_members_are_not_merged():
    def run(sliders, motions, first=64):
        return ss.run_ensemble(sliders, motions, members=64, seed=1, first_member=first)

    e = run(BLOCKS, RECORDS, 0)
    told = e.configuration["slider"]["random"]
    assert told == {"mu": {"distribution": "Lognormal", "median": 0.1, "beta": 0.3}}
    assert e.configuration["excitation"]["motions"] == 7
    for sliders, motions in (
        (ss.Random(ss.Coulomb, mu=ss.Lognormal(0.1, 0.31)), RECORDS),
        (ss.Random(lambda mu: ss.Coulomb(mu=2 * mu), mu=ss.Lognormal(0.1, 0.3)), RECORDS),
        (BLOCKS, ss.Drawn(RECORDS)),
        (BLOCKS, RECORDS[::-1]),
        (BLOCKS, RECORDS[:-1]),
    ):
        with pytest.raises(ValueError, match="cannot merge"):
            e.merge(run(sliders, motions))
    e.merge(run(pickle.loads(pickle.dumps(BLOCKS)), pickle.loads(pickle.dumps(RECORDS))))
    assert e.members == 128


# ---- errors

REFUSED = {
    "no sliders": ([], RECORDS, ValueError, "sliders must hold at least one, got an empty list"),
    "no records": (BLOCK, [], ValueError, "motions must hold at least one, got an empty list"),
    "a number among sliders": ([BLOCK, 3.0], RECORDS, TypeError, "sliders[1] must be a Slider"),
    "a list among records": (
        BLOCK,
        [*RECORDS, [1.0, 2.0]],
        TypeError,
        "motions[7] must be a GroundMotion, got list",
    ),
    "a source among records": (BLOCK, [SHAKING], TypeError, "got GaussianExcitation"),
    "a class": (ss.Coulomb, RECORDS, TypeError, "sliders must be a Slider, a friction law"),
    "a law that refuses": (
        ss.Random(ss.Coulomb, mu=ss.Normal(0.1, 0.08)),
        RECORDS,
        ValueError,
        ": Coulomb: mu must be finite and at least 0, got -0.",
    ),
    "what is no slider": (
        ss.Random(lambda mu: mu, mu=ss.Uniform(0, 1)),
        RECORDS,
        TypeError,
        "a sample of sliders must be a Slider or a friction law; that of member",
    ),
}


@pytest.mark.parametrize("what", REFUSED)
def test_bad_sliders_and_motions_are_named(what):
    sliders, motions, kind, message = REFUSED[what]
    with pytest.raises(kind) as refusal:
        ss.run_ensemble(sliders, motions, members=1000, seed=1)
    assert message in str(refusal.value)


def test_parameters_that_the_law_refuses_are_named_with_their_member():
    slippery = ss.Random(ss.Coulomb, mu=ss.Normal(0.1, 0.08))
    with pytest.raises(
        ValueError, match=r"^Random: member \d+: Coulomb: mu .* got -0\."
    ) as refusal:
        ss.run_ensemble(slippery, RECORDS, members=1000, seed=1, threads=1)
    member = int(str(refusal.value).split()[2].rstrip(":"))
    with pytest.raises(ValueError, match=f"^Random: member {member}: "):
        slippery.sample(seed=1, member=member)
    bounded = ss.Random(ss.Coulomb, mu=ss.Normal(0.1, 0.08, low=0.01))
    assert ss.run_ensemble(bounded, RECORDS, members=1000, seed=1).members == 1000


def test_random_sliders_are_tried_when_they_are_made():
    with pytest.raises(TypeError, match=r"kind must be callable, such as Coulomb, got 0.3"):
        ss.Random(0.3, mu=0.2)
    with pytest.raises(ValueError, match=r"mu must be finite and at least 0, got -1.75"):
        ss.Random(ss.Coulomb, mu=ss.Uniform(-2, -1))
    with pytest.raises(TypeError):
        ss.Random(ss.Coulomb, nu=ss.Uniform(1, 2))
    with pytest.raises(ValueError, match="items must hold at least one"):
        ss.Drawn([])


def test_random_sliders_say_what_they_are():
    assert repr(BLOCKS) == "Random(Coulomb, mu=Lognormal(median=0.1, beta=0.3))"
    assert repr(ss.Normal(1, 2, high=3)) == "Normal(mean=1, std=2, high=3)"
    assert repr(ss.Uniform(1, 2)) == "Uniform(low=1, high=2)"
    assert repr(ss.Drawn(RECORDS)) == "<Drawn: one of 7 motions>"
    assert BLOCKS.kind is ss.Coulomb
    assert BLOCKS.parameters == {"mu": ss.Lognormal(0.1, 0.3)}
    assert (len(ss.Drawn(RECORDS)), ss.Drawn(RECORDS).items) == (7, tuple(RECORDS))


# ---- distributions


def test_quantiles_are_those_of_scipy():
    stats = pytest.importorskip("scipy.stats")
    p = np.linspace(0.001, 0.999, 999)
    theirs = stats.lognorm(s=0.4, scale=0.3).ppf(p)
    assert ss.Lognormal(0.3, 0.4).quantile(p) == pytest.approx(theirs, rel=1e-13)
    theirs = stats.truncnorm((1 - 2) / 0.5, (2.2 - 2) / 0.5, loc=2, scale=0.5).ppf(p)
    assert ss.Normal(2, 0.5, 1, 2.2).quantile(p) == pytest.approx(theirs, rel=1e-12)
    assert ss.Uniform(2, 6).quantile(p) == pytest.approx(2 + 4 * p, rel=1e-15)
    assert ss.Lognormal(0.3, 0.4).quantile(0.5) == 0.3


def test_distributions_that_do_not_exist_are_refused():
    for make, message in (
        (lambda: ss.Lognormal(-1, 0.3), "median must be positive and finite, got -1"),
        (lambda: ss.Normal(1, 1, 2, 2), "low must be less than high, 2, got 2"),
        (lambda: ss.Uniform(1, math.inf), "high must be finite and at least low, 1, got inf"),
        (lambda: ss.Uniform(1, 2).quantile(1), "probability must lie between 0 and 1, got 1"),
    ):
        with pytest.raises(ValueError, match=message):
            make()


# ---- pictures


def test_an_ensemble_without_times_draws_its_peaks():
    pytest.importorskip("matplotlib")
    figure = ss.run_ensemble(BLOCKS, RECORDS, members=200, seed=1).plot()
    (axes,) = figure.axes
    assert axes.get_ylabel() == "probability of exceedance"
    assert figure.get_suptitle() == "200 members, random sliders"
