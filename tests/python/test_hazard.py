"""Hazard curves and rates of exceedance: closed forms, files, limits."""

import itertools
import json
import math
import warnings

import numpy as np
import pytest
import stickslip as ss
from test_fragility import LEVELS, simulated

integrate = pytest.importorskip("scipy.integrate")
stats = pytest.importorskip("scipy.stats")

pytestmark = pytest.mark.filterwarnings("ignore:Fragility.*extrapolated")


@pytest.fixture(scope="module")
def fragility():
    return ss.Fragility.fit(simulated(1, records=40), im="pga_g", thresholds=[0.05, 0.1])


def power_law(k0, k, low=1e-3, high=1e3, count=7):
    im = np.geomspace(low, high, count)
    return ss.Hazard(im, k0 * im**-k, name="pga_g", unit="g")


@pytest.mark.parametrize("k", [0.5, 1.7, 3.0, 8.0])
def test_a_power_law_has_the_closed_form(fragility, k):
    h = fragility.rate_of_exceedance(power_law(1e-4, k))
    exact = 1e-4 * fragility.median**-k * np.exp((k * fragility.beta) ** 2 / 2)
    assert h.rate == pytest.approx(exact, rel=1e-10)
    assert h.probability(50) == pytest.approx(-np.expm1(-50 * exact), rel=1e-10)
    assert h.probability(0) == pytest.approx(0, abs=0)
    # Where the points do not reach, the slope is extrapolated: the same rate, with a share beyond.
    with pytest.warns(RuntimeWarning, match=r"% of the rate for 0\.\d+ m comes from beyond"):
        short = fragility.rate_of_exceedance(power_law(1e-4, k, 0.3, 0.5, 2))
    assert short.rate == pytest.approx(exact, rel=1e-10)
    shift = np.log(fragility.median) - k * fragility.beta**2
    scores = (np.log([[0.3], [0.5]]) - shift) / fragility.beta
    below, above = stats.norm.cdf(scores)
    im = np.array([0.3, 0.5])
    edge = 1e-4 * im[:, np.newaxis] ** -k * fragility.probability(im).T / exact
    assert short.beyond == pytest.approx(below - edge[0] + 1 - above + edge[1], abs=1e-9)


def kinked():
    return ss.Hazard([0.01, 0.05, 0.2, 0.5, 1.5, 4.0], [0.3, 0.05, 3e-3, 4e-4, 1e-5, 2e-8])


@pytest.mark.parametrize("method", ["lognormal", "logit", "cloud"])
def test_the_integral_is_that_of_a_quadrature(method):
    f = ss.Fragility.fit(
        simulated(2, records=40), im="pga_g", thresholds=[0.05, 0.1], method=method
    )
    hazard = kinked()
    h = f.rate_of_exceedance(hazard)
    u = np.log(hazard.im)

    def integrand(x, i):
        k = hazard.slopes[np.clip(np.searchsorted(u, x) - 1, 0, len(u) - 2)]
        return f.probability(math.exp(x))[i] * k * hazard.at(math.exp(x))

    edges = [-9, *u, 9]
    for i in range(2):
        parts = [
            integrate.quad(integrand, a, b, args=(i,), epsabs=1e-16, epsrel=1e-11)[0]
            for a, b in itertools.pairwise(edges)
        ]
        assert h.rate[i] == pytest.approx(sum(parts), rel=1e-7)
        assert h.beyond[i] == pytest.approx((parts[0] + parts[-1]) / sum(parts), abs=1e-7)


def test_steep_curves_and_small_dispersions_stay_finite(fragility):
    for k, reach in ((40.0, 1e4), (15.0, 300.0)):
        im = np.geomspace(1 / reach, reach, 20)
        with np.errstate(all="raise", under="ignore"):
            h = fragility.rate_of_exceedance(ss.Hazard(im, np.exp(-k * np.log(im) - 30)))
        exact = np.exp(-30 - k * np.log(fragility.median) + (k * fragility.beta) ** 2 / 2)
        assert h.rate == pytest.approx(exact, rel=1e-8)


