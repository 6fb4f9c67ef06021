"""Gaussian excitations: from a spectrum to motions and back, warnings, refusals, values."""

import json
import math
import pickle
import threading
import warnings

import numpy as np
import pytest
import stickslip as ss

EDGE = 20 / math.pi**2  # thesis, figures 4.4 to 4.6
BAND = ss.Spectrum.band_pass(s0=1.0, low=EDGE, high=2 * EDGE)
SOIL = ss.Spectrum.kanai_tajimi(s0=1.0, frequency=15.0, damping=0.6)


def decaying(omega):
    return math.exp(-omega / 5)


def test_the_case_of_the_thesis_gives_no_warning_and_the_reference_variances():
    shaking = ss.GaussianExcitation(BAND, dt=0.1, samples=1024)
    plain = ss.GaussianExcitation(BAND, 0.1, 1024, correct_interpolation=False)
    assert shaking.variance == pytest.approx(4.116216534553666, rel=1e-14)  # mc.fig44.pre2
    assert plain.variance == pytest.approx(4.049709280018092, rel=1e-14)  # mc.fig44.pre0
    assert shaking.lines == 33
    assert shaking.effective_lines == pytest.approx(33, rel=1e-4)
    assert shaking.line_spacing == pytest.approx(2 * math.pi / 102.4)
    assert shaking.lost_variance == 0


def test_samples_have_the_spectrum_line_by_line():
    e = ss.GaussianExcitation(SOIL, dt=0.05, samples=400, correct_interpolation=False)
    n = e.sample(seed=3, member=1).acceleration
    found = np.abs(np.fft.rfft(n) / 400) ** 2
    omega = e.line_spacing * np.arange(201)
    target = SOIL(omega) * e.line_spacing  # on each side of the line
    assert found[1:200] == pytest.approx(target[1:200], rel=1e-11)
    assert found[0] == pytest.approx(0, abs=1e-28)
    corrected = ss.GaussianExcitation(SOIL, dt=0.05, samples=400).sample(seed=3, member=1)
    more = np.abs(np.fft.rfft(corrected.acceleration) / 400) ** 2
    sinc = np.sinc(omega * 0.05 / 2 / math.pi)
    assert (more[1:200] * sinc[1:200] ** 4) == pytest.approx(target[1:200], rel=1e-11)


def test_a_sample_is_a_ground_motion_and_the_same_for_ever():
    e = ss.GaussianExcitation(BAND, dt=0.1, samples=1000, interpolation="constant")
    motion = e.sample(seed=1, member=7)
    assert (len(motion), motion.dt, motion.interpolation) == (1000, 0.1, "constant")
    assert motion.duration == e.duration
    assert motion.name == "seed 1, member 7"
    assert np.array_equal(motion.acceleration, e.sample(member=7, seed=1).acceleration)
    for seed, member in ((1, 8), (2, 7), (2**64 - 1, 2**64 - 1)):
        other = e.sample(seed=seed, member=member).acceleration
        assert not np.array_equal(motion.acceleration, other)
    r = ss.integrate(ss.Coulomb(slip_level=1.0), motion)
    assert r.peak > 0


def test_threads_make_the_same_motions():
    e = ss.GaussianExcitation(BAND, dt=0.1, samples=1024)
    expected = [e.sample(seed=1, member=m).acceleration for m in range(50)]
    same = []

    def check():
        same.append(
            all(
                np.array_equal(e.sample(seed=1, member=m).acceleration, expected[m])
                for m in range(50)
            )
        )

    threads = [threading.Thread(target=check) for _ in range(4)]
    for t in threads:
        t.start()
    for t in threads:
        t.join()
    assert same == [True] * 4


def test_options_do_what_they_say():
    plain = dict(dt=0.05, samples=256, correct_interpolation=False)
    whole = ss.GaussianExcitation(SOIL, **plain)
    assert abs(whole.sample(seed=1, member=1).acceleration.mean()) < 1e-14
    longer = ss.GaussianExcitation(SOIL, **plain, period=1024)
    assert abs(longer.sample(seed=1, member=1).acceleration.mean()) > 1e-3
    assert longer.period == 1024
    constant = ss.GaussianExcitation(SOIL, **plain, zero_frequency=True)
    assert abs(constant.sample(seed=1, member=1).acceleration.mean()) > 1e-3
    assert constant.lines == whole.lines + 1

    def variances(e):
        return [np.mean(e.sample(seed=1, member=m).acceleration ** 2) for m in range(10)]

    # The Nyquist line alone differs from member to member.
    assert np.ptp(variances(whole)) < 2 * SOIL(math.pi / 0.05) * whole.line_spacing * 1.001
    random = ss.GaussianExcitation(SOIL, **plain, random_amplitudes=True)
    assert np.ptp(variances(random)) > 0.05 * random.variance

    envelope = ss.Envelope(build_up=2, strong_duration=3, decay_rate=0.5)
    shaped = ss.GaussianExcitation(SOIL, **plain, envelope=envelope)
    t = np.arange(256) * 0.05
    assert shaped.envelope == envelope
    assert np.array_equal(
        shaped.sample(seed=1, member=1).acceleration,
        whole.sample(seed=1, member=1).acceleration * envelope(t),
    )


def test_a_refined_motion_passes_through_the_coarse_samples():
    coarse = ss.GaussianExcitation(SOIL, dt=0.05, samples=256, correct_interpolation=False)
    fine = coarse.refined(2).refined(4)
    assert fine == coarse.refined(8)
    assert fine.refinement == 8
    assert fine.samples == 8 * 255 + 1
    assert fine.dt == 0.05 / 8
    n, m = (e.sample(seed=1, member=1).acceleration for e in (coarse, fine))
    assert m[::8] == pytest.approx(n, abs=1e-12)


