"""The equations of the pages of docs/, with the same numbers, agree with the library."""

import itertools
from math import asinh, atan, cos, cosh, exp, factorial, pi, sin, sqrt, tanh

import pytest
import stickslip as ss
from stickslip import theory

close = pytest.approx


def integral(f, low, high):
    """By quadrature, to some 1e-12."""
    quad = pytest.importorskip("scipy.integrate").quad
    return quad(f, low, high, epsabs=0, epsrel=1e-12, limit=500)[0]


def test_slowly_varying_parameters():
    a, r, amplitude, load = 1.4, 0.5, 0.8, 3.0
    svp = theory.SlowlyVaryingParameters(ss.Caster(slip_level=a, reach=r))
    y = amplitude / r
    gd = 2 * atan(tanh(y / 2))
    assert svp.dissipative(amplitude) == close(-4 * a / pi * gd / y, rel=1e-14)  # (2.30)
    slope = 4 * a / (pi * amplitude) * (gd / y - 1 / cosh(y))
    assert svp.dissipative_slope(amplitude) == close(slope, rel=1e-13)  # (2.38)
    w4 = ((load / a) ** 2 - (4 / pi * gd / y) ** 2) / y**2 * a**2 / r**2
    assert svp.frequency(load, amplitude)[1] ** 4 == close(w4, rel=1e-13)  # (2.35)
    edge = (4 / (pi * y**2)) ** 2 * gd * (gd - y / cosh(y)) * a**2 / r**2
    assert svp.stability_boundary(amplitude)[1] ** 4 == close(edge, rel=1e-13)  # (2.41)
    least = svp.min_amplitude(1.5) / r
    assert least == close(4 * a / (pi * 1.5) * 2 * atan(tanh(least / 2)), rel=1e-13)  # (2.37)
    corner = svp.stability_boundary(1e-4 * r)[1] * sqrt(r / a)
    assert corner == close(sqrt(4 / (sqrt(3) * pi)), rel=1e-7)  # (2.42)


def test_a_solution_of_the_averaged_equations():
    a, wn, load, omega = 1.0, 0.7, 2.0, 1.1
    svp = theory.SlowlyVaryingParameters(ss.Slider(ss.Coulomb(slip_level=a), wn))
    (solution,) = svp.response(load, omega)
    s, c = -4 * a / pi, wn**2 * solution.amplitude  # (2.22), (2.46)
    assert s == close(load * sin(solution.phase), rel=1e-13)  # (2.14) corrected
    assert c - omega**2 * solution.amplitude == close(load * cos(solution.phase), rel=1e-13)
    high = wn**2 + sqrt(load**2 - (4 * a / pi) ** 2) / solution.amplitude
    assert omega**2 == close(high, rel=1e-13)  # (2.48)


def test_white_noise():
    a, b, d = 1.3, 0.8, pi * 0.4
    noise = theory.WhiteNoise.coulomb(a, 0.4)
    assert noise.variance == close(2 * (pi * 0.4) ** 2 / a**2, rel=1e-14)  # (3.48)
    assert noise.growth_rate == close(10 * pi**3 * 0.4**3 / a**4, rel=1e-14)  # (3.49)
    noise = theory.WhiteNoise(ss.Coulomb(slip_level=a, backward=b), 0.4)
    assert noise.variance == close(d**2 * (1 / a**2 + 1 / b**2), rel=1e-14)
    growth = 2 * d**3 * (2 / a**4 + 1 / (a * b) ** 2 + 2 / b**4)
    assert noise.growth_rate == close(growth, rel=1e-14)
    assert noise.mean == close(d / a - d / b, rel=1e-14)
    noise, v, d = theory.WhiteNoise.coulomb(1.0, 0.4), 0.7, pi * 0.4

    def beyond(sign):  # on the side of the start, and beyond rest; a = 1, t = 2, v0 = 0.3
        erfc = pytest.importorskip("scipy.special").erfc
        q = exp(-v / d) / (4 * d) * erfc((v + 0.3 - 2) / sqrt(8 * d))
        if sign > 0:
            return exp(-((v - 0.3 + 2) ** 2) / (8 * d)) / sqrt(8 * pi * d) + q
        return exp(-v / d) * exp(-((v + 0.3 - 2) ** 2) / (8 * d)) / sqrt(8 * pi * d) + q

    for sign in (1, -1):
        assert noise.transition_density(sign * v, 2.0, 0.3) == close(beyond(sign), rel=1e-12)
    k = (1 + (1 + 4j * 0.9 * d) ** 0.5) / 2
    spectrum = d**3 / pi * ((2 * k**2 + 2 * k + 1) / k**4).real
    assert noise.velocity_spectrum(0.9) == close(spectrum, rel=1e-12)


