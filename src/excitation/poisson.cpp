#include "stickslip/excitation/poisson.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <queue>
#include <stdexcept>

#include "base/json.hpp"
#include "excitation/pulse_shape.hpp"
#include "stickslip/base/error.hpp"
#include "stickslip/excitation/random.hpp"

namespace stickslip {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

constexpr std::uint32_t gap_purpose = 0x70756c73, amplitude_purpose = 0x616d706c;  // "puls", "ampl"

struct Event {
  std::string_view name;
  double rms_acceleration, center_frequency_hz, duration;
};

// thesis, Table 5.1, whose column of frequencies is in Hz
constexpr std::array<Event, 4> table_5_1 = {{{"great very near field", 2.5, 3, 60},
                                             {"great near field", 1, 2.5, 60},
                                             {"moderate very near field", 2, 4, 15},
                                             {"moderate near field", 0.5, 3, 15}}};

constexpr auto event_names = [] {
  std::array<std::string_view, table_5_1.size()> names;
  for (std::size_t i = 0; i < names.size(); ++i) names[i] = table_5_1[i].name;
  return names;
}();

void require_positive(double value, const char* name, const char* unit) {
  detail::require(std::isfinite(value) && value > 0,
                  std::string("PoissonPulses: ") + name + " must be positive and finite", value, unit);
}

/// A running sum that tracks the rounding errors of its additions (Knuth's two-sum): values that are added and later
/// subtracted leave no significant residue.
struct Sum {
  double high = 0, low = 0;

  void add(double x, double y) {
    const double both = x + y;
    const double sum = high + both;
    low += error(x, y, both) + error(high, both, sum);
    high = sum;
  }
  double value() const { return high + low; }

 private:
  static double error(double x, double y, double sum) {
    const double added = sum - x;
    return (x - (sum - added)) + (y - added);
  }
};

/// Calls step(time, edge, pulse) for every edge of every pulse in order of time, up to `end`, the edges of one pulse in
/// their order even where their times coincide. The rows of first edges, second edges, ... are sorted: they are merged.
/// @param arrivals  ascending, the last one infinite
template <class Step>
void merge_edges(std::span<const double> arrivals, std::span<const double> edges, double end, Step step) {
  if (edges.size() == 3) {
    std::array<std::size_t, 3> pulse = {0, 0, 0};
    std::array<double, 3> next = {arrivals[0], arrivals[0] + edges[1], arrivals[0] + edges[2]};
    while (true) {
      std::size_t edge = next[1] < next[0] ? 1 : 0;
      edge = next[2] < next[edge] ? 2 : edge;
      const double time = next[edge];
      if (!(time < end)) return;
      step(time, edge, pulse[edge]);
      next[edge] = arrivals[++pulse[edge]] + edges[edge];
    }
  }
  struct Next {
    double time;
    std::size_t edge, pulse;
    bool operator>(const Next& other) const { return time > other.time || (time == other.time && edge > other.edge); }
  };
  std::priority_queue<Next, std::vector<Next>, std::greater<>> queue;
  for (std::size_t edge = 0; edge < edges.size(); ++edge) queue.push({arrivals[0] + edges[edge], edge, 0});
  while (queue.top().time < end) {
    Next next = queue.top();
    queue.pop();
    step(next.time, next.edge, next.pulse);
    next.time = arrivals[++next.pulse] + edges[next.edge];
    queue.push(next);
  }
}

double sinc(double x) { return x == 0 ? 1 : std::sin(x) / x; }

/// Velocity that a pulse of unit amplitude leaves, divided by the half width: zero if it is only round-off.
double net_velocity(const PulseShape& shape) {
  double net = 0, size = 0;
  for (std::size_t i = 0; i < shape.values().size(); ++i) {
    const double area = shape.values()[i] * (shape.times()[i + 1] - shape.times()[i]);
    net += area;
    size += std::abs(area);
  }
  return std::abs(net) <= 1e-12 * size ? 0 : net;
}

/// Rejects functions that cannot be a quantile function of mean square 1, and returns a hash (FNV-1a) of their values.
/// These are rounded to float, because the last digits may differ where a mathematical library chooses among
/// instruction sets.
std::uint64_t examine(const std::function<void(std::span<double>)>& quantile) {
  std::vector<double> values(1024);
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = (static_cast<double>(i) + 0.5) / static_cast<double>(values.size());
  quantile(values);
  double sum = 0;
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const double value : values) {
    detail::require(std::isfinite(value), "PoissonPulses: the quantile function must be finite in (0, 1)", value);
    sum += value * value;
    hash = (hash ^ std::bit_cast<std::uint32_t>(static_cast<float>(value))) * 0x100000001b3;
  }
  const double mean_square = sum / static_cast<double>(values.size());
  detail::require(mean_square > 0.75 && mean_square < 1.25,
                  "PoissonPulses: the quantile function must have a mean square of 1, for sigma is the rms amplitude",
                  mean_square);
  return hash;
}

}  // namespace