def test_the_interpolation_error_of_a_response_vanishes():
    coarse = ss.GaussianExcitation(BAND, dt=0.1, samples=1024)
    law = ss.Coulomb(slip_level=1.0)
    residual = [
        ss.integrate(law, coarse.refined(f).sample(seed=1, member=3)).displacement[::f]
        for f in (1, 4, 16, 64)
    ]
    errors = [np.max(np.abs(x - residual[-1])) for x in residual[:-1]]
    assert errors[0] > 4 * errors[1] > 16 * errors[2]


def test_white_noise_of_all_lines_has_variance_2_pi_s0_over_dt():
    e = ss.GaussianExcitation(
        ss.Spectrum.white(s0=0.7),
        dt=0.1,
        samples=64,
        interpolation="constant",
        correct_interpolation=False,
        random_amplitudes=True,
        zero_frequency=True,
    )
    assert e.variance == pytest.approx(2 * math.pi * 0.7 / 0.1, rel=1e-13)
    assert e.lost_variance == 1


# ---- warnings


def test_too_few_lines_give_a_warning_with_numbers():
    narrow = ss.Spectrum.band_pass(s0=1.0, low=EDGE, high=EDGE + 0.2)
    with pytest.warns(UserWarning) as record:
        few = ss.GaussianExcitation(narrow, dt=0.1, samples=1024)
    (warning,) = record
    assert str(warning.message) == (
        "GaussianExcitation: the spectrum is carried by 3 lines, 3 in effect; the kurtosis of the "
        "motions is 2.5 instead of 3; period=16384 would give at least 30"
    )
    assert warning.filename == __file__
    assert few.lines == 3
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        enough = ss.GaussianExcitation(narrow, dt=0.1, samples=1024, period=16384)
        pickle.loads(pickle.dumps(few))  # who has been warned once knows
        few.refined(2)
    assert enough.effective_lines >= 30


def test_a_warning_can_be_made_an_error():
    narrow = ss.Spectrum.band_pass(s0=1.0, low=EDGE, high=EDGE + 0.2)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        with pytest.raises(UserWarning, match="3 lines"):
            ss.GaussianExcitation(narrow, dt=0.1, samples=1024)


def test_random_amplitudes_are_gaussian_but_still_warned_of():
    narrow = ss.Spectrum.band_pass(s0=1.0, low=EDGE, high=EDGE + 0.2)
    with pytest.warns(UserWarning, match="3 in effect; period=16384"):
        ss.GaussianExcitation(narrow, dt=0.1, samples=1024, random_amplitudes=True)


# ---- rejected arguments


@pytest.mark.parametrize(
    "arguments, message",
    [
        (dict(dt=0), "dt must be positive and finite, got 0 s"),
        (dict(dt=1.0), r"the Nyquist frequency pi / dt = 3\.14.* dt must be at most 0\.77.* got 1"),
        (dict(samples=1), "at least two samples, got 1"),
        (dict(period=1000), "period must be at least samples = 1024, got 1000"),
        (dict(period=0), "period must be positive, got 0"),
        (dict(samples=2), "no line lies in the band .* A period of 32 samples would do, got 2"),
        (dict(interpolation="cubic"), "'linear' or 'constant', got 'cubic'"),
    ],
)
def test_what_is_refused_is_named_with_its_value(arguments, message):
    with pytest.raises(ValueError, match="^GaussianExcitation: .*" + message):
        ss.GaussianExcitation(BAND, **{"dt": 0.1, "samples": 1024, **arguments})


@pytest.mark.parametrize("seed, member", [(-1, 0), (0, -1), (2**64, 0), (0.5, 0), ("1", 0)])
def test_seeds_and_members_are_whole_numbers_of_64_bits(seed, member):
    with pytest.raises(TypeError):
        ss.GaussianExcitation(BAND, dt=0.1, samples=1024).sample(seed=seed, member=member)


def test_a_refinement_of_nothing_is_refused():
    with pytest.raises(ValueError, match="refinement must be at least 1, got 0"):
        ss.GaussianExcitation(BAND, dt=0.1, samples=1024).refined(0)


# ---- values

EXCITATIONS = [
    ss.GaussianExcitation(BAND, dt=0.1, samples=1024),
    ss.GaussianExcitation(BAND, dt=0.1, samples=1023),
    ss.GaussianExcitation(BAND, dt=0.1, samples=1024, period=2048, interpolation="constant"),
    ss.GaussianExcitation(
        SOIL,
        dt=0.02,
        samples=300,
        correct_interpolation=False,
        random_amplitudes=True,
        zero_frequency=True,
        envelope=ss.Envelope(build_up=1, strong_duration=2, decay_rate=0.5),
    ),
    ss.GaussianExcitation(SOIL, dt=0.02, samples=300).refined(3),
    ss.GaussianExcitation(ss.Spectrum.from_function(decaying, high=20.0), dt=0.1, samples=512),
]


# A function's address is another in each process that pytest-xdist starts.


def test_a_configuration_is_all_that_the_motions_depend_on():
    e = EXCITATIONS[3]
    c = json.loads(e.configuration)
    assert c["excitation"] == "GaussianExcitation"
    assert c["spectrum"] == {"kind": "kanai_tajimi", "s0": 1, "frequency": 15, "damping": 0.6}
    assert (c["dt"], c["samples"], c["period"], c["refinement"]) == (0.02, 300, 300, 1)
    assert c["envelope"]["strong_duration"] == 2
    assert len({e.configuration for e in EXCITATIONS}) == len(EXCITATIONS)