def test_a_curve_is_linear_in_logarithms_between_and_beyond_its_points():
    hazard = ss.Hazard([0.1, 0.4, 0.8], [1e-2, 1e-3, 1e-4])
    assert hazard.at([0.1, 0.4, 0.8]) == pytest.approx([1e-2, 1e-3, 1e-4], rel=1e-12)
    assert hazard.at(0.2) == pytest.approx(math.sqrt(1e-5), rel=1e-12)
    assert hazard.at(0.05) == pytest.approx(1e-2 * math.sqrt(10), rel=1e-12)
    assert hazard.at(1.6) == pytest.approx(1e-5, rel=1e-12)
    assert "3 points, 0.01/year at 0.1" in repr(hazard)
    # Part of a curve may be flat: all earthquakes exceed a small intensity.
    assert ss.Hazard([0.01, 0.1, 0.4], [1e-2, 1e-2, 1e-3]).at(0.001) == pytest.approx(1e-2)


def test_curves_that_do_not_decrease_are_refused():
    for im, rate, why in (
        ([0.1, 0.2, 0.4], [1e-2, 2e-2, 1e-3], r"must decrease.*0.01 at 0.1 and 0.02 at 0.2"),
        ([0.1, 0.2, 0.4], [1e-2, 1e-3, 1e-3], "at both of the last points"),
        ([0.1, 0.1], [1e-2, 1e-3], "im must increase, got 0.1 before 0.1"),
        ([0, 0.1], [1e-2, 1e-3], "im must be positive and finite, got 0"),
        ([0.1, 0.2], [1e-2, 0], "rate must be positive and finite, got 0 1/year"),
        ([0.1, 0.2], [math.nan, 1e-3], "rate must be positive and finite, got nan"),
        ([0.1], [1e-2], "two lists of equal length, at least 2"),
        ([0.1, 0.2], [1e-2], "two lists of equal length"),
    ):
        with pytest.raises(ValueError, match=f"Hazard: .*{why}"):
            ss.Hazard(im, rate)
    with pytest.raises(ValueError, match="im must be positive, got 0"):
        kinked().at(0)


def test_a_fragility_and_a_hazard_of_different_measures_do_not_go_together(fragility):
    with pytest.raises(TypeError, match="hazard must be a Hazard"):
        fragility.rate_of_exceedance([0.1, 0.2])
    with pytest.raises(ValueError, match="the hazard curve is of pgv, the fragility of pga_g"):
        fragility.rate_of_exceedance(ss.Hazard([0.1, 1], [1e-2, 1e-4], name="pgv"))
    with pytest.raises(ValueError, match="years must be at least 0"):
        fragility.rate_of_exceedance(power_law(1e-4, 2)).probability(-1)


# ---- files


def test_two_columns(tmp_path):
    for text in (
        "PGA (g),annual rate\n0.1,1e-2\n0.4,1e-3\n",
        "# im rate\n0.1 1e-2\n0.4\t1e-3\n\n",
        "0.1;1e-2\n0.4;1e-3",
    ):
        (tmp_path / "h.csv").write_text(text)
        hazard = ss.read_hazard(tmp_path / "h.csv")
        assert hazard == ss.Hazard([0.1, 0.4], [1e-2, 1e-3])
    (tmp_path / "h.csv").write_text("0.1,0.5\n0.4,0.1\n0.8,0\n")
    hazard = ss.read_hazard(tmp_path / "h.csv", years=50)
    assert hazard.rate == pytest.approx([math.log(2) / 50, -math.log(0.9) / 50], rel=1e-14)
    for text, why in (
        ("0.1,1e-2,3\n0.4,1e-3,4", "needs two columns"),
        ("im,rate\n0.1,1e-2", "at least 2 rows of numbers, got 1"),
        ("0.1,1e-3\n0.4,1e-2", "rates must decrease"),
        ("0.1,-1e-3\n0.4,1e-2", "a rate must be at least 0"),
    ):
        (tmp_path / "h.csv").write_text(text)
        with pytest.raises(ValueError, match=rf"read_hazard: '.*h.csv': .*{why}"):
            ss.read_hazard(tmp_path / "h.csv")
    (tmp_path / "h.csv").write_text("0.1,1.2\n0.4,0.1")
    with pytest.raises(ValueError, match=r"a probability must lie between 0 and 1, got 1\.2"):
        ss.read_hazard(tmp_path / "h.csv", years=50)