PoissonPulses::PoissonPulses(double rate, double half_width, double sigma, double duration, Options options)
    : rate_(rate), half_width_(half_width), sigma_(sigma), duration_(duration), options_(std::move(options)) {
  require_positive(rate, "rate", "per second");
  require_positive(half_width, "half_width", "s");
  require_positive(sigma, "sigma", "m/s^2");
  require_positive(duration, "duration", "s");
  for (const double time : options_.shape.times()) edges_.push_back(time * half_width);
  detail::require(std::isfinite(edges_.back()), "PoissonPulses: the length of a pulse must be finite", edges_.back(),
                  "s");
  const double lead = options_.stationary_start ? edges_.back() : 0;
  detail::require(rate * (lead + duration) * static_cast<double>(edges_.size()) <= max_steps,
                  "PoissonPulses: rate times duration must make at most 3e8 steps (4.8 GB), " +
                      std::to_string(edges_.size()) + " for each pulse",
                  rate * (lead + duration) * static_cast<double>(edges_.size()), "steps");
  if (options_.quantile) quantile_hash_ = examine(options_.quantile);
}

PoissonPulses PoissonPulses::from_earthquake(double rms_acceleration, double center_frequency_hz, double duration,
                                             double overlap, Options options) {
  require_positive(rms_acceleration, "rms_acceleration", "m/s^2");
  require_positive(center_frequency_hz, "center_frequency_hz", "Hz");
  require_positive(overlap, "overlap", "");
  const double rate = 2 * overlap * center_frequency_hz;
  const double half_width = 1 / (2 * center_frequency_hz);  // thesis (5.60)
  PoissonPulses unit(rate, half_width, 1, duration, std::move(options));
  unit.sigma_ = rms_acceleration / std::sqrt(unit.variance());  // thesis (5.61), for any shape
  require_positive(unit.sigma_, "sigma", "m/s^2");
  return unit;
}

PoissonPulses PoissonPulses::from_spectrum(const Spectrum& spectrum, double rate, double duration, double dt,
                                           double tolerance, Options options) {
  if (options.shape != PulseShape())
    throw std::invalid_argument("PoissonPulses: from_spectrum finds the shape of the pulses, and must get no other");
  require_positive(rate, "rate", "per second");
  detail::SpectralPulse pulse = detail::spectral_pulse(spectrum, dt, tolerance);
  options.shape = std::move(pulse.shape);
  return {rate, 1, pulse.peak / std::sqrt(rate), duration, std::move(options)};
}

PoissonPulses PoissonPulses::event(std::string_view name, Options options) {
  for (const Event& e : table_5_1)
    if (e.name == name)
      return from_earthquake(e.rms_acceleration, e.center_frequency_hz, e.duration, 0.5, std::move(options));
  std::string names;
  for (const std::string_view known : event_names) names += (names.empty() ? "'" : ", '") + std::string(known) + "'";
  throw std::invalid_argument("PoissonPulses: event must be one of " + names + ", got '" + std::string(name) + "'");
}

std::span<const std::string_view> PoissonPulses::events() noexcept { return event_names; }

void PoissonPulses::pulses(std::uint64_t seed, std::uint64_t member, std::uint64_t amplitude_seed,
                           std::vector<double>& arrivals, std::vector<double>& amplitudes) const {
  const double begin = options_.stationary_start ? -edges_.back() : 0;
  const double mean_gap = 1 / rate_;
  const double expected = rate_ * (duration_ - begin);
  std::size_t count = 0;
  // Four deviations above the mean suffice except once in 30,000 motions; the motion then starts again with twice as
  // many. The numbers of a row do not depend on how many are requested.
  for (auto enough = static_cast<std::size_t>(expected + 4 * std::sqrt(expected) + 8);; enough *= 2) {
    arrivals.resize(enough);
    exponentials({seed, member, gap_purpose}, arrivals);
    double time = begin;
    for (count = 0; count < enough; ++count) {
      time += arrivals[count] * mean_gap;  // thesis (5.56)
      if (!(time < duration_)) break;
      arrivals[count] = time;
    }
    if (count < enough) break;
  }
  arrivals.resize(count);
  amplitudes.resize(count);
  if (count == 0) return;
  const RandomStream stream{amplitude_seed, member, amplitude_purpose};
  if (options_.quantile) {
    uniforms(stream, amplitudes);
    options_.quantile(amplitudes);
    for (const double b : amplitudes)
      detail::require(std::isfinite(b), "PoissonPulses: the quantile function must be finite in (0, 1)", b);
  } else {
    normals(stream, amplitudes);  // thesis (5.57), (5.58)
  }
  for (double& b : amplitudes) b *= sigma_;
  if (options_.envelope)
    for (std::size_t i = 0; i < count; ++i) amplitudes[i] *= (*options_.envelope)(std::max(arrivals[i], 0.0));
}

GroundMotion PoissonPulses::sample(std::uint64_t seed, std::uint64_t member) const {
  return sample(seed, member, seed);
}

