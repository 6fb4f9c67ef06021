// Pulses: figures 5.1 to 5.7, Table 5.1 and the vertical motion of section 5.6.
#include <algorithm>
#include <array>
#include <numbers>
#include <stickslip/base/units.hpp>
#include <stickslip/ensemble/run.hpp>
#include <stickslip/excitation/poisson.hpp>
#include <stickslip/excitation/with_vertical.hpp>
#include <stickslip/friction/caster.hpp>
#include <stickslip/friction/coulomb.hpp>
#include <stickslip/numerics/root.hpp>
#include <stickslip/theory/pulse_chain.hpp>
#include <stickslip/theory/pulse_response.hpp>
#include <stickslip/theory/pulse_superposition.hpp>

#include "reproduction/figures.hpp"

namespace stickslip::detail {

namespace {

constexpr double pi = std::numbers::pi;
constexpr double amplitude = 1.5;  // of the pulse of figures 5.1 to 5.3; a = dt = 1
const Slider<Coulomb> block(Coulomb(1.0));

using theory::Overlap;
using theory::PulseSuperposition;

constexpr std::array<std::pair<Overlap, const char*>, 3> superpositions{
    {{Overlap::none, "no overlap"},
     {Overlap::thesis, "overlap series"},
     {Overlap::renewal, "overlap series, rate corrected"}}};
Kind kind_of(Overlap overlap) { return overlap == Overlap::renewal ? Kind::theory : Kind::thesis; }

}  // namespace

ThesisFigure figure_5_1(Thesis&) {
  ThesisFigure figure{"5.1", "The pulse n(t) and the slip level a: a = 1, b = 1.5, Δt = 1.", ""};
  ThesisPanel panel{"Pulse", "$t$", "$n(t)$"};
  panel.curves.push_back(
      {"pulse", Kind::thesis, {-0.5, 0, 0, 1, 1, 2, 2, 4}, {0, 0, amplitude, amplitude, -amplitude, -amplitude, 0, 0}});
  panel.curves.push_back(line("slip level", -0.5, 4, 1));
  panel.curves.push_back(line("slip level", -0.5, 4, -1));
  figure.panels.push_back(std::move(panel));
  return figure;
}

ThesisFigure figure_5_2(Thesis&) {
  ThesisFigure figure{"5.2",
                      "Fourier amplitude of the pulse. Dashed: (5.6) as printed; solid: with its factor corrected, "
                      "(2b/πω) sin²(ωΔt/2); dotted: the envelope that falls as 1/ω.",
                      ""};
  ThesisPanel panel{"Pulse", "$\\omega$", "$|\\hat n(\\omega)|$"};
  const PoissonPulses pulses(1, 1, 1, 10);
  const auto printed = [](double w) {
    const double squares = 4 * std::pow(std::sin(w / 2), 2) - std::pow(std::sin(w), 2);
    return w == 0 ? 0 : amplitude / (2 * pi * w) * std::sqrt(std::max(squares, 0.0));
  };
  const auto transform = [&](double w) { return amplitude * std::sqrt(pulses.density(w) / (2 * pi)); };  // (5.20)
  const std::vector<double> omega = even(0, 25, 251);
  panel.curves.push_back(curve("(5.6)", Kind::thesis, omega, printed));
  panel.curves.push_back(curve("corrected", Kind::exact, omega, transform));
  panel.curves.push_back(
      curve("envelope", Kind::limit, even(1.2, 25, 120), [](double w) { return 2 * amplitude / (pi * w); }));
  figure.panels.push_back(std::move(panel));

  // By the mean square: the integral of (5.20) with (5.6) as printed must equal (5.19).
  double sum = 0;  // midpoints, and the tail beyond them, in which sin^4 is 3/8 on average
  constexpr double step = 1e-3, last = 2000 * pi;
  for (double w = step / 2; w < last; w += step) sum += 2 * step * 2 * pi * std::pow(printed(w) / amplitude, 2);
  sum += 2 * 2 * pi / last * std::pow(1 / pi, 2) * 3.0 / 8;
  figure.statements.push_back(about("(5.6), (5.20)", "integral of the pulses' density over their variance (5.19)", 1,
                                    1e-3, {sum / pulses.variance()}, "(5.6) gives half of the amplitude"));
  constexpr double h = 1e-4;
  const double peak =
      numerics::first_where(2, 2.6, [&](double w) { return pulses.density(w + h) <= pulses.density(w - h); });
  figure.statements.push_back(about("(5.60)", "the spectrum's peak, ωΔt", pi, 0.05, {peak},
                                    "π/Δt is a definition of the center frequency, not the frequency of the peak"));
  return figure;
}

ThesisFigure figure_5_3(Thesis&) {
  ThesisFigure figure{
      "5.3",
      "Response of a Coulomb block and of a linear system of the same rms velocity to the pulse. The block "
      "keeps an offset, the linear system does not. Dashed: (5.15) with its third line as printed.",
      ""};
  const theory::PulseResponse whole = theory::pulse_response(block, amplitude, 1);
  const double zeta = theory::viscous_damping_for(whole.velocity_square, amplitude, 1);
  const std::vector<double> times = even(0, 4, 201);
  const theory::PulseResponse slid = theory::pulse_response(block, amplitude, 1, {}, 0, times),
                              damped = theory::viscous_pulse_response(zeta, amplitude, 1, times);
  ThesisPanel velocity{"Velocity", "$t$", "$v$"}, displacement{"Displacement", "$t$", "$x$"};
  velocity.curves.push_back({"Coulomb", Kind::exact, times, slid.velocity});
  velocity.curves.push_back({"linear", Kind::exact, times, damped.velocity});
  displacement.curves.push_back({"Coulomb", Kind::exact, times, slid.displacement});
  displacement.curves.push_back({"linear", Kind::exact, times, damped.displacement});
  const double printed = std::pow(1 - std::exp(-zeta), 2);
  displacement.curves.push_back(curve("(5.15) as printed", Kind::thesis, even(2, 4, 101), [&](double t) {
    return -amplitude / (zeta * zeta) * std::exp(-zeta * t) * printed;
  }));
  figure.panels.push_back(std::move(velocity));
  figure.panels.push_back(std::move(displacement));

  const double beta = amplitude;
  figure.statements.push_back(
      about("(5.8)", "final offset Δx/(aΔt²)", -beta * std::pow((beta - 1) / (beta + 1), 2), 1e-12, {whole.offset}));
  figure.statements.push_back(
      about("(5.32)", "integral of v²/(a²Δt³)",
            2.0 / 3 * beta * std::pow(beta - 1, 2) / (beta + 1) * (1 + 4 / std::pow(beta + 1, 2)), 1e-12,
            {whole.velocity_square}));
  figure.statements.push_back(at_most("5.2", "longest response to a pulse, in Δt, for b = 1000 a", 4,
                                      {theory::pulse_response(block, 1000, 1).stop}));
  const double end[] = {2.0};
  figure.statements.push_back(about("(5.15)", "the linear displacement at 2Δt by its third line",
                                    -amplitude / (zeta * zeta) * std::exp(-2 * zeta) * printed, 1e-6,
                                    {theory::viscous_pulse_response(zeta, amplitude, 1, end).displacement[0]},
                                    "the exponent in the bracket must be positive; as printed x jumps"));
  return figure;
}

namespace {

const std::vector<double> overlaps{0.05, 0.1, 0.2, 0.35, 0.5, 0.75, 1, 1.5, 2};

const Ensemble& simulated(Thesis& thesis, double sigma, double overlap, std::uint64_t members) {
  return thesis.ensemble("pulses, sigma = " + number(sigma) + ", lambda dt = " + number(overlap),
                         std::min(members, thesis.options().members), false, [&](const EnsembleOptions& options) {
                           const PoissonPulses pulses(overlap, 1, sigma, 200);
                           return run_ensemble(block, pulses, options);
                         });
}

ThesisFigure against_overlap(Thesis& thesis, const char* number_, double sigma, const char* said) {
  ThesisFigure figure{number_,
                      std::string("Rms velocity and growth of the displacement variance under pulses, σ/a = ") + said +
                          ". Dashed: superposition as printed; dash-dotted: its rate corrected, and the pulse chain; "
                          "points: simulations with standard errors.",
                      "3 to 6 hours a point"};
  struct Measure {
    const char *title, *axis;
    Estimate (*simulated)(const Stationary&);
    double (*predicted)(const Moments&);
  };
  const Measure measures[] = {
      {"Velocity", "$\\sigma_{\\dot x}/(a\\Delta t)$", [](const Stationary& s) { return root(s.velocity_variance); },
       [](const Moments& m) { return std::sqrt(m.velocity_variance.value[0]); }},
      {"Displacement", "$dE[x^2]/dt/(a^2\\Delta t^3)$", [](const Stationary& s) { return s.growth_rate; },
       [](const Moments& m) { return m.growth_rate.value; }}};
  const double end[] = {200.0};
  const auto series = [&](double overlap, Overlap kind) {
    return PulseSuperposition(kind).predict(block, PoissonPulses(overlap, 1, sigma, 200), end);
  };
  const auto chain = [&](double overlap) {
    return theory::PulseChain().predict(block, PoissonPulses(overlap, 1, sigma, 200), end);
  };
  const std::vector<double> finely = geometric(0.05, 2, 25);
  struct Prediction {
    const char* name;
    Kind kind;
    std::vector<Moments> moments;
  };
  std::vector<Prediction> predictions;
  for (const auto& [overlap, name] : superpositions) {
    predictions.push_back({name, kind_of(overlap), {}});
    for (const double p : finely) predictions.back().moments.push_back(series(p, overlap));
  }
  predictions.push_back({"pulse chain", Kind::theory, {}});
  for (const double p : finely) {
    if (thesis.options().progress) thesis.options().progress("pulse chain", p / 2);
    predictions.back().moments.push_back(chain(p));
  }
  for (const Measure& measure : measures) {
    ThesisPanel panel{measure.title, "$\\lambda\\Delta t$", measure.axis, false, true};
    for (const Prediction& prediction : predictions) {
      panel.curves.push_back({prediction.name, prediction.kind, finely, {}});
      for (const Moments& moments : prediction.moments) panel.curves.back().y.push_back(measure.predicted(moments));
    }
    for (const std::uint64_t members : {thesis_members, thesis.options().members}) {
      const std::uint64_t some = std::min(members, thesis.options().members);
      Points points("simulation, " + number(some) + " members", some);
      for (const double p : overlaps) {
        const Estimate e = measure.simulated(simulated(thesis, sigma, p, members).stationary());
        points.add(p, e);
      }
      panel.curves.push_back(std::move(points.curve));
    }
    figure.panels.push_back(std::move(panel));
  }

  // Largest errors of the rms velocity and of the growth rate, for lambda dt from `least` to `most`. Pulses as small as
  // a third of the slip level cause slip only together with others. Where pulses are rare, the largest error is that of
  // the simulation, which for the growth rate and 100,000 members is 11 % (lambda dt = 0.05), 5 % (0.1), 3 % (0.2) and
  // 2 % (0.35).
  const auto worst = [&](const Measure& measure, const auto& predict, double least, double most) {
    Estimate result;
    for (const double p : overlaps) {
      if (p < least || p > most) continue;
      const Estimate e = measure.simulated(simulated(thesis, sigma, p, thesis.options().members).stationary());
      const double over = measure.predicted(predict(p)) / e.value, off = std::abs(over - 1);
      if (off > result.value) result = {off, over * e.error / e.value};
    }
    return result;
  };
  const auto printed = [&](double p) { return series(p, Overlap::thesis); };
  const auto alone = [&](double p) { return series(p, Overlap::none); };
  if (sigma < 1) {
    const Stationary dense = simulated(thesis, sigma, 1, thesis.options().members).stationary();
    figure.statements.push_back(
        at_most("5.6", "overlap series: error of the growth rate for λΔt from 0.2 to 1 (also 5.5: within 50 %)", 0.5,
                worst(measures[1], printed, 0.2, 0.99),
                "it is too low by an order of magnitude, as another passage of 5.5 says"));
    const double low = measures[1].predicted(printed(1));
    figure.statements.push_back(at_least("5.5", "growth rate simulated over the overlap series', λΔt = 1", 5,
                                         {dense.growth_rate.value / low, dense.growth_rate.error / low},
                                         "\"off by an order of magnitude\""));
    const double rms = measures[0].predicted(alone(0.05));
    const Estimate sparse =
        measures[0].simulated(simulated(thesis, sigma, 0.05, thesis.options().members).stationary());
    figure.statements.push_back(about("5.5", "rms velocity without overlaps over simulation, λΔt = 0.05", 0.5, 0.15,
                                      {rms / sparse.value, rms * sparse.error / (sparse.value * sparse.value)}));
  } else if (sigma == 1) {
    figure.statements.push_back(at_most("5.5", "overlap series: largest error of the rms velocity", 0.10,
                                        worst(measures[0], printed, 0, 1), "\"on the order of 10 %\""));
    figure.statements.push_back(
        at_most("5.5", "no overlap: largest error of the rms velocity", 0.30, worst(measures[0], alone, 0, 1)));
    figure.statements.push_back(at_most("5.5", "overlap series: largest error of the growth rate", 0.50,
                                        worst(measures[1], printed, 0, 1), "\"on the order of 50 %\""));
  } else {
    figure.statements.push_back(at_most("5.5", "overlap series: largest error of the rms velocity", 0.20,
                                        worst(measures[0], printed, 0, 1), "its rate is 1 + λΔt times too high"));
    figure.statements.push_back(at_most("5.5", "overlap series: largest error of the growth rate", 0.20,
                                        worst(measures[1], printed, 0, 1), "the same"));
    figure.statements.push_back(
        at_most("5.5", "no overlap: largest error of the growth rate", 0.20, worst(measures[1], alone, 0, 1)));
  }
  figure.statements.push_back(at_most("",
                                      sigma < 1 ? "the pulse chain's largest error of the growth rate, λΔt from 0.35 on"
                                                : "the pulse chain's largest error of the growth rate",
                                      0.10, worst(measures[1], chain, sigma < 1 ? 0.35 : 0, 2)));
  if (sigma < 1)
    figure.statements.push_back(at_most("5.5", "fraction of the pulses that exceed the slip level without overlap",
                                        0.003, {std::erfc(1 / (sigma * std::numbers::sqrt2))}));

  // The part omitted without overlaps.
  const auto times_more = [&](const Measure& measure) {
    const Estimate e = measure.simulated(simulated(thesis, sigma, 1, thesis.options().members).stationary());
    const double low = measure.predicted(alone(1));
    return Estimate{e.value / low, e.error / low};
  };
  if (sigma < 1) {
    figure.statements.push_back(about("5.5", "rms velocity simulated over that without overlaps, λΔt = 1", 10, 3,
                                      times_more(measures[0]), "\"almost an order of magnitude\""));
    figure.statements.push_back(at_most("5.5", "growth rate simulated over that without overlaps, λΔt = 1", 100,
                                        times_more(measures[1]), "\"one to two orders of magnitude\""));
  } else if (sigma == 1) {
    figure.statements.push_back(at_most("5.5", "growth rate simulated over that without overlaps, λΔt = 1", 10,
                                        times_more(measures[1]), "\"up to an order of magnitude\""));
  } else {
    figure.statements.push_back(
        at_most("5.5", "no overlap: largest error of the rms velocity", 0.20, worst(measures[0], alone, 0, 1)));
  }
  return figure;
}

}  // namespace

ThesisFigure figure_5_4(Thesis& thesis) { return against_overlap(thesis, "5.4", 1.0 / 3, "1/3"); }
ThesisFigure figure_5_5(Thesis& thesis) { return against_overlap(thesis, "5.5", 1, "1"); }
ThesisFigure figure_5_6(Thesis& thesis) { return against_overlap(thesis, "5.6", 5, "5"); }

namespace {

struct Row {
  double sigma, rate, half_width, ground_velocity, ground_displacement, velocity_digit, displacement_digit;
};
// Table 5.1 [cm/s^2, 1/s, s, cm/s, cm], and half a unit of its last digits.
constexpr std::array<Row, 4> table{{{250, 3, 1.0 / 6, 24, 93, 0.5, 0.5},
                                    {100, 2.5, 0.2, 12, 49, 0.5, 0.5},
                                    {200, 4, 0.125, 14, 24, 0.5, 0.5},
                                    {50, 3, 1.0 / 6, 4.8, 9.3, 0.05, 0.05}}};

const Ensemble& ground(Thesis& thesis, std::string_view event) {
  return thesis.ensemble(std::string("ground, ") + std::string(event), thesis.options().members, false,
                         [&](const EnsembleOptions& options) {
                           return run_ensemble(Slider<Coulomb>(Coulomb(0.0)), PoissonPulses::event(event), options);
                         });
}

Estimate rms(const std::vector<double>& x) {
  double mean = 0, scatter = 0;
  for (const double value : x) mean += value * value;
  mean /= static_cast<double>(x.size());
  for (const double value : x) scatter += std::pow(value * value - mean, 2);
  const auto n = static_cast<double>(x.size());
  return root({mean, std::sqrt(scatter / (n - 1) / n)});
}

Estimate in_centimeters(Estimate e) { return {100 * e.value, 100 * e.error}; }

}  // namespace

ThesisFigure table_5_1(Thesis& thesis) {
  ThesisFigure figure{
      "Table 5.1",
      "The four earthquakes, as rms displacement of the ground (of a frictionless mass) by time. Solid: "
      "(5.49); points: simulations.",
      ""};
  ThesisPanel panel{"Ground", "$t$ [s]", "$\\sigma_{x_g}$ [cm]"};
  for (std::size_t i = 0; i < table.size(); ++i) {
    const std::string_view event = PoissonPulses::events()[i];
    const PoissonPulses pulses = PoissonPulses::event(event);
    const std::string name(event);
    panel.curves.push_back(curve(name, Kind::exact, even(0, pulses.duration(), 61),
                                 [&](double t) { return 100 * std::sqrt(pulses.ground_displacement_variance(t)); }));
    const Ensemble& ensemble = ground(thesis, event);
    const Estimates variance = ensemble.displacement_variance();
    const std::vector<double> time = ensemble.time();
    Points points(name, ensemble.members());
    for (std::size_t k = time.size() / 8; k < time.size(); k += time.size() / 8)
      points.add(time[k], in_centimeters(root({variance.value[k], variance.error[k]})));
    panel.curves.push_back(std::move(points.curve));

    const Row& row = table[i];
    const auto says = [&](const char* what, double said, double digit, double found, const char* why = "") {
      figure.statements.push_back(about("Table 5.1", name + ": " + what, said, digit, {found}, why));
    };
    says("σ_b [cm/s²]", row.sigma, 0.5, 100 * pulses.sigma());
    says("λ [1/s]", row.rate, 0.05, pulses.rate());
    says("Δt [s]", row.half_width, 1e-9, pulses.half_width(), "the column f_c holds ω_c/2π, in Hz");
    says("σ_ẋ_g [cm/s]", row.ground_velocity, row.velocity_digit, 100 * std::sqrt(pulses.ground_velocity_variance()));
    says("σ_x_g(t_d) [cm]", row.ground_displacement, row.displacement_digit,
         100 * std::sqrt(pulses.ground_displacement_variance(pulses.duration())));

    double sum = 0, squares = 0;
    const std::uint64_t motions = std::min<std::uint64_t>(thesis.options().members, 2000);
    for (std::uint64_t member = 0; member < motions; ++member) {
      const double peak =
          pulses.sample(thesis.options().seed, member).peak_acceleration() / std::sqrt(pulses.variance());
      sum += peak;
      squares += peak * peak;
    }
    const auto n = static_cast<double>(motions);
    figure.statements.push_back(at_most("5.6", name + ": mean ratio of peak to rms acceleration, usually 3 to 4", 4,
                                        {sum / n, std::sqrt((squares / n - sum * sum / n / n) / (n - 1))},
                                        "it increases with the number of pulses"));
    figure.statements.back().members = motions;
  }
  figure.panels.push_back(std::move(panel));
  return figure;
}

ThesisFigure figure_5_7(Thesis& thesis) {
  ThesisFigure figure{
      "5.7",
      "Final rms displacement against the coefficient of friction for the four earthquakes of Table 5.1. "
      "Dashed: the overlap series as printed; dash-dotted: the pulse chain; points: simulations with standard "
      "errors; marks at μ = 0: the ground. Right: carts on casters (trail 40 mm, wheels 32 mm wide, corrected "
      "mechanics); dotted: the ground, in the same order. In great earthquakes and for μ of 0.3 and above "
      "the final displacement of the carts exceeds that of the ground.",
      ""};
  ThesisPanel panel{"Earthquakes", "coefficient of friction $\\mu$", "final rms displacement [cm]", false, true};
  const std::vector<double> finely = even(0.01, 0.7, 36),
                            points{0.01, 0.03, 0.05, 0.1, 0.15, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7};
  const auto slider = [](double mu) { return Slider<Coulomb>(Coulomb(mu * standard_gravity)); };
  const auto simulated = [&](std::string_view event, double mu) {
    return rms(thesis
                   .ensemble(std::string(event) + ", mu = " + number(mu), thesis.options().members, false,
                             [&](const EnsembleOptions& options) {
                               return run_ensemble(slider(mu), PoissonPulses::event(event), options);
                             })
                   .residual());
  };
  const auto series = [&](std::string_view event, double mu) {
    return 100 * PulseSuperposition(Overlap::thesis).final_rms(slider(mu), PoissonPulses::event(event));
  };
  const auto in_ground = [](std::string_view event) {
    const PoissonPulses pulses = PoissonPulses::event(event);
    return 100 * std::sqrt(pulses.ground_displacement_variance(pulses.duration()));
  };
  const auto chain = [&](std::string_view event, double mu) {
    return 100 * theory::PulseChain().final_rms(slider(mu), PoissonPulses::event(event));
  };
  for (const std::string_view event : PoissonPulses::events()) {
    const std::string name(event);
    panel.curves.push_back(curve(name, Kind::thesis, finely, [&](double mu) { return series(event, mu); }));
    panel.curves.push_back(curve(name, Kind::theory, finely, [&](double mu) { return chain(event, mu); }));
    Points simulation(name, thesis.options().members);
    for (const double mu : points) simulation.add(mu, in_centimeters(simulated(event, mu)));
    panel.curves.push_back(std::move(simulation.curve));
    panel.curves.push_back(line("ground", 0, 0.01, in_ground(event)));
  }
  panel.y_limits = {0.01, 150};
  figure.panels.push_back(std::move(panel));

  // A caster takes some ten times as long as a block.
  const std::uint64_t carts = std::max<std::uint64_t>(100, thesis.options().members / 20);
  const auto cart = [](double mu) { return Caster::from_geometry(mu, 0.04, 0.032); };
  const auto rolled = [&](std::string_view event, double mu) {
    return rms(thesis
                   .ensemble("cart, " + std::string(event) + ", mu = " + number(mu), carts, false,
                             [&](const EnsembleOptions& options) {
                               return run_ensemble(cart(mu), PoissonPulses::event(event), options);
                             })
                   .residual());
  };
  ThesisPanel casters{"Carts on casters", figure.panels[0].x, figure.panels[0].y, false, true};
  for (const std::string_view event : PoissonPulses::events()) {
    Points simulation{std::string(event), carts};
    for (const double mu : {0.1, 0.3, 0.5, 0.7}) simulation.add(mu, in_centimeters(rolled(event, mu)));
    casters.curves.push_back(std::move(simulation.curve));
    casters.curves.push_back(line("ground", 0.05, 0.75, in_ground(event)));
  }
  figure.panels.push_back(std::move(casters));

  const char* events[] = {"great very near field", "great near field", "moderate very near field",
                          "moderate near field"};
  const auto almost_none = [&](const char* event) { return series(event, 1e-4) / in_ground(event) - 1; };
  figure.statements.push_back(
      about("5.6", "great earthquakes: as μ tends to 0, the series tends to the ground's displacement; relative error",
            0, 0.05, {almost_none(events[0])}, "the ratio is √(1 + λΔt) in all four earthquakes"));
  figure.statements.push_back(
      about("5.6", "moderate earthquakes: relative error by which the series is too high", 0.5, 0.05,
            {almost_none(events[2])},
            "50 % is the error of the variance; that of the rms is 22.5 %, as for the great earthquakes"));
  for (const double mu : {0.1, 0.3})
    figure.statements.push_back(at_least(
        "5.6",
        "moderate very near field, μ = " + number(mu) + ": final rms displacement in \"tens of centimeters\" [cm]", 10,
        in_centimeters(simulated(events[2], mu)), ""));
  const auto ratio = [&](const char* event, double mu) {
    const Estimate e = in_centimeters(simulated(event, mu));
    const double predicted = series(event, mu);
    return Estimate{e.value / predicted, e.error / predicted};
  };
  figure.statements.push_back(
      at_most("5.6",
              "high friction, small displacements: factor by which the series is too low, great near "
              "field, μ = 0.5",
              3, ratio(events[1], 0.5)));
  double worst = 0, error = 0;
  for (const char* event : events)
    for (const double mu : points) {
      const Estimate e = in_centimeters(simulated(event, mu));
      if (e.value < 1) continue;
      const double over = chain(event, mu) / e.value, off = std::abs(over - 1);
      if (off > worst) {
        worst = off;
        error = over * e.error / e.value;
      }
    }
  figure.statements.push_back(at_most("", "the chain's largest error above 1 cm", 0.10, {worst, error}));

  // 5.6 and chapter 6: a caster lies between the block and the ground.
  const auto of_carts = [&](ThesisStatement statement) {
    statement.members = carts;
    figure.statements.push_back(std::move(statement));
  };
  for (const char* event : {events[0], events[1]}) {
    const Estimate e = in_centimeters(rolled(event, 0.5));
    of_carts(at_most("5.6", std::string(event) + ", μ = 0.5: final rms of a cart, relative to the ground", 1,
                     {e.value / in_ground(event), e.error / in_ground(event)},
                     "beyond a few reaches its friction vanishes, and it keeps the velocity at which it broke loose"));
  }
  const Estimate e = in_centimeters(rolled(events[0], 0.5)),
                 block_of_level =
                     in_centimeters(rms(thesis
                                            .ensemble("block of the cart's level", carts, false,
                                                      [&](const EnsembleOptions&options) {
                                                        return run_ensemble(Coulomb(cart(0.5).slip_level()),
                                                                            PoissonPulses::event(events[0]), options);
                                                      })
                                            .residual()));
  const double over = e.value / block_of_level.value;
  of_carts(at_least("5.6", "great very near field, μ = 0.5: final rms of a cart, relative to a block of its slip level",
                    1, {over, over * std::hypot(e.error / e.value, block_of_level.error / block_of_level.value)}));
  return figure;
}

namespace {

// The root of E[y^2] / E[x^2] of two quantities of the same members, with the standard error that their correlation
// leaves.
Estimate paired_rms_ratio(const std::vector<double>& y, const std::vector<double>& x) {
  double of_y = 0, of_x = 0, scatter = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    of_y += y[i] * y[i];
    of_x += x[i] * x[i];
  }
  const double square = of_y / of_x;
  for (std::size_t i = 0; i < x.size(); ++i) scatter += std::pow(y[i] * y[i] - square * x[i] * x[i], 2);
  return root({square, std::sqrt(scatter) / of_x});
}

}  // namespace