OPENQUAKE = """\
#,,,,,,"generated_by='OpenQuake engine 3.16.3', start_date='2023-05-01T10:00:00', checksum=1, \
kind='mean', investigation_time=50.0, imt='{}'"
lon,lat,depth,poe-0.0050000,poe-0.1000000,poe-0.4000000,poe-1.0000000
10.00000,45.00000,0.00000,1.000000E+00,3.934693E-01,9.516258E-02,4.987521E-03
11.00000,45.00000,0.00000,1.000000E+00,1.934693E-01,2.516258E-02,0.000000E+00
"""


def test_openquake_curves(tmp_path):
    file = tmp_path / "hazard_curve-mean-PGA.csv"
    file.write_text(OPENQUAKE.format("PGA"))
    hazard = ss.read_hazard(file, site=0)
    assert hazard.im.tolist() == [0.1, 0.4, 1.0]  # a probability of 1 has no rate
    assert hazard.rate == pytest.approx([0.01, 0.002, 1e-4], rel=1e-6)
    assert (hazard.name, hazard.unit) == ("pga_g", "g")
    assert ss.read_hazard(file, site=(11, 45)).im.tolist() == [0.1, 0.4]
    with pytest.raises(ValueError, match="has 2 sites; give site="):
        ss.read_hazard(file)
    with pytest.raises(ValueError, match="has 2 sites, got site=2"):
        ss.read_hazard(file, site=2)
    with pytest.raises(ValueError, match=r"has 0 sites at \(12, 45\)"):
        ss.read_hazard(file, site=(12, 45))
    file.write_text(OPENQUAKE.format("SA(1.0)"))
    hazard = ss.read_hazard(file, site=0)
    assert (hazard.name, hazard.period) == ("sa_g", 1.0)
    file.write_text(OPENQUAKE.format("PGV"))
    assert ss.read_hazard(file, site=0).im == pytest.approx([1e-3, 4e-3, 1e-2])
    file.write_text("\n".join(OPENQUAKE.splitlines()[1:3]))
    with pytest.raises(ValueError, match="does not state investigation_time; give years="):
        ss.read_hazard(file)
    assert ss.read_hazard(file, years=50).rate[0] == pytest.approx(0.01, rel=1e-6)


def usgs(first):
    """The JSON of both generations of the hazard service."""
    x, y = [0.1, 0.4, 1.0], [1e-2, 1e-3, 0.0]
    if first:
        curve = {
            "metadata": {"imt": {"value": "PGA"}, "xvalues": x},
            "data": [
                {"component": "Fault", "yvalues": [1, 1, 1]},
                {"component": "Total", "yvalues": y},
            ],
        }
        other = {
            "metadata": {"imt": {"value": "SA1P0"}, "xvalues": x},
            "data": [{"component": "Total", "yvalues": y}],
        }
        return {"status": "success", "response": [curve, other]}
    data = [{"component": "Total", "values": {"xs": x, "ys": y}}]
    curves = [{"imt": {"value": name}, "data": data} for name in ("PGA", "SA1P0")]
    return {"status": "success", "response": {"metadata": {}, "hazardCurves": curves}}


@pytest.mark.parametrize("first", [True, False])
def test_usgs_curves(tmp_path, first):
    file = tmp_path / "hazard.json"
    file.write_text(json.dumps(usgs(first)))
    hazard = ss.read_hazard(file, imt="PGA")
    assert hazard == ss.Hazard([0.1, 0.4], [1e-2, 1e-3], name="pga_g", unit="g")
    assert ss.read_hazard(file, imt="SA1P0").period == 1.0
    with pytest.raises(ValueError, match="has curves of PGA, SA1P0; give imt="):
        ss.read_hazard(file)
    with pytest.raises(ValueError, match="has no curve of PGV; it has PGA, SA1P0"):
        ss.read_hazard(file, imt="PGV")
    file.write_text('{"response": {}}')
    with pytest.raises(ValueError, match="has no hazard curve"):
        ss.read_hazard(file)


