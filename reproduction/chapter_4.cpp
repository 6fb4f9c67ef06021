// Filtered noise and equivalent linearization: figures 4.1 to 4.8.
#include <algorithm>
#include <bit>
#include <complex>
#include <numbers>
#include <stickslip/ensemble/run.hpp>
#include <stickslip/excitation/gaussian.hpp>
#include <stickslip/friction/coulomb.hpp>
#include <stickslip/numerics/root.hpp>
#include <stickslip/slider/viscous.hpp>
#include <stickslip/theory/stationary_linearization.hpp>
#include <stickslip/theory/white_noise.hpp>

#include "excitation/interpolation_loss.hpp"
#include "numerics/kaiser_window.hpp"
#include "reproduction/figures.hpp"

namespace stickslip::detail {

namespace {

constexpr double pi = std::numbers::pi;
constexpr double band = 20 / (pi * pi);                  // the thesis's case: bandwidth, and lower edge, of 20 / pi^2
const double white_noise = std::sqrt(pi * pi * pi / 2);  // (4.36)

const Coulomb block(1.0);
const theory::StationaryLinearization method;

Spectrum band_pass(double low, double width) { return Spectrum::band_pass(1.0, low, low + width); }
double linearized(double low, double width) { return method.predict(block, band_pass(low, width)).velocity_std; }

// Motions of 1024 samples with a step of 0.1, as in the thesis; figure 4.4 then has 33 lines. A narrower band would
// have fewer lines, and be less Gaussian: it gets a longer period.
GaussianExcitation shaking(double low, double width) {
  constexpr std::size_t samples = 1024;
  constexpr double dt = 0.1, min_lines = 32;
  const auto period = std::bit_ceil(static_cast<std::size_t>(std::ceil(min_lines * 2 * pi / dt / width)));
  GaussianOptions options;
  options.period = std::max(samples, period);
  options.zero_frequency = low == 0;
  return {band_pass(low, width), dt, samples, options};
}

std::string of(double low, double width) { return "band " + number(low) + " + " + number(width); }

const Ensemble& simulated(Thesis& thesis, double low, double width, std::uint64_t members, bool spectrum = false) {
  return thesis.ensemble(
      "block, " + of(low, width), std::min(members, thesis.options().members), spectrum,
      [&](const EnsembleOptions& options) { return run_ensemble(block, shaking(low, width), options); });
}

Estimate rms_velocity(Thesis& thesis, double low, double width, std::uint64_t members) {
  return root(simulated(thesis, low, width, members).stationary().velocity_variance);
}

// The case of figures 4.4 to 4.6: the block and its equivalent linear system.
const Ensemble& block_case(Thesis& thesis, std::uint64_t members) {
  return simulated(thesis, band, band, members, true);
}
theory::StationaryPrediction linear_prediction() { return method.predict(block, band_pass(band, band)); }
const Ensemble& linear_case(Thesis& thesis) {
  return thesis.ensemble("linear system", thesis.options().members, true, [](const EnsembleOptions& options) {
    return run_ensemble(ViscousSlider(linear_prediction().damping), shaking(band, band), options);
  });
}

ThesisCurve by_time(std::string label, const Ensemble& ensemble, const Estimates& y, std::size_t every) {
  Points points(std::move(label), ensemble.members());
  const std::vector<double> time = ensemble.time();
  for (std::size_t i = every; i < time.size(); i += every) points.add(time[i], {y.value[i], y.error[i]});
  return std::move(points.curve);
}

Estimates roots(Estimates e) {
  for (std::size_t i = 0; i < e.value.size(); ++i) {
    const Estimate r = root({e.value[i], e.error[i]});
    e.value[i] = r.value;
    e.error[i] = r.error;
  }
  return e;
}

// The scatter of the means of x^2 over groups of members, relative to the prediction of (4.61) from single members.
Estimate scatter_over_predicted(const std::vector<double>& x, std::size_t group) {
  const std::size_t groups = x.size() / group;
  const auto scatter = [](const std::vector<double>& f) {
    double mean = 0, squares = 0;
    for (const double value : f) mean += value / static_cast<double>(f.size());
    for (const double value : f) squares += (value - mean) * (value - mean);
    return std::sqrt(squares / static_cast<double>(f.size() - 1));
  };
  std::vector<double> squares, means(groups);
  for (std::size_t i = 0; i < groups * group; ++i) {
    squares.push_back(x[i] * x[i]);
    means[i / group] += x[i] * x[i] / static_cast<double>(group);
  }
  const double ratio = scatter(means) / (scatter(squares) / std::sqrt(static_cast<double>(group)));
  return {ratio, ratio / std::sqrt(2 * (static_cast<double>(groups) - 1))};  // means of 100 are nearly Gaussian
}

std::string members_of(const Ensemble& ensemble) { return ", " + number(ensemble.members()) + " members"; }

// The first side lobe of the window for velocities relative to its main lobe [dB of the amplitude]: the first maximum
// of its Fourier amplitude after the first minimum.
double first_side_lobe(double beta) {
  constexpr std::size_t samples = 512;  // of the central half, to which the window is applied
  constexpr double step = 1.0 / 64;     // of a line
  const std::vector<double> window = kaiser_window(samples, beta);
  const auto amplitude = [&](double line) {
    std::complex<double> sum = 0;
    for (std::size_t i = 0; i < samples; ++i)
      sum += std::polar(window[i], -2 * pi * line * static_cast<double>(i) / static_cast<double>(samples));
    return std::abs(sum);
  };
  double line = 1;
  while (amplitude(line + step) < amplitude(line)) line += step;
  while (amplitude(line + step) > amplitude(line)) line += step;
  return 20 * std::log10(amplitude(line) / amplitude(0));
}

constexpr const char* hours = "3 hours a point";

}  // namespace

ThesisFigure figure_4_1(Thesis&) {
  ThesisFigure figure{"4.1",
                      "Stationary rms velocity of a Coulomb block by equivalent linearization against bandwidth, for "
                      "20 lower edges Ω1 from 0 to 2: the 400 points of the thesis.",
                      "1 minute"};
  ThesisPanel panel{"Equivalent linearization", "$\\Delta\\Omega$", "$\\sigma_{X'}$"};
  const std::vector<double> widths = even(0.1, 2, 20), edges = even(0, 2, 20);
  double peak = 0;
  for (const double low : edges) {
    panel.curves.push_back(curve("$\\Omega_1 = " + number(std::round(low * 1000) / 1000) + "$", Kind::thesis, widths,
                                 [&](double width) { return linearized(low, width); }));
    peak = std::max(peak, std::ranges::max(panel.curves.back().y));
  }
  panel.curves.push_back(line("white noise, linearized", 0.1, 2, white_noise));
  figure.panels.push_back(std::move(panel));
  figure.statements.push_back(
      about("figure 4.1", "the peak value of the graph, σ_X′", 3.67, 0.005, {linearized(0, 2)}, "at Ω1 = 0, ΔΩ = 2"));
  figure.statements.push_back(
      about("figure 4.1", "that peak as a fraction of the value for white noise", 0.93, 0.005, {peak / white_noise}));
  figure.statements.push_back(
      about("(4.36)", "for white noise, σ_X′", white_noise, 1e-6, {linearized(0, 1e9)}, "√(π³/2)"));
  figure.statements.push_back(about("(4.36)", "the same value as a bound of the block's velocity, σ_X′", white_noise,
                                    0.01, {std::sqrt(theory::WhiteNoise(block, 1.0).variance())},
                                    "it bounds the linearized velocity only; the exact value is √2 π"));
  // (4.22) from below and above.
  const double least = numerics::first_where(0.2, 0.5, [](double width) { return linearized(1, width) > 0; });
  figure.statements.push_back(about("(4.39)", "no motion by linearization below ΔΩ =", 1 / pi, 1e-6, {least}));
  double z = 1e6;  // (4.41) as printed, 50 steps
  for (int i = 0; i < 50; ++i) z = 1 / (pi * std::atan(z * 0.35 / (z * z + 1.35)));
  figure.statements.push_back(about("(4.41)", "50 steps from 1e6 suffice: Z_eq for Ω1 = 1, ΔΩ = 0.35", z, 0.01,
                                    {method.predict(block, band_pass(1, 0.35)).damping},
                                    "n steps reduce the iterate only by about (πΔΩ)⁻ⁿ"));
  return figure;
}

ThesisFigure figure_4_2(Thesis& thesis) {
  ThesisFigure figure{"4.2",
                      "Stationary rms velocity of a Coulomb block without an upper band edge, (4.42). Dashed: "
                      "equivalent linearization; dotted: its limits "
                      "(4.40) and (4.44). Points: ensembles for Ω2 = 20, standard errors within the points.",
                      ""};
  ThesisPanel panel{"No upper edge", "$\\Omega_1$", "$\\sigma_{X'}$"};
  const auto without_end = [](double low) { return linearized(low, 1e9); };
  panel.curves.push_back(curve("linearization", Kind::thesis, even(0.01, 5, 120), without_end));
  panel.curves.push_back(
      curve("$\\sqrt{2/\\Omega_1}$", Kind::limit, even(0.15, 5, 60), [](double low) { return std::sqrt(2 / low); }));
  panel.curves.push_back(line("white noise, linearized", 0.01, 5, white_noise));
  panel.curves.push_back(
      line("white noise, exact", 0.01, 5, std::sqrt(theory::WhiteNoise(block, 1.0).variance()), Kind::exact));
  Points points("simulation", thesis.options().members);
  for (const double low : {0.05, 0.1, 0.25, 0.5, 1.0, 2.0, 3.5, 5.0})
    points.add(low, rms_velocity(thesis, low, 20 - low, thesis.options().members));
  panel.curves.push_back(std::move(points.curve));
  figure.statements.push_back(
      about("(4.44)", "σ_X′ at Ω1 = 20", std::sqrt(0.1), 0.01, {without_end(20)}, "for Ω1 ≫ 1/π"));
  figure.panels.push_back(std::move(panel));
  return figure;
}

ThesisFigure figure_4_3(Thesis&) {
  ThesisFigure figure{
      "4.3",
      "Effect of linear interpolation between samples on the Fourier amplitude (numbered 4.9 in the thesis). Dashed: "
      "the product (4.57) truncated after K factors; solid: the infinite product, sinc²(πl/2N); dash-dotted: factor on "
      "the spectral density, sinc⁴.",
      ""};
  ThesisPanel panel{"Linear interpolation", "$l/N$", "factor"};
  const auto all = [](double l) { return interpolation_loss(Interpolation::linear, pi * l / 2); };
  const auto product = [](double l, int factors) {
    double p = 1;
    for (int k = 1; k <= factors; ++k) p *= std::pow(std::cos(pi * l / std::exp2(k + 1)), 2);
    return p;
  };
  const std::vector<double> l = even(0, 2, 101);
  for (const int factors : {1, 2, 3, 10})
    panel.curves.push_back(
        curve("K = " + std::to_string(factors), Kind::thesis, l, [&](double x) { return product(x, factors); }));
  panel.curves.push_back(curve("amplitude", Kind::exact, l, all));
  panel.curves.push_back(curve("density", Kind::theory, l, [&](double x) { return all(x) * all(x); }));
  figure.panels.push_back(std::move(panel));
  figure.statements.push_back(at_most("after (4.57)", "reduction of the amplitude at l/N = 0.3", 0.10, {1 - all(0.3)},
                                      "the density is reduced by 14 %"));
  double worst = 0;
  for (const double x : even(0.01, 1, 100)) worst = std::max(worst, std::abs(product(x, 10) / product(x, 100) - 1));
  figure.statements.push_back(
      at_most("after (4.58)", "10 factors against 100, relative", 5e-6, {worst}, "five significant figures"));
  figure.statements.push_back(about("(4.58)", "the density at the Nyquist frequency is multiplied by", all(1), 0.01,
                                    {all(1) * all(1)},
                                    "the product applies to amplitudes; its square applies to a density"));
  return figure;
}

ThesisFigure figure_4_4(Thesis& thesis) {
  ThesisFigure figure{"4.4",
                      "Rms velocity from rest, ΔΩ = Ω1 = 20/π², Δτ = 0.1. Points: simulations of block and linear "
                      "system, with standard errors; dashed: stationary linearization; solid: the linear system from "
                      "rest, exactly.",
                      hours};
  ThesisPanel panel{"Velocity", "$\\tau$", "$\\sigma_{X'}$"};
  const Ensemble &many = block_case(thesis, thesis.options().members), &few = block_case(thesis, thesis_members),
                 &linear = linear_case(thesis);
  const theory::StationaryPrediction prediction = linear_prediction();
  panel.curves.push_back(by_time("Coulomb" + members_of(few), few, roots(few.velocity_variance()), 8));
  panel.curves.push_back(by_time("Coulomb" + members_of(many), many, roots(many.velocity_variance()), 4));
  panel.curves.push_back(by_time("linear" + members_of(linear), linear, roots(linear.velocity_variance()), 4));
  panel.curves.push_back(line("linearization", 0, 102.3, prediction.velocity_std, Kind::thesis));
  const std::vector<double> times = even(0, 102.3, 342);
  panel.curves.push_back(
      {"linear, exact", Kind::exact, times, roots(prediction.transient(times).velocity_variance).value});
  panel.x_limits = {0, 30};
  figure.panels.push_back(std::move(panel));

  const Estimate simulated = root(many.stationary().velocity_variance);
  figure.statements.push_back(about("4.5", "linearization over simulation, rms velocity, within 10 %", 1, 0.1,
                                    {prediction.velocity_std / simulated.value, simulated.error / simulated.value}));
  const Estimate linear_simulated = root(linear.stationary().velocity_variance);
  figure.statements.push_back(about("4.5", "simulated linear system over simulated block, rms velocity", 1, 0.1,
                                    {linear_simulated.value / simulated.value,
                                     std::hypot(linear_simulated.error, simulated.error) / simulated.value}));
  const double one[] = {1.0};
  figure.statements.push_back(
      about("4.5",
            "the overshoot is caused by the periodicity of the records: linear system at τ = 1 without any "
            "record, σ_X′",
            prediction.velocity_std, 0.01, {std::sqrt(prediction.transient(one).velocity_variance.value[0])},
            "the overshoot is the transient from rest"));
  return figure;
}

ThesisFigure figure_4_5(Thesis& thesis) {
  ThesisFigure figure{
      "4.5",
      "Spectral density of the stationary velocity, linear and logarithmic. Points: simulations, "
      "Kaiser-Bessel window, β = 8; dashed: stationary linearization, (4.8). In contrast to that of the "
      "linear system, the spectrum of the block extends beyond the band, down to zero frequency.",
      hours};
  const Ensemble &many = block_case(thesis, thesis.options().members), &linear = linear_case(thesis);
  const theory::StationaryPrediction prediction = linear_prediction();
  for (const bool logarithmic : {false, true}) {
    ThesisPanel panel{logarithmic ? "logarithmic" : "linear", "$\\Omega$", "$S_{X'X'}$", false, logarithmic};
    for (const auto& [label, ensemble] : {std::pair{"Coulomb", &many}, std::pair{"linear", &linear}}) {
      const VelocitySpectrum spectrum = ensemble->velocity_spectrum();
      Points points(label + members_of(*ensemble), ensemble->members());
      for (std::size_t i = 0; i < spectrum.omega.size() && spectrum.omega[i] < 12; ++i)
        points.add(spectrum.omega[i], {spectrum.density[i], spectrum.error[i]});
      panel.curves.push_back(std::move(points.curve));
    }
    panel.curves.push_back(curve("linearization", Kind::thesis, even(band * 1.0001, 2 * band * 0.9999, 60),
                                 [&](double omega) { return prediction.velocity_spectrum(omega); }));
    if (logarithmic) panel.y_limits = {1e-9, 1};
    panel.x_limits = {0, logarithmic ? 12.0 : 6.0};
    figure.panels.push_back(std::move(panel));
  }
  const VelocitySpectrum spectrum = many.velocity_spectrum();
  const Estimate growth = many.stationary().growth_rate, zero{2 * pi * spectrum.density[0], 2 * pi * spectrum.error[0]};
  figure.statements.push_back(
      about("(4.63)", "2πS_X′X′(0) over the growth rate of the displacement variance", 1, 0.1,
            {zero.value / growth.value,
             std::hypot(zero.error / zero.value, growth.error / growth.value) * zero.value / growth.value}));
  double enough = 8;
  while (first_side_lobe(enough) > -70) enough += 0.1;
  figure.statements.push_back(
      at_most("after (4.62)", "first side lobe of the window, β = 8 [dB of the amplitude]", -70, {first_side_lobe(8)},
              "-70 dB requires β = " + number(enough) + "; in dB, the density has the same value, not 140"));
  return figure;
}

ThesisFigure figure_4_6(Thesis& thesis) {
  ThesisFigure figure{
      "4.6",
      "Displacement variance from rest. Points: simulations; solid: exact solution of the linear system. The variance "
      "of the block grows without bound. The variance of the linear system is bounded, but exceeds (4.45): a linear "
      "system that starts from rest keeps an offset, the initial ground velocity divided by the damping.",
      hours};
  ThesisPanel panel{"Displacement", "$\\tau$", "$\\sigma_X^2$"};
  const Ensemble &many = block_case(thesis, thesis.options().members), &few = block_case(thesis, thesis_members),
                 &linear = linear_case(thesis);
  const theory::StationaryPrediction prediction = linear_prediction();
  panel.curves.push_back(by_time("Coulomb" + members_of(few), few, few.displacement_variance(), 16));
  panel.curves.push_back(by_time("Coulomb" + members_of(many), many, many.displacement_variance(), 16));
  panel.curves.push_back(by_time("linear" + members_of(linear), linear, linear.displacement_variance(), 16));
  const std::vector<double> times = even(0, 102.3, 342);
  panel.curves.push_back(
      {"linear, exact", Kind::exact, times, prediction.transient(times).displacement_variance.value});
  panel.curves.push_back(
      line("(4.45)", 0, 102.3, prediction.displacement_std * prediction.displacement_std, Kind::thesis));
  figure.panels.push_back(std::move(panel));
  const double late[] = {1000.0};
  figure.statements.push_back(about("(4.45)", "limit of the linear system's displacement variance",
                                    prediction.displacement_std * prediction.displacement_std, 0.005,
                                    {prediction.transient(late).displacement_variance.value[0]},
                                    "from rest, as simulated, it is larger by σ_v_g²/ζ²"));
  figure.statements.push_back(about("4.5", "growth rate predicted by linearization [S0³/a⁴]", 0, 0,
                                    many.stationary().growth_rate,
                                    "as the thesis says, no linearization predicts growth"));
  figure.statements.push_back(about("(4.61)", "scatter of means of 100 records, x² at the end, over σ_f/√100", 1, 0,
                                    scatter_over_predicted(many.residual(), 100)));
  return figure;
}

namespace {

// Ratios of simulated rms velocities to theory, and the thesis's statements about them.
ThesisFigure slice(Thesis& thesis, ThesisFigure figure, ThesisPanel panel, const std::vector<double>& abscissae,
                   const std::vector<double>& points, const std::function<std::pair<double, double>(double)>& low_width,
                   const std::function<bool(double)>& counted) {
  panel.curves.push_back(curve("linearization", Kind::thesis, abscissae, [&](double x) {
    const auto [low, width] = low_width(x);
    return linearized(low, width);
  }));
  double worst = 0, error = 0;
  for (const std::uint64_t members : {thesis_members, thesis.options().members}) {
    Points simulation("simulation, " + number(std::min(members, thesis.options().members)) + " members",
                      std::min(members, thesis.options().members));
    for (const double x : points) {
      const auto [low, width] = low_width(x);
      const Estimate velocity = rms_velocity(thesis, low, width, members);
      simulation.add(x, velocity);
      const double over = linearized(low, width) / velocity.value, off = std::abs(over - 1);
      if (members == thesis.options().members && counted(x) && off > worst) {
        worst = off;
        error = over * velocity.error / velocity.value;
      }
    }
    panel.curves.push_back(std::move(simulation.curve));
  }
  figure.statements.push_back(at_most(
      "4.5",
      "largest error of the rms velocity by linearization above the critical "
      "bandwidth",
      0.20, {worst, error}, figure.number == "4.8" ? "near the critical bandwidth linearization is far too low" : ""));
  figure.panels.push_back(std::move(panel));
  return figure;
}

}  // namespace

ThesisFigure figure_4_7(Thesis& thesis) {
  return slice(
      thesis,
      {"4.7", "Rms velocity against the lower edge, ΔΩ = 20/π². Dashed: linearization; points: simulations.", hours},
      {"$\\Delta\\Omega = 20/\\pi^2$", "$\\Omega_1$", "$\\sigma_{X'}$"}, even(0, 5, 120),
      {0, 0.1, 0.25, 0.5, 0.75, 1, 1.5, band, 3, 4, 5},
      [](double x) {
        return std::pair{x, band};
      },
      [](double) { return true; });
}

ThesisFigure figure_4_8(Thesis& thesis) {
  ThesisFigure figure = slice(
      thesis,
      {"4.8", "Rms velocity against the bandwidth, Ω1 = 20/π². Dashed: linearization; points: simulations.", hours},
      {"$\\Omega_1 = 20/\\pi^2$", "$\\Delta\\Omega$", "$\\sigma_{X'}$"}, even(0.02, 5, 150),
      {0.2, 0.3, 0.32, 0.35, 0.4, 0.5, 0.7, 1, 1.5, band, 3, 4, 5},
      [](double x) {
        return std::pair{band, x};
      },
      [](double x) { return x > 1 / pi; });
  figure.statements.push_back(about("4.5", "σ_X′ by linearization below the critical bandwidth, ΔΩ = 0.3", 0, 0,
                                    rms_velocity(thesis, band, 0.3, thesis.options().members),
                                    "as the thesis says, the cutoff is spurious: the block moves"));
  return figure;
}

}  // namespace stickslip::detail