@pytest.mark.parametrize("n", [2, 3, 5])
def test_white_noise_in_the_plane(n):
    """The transforms of the page at some s, against quadrature of the library over time."""
    special = pytest.importorskip("scipy.special")
    noise = theory.WhiteNoise.coulomb(1.0, 1 / pi, dimensions=n)  # a = D = 1
    assert noise.variance == close(n + 1, rel=1e-14)  # (W.5)
    assert noise.growth_rate == close((n + 1) * (2 * n + 3), rel=1e-14)  # (W.7)
    assert noise.relaxation_rate == close(n / (n + 1) ** 2, rel=1e-14)  # (W.10)
    y = 0.8
    margin = (y / 2) ** (n / 2) * special.kv(n / 2, y) / sqrt(pi) / special.gamma((n + 1) / 2)
    assert noise.density(y) == close(margin, rel=1e-12)  # (W.4)
    delay = (n + 1) * (47 * n**2 + 151 * n + 126) / 12
    late = noise.predict([1e4]).displacement_variance[0]
    assert late == close(noise.growth_rate * 1e4 - delay, rel=1e-11)  # (W.15)

    s = 0.7
    q = sqrt(1 + 4 * s)
    k, rho = (1 + q) / 2, (q - 1) / (q + 1)
    z = (k - 1) / q
    alpha = (n - 1) * z
    b = alpha + 1

    def transform(f):
        return integral(lambda t: exp(-s * t) * f(t), 0, 4) + integral(
            lambda t: exp(-s * t) * f(t), 4, 60
        )

    closed = (n + 1) / s - 1 / s**2 + special.hyp2f1(1, b - n, b + 1, rho**2) / (b * k**2 * s**2)
    terms = [
        factorial(m + n) / factorial(m) * ((m + n + 1) * rho**m + m * rho ** (m - 1)) ** 2 / (m + b)
        for m in range(100)
    ]
    assert closed == close(q**n / factorial(n) / k ** (2 * n + 4) * sum(terms), rel=1e-12)  # (W.12)
    assert transform(noise.velocity_autocovariance) == close(closed, rel=1e-9)

    def gauss(order):
        return special.hyp2f1(alpha, alpha + 2 - n, alpha + order + 2, z)

    square = n * (n + 1) * 6 / ((alpha + 2) * (alpha + 3)) / (s * k**2) * gauss(2) / gauss(0)
    assert transform(lambda t: noise.absolute_moment(2, t)) == close(square, rel=1e-9)

    def g(m):
        p = m + alpha + 1
        return 2 * ((n - 3) * p - 2 * (n - 1) / q) / (p**2 * (p**2 - 1) * (p**2 - 4))

    row, total = [g(m) for m in range(61)], 0.0
    for j in range(60):
        row = [x - y for x, y in itertools.pairwise(row)]
        total += special.binom(j + n + 1, j) * z**j * row[0]
    product = 3 * (n - 1) * n * (n + 1) / q**6 * total  # (W.14)
    found = transform(lambda t: n * noise.predict([t]).covariance[0])
    assert found == close(product, rel=1e-9)


@pytest.mark.parametrize(("n", "gaussian"), [(1, 2 / pi), (2, pi / 8), (3, 8 / (9 * pi))])
def test_linearization_in_the_plane(n, gaussian):
    exact = theory.WhiteNoise.coulomb(1.0, 1 / pi, dimensions=n)
    for force, square in (("gaussian", gaussian), ("laplace", 1 / (n + 1))):
        linear = theory.EquivalentLinearization(force, dimensions=n)
        block = ss.Coulomb(slip_level=1.0)
        assert linear.coefficients(block, 1, 0, 1)[1] == close(-sqrt(square), rel=1e-12)  # (W.17)
        m = linear.stationary(block, 1 / pi)
        assert m.velocity_variance[0] == close(1 / square, rel=1e-8)  # (W.18)
        assert m.growth_rate.value == close(2 / square**2, rel=1e-8)
    assert m.velocity_variance[0] == close(exact.variance, rel=1e-8)