def static_usgs(edition, points=1):
    """A static curve of the hazard tool: no components, one set of rates for each grid point."""
    return {
        "metadata": {
            "edition": {"id": 3, "value": edition, "display": "NSHM"},
            "latitude": 34.005,
            "longitude": -118.005,
            "imt": {"id": 1, "value": "PGA", "display": "Peak Ground Acceleration"},
            "vs30": {"id": 3, "value": "760"},
            "xlabel": "Ground Motion (g)",
            "ylabel": "Annual Frequency of Exceedence",
            "xvals": [0.1, 0.4, 1.0],
        },
        "data": [
            {"id": i, "datasetid": 6, "latitude": 34 + 0.05 * i, "longitude": -118, "yvals": y}
            for i, y in zip(range(points), ([1e-2, 1e-3, 0.0], [2e-2, 2e-3, 1e-4]))
        ],
    }


def test_static_usgs_curves(tmp_path):
    file = tmp_path / "hazard.json"
    file.write_text(json.dumps({"status": "success", "response": [static_usgs("E2014R1")]}))
    assert ss.read_hazard(file) == ss.Hazard([0.1, 0.4], [1e-2, 1e-3], name="pga_g", unit="g")


@pytest.mark.parametrize(
    "curves",
    [
        [static_usgs("E2014R1", points=2)],
        [static_usgs("E2008R3"), static_usgs("E2014R1")],
        [usgs(True)["response"][0], usgs(True)["response"][0]],
    ],
)
def test_usgs_curves_of_several_editions_or_places_are_refused(tmp_path, curves):
    """None of them is chosen silently."""
    file = tmp_path / "hazard.json"
    file.write_text(json.dumps({"status": "success", "response": curves}))
    with pytest.raises(ValueError, match="has 2 curves of PGA, of several editions or places"):
        ss.read_hazard(file)


def test_deep_nesting_and_many_points(tmp_path):
    file = tmp_path / "hazard.json"
    for text in ("[" * 200_000, '{"response":' * 200_000):
        file.write_text(text)
        with pytest.raises(ValueError, match=r"hazard.json': is nested too deeply"):
            ss.read_hazard(file)
    im = np.geomspace(1e-4, 10, 200_000)
    rate = 1e-4 * im**-2.0
    file.write_text("\n".join(f"{a!r},{b!r}" for a, b in zip(im.tolist(), rate.tolist())))
    hazard = ss.read_hazard(file)  # some tenths of a second
    assert hazard.im.tolist() == im.tolist()
    assert hazard.rate.tolist() == rate.tolist()


def test_rates_are_a_table_and_a_picture(fragility):
    h = fragility.rate_of_exceedance(power_law(1e-4, 2))
    frame = pytest.importorskip("pandas") and h.to_dataframe()
    assert frame["rate"].tolist() == h.rate.tolist()
    assert frame.attrs["units"]["rate"] == "1/year"
    assert "/year" in repr(h)
    pytest.importorskip("matplotlib")
    (axes,) = h.plot().axes
    # The area under the contributions is one: a solid line, and two dashed ones beyond the stripes.
    area = {}
    for line in axes.get_lines()[:6]:
        x, y = line.get_data()
        area.setdefault(line.get_color(), []).append(np.trapezoid(y, np.log(x)))
    assert [sum(parts) for parts in area.values()] == pytest.approx([1, 1], abs=0.01)
    for i, parts in enumerate(area.values()):
        assert sum(parts[1:]) == pytest.approx(h.extrapolated[i], abs=0.01)


def test_the_share_from_beyond_the_stripes_is_that_of_the_integral(fragility):
    """Trapezoids between the ends of the stripes, and over all intensities."""
    k, (low, high) = 2.0, fragility.im_range
    h = fragility.rate_of_exceedance(power_law(1e-4, k))
    for i in range(2):
        m, beta = math.log(fragility.median[i]), fragility.beta[i]
        u = np.linspace(m - 12 * beta, m + 12 * beta, 400_001)
        part = stats.norm.cdf((u - m) / beta) * k * 1e-4 * np.exp(-k * u)
        inside = (u >= math.log(low)) & (u <= math.log(high))
        share = 1 - np.trapezoid(part * inside, u) / np.trapezoid(part, u)
        assert h.extrapolated[i] == pytest.approx(share, abs=1e-4)  # a step of 1e-5 at each end
    # Ends of the stripes at points of the hazard curve, or far from them, change no rate.
    im = np.geomspace(low, high, 7)
    same = fragility.rate_of_exceedance(ss.Hazard(im, 1e-4 * im**-k))
    assert same.rate == pytest.approx(h.rate, rel=1e-12)
    assert same.extrapolated == pytest.approx(h.extrapolated, rel=1e-9)