GroundMotion PoissonPulses::sample(std::uint64_t seed, std::uint64_t member, std::uint64_t amplitude_seed) const {
  std::vector<double> arrivals, amplitudes;
  pulses(seed, member, amplitude_seed, arrivals, amplitudes);
  const std::size_t most = edges_.size() * arrivals.size() + 2;
  arrivals.push_back(infinity);

  struct Edge {
    double before, after;  // what the shape is
    std::ptrdiff_t acting;
  };
  std::vector<Edge> edges(edges_.size());
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) edges[i].after = edges[i + 1].before = options_.shape.values()[i];
  edges.front().acting = 1;
  edges.back().acting = -1;

  std::vector<double> times(most), accelerations(most);
  std::size_t i = 0;
  Sum sum;
  std::ptrdiff_t acting = 0;
  merge_edges(arrivals, edges_, duration_, [&](double time, std::size_t edge, std::size_t pulse) {
    sum.add(amplitudes[pulse] * edges[edge].after, -amplitudes[pulse] * edges[edge].before);
    acting += edges[edge].acting;
    const auto keep = acting > 0 ? ~std::uint64_t{0} : 0;
    sum.high = std::bit_cast<double>(std::bit_cast<std::uint64_t>(sum.high) & keep);
    sum.low = std::bit_cast<double>(std::bit_cast<std::uint64_t>(sum.low) & keep);
    i += time > times[i] ? 1 : 0;
    times[i] = std::max(time, 0.0);
    accelerations[i] = sum.value();
  });
  ++i;
  times[i] = duration_;
  accelerations[i] = sum.value();
  times.resize(i + 1);
  accelerations.resize(i + 1);
  return {std::move(accelerations), std::move(times), Interpolation::constant,
          "Poisson pulses, seed " + std::to_string(seed) + ", member " + std::to_string(member)};
}

double PoissonPulses::variance() const noexcept {
  double sum = 0;
  for (std::size_t i = 0; i < options_.shape.values().size(); ++i)
    sum += options_.shape.values()[i] * options_.shape.values()[i] * (edges_[i + 1] - edges_[i]);
  return rate_ * sigma_ * sigma_ * sum;
}

double PoissonPulses::density(double omega) const noexcept {
  // int w e^{-i omega t} dt, its constant part taken out of the cosines: without net velocity they cancel at low
  // frequencies, which the sum must not do by rounding alone.
  double real = net_velocity(options_.shape) * half_width_, imaginary = 0;
  for (std::size_t i = 0; i < options_.shape.values().size(); ++i) {
    const double length = edges_[i + 1] - edges_[i];
    const double phase = omega * (edges_[i] + length / 2);
    const double area = options_.shape.values()[i] * length;
    const double smoothing = sinc(omega * length / 2);
    real += area * (std::cos(phase) * smoothing - 1);
    imaginary -= area * std::sin(phase) * smoothing;
  }
  return rate_ * sigma_ * sigma_ * (real * real + imaginary * imaginary) / (2 * std::numbers::pi);
}

double PoissonPulses::ground_velocity_variance() const noexcept {
  if (net_velocity(options_.shape) != 0) return infinity;
  double velocity = 0, sum = 0;
  for (std::size_t i = 0; i < options_.shape.values().size(); ++i) {
    const double length = edges_[i + 1] - edges_[i];
    const double after = velocity + options_.shape.values()[i] * length;
    sum += length * (velocity * velocity + velocity * after + after * after) / 3;
    velocity = after;
  }
  return rate_ * sigma_ * sigma_ * sum;
}

double PoissonPulses::ground_displacement_variance(double t) const {
  detail::require(std::isfinite(t) && t >= 0, "PoissonPulses: t must be finite and at least 0", t, "s");
  if (net_velocity(options_.shape) != 0) return infinity;
  double velocity = 0, displacement = 0;
  for (std::size_t i = 0; i < options_.shape.values().size(); ++i) {
    const double length = edges_[i + 1] - edges_[i];
    const double after = velocity + options_.shape.values()[i] * length;
    displacement += length * (velocity + after) / 2;
    velocity = after;
  }
  return rate_ * sigma_ * sigma_ * displacement * displacement * t;
}

std::string PoissonPulses::configuration() const {
  std::string text = R"({"excitation": "PoissonPulses", "rate": )";
  text.append(detail::json(rate_)).append(R"(, "half_width": )").append(detail::json(half_width_));
  text.append(R"(, "sigma": )").append(detail::json(sigma_));
  text.append(R"(, "duration": )").append(detail::json(duration_));
  text.append(R"(, "stationary_start": )").append(options_.stationary_start ? "true" : "false");
  text.append(R"(, "shape": {"times": )").append(detail::json(options_.shape.times()));
  text.append(R"(, "values": )").append(detail::json(options_.shape.values()));
  text.append(R"(}, "quantile": )");
  text.append(options_.quantile ? std::string(R"({"hash": ")").append(std::to_string(quantile_hash_)).append("\"}")
                                : "null");
  text.append(R"(, "envelope": )").append(options_.envelope ? options_.envelope->configuration() : "null");
  return text.append("}");
}

}  // namespace stickslip