def test_equivalent_linearization():
    special = pytest.importorskip("scipy.special")
    a, r, q11, q12, q22 = 1.4, 0.5, 0.5, 0.3, 1.2
    det = q11 * q22 - q12**2
    cart = ss.Caster(slip_level=a, reach=r)

    def normal(x, variance):
        return exp(-x * x / (2 * variance)) / sqrt(2 * pi * variance)

    a21, a22 = theory.EquivalentLinearization().coefficients(cart, q11, q12, q22)
    expected = integral(
        lambda x: (
            tanh(x / r) / cosh(x / r) * special.erf(q12 * x / sqrt(2 * q11 * det)) * normal(x, q11)
        ),
        -9,
        9,
    )
    assert a21 == close(a / r * expected, rel=1e-11)  # (3.24) corrected
    level = integral(lambda x: a / cosh(x / r) * normal(x, det / q22), -9, 9)
    assert a22 == close(-sqrt(2 / (pi * q22)) * level, rel=1e-11)  # (3.25)
    z = r * sqrt(q22 / (2 * det))  # (3.30)
    _, a22 = theory.EquivalentLinearization(force="thesis").coefficients(cart, q11, q12, q22)
    assert a22 == close(-a * sqrt(2 / q22) * z * special.erfcx(z), rel=1e-13)  # (3.29)
    gamma = 0.2**2 / (r * a**3)
    loose = 0.2 / a**2 * (1 / (pi**5 * gamma**2) + pi**2 / 4)
    assert theory.transition_time(cart, 0.2).thesis == close(loose, rel=1e-14)  # (3.51)


def test_stationary_linearization_of_a_band():
    low, high = 1.2, 3.0
    block, method = ss.Coulomb(slip_level=1.0), theory.StationaryLinearization()
    p = method.predict(block, ss.Spectrum.band_pass(s0=1.0, low=low, high=high))
    z, v2 = p.damping, p.velocity_std**2
    angle = atan(z * (high - low) / (z**2 + low * high))
    assert v2 == close(2 / z * angle, rel=1e-14)  # (4.32) corrected
    assert z == close(sqrt(2 / pi) / sqrt(v2), rel=1e-14)  # (4.34)
    assert 1 / z == close(pi * angle, rel=1e-14)  # (4.35)
    x2 = pi * v2 * (1 / low - 1 / high - v2 / 2)
    assert p.displacement_std**2 == close(x2, rel=1e-13)  # (4.45)
    p = method.predict(block, ss.Spectrum.band_pass(s0=1.0, low=0.0, high=high))
    assert p.growth_rate == close(2 * pi / p.damping**2, rel=1e-14)  # (4.46)
    p = method.predict(block, ss.Spectrum.white(s0=1.0))
    assert 1 / p.damping == close(pi**2 / 2, rel=1e-14)  # (4.40)


A, DT, RATE, SIGMA = 1.3, 0.4, 1.1, 2.0
PULSES = ss.PoissonPulses(rate=RATE, half_width=DT, sigma=SIGMA, duration=1000.0)


def test_the_ground_under_pulses():
    assert PULSES.variance == close(2 * RATE * DT * SIGMA**2, rel=1e-14)  # (5.61)
    assert PULSES.ground_velocity_variance == close(PULSES.variance * DT**2 / 3)  # (5.46)
    assert PULSES.ground_displacement_variance(9.0) == close(PULSES.variance * DT**3 / 2 * 9)
    w = 3.0
    fourier = 2 / (pi * w) * sin(w * DT / 2) ** 2  # (5.6) corrected
    assert PULSES.density(w) == close(2 * pi * RATE * SIGMA**2 * fourier**2)  # (5.20)