def test_a_rate_from_beyond_the_stripes_is_marked():
    f = ss.Fragility.fit(simulated(1, levels=LEVELS[:6]), im="pga_g", thresholds=[0.1, 0.15])
    with pytest.warns(
        ss.regressions.RangeWarning,
        match=r"\d+ % of the rate for 0.15 m comes from outside .* 0.1 to",
    ):
        h = f.rate_of_exceedance(power_law(1e-4, 0.5))
    assert "% extrapolated)" in repr(h)


def test_a_logistic_curve_under_a_steep_hazard_has_no_rate():
    """The tail of the curve falls as IM^(pi/(sqrt(3) beta)), the hazard rises as IM^-k."""
    f = ss.Fragility.fit(simulated(5, 400), im="pga_g", thresholds=0.1, method="logit")
    tail = math.pi / (math.sqrt(3) * f.beta[0])
    im = np.array([0.01, 1.0])
    with pytest.raises(ValueError, match=r"has no bound.*use method='lognormal'"):
        f.rate_of_exceedance(ss.Hazard(im, (im / im[0]) ** -(tail + 0.1)))
    assert f.rate_of_exceedance(ss.Hazard(im, (im / im[0]) ** -(tail - 1.0))).rate[0] > 0


def test_a_logistic_curve_is_integrated_to_the_end_of_its_tail():
    """Under IM^-k the rate is k0 theta^-k x/sin(x), x = pi k/t, with the tail's exponent t > k.

    The nearer k is to t, the more of it comes from the smallest intensities.
    """
    f = ss.Fragility.fit(simulated(5, 400), im="pga_g", thresholds=[0.1, 0.2], method="logit")
    tail = math.pi / (math.sqrt(3) * f.beta)
    for first in (1e-9, 0.01):  # of the hazard curve: below all that matters, or in the tail
        im = np.array([first, 1.0])
        for less in (2.0, 0.5, 0.1, 0.001):
            k = tail.min() - less
            x = math.pi * k / tail
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")  # much comes from beyond the points
                h = f.rate_of_exceedance(ss.Hazard(im, im**-k))
            # k cancels in t - k to 1e-16 t/less.
            assert h.rate == pytest.approx(f.median**-k * x / np.sin(x), rel=1e-9)


SHORT = "#,,\"investigation_time=1.0, imt='PGA'\"\nlon,lat,depth,poe-0.1,poe-0.2\n"


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("im,rate\n0.1,1e-2\n0.3\n1,1e-4\n", "line 3: needs two columns"),
        ("0.1 1e-2\n0.3 a\n1 1e-4\n", r"line 2: 'a' is no number"),
        ("0.1 1e-2 7\n0.3 1e-3 7\n", "line 1: needs two columns"),
        ("{", "is no JSON document"),
        ('{"response": [3]}', "has no hazard curve where the JSON"),
        ('[{"imt": "PGA"}]', "has no hazard curve where the JSON"),
        (
            SHORT + "1,2,0,0.1\n",
            "line 3: has 4 values where the head has 5",
        ),
        (
            SHORT + "1,2,0,0.1,x\n",
            "line 3: 'x' is no number",
        ),
    ],
)
def test_a_line_that_does_not_belong_in_a_hazard_file_is_named(tmp_path, text, message):
    file = tmp_path / "hazard.txt"
    file.write_text(text)
    with pytest.raises(ValueError, match=message):
        ss.read_hazard(file)


def test_a_hazard_file_may_have_a_head_and_comments(tmp_path):
    file = tmp_path / "hazard.txt"
    file.write_text("PGA [g]; rate\n# from a site study\n0.1; 1e-2\n\n1; 1e-4\n")
    assert ss.read_hazard(file).rate.tolist() == [1e-2, 1e-4]
    file.write_bytes(b"\xff\xfe\x00\x80")
    with pytest.raises(ValueError, match="is not a text file"):
        ss.read_hazard(file)
    with pytest.raises(TypeError, match="path must be a path, got int"):
        ss.read_hazard(3)


