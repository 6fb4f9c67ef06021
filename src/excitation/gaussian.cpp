#include <fftw3.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <new>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "base/json.hpp"
#include "excitation/interpolation_loss.hpp"
#include "numerics/fftw_plan.hpp"
#include "stickslip/base/error.hpp"
#include "stickslip/excitation/gaussian.hpp"
#include "stickslip/excitation/random.hpp"

namespace stickslip {
namespace {

constexpr std::size_t longest_period = std::numeric_limits<int>::max();  // FFTW's

/// Without an exponent, as long as it fits.
std::string whole(double value) {
  return value < 0x1p53 ? std::to_string(static_cast<std::uint64_t>(value)) : detail::shortest(value);
}

}  // namespace

/// The plan for one period, made once and used by all threads.
struct GaussianExcitation::Transform {
  explicit Transform(std::size_t period) {
    Workspace workspace;
    workspace.grow(period / 2 + 1, period, 0);
    plan = detail::make_plan([&] {
      return fftw_plan_dft_c2r_1d(static_cast<int>(period), reinterpret_cast<fftw_complex*>(workspace.lines_.get()),
                                  workspace.samples_.get(), FFTW_ESTIMATE | FFTW_DESTROY_INPUT);
    });
  }

  /// Both arrays aligned as fftw_malloc does it; `lines` is destroyed.
  void operator()(std::complex<double>* lines, double* samples) const {
    fftw_execute_dft_c2r(plan.get(), reinterpret_cast<fftw_complex*>(lines), samples);
  }

