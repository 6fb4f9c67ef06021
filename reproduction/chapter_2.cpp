// Harmonic ground motion: figures 2.1 to 2.6.
#include <algorithm>
#include <limits>
#include <numbers>
#include <optional>
#include <stickslip/friction/caster.hpp>
#include <stickslip/friction/coulomb.hpp>
#include <stickslip/ground/harmonic_motion.hpp>
#include <stickslip/harmonic/continuation.hpp>
#include <stickslip/harmonic/orbits.hpp>
#include <stickslip/numerics/root.hpp>
#include <stickslip/sliding/integrate.hpp>
#include <stickslip/theory/slowly_varying_parameters.hpp>

#include "reproduction/figures.hpp"

namespace stickslip::detail {

namespace {

constexpr double four_over_pi = 4 / std::numbers::pi;
constexpr double sqrt_half = std::numbers::sqrt2 / 2;

using theory::SlowlyVaryingParameters;

std::string ratio(double b) { return "$B/a = " + number(b) + "$"; }

// The amplitude of a block's orbit under B cos(omega t), a = 1.
double block_amplitude(const Slider<Coulomb>& slider, double b, double omega) {
  const std::vector<Orbit> found = orbits(slider, b, omega);
  return found.empty() ? std::numeric_limits<double>::infinity() : found.back().amplitude;
}

// The frequencies of amplitude A by averaging: the lower branch and the upper one, where they are real.
void add_branches(ThesisPanel& panel, const SlowlyVaryingParameters& svp, double b, double least, double most) {
  ThesisCurve upper{ratio(b), Kind::thesis, {}, {}}, lower = upper;
  for (const double amplitude : geometric(std::max(least, svp.min_amplitude(b) * (1 + 1e-9)), most, 240)) {
    const theory::Branches omega = svp.frequency(b, amplitude);
    for (auto [curve, value] : {std::pair{&upper, omega.upper}, std::pair{&lower, omega.lower}})
      if (std::isfinite(value)) {
        curve->x.push_back(value);
        curve->y.push_back(amplitude);
      } else if (!curve->x.empty()) {  // the branch is cut in two where omega^2 would be negative
        panel.curves.push_back(std::exchange(*curve, {ratio(b), Kind::thesis, {}, {}}));
      }
  }
  for (ThesisCurve& curve : {std::ref(upper), std::ref(lower)})
    if (!curve.x.empty()) panel.curves.push_back(std::move(curve));
}

// Exact orbits that are connected with `from`, in parts of constant stability.
void add_exact(ThesisPanel& panel, const OrbitBranch& branch, const std::string& label, double omega_unit,
               double amplitude_unit) {
  std::optional<bool> stable;
  for (std::size_t i = 0; i < branch.orbits.size(); ++i) {
    const Orbit& orbit = branch.orbits[i];
    const double x = orbit.omega * omega_unit, y = orbit.amplitude * amplitude_unit;
    // At a fold a multiplier is 1, and round-off decides on which side: the fold belongs to the part before it.
    const bool folds = std::ranges::find(branch.folds, i) != branch.folds.end();
    if (const bool now = folds && stable ? *stable : orbit.stable; stable != now) {
      if (stable) {  // parts share their end points
        panel.curves.back().x.push_back(x);
        panel.curves.back().y.push_back(y);
      }
      stable = now;
      panel.curves.push_back({label, *stable ? Kind::exact : Kind::unstable, {}, {}});
    }
    panel.curves.back().x.push_back(x);
    panel.curves.back().y.push_back(y);
  }
}

// The branches of a caster, a = 3l = 1: the branch of its large orbits, and those not connected with it.
std::vector<OrbitBranch> caster_branches(const Thesis& thesis, const Slider<Caster>& slider, double b,
                                         std::vector<double> starts, double low, double high, double largest) {
  const auto progress = [&] {
    if (thesis.options().progress) thesis.options().progress("exact orbits, B/a = " + number(b), 0);
  };
  const ContinuationOptions options{.max_step = 0.04, .max_amplitude = largest, .progress = progress};
  std::vector<OrbitBranch> branches;
  for (const double omega : starts)
    for (const Orbit& orbit : orbits(slider, b, omega, progress)) {
      const auto passes = [&](const OrbitBranch& branch) {
        // Between two neighbors on the branch that enclose both frequency and amplitude.
        for (std::size_t i = 0; i + 1 < branch.orbits.size(); ++i) {
          const Orbit &p = branch.orbits[i], &q = branch.orbits[i + 1];
          if ((p.omega - orbit.omega) * (q.omega - orbit.omega) > 0) continue;
          const double part = q.omega == p.omega ? 0 : (orbit.omega - p.omega) / (q.omega - p.omega);
          if (std::abs(p.amplitude + part * (q.amplitude - p.amplitude) - orbit.amplitude) < 0.02 * orbit.amplitude)
            return true;
        }
        return false;
      };
      if (orbit.at_rest() || orbit.amplitude > largest || std::ranges::any_of(branches, passes)) continue;
      branches.push_back(continuation(slider, orbit, low, high, options));
    }
  return branches;
}

const Slider<Caster> unit_caster(Caster(1.0, 1.0));

std::vector<OrbitBranch> free_caster_branches(const Thesis& thesis, double b) {
  return caster_branches(thesis, unit_caster, b, {0.2, 0.45, 0.65, 1.2}, 0.15, 3.6, 16);
}

// The zone in which averaged amplitudes are unstable for any force, as an outline.
ThesisCurve unstable_zone(const SlowlyVaryingParameters& svp, std::string label, double omega_unit,
                          double amplitude_unit, double largest) {
  ThesisCurve zone{std::move(label), Kind::region, {}, {}};
  const std::vector<double> amplitudes = geometric(1e-3, largest, 160);
  for (const double amplitude : amplitudes) {
    zone.x.push_back(svp.stability_boundary(amplitude).upper * omega_unit);
    zone.y.push_back(amplitude * amplitude_unit);
  }
  for (auto amplitude = amplitudes.rbegin(); amplitude != amplitudes.rend(); ++amplitude) {
    zone.x.push_back(svp.stability_boundary(*amplitude).lower * omega_unit);
    zone.y.push_back(*amplitude * amplitude_unit);
  }
  return zone;
}

}  // namespace

ThesisFigure figure_2_1(Thesis&) {
  ThesisFigure figure{"2.1",
                      "Amplitude of a Coulomb block against frequency, a = 1 m/s². Dashed: averaged, (2.25). Solid: "
                      "exact periodic motion, which exists for every B > a.",
                      ""};
  ThesisPanel panel{"Coulomb block", "$\\omega$ [rad/s]", "amplitude $A$ [m]"};
  const Slider<Coulomb> block(Coulomb(1.0));
  const SlowlyVaryingParameters svp(block);
  for (const double b : {1.3, 2.0, 4.0, 8.0}) {
    const double averaged = svp.response(b, 1.0).back().amplitude, exact = block_amplitude(block, b, 1.0);
    panel.curves.push_back(
        curve(ratio(b), Kind::thesis, even(0.25, 4, 120), [&](double omega) { return averaged / (omega * omega); }));
    panel.curves.push_back(
        curve(ratio(b), Kind::exact, even(0.25, 4, 120), [&](double omega) { return exact / (omega * omega); }));
    figure.statements.push_back(about("(2.24)", "amplitude at B/a = " + number(b) + ", Aω²/a", averaged,
                                      0.05 * averaged, {exact},
                                      "averaging assumes a cosine that never sticks; within 5 % counts as agreement"));
  }
  panel.y_limits = {0, 10};
  figure.statements.push_back(
      about("after (2.25)", "below B/a = 4/π the only solution is A = 0: amplitude at B/a = 1.2, Aω²/a", 0, 0,
            {block_amplitude(block, 1.2, 1.0)},
            "this holds for the averaged motion only; the block moves for every B > a, and sticks "
            "twice a cycle up to B/a = √(1 + π²/4) = 1.8621"));
  figure.panels.push_back(std::move(panel));
  return figure;
}

ThesisFigure figure_2_2(Thesis& thesis) {
  ThesisFigure figure{"2.2",
                      "Amplitude of a caster against frequency. Dashed: averaged, (2.35); gray: where averaged "
                      "solutions are unstable. Solid: exact orbits; dotted: exact, unstable.",
                      ""};
  ThesisPanel panel{"Caster", "$\\omega\\sqrt{3\\ell/a}$", "$A/3\\ell$"};
  const SlowlyVaryingParameters svp(unit_caster);
  panel.curves.push_back(unstable_zone(svp, "averaged, unstable", 1, 1, 12));
  std::size_t folds = 0;
  for (const double b : {0.5, 1.0, 1.25, 1.3, 2.0, 4.0, 8.0}) {
    add_branches(panel, svp, b, 0.01, 12);
    for (const OrbitBranch& branch : free_caster_branches(thesis, b)) {
      add_exact(panel, branch, ratio(b), 1, 1);
      if (b == 1.3) folds += branch.folds.size();
    }
  }
  panel.x_limits = {0, 2};
  panel.y_limits = {0, 8};
  const double boundary = svp.stability_boundary(1e-4).upper;
  figure.statements.push_back(about("(2.42)", "stability boundary at zero amplitude, ω √(3l/a)",
                                    std::sqrt(4 / (std::sqrt(3.0) * std::numbers::pi)), 1e-6, {boundary}));
  const double moves = numerics::first_where(0.5, 2, [](double b) {
    return integrate(unit_caster, HarmonicMotion(b, 0.7, 2 * std::numbers::pi / 0.7)).peak > 0;
  });
  figure.statements.push_back(
      about("before (2.36)", "rest is stable up to B/a =", four_over_pi, 0.01, {moves},
            "for the averaged motion; exactly, x = 0 is at rest up to B = a, and moves slightly from B = a to 4a/π"));
  const std::vector<Orbit> small = orbits(unit_caster, 1.25, 0.7);
  figure.statements.push_back(about("before (2.36)", "small motion at B/a = 1.25, ω √(3l/a) = 0.7: A/3l", 0, 0,
                                    {small.front().at_rest() ? small[1].amplitude : small.front().amplitude},
                                    "sticks twice a cycle; stable"));
  figure.statements.push_back(about("after (2.43)", "number of folds of the curve for B/a = 1.3, above 4/π", 0, 0,
                                    {static_cast<double>(folds)}, "exact curves have two folds up to B/a = 1.44"));
  figure.panels.push_back(std::move(panel));
  return figure;
}

ThesisFigure figure_2_3(Thesis& thesis) {
  ThesisFigure figure{"2.3",
                      "Amplitude of three casters against frequency in the units of figure 2.1, a = 1 m/s² (the text "
                      "of the thesis does not give its "
                      "a/3l). Dashed: averaged; solid: exact, dotted: exact and unstable; thin: "
                      "the averaged Coulomb block, the lower bound; gray: averaged solutions unstable.",
                      ""};
  const SlowlyVaryingParameters svp(unit_caster), coulomb(Coulomb(1.0));
  const std::vector<double> loads{1.25, 1.3, 2.0, 4.0};
  std::vector<std::vector<OrbitBranch>> branches;
  for (const double b : loads) branches.push_back(free_caster_branches(thesis, b));
  for (const double a_over_3l : {2.0, 1.0, 0.5}) {
    const double reach = 1 / a_over_3l, omega_unit = std::sqrt(a_over_3l);
    ThesisPanel panel{"$a/3\\ell$ = " + number(a_over_3l) + " 1/s²", "$\\omega$ [rad/s]", "amplitude $A$ [m]"};
    panel.curves.push_back(unstable_zone(svp, "averaged, unstable", omega_unit, reach, 16));
    for (std::size_t i = 0; i < loads.size(); ++i) {
      ThesisPanel unit;
      add_branches(unit, svp, loads[i], 0.01, 16);
      for (ThesisCurve& curve : unit.curves) {
        for (double& x : curve.x) x *= omega_unit;
        for (double& y : curve.y) y *= reach;
        panel.curves.push_back(std::move(curve));
      }
      for (const OrbitBranch& branch : branches[i]) add_exact(panel, branch, ratio(loads[i]), omega_unit, reach);
      if (loads[i] > four_over_pi)
        panel.curves.push_back(curve("Coulomb block", Kind::limit, even(0.25, 3, 80),
                                     [&](double omega) { return coulomb.response(loads[i], omega).back().amplitude; }));
    }
    panel.x_limits = {0, 2.5};
    panel.y_limits = {0, 8};
    figure.panels.push_back(std::move(panel));
  }
  // (2.34): A_Coulomb <= A_caster <= B / omega^2, for averaged amplitudes.
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (const double b : {1.3, 2.0, 4.0, 8.0})
    for (const double omega : geometric(0.2, 3, 40)) {
      const double caster = svp.response(b, omega).back().amplitude;
      least = std::min(least, caster / coulomb.response(b, omega).back().amplitude);
      most = std::max(most, caster * omega * omega / b);
    }
  figure.statements.push_back(
      at_least("(2.34)", "minimum of the averaged amplitude over that of the Coulomb block", 1, {least}));
  figure.statements.push_back(at_most("(2.34)", "maximum of the averaged amplitude over the ground's", 1, {most},
                                      "holds for averaged amplitudes; exact ones may cross both bounds"));
  return figure;
}

ThesisFigure figure_2_4(Thesis& thesis) {
  ThesisFigure figure{"2.4",
                      "Stability boundaries of the caster for a = 1 m/s² and several a/3l. Lines: averaged, (2.41); "
                      "points: folds of exact response curves.",
                      ""};
  ThesisPanel panel{"Caster", "$\\omega$ [rad/s]", "amplitude $A$ [m]"};
  const SlowlyVaryingParameters svp(unit_caster);
  std::vector<Orbit> folds;
  for (const double b : {0.4, 0.5, 0.6, 0.8, 1.0, 1.1, 1.2, 1.3, 1.4, 1.44})
    for (const OrbitBranch& branch : free_caster_branches(thesis, b))
      for (const std::size_t fold : branch.folds) folds.push_back(branch.orbits[fold]);
  std::ranges::sort(folds, {}, &Orbit::amplitude);
  for (const double a_over_3l : {4.0, 2.0, 1.0, 0.5, 0.25}) {
    const double reach = 1 / a_over_3l, omega_unit = std::sqrt(a_over_3l);
    const std::string label = "$a/3\\ell$ = " + number(a_over_3l) + " 1/s²";
    ThesisCurve boundary{label, Kind::thesis, {}, {}}, exact{label, Kind::points, {}, {}};
    for (const double amplitude : geometric(1e-3, 30, 200)) {
      boundary.x.push_back(svp.stability_boundary(amplitude).upper * omega_unit);
      boundary.y.push_back(amplitude * reach);
    }
    for (const Orbit& fold : folds) {
      exact.x.push_back(fold.omega * omega_unit);
      exact.y.push_back(fold.amplitude * reach);
    }
    panel.curves.push_back(std::move(boundary));
    panel.curves.push_back(std::move(exact));
  }
  panel.x_limits = {0, 2};
  panel.y_limits = {0, 8};
  figure.panels.push_back(std::move(panel));
  return figure;
}

ThesisFigure figure_2_5(Thesis& thesis) {
  ThesisFigure figure{"2.5",
                      "Amplitude of a Coulomb block on a spring, squared natural frequency 0.5 (rad/s)², a = 1 m/s². "
                      "Dashed: averaged, (2.48). Solid: exact periodic motion.",
                      ""};
  ThesisPanel panel{"Coulomb block with a centering spring", "$\\omega$ [rad/s]", "amplitude $A$ [m]"};
  const Slider<Coulomb> block(Coulomb(1.0), sqrt_half);
  const SlowlyVaryingParameters svp(block);
  for (const double b : {1.3, 2.0, 4.0}) {
    add_branches(panel, svp, b, 0.02, 12);
    for (const auto& [low, high] : {std::pair{0.05, 0.695}, std::pair{0.72, 2.0}}) {
      ThesisCurve exact = curve(ratio(b), Kind::exact, even(low, high, 80),
                                [&](double omega) { return block_amplitude(block, b, omega); });
      panel.curves.push_back(std::move(exact));
      if (thesis.options().progress) thesis.options().progress("2.5", b / 4);
    }
  }
  panel.x_limits = {0, 2};
  panel.y_limits = {0, 10};
  // At resonance, wn = omega = 1: growth from cycle to cycle.
  const auto peak_after = [](double b, int cycles) {
    const Slider<Coulomb> resonant(Coulomb(1.0), 1.0);
    return integrate(resonant, HarmonicMotion(b, 1.0, 2 * std::numbers::pi * cycles)).peak;
  };
  const double early = peak_after(1.3, 200) - peak_after(1.3, 100), late = peak_after(1.3, 800) - peak_after(1.3, 700);
  figure.statements.push_back(about(
      "after (2.48)",
      "at resonance the amplitude grows as the square root of time: growth in cycles 700 to 800 over "
      "that in cycles 100 to 200, B/a = 1.3",
      (std::sqrt(800) - std::sqrt(700)) / (std::sqrt(200) - std::sqrt(100)), 0.02, {late / early},
      "it grows in proportion to time, by (B − 4a/π)π/ω² per cycle: energy input and loss are both proportional to A"));
  figure.statements.push_back(about("", "growth per cycle at resonance, B/a = 1.3, ω = 1 rad/s [m]",
                                    (1.3 - four_over_pi) * std::numbers::pi, 1e-4, {late / 100},
                                    "(B − 4a/π)π/ω², the corrected averaged value after (2.48)"));
  figure.statements.push_back(about(
      "2.3.2", "the peak is unbounded for all parameters: largest |x| at resonance, B/a = 1.2, after 800 cycles [m]",
      std::numeric_limits<double>::infinity(), 0, {peak_after(1.2, 800)}, "bounded for B < 4a/π"));
  figure.panels.push_back(std::move(panel));
  return figure;
}

ThesisFigure figure_2_6(Thesis& thesis) {
  ThesisFigure figure{
      "2.6",
      "Amplitude of a caster on a spring, squared natural frequency 0.5 a/3l. Dashed: averaged, (2.53); "
      "gray: averaged solutions unstable. Solid: exact orbits; dotted: exact, unstable.",
      ""};
  ThesisPanel panel{"Caster with a centering device", "$\\omega\\sqrt{3\\ell/a}$", "$A/3\\ell$"};
  const Slider<Caster> cart(unit_caster.law(), sqrt_half);
  const SlowlyVaryingParameters svp(cart);
  panel.curves.push_back(unstable_zone(svp, "averaged, unstable", 1, 1, 12));
  for (const double b : {0.5, 1.0, 1.25, 1.3, 2.0, 4.0}) {
    add_branches(panel, svp, b, 0.02, 12);
    for (const OrbitBranch& branch : caster_branches(thesis, cart, b, {0.55, 0.68, 0.85, 1.2}, 0.2, 2.0, 12))
      add_exact(panel, branch, ratio(b), 1, 1);
  }
  panel.x_limits = {0, 2};
  panel.y_limits = {0, 8};
  // (2.48), (2.53): more than without the spring where |omega^2 - wn^2| < omega^2.
  const SlowlyVaryingParameters spring(Slider<Coulomb>(Coulomb(1.0), 1.0)), none(Coulomb(1.0));
  const double begin = numerics::first_where(0.5, 0.95, [&](double omega) {
    return spring.response(4, omega).back().amplitude > none.response(4, omega).back().amplitude;
  });
  figure.statements.push_back(about("after (2.48)", "the spring makes the amplitude larger above ω/ω_n =", 1, 0.01,
                                    {begin}, "already above 1/√2"));
  figure.panels.push_back(std::move(panel));
  return figure;
}

}  // namespace stickslip::detail