@pytest.mark.parametrize(
    ("text", "arguments", "message"),
    [
        (
            "0.1 1e-2\n1 1e-4\n",
            {"imt": "PGA"},
            "imt='PGA' has no meaning for a file of two columns",
        ),
        ("0.1 1e-2\n1 1e-4\n", {"site": 0}, "site=0 has no meaning for a file of two columns"),
        ("[]", {"years": 50}, "years=50 has no meaning for the JSON"),
        (
            "lon,lat,depth,poe-0.1\n1,2,0,0.1\n",
            {"imt": "PGA"},
            "imt='PGA' has no meaning for a file of O",
        ),
    ],
)
def test_an_argument_that_a_kind_of_hazard_file_has_no_use_for_is_refused(
    tmp_path, text, arguments, message
):
    file = tmp_path / "hazard.txt"
    file.write_text(text)
    with pytest.raises(ValueError, match=message):
        ss.read_hazard(file, **arguments)


def test_units_and_names_of_hazard_and_fragility_must_agree(fragility):
    with pytest.raises(ValueError, match=r"the hazard curve is in m/s\^2, the fragility in g"):
        fragility.rate_of_exceedance(ss.Hazard([0.1, 10], [1e-2, 1e-5], name="pga_g", unit="m/s^2"))
    with pytest.raises(ValueError, match="is of PGA, the fragility of pga_g; give name='pga_g'"):
        fragility.rate_of_exceedance(ss.Hazard([0.1, 10], [1e-2, 1e-5], name="PGA"))
    with pytest.raises(ValueError, match="Hazard: im must hold real numbers"):
        ss.Hazard(["a", "b"], [1e-2, 1e-5])


def test_a_file_of_openquake_states_its_time(tmp_path):
    file = tmp_path / "hazard.csv"
    file.write_text(SHORT + "1,2,0,0.1,0.01\n")
    assert ss.read_hazard(file, years=1) == ss.read_hazard(file)
    with pytest.raises(ValueError, match="states investigation_time=1 years, got years=50"):
        ss.read_hazard(file, years=50)


def test_measures_of_openquake_that_have_other_units_or_no_name_here(tmp_path, fragility):
    file = tmp_path / "hazard.csv"
    file.write_text(SHORT.replace("PGA", "CAV") + "1,2,0,0.1,0.01\n")
    hazard = ss.read_hazard(file)  # in g s there
    assert (hazard.name, hazard.unit) == ("cav", "m/s")
    assert hazard.im == pytest.approx([0.980665, 1.96133], rel=1e-12)
    file.write_text(SHORT.replace("PGA", "MMI") + "1,2,0,0.1,0.01\n")
    hazard = ss.read_hazard(file)
    assert hazard.name == "MMI"
    with pytest.raises(ValueError, match="the hazard curve is of MMI, the fragility of pga_g"):
        fragility.rate_of_exceedance(hazard)


def test_arguments_of_hazards_of_a_wrong_type_are_named(tmp_path, fragility):
    hazard = ss.Hazard([0.1, 10], [1e-2, 1e-5])
    file = tmp_path / "hazard.csv"
    file.write_text(SHORT + "1,2,0,0.1,0.01\n")
    two = tmp_path / "two.txt"
    two.write_text("0.1 1e-2\n1 1e-4\n")
    with pytest.raises(TypeError, match=r"Exceedances.probability: years must be a number, got '5"):
        fragility.rate_of_exceedance(hazard).probability("50")
    with pytest.raises(ValueError, match=r"Hazard.at: im must hold real numbers, got 'a'"):
        hazard.at("a")
    with pytest.raises(TypeError, match="read_hazard: years must be a number, got '50'"):
        ss.read_hazard(two, years="50")
    for site in (5.0, "0", (10.0,)):
        with pytest.raises(
            TypeError, match=r"read_hazard: site must be a row or \(lon, lat\), got"
        ):
            ss.read_hazard(file, site=site)
    with pytest.raises(TypeError, match="Hazard: period must be a number, got '1'"):
        ss.Hazard([0.1, 1], [1e-2, 1e-3], period="1")
    with pytest.raises(TypeError, match="Hazard: name must be a string, got 3"):
        ss.Hazard([0.1, 1], [1e-2, 1e-3], name=3)