ThesisFigure section_5_6(Thesis& thesis) {
  constexpr double strength = 2.0 / 3, frequency = 1.5;
  ThesisFigure figure{
      "Section 5.6",
      "Vertical motion: final rms displacement with vertical pulses over that without, for the same horizontal pulses. "
      "The vertical pulses are independent of the horizontal ones, two thirds as strong, and 1.5 times as fast and as "
      "frequent. Displacements increase, as the thesis expects: most where friction is high in great earthquakes "
      "nearby, and by less than a tenth everywhere.",
      ""};
  const std::uint64_t members = std::max<std::uint64_t>(100, thesis.options().members / 5);
  ThesisPanel panel{"Vertical motion", "$\\mu g/\\sigma_b$", "final rms, ratio"};
  for (const std::string_view event : PoissonPulses::events()) {
    const PoissonPulses pulses = PoissonPulses::event(event);
    const PoissonPulses vertical(frequency * pulses.rate(), pulses.half_width() / frequency, pulses.sigma(),
                                 pulses.duration());
    const auto residual = [&](double level, const char* what, const auto& excitation) {
      return thesis
          .ensemble(std::string(event) + ", level = " + number(level) + " sigma" + what, members, false,
                    [&](EnsembleOptions options) {
                      options.settle = true;
                      return run_ensemble(Slider<Coulomb>(Coulomb(level * pulses.sigma())), excitation, options);
                    })
          .residual();
    };
    const auto ratio = [&](double level) {
      return paired_rms_ratio(residual(level, ", vertical pulses", WithVertical(pulses, vertical, strength)),
                              residual(level, "", pulses));
    };
    Points points{std::string(event), members};
    for (const double level : {0.2, 0.5, 1.0, 1.5, 2.0}) points.add(level, ratio(level));
    panel.curves.push_back(std::move(points.curve));
    for (const double level : {0.5, 2.0}) {
      figure.statements.push_back(at_least(
          "5.6",
          std::string(event) + ", μg = " + number(level) + " σ_b: vertical motion makes displacements larger; ratio", 1,
          ratio(level)));
      figure.statements.back().members = members;
    }
  }
  panel.curves.push_back(line("no effect", 0, 2.2, 1));
  figure.panels.push_back(std::move(panel));
  return figure;
}

}  // namespace stickslip::detail