def test_one_pulse():
    beta = 4 / A
    r = theory.pulse_response(ss.Coulomb(slip_level=A), b=4.0, dt=DT)
    assert r.offset == close(-A * DT**2 * beta * (beta - 1) ** 2 / (beta + 1) ** 2)  # (5.8)
    square = beta * (beta - 1) ** 2 / (beta + 1) * (1 + 4 / (beta + 1) ** 2)
    assert r.velocity_square == close(2 / 3 * A**2 * DT**3 * square)  # (5.32)
    assert r.peak == close(A * DT**2 * beta * (beta - 1) / (beta + 1))
    turn = 2 * DT * beta / (beta + 1)
    assert r.stop == close(2 * turn)
    times = [0.5 * DT, (DT + turn) / 2, (turn + 2 * DT) / 2, DT + turn, 3 * turn]  # (5.7)
    v = theory.pulse_response(ss.Coulomb(slip_level=A), b=4.0, dt=DT, times=times).velocity
    assert -v[0] == close((4 - A) * times[0])
    assert -v[1] == close((4 - A) * DT - (4 + A) * (times[1] - DT))
    assert -v[2] == close(-(4 - A) * (times[2] - turn))
    assert -v[3] == close(-(4 - A) * (2 * DT - turn) + A * (times[3] - 2 * DT))
    assert v[4] == 0
    r = theory.viscous_pulse_response(2.0, b=1.5, dt=1.0, times=[2.7])
    assert r.velocity[0] == close(1.5 / 2 * exp(-5.4) * (1 - exp(2)) ** 2)  # (5.14)
    assert r.displacement[0] == close(-1.5 / 4 * exp(-5.4) * (1 - exp(2)) ** 2)  # (5.15) corrected


@pytest.mark.parametrize("overlap", ["none", "renewal", "thesis"])
def test_many_pulses(overlap):
    def h(s):  # (5.35)
        return (2 / 3 * sqrt(2 / pi)) * integral(
            lambda b: (
                b * (b - 1) ** 2 / (b + 1) * (1 + 4 / (b + 1) ** 2) * exp(-((b / s) ** 2) / 2)
            ),
            1,
            1 + 12 * s,
        )

    def g(s):  # (5.41)
        return sqrt(2 / pi) * integral(
            lambda b: (b * (b - 1) ** 2 / (b + 1) ** 2) ** 2 * exp(-((b / s) ** 2) / 2),
            1,
            1 + 12 * s,
        )

    sigma_b, p = SIGMA / A, RATE * DT
    of_velocity = RATE * A**2 * DT**3 / sigma_b
    of_growth = RATE * A**2 * DT**4 / sigma_b
    if overlap == "none":
        velocity, growth = of_velocity * h(sigma_b), of_growth * g(sigma_b)  # (5.34), (5.40)
    else:  # (5.54), (5.55), with the printed rate and the corrected one
        factor = exp(-p) / (1 + p if overlap == "renewal" else 1)
        terms = [(p**m / factorial(m) / sqrt(m + 1), sqrt(m + 1) * sigma_b) for m in range(20)]
        velocity = factor * of_velocity * sum(weight * h(s) for weight, s in terms)
        growth = factor * of_growth * sum(weight * g(s) for weight, s in terms)
    moments = theory.PulseSuperposition(overlap=overlap).predict(
        ss.Coulomb(slip_level=A), PULSES, [1000.0]
    )
    assert moments.velocity_variance[0] == close(velocity, rel=1e-10)
    assert moments.growth_rate.value == close(growth, rel=1e-10)


@pytest.mark.parametrize("ratio", [0.05, 0.5, 2.0])
def test_the_caster(ratio):
    cart = ss.Caster.from_geometry(mu=0.5, trail=0.04, wheel_width=0.04 / ratio)
    w = 0.04 / ratio
    b = 2 * (cart.reach - 0.04) / w  # (A.20) corrected
    moment = (b**2 + 4 * ratio * b) * asinh(1 / b)
    assert moment == close(sqrt(1 + b**2), rel=1e-10)  # (A.12) corrected
    share = cart.slip_level / (0.5 * ss.STANDARD_GRAVITY)
    assert share == close(b * asinh(1 / b), rel=1e-10)  # (A.16) corrected