  detail::FftwPlan plan;
};

void GaussianExcitation::Workspace::Free::operator()(void* memory) const noexcept { fftw_free(memory); }

void GaussianExcitation::Workspace::grow(std::size_t lines, std::size_t samples, std::size_t amplitudes) {
  const auto allocate = [](std::size_t count, std::size_t size) {
    void* const memory = fftw_malloc(count * size);
    if (memory == nullptr) throw std::bad_alloc();
    return memory;
  };
  if (lines > room_for_lines_) {
    lines_.reset(static_cast<std::complex<double>*>(allocate(lines, sizeof(std::complex<double>))));
    room_for_lines_ = lines;
  }
  if (samples > room_for_samples_) {
    samples_.reset(static_cast<double*>(allocate(samples, sizeof(double))));
    room_for_samples_ = samples;
  }
  if (amplitudes > amplitudes_.size()) amplitudes_.resize(amplitudes);
}

GaussianExcitation::GaussianExcitation(Spectrum spectrum, double dt, std::size_t samples, Options options)
    : spectrum_(std::move(spectrum)), options_(std::move(options)), dt_(dt), samples_(samples), coarse_dt_(dt) {
  detail::require(std::isfinite(dt) && dt > 0, "GaussianExcitation: dt must be positive and finite", dt, "s");
  if (samples < 2)
    throw std::invalid_argument("GaussianExcitation: needs at least two samples, got " + std::to_string(samples));
  if (options_.period == 0) options_.period = samples;
  if (options_.period < samples)
    throw std::invalid_argument("GaussianExcitation: period must be at least samples = " + std::to_string(samples) +
                                ", got " + std::to_string(options_.period));
  if (options_.period > longest_period)
    throw std::invalid_argument("GaussianExcitation: period must be at most " + std::to_string(longest_period) +
                                " samples, got " + std::to_string(options_.period));
  line_spacing_ = 2 * std::numbers::pi / (static_cast<double>(options_.period) * dt);
  detail::require(std::isfinite(line_spacing_) && line_spacing_ > 0,
                  "GaussianExcitation: the spacing of the lines, 2 pi / (period dt), must be positive and finite",
                  line_spacing_, "rad/s");

  const double nyquist = std::numbers::pi / dt, low = spectrum_.low(), high = spectrum_.high();
  constexpr double rounding = 1e-12;
  if (std::isfinite(high) && high > nyquist * (1 + rounding))
    throw std::invalid_argument("GaussianExcitation: the spectrum reaches " + detail::shortest(high) +
                                " rad/s, beyond the Nyquist frequency pi / dt = " + detail::shortest(nyquist) +
                                " rad/s; dt must be at most " + detail::shortest(std::numbers::pi / high) + " s, got " +
                                detail::shortest(dt) + " s");

  for (std::size_t k = options_.zero_frequency ? 0 : 1; k <= options_.period / 2; ++k) {
    double omega = static_cast<double>(k) * line_spacing_;
    // A line that meets an edge within round-off is in the band.
    for (const double edge : {low, high})
      if (std::isfinite(edge) && std::abs(omega - edge) <= rounding * edge) omega = edge;
    const double variance = (alone(k) ? 1 : 2) * spectrum_(omega) * line_spacing_;
    if (target_.empty() && variance == 0) continue;
    if (target_.empty()) first_line_ = k;
    target_.push_back(variance);
  }
  while (!target_.empty() && target_.back() == 0) target_.pop_back();
  if (target_.empty()) {
    const double width = std::min(high, nyquist) - low;
    throw std::invalid_argument("GaussianExcitation: no line lies in the band from " + detail::shortest(low) + " to " +
                                detail::shortest(high) +
                                " rad/s; the lines are 2 pi / (period dt) = " + detail::shortest(line_spacing_) +
                                " rad/s apart. A period of " + whole(std::ceil(2 * std::numbers::pi / (dt * width))) +
                                " samples would do, got " + std::to_string(options_.period));
  }
  prepare();
}

/// Whether line k and its mirror image -k are one and the same.
bool GaussianExcitation::alone(std::size_t k) const noexcept { return k == 0 || 2 * k == options_.period; }

/// What follows from the lines and the grid.
void GaussianExcitation::prepare() {
  amplitude_.resize(target_.size());
  for (std::size_t i = 0; i < target_.size(); ++i) {
    const std::size_t k = first_line_ + i;
    const double u = std::numbers::pi * static_cast<double>(k) / static_cast<double>(options_.period);  // omega dt / 2
    const double loss = options_.correct_interpolation ? detail::interpolation_loss(options_.interpolation, u) : 1;
    // A cos(..) is A/2 at k and at -k, its mean square A^2 / 2. At zero and Nyquist A cos(phi) is all there is.
    amplitude_[i] = (alone(k) ? 1 : 0.5) * std::sqrt(2 * target_[i]) / loss;  // thesis (4.49); ERRATA (4.58)
  }
  envelope_.clear();
  if (options_.envelope)
    for (std::size_t i = 0; i < samples_; ++i) envelope_.push_back((*options_.envelope)(static_cast<double>(i) * dt_));
  transform_ = std::make_shared<const Transform>(options_.period);
}

void GaussianExcitation::sample(std::uint64_t seed, std::uint64_t member, std::span<double> acceleration,
                                Workspace& workspace) const {
  if (acceleration.size() != samples_)
    throw std::invalid_argument("GaussianExcitation: needs room for " + std::to_string(samples_) + " samples, got " +
                                std::to_string(acceleration.size()));
  const std::size_t period = options_.period, half = period / 2 + 1, count = amplitude_.size();
  workspace.grow(half, period, options_.random_amplitudes ? count : 0);
  std::complex<double>* const lines = workspace.lines_.get();
  std::complex<double>* const band = lines + first_line_;
  std::fill(lines, band, 0);
  std::fill(band + count, lines + half, 0);

  // Counted from the first line, so that those outside the band cost nothing; it is the same one on a finer grid.
  phasors({seed, member, phase_purpose}, {band, count});
  if (options_.random_amplitudes) {
    const std::span<double> squares(workspace.amplitudes_.data(), count);
    exponentials({seed, member, amplitude_purpose}, squares);  // Rayleigh squared, of mean 1
    for (std::size_t i = 0; i < count; ++i) band[i] *= amplitude_[i] * std::sqrt(squares[i]);
  } else {
    for (std::size_t i = 0; i < count; ++i) band[i] *= amplitude_[i];
  }
  lines[0] = lines[0].real();  // where the two of a pair are one and the same, only the sum of both shows
  if (period % 2 == 0) lines[half - 1] = lines[half - 1].real();

  // In place where that is a whole period in memory that suits the plan; else by way of the workspace.
  double* const samples = samples_ == period && fftw_alignment_of(acceleration.data()) == 0 ? acceleration.data()
                                                                                            : workspace.samples_.get();
  (*transform_)(lines, samples);
  if (!envelope_.empty())
    for (std::size_t i = 0; i < samples_; ++i) acceleration[i] = samples[i] * envelope_[i];
  else if (samples != acceleration.data())
    std::copy_n(samples, samples_, acceleration.data());
}

GroundMotion GaussianExcitation::sample(std::uint64_t seed, std::uint64_t member) const {
  Workspace workspace;
  std::vector<double> acceleration(samples_);
  sample(seed, member, acceleration, workspace);
  return {std::move(acceleration), dt_, options_.interpolation,
          "seed " + std::to_string(seed) + ", member " + std::to_string(member)};
}

GaussianExcitation GaussianExcitation::refined(std::size_t factor) const {
  if (factor < 1) throw std::invalid_argument("GaussianExcitation: a refinement must be at least 1, got 0");
  if (factor > longest_period / options_.period)
    throw std::invalid_argument("GaussianExcitation: period must be at most " + std::to_string(longest_period) +
                                " samples, got " + std::to_string(options_.period) + " times a refinement of " +
                                std::to_string(factor));
  GaussianExcitation result = *this;
  result.refinement_ *= factor;
  result.dt_ = coarse_dt_ / static_cast<double>(result.refinement_);
  result.samples_ = (samples_ - 1) * factor + 1;
  result.options_.period *= factor;
  result.prepare();
  return result;
}

double GaussianExcitation::line_variance(std::size_t i) const noexcept {
  return (alone(first_line_ + i) ? 0.5 : 2) * amplitude_[i] * amplitude_[i];
}

double GaussianExcitation::variance() const noexcept {
  double sum = 0;
  for (std::size_t i = 0; i < amplitude_.size(); ++i) sum += line_variance(i);
  return sum;
}

std::size_t GaussianExcitation::lines() const noexcept {
  return static_cast<std::size_t>(std::ranges::count_if(target_, [](double p) { return p > 0; }));
}

double GaussianExcitation::effective_lines() const noexcept {
  const double all = variance();  // shares of it, whose squares neither overflow nor vanish
  double squares = 0;
  for (std::size_t i = 0; i < amplitude_.size(); ++i) squares += (line_variance(i) / all) * (line_variance(i) / all);
  return 1 / squares;
}

std::size_t GaussianExcitation::period_for(double wanted) const {
  const double needed = static_cast<double>(options_.period / refinement_) * wanted / effective_lines();
  detail::require(needed > 0 && needed <= static_cast<double>(longest_period),
                  "GaussianExcitation: a number of effective lines must be positive and within reach", wanted);
  GaussianOptions longer = options_;
  longer.period = std::bit_ceil(static_cast<std::size_t>(std::ceil(needed)));
  while (GaussianExcitation(spectrum_, coarse_dt_, 2, longer).effective_lines() < wanted) longer.period *= 2;
  return longer.period * refinement_;
}

double GaussianExcitation::lost_variance() const {
  const double all = spectrum_.variance(), nyquist = std::numbers::pi / coarse_dt_;
  if (std::isinf(all)) return 1;
  if (spectrum_.high() <= nyquist) return 0;
  return spectrum_.variance(nyquist, std::numeric_limits<double>::infinity()) / all;
}

std::string GaussianExcitation::configuration() const {
  const auto boolean = [](bool value) { return value ? "true" : "false"; };
  std::string text = R"({"excitation": "GaussianExcitation", "spectrum": )" + spectrum_.configuration();
  text += R"(, "dt": )" + detail::json(coarse_dt_) + R"(, "samples": )" + std::to_string(samples_) +
          R"(, "interpolation": ")" + (options_.interpolation == Interpolation::linear ? "linear" : "constant") +
          R"(", "correct_interpolation": )" + boolean(options_.correct_interpolation) + R"(, "random_amplitudes": )" +
          boolean(options_.random_amplitudes) + R"(, "zero_frequency": )" + boolean(options_.zero_frequency) +
          R"(, "period": )" + std::to_string(options_.period) + R"(, "refinement": )" + std::to_string(refinement_) +
          R"(, "envelope": )" + (options_.envelope ? options_.envelope->configuration() : "null") + "}";
  return text;
}

}  // namespace stickslip
