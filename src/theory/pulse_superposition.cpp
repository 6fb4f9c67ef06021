#include "stickslip/theory/pulse_superposition.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/digits.hpp"
#include "stickslip/friction/coulomb.hpp"
#include "stickslip/numerics/gauss_legendre.hpp"
#include "stickslip/numerics/root.hpp"
#include "stickslip/theory/pulse_chain.hpp"

namespace stickslip::theory {
namespace {

using detail::digits;
using detail::refuse;
using detail::require;
using detail::shortest;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// An amplitude and its weight in a mean over the law of amplitudes.
struct Node {
  double b;
  double weight;
};

constexpr std::size_t points = 16;  // of Gauss and Legendre, on each panel

/// Amplitudes of one sign at which a step of the pulse just moves the slider, ascending.
std::vector<double> thresholds(const PulseShape& shape, double forward, double backward, double sign) {
  std::vector<double> result;
  for (const double value : shape.values())
    if (const double threshold = (sign * value > 0 ? backward : forward) / std::abs(value); std::isfinite(threshold))
      result.push_back(threshold);
  std::ranges::sort(result);
  return result;
}

// ---- Gaussian amplitudes, alone or in composites

/// Of a mixture of Gaussian laws of mean zero.
struct Component {
  double log_weight;
  double sigma;
};

/// Terms whose logarithm is below that of the largest one by more than this are omitted.
constexpr double negligible = 45;

/// The law of composite amplitudes, thesis (5.50), (5.51): the terms that matter above a threshold.
std::vector<Component> composites(double sigma, double overlap, double threshold) {
  const double squared = 0.5 * (threshold / sigma) * (threshold / sigma);
  const double first = overlap > 400 ? std::floor(overlap - 15 * std::sqrt(overlap)) : 0;
  double log_weight = first == 0 ? -overlap : first * std::log(overlap) - overlap - std::lgamma(first + 1);
  double most = -infinity;
  std::vector<Component> terms;
  for (double m = first;; ++m) {
    if (m > first) log_weight += std::log(overlap / m);
    const double size = log_weight - squared / (m + 1);
    most = std::max(most, size);
    if (m > overlap && (size < most - negligible || log_weight < -800)) break;
    terms.push_back({log_weight, std::sqrt(m + 1) * sigma});
  }
  std::erase_if(terms, [&](const Component& term) {
    const double ratio = sigma / term.sigma;
    return !(term.log_weight - squared * ratio * ratio >= most - negligible);
  });
  return terms;
}

/// Positive amplitudes, for means of functions that are zero below the first threshold and smooth between thresholds;
/// by panels as wide as the density is smooth.
void add_gaussian(std::vector<Node>& nodes, const std::vector<Component>& components, std::vector<double> edges) {
  if (edges.empty() || components.empty()) return;
  const double narrow = components.front().sigma, wide = components.back().sigma;
  edges.push_back(std::hypot(edges.front(), std::sqrt(120.0) * wide));
  for (std::size_t i = 0; i + 1 < edges.size() && edges[i] < edges.back(); ++i) {
    const double end = std::min(edges[i + 1], edges.back());
    // The density falls within sigma^2 / b, and a slider's answers have poles at about minus the threshold.
    double width = edges[i] > narrow ? narrow * (narrow / edges[i]) : edges[i] > 0 ? edges[i] : narrow;
    for (double from = edges[i]; from < end; width = std::min(2 * width, std::max(2 * narrow, from / 5))) {
      const double to = std::min(from + width, end);
      if (!(to > from)) break;  // steps below the last digit: nothing slips
      numerics::gauss_points<points>(from, to, [&](double b, double weight) {
        double density = 0;
        for (const Component& c : components) {
          const double z = b / c.sigma;
          density += std::exp(c.log_weight - z * z / 2) / c.sigma;
        }
        nodes.push_back({b, weight * density / std::sqrt(2 * std::numbers::pi)});
      });
      from = to;
    }
  }
}

// ---- any other law of amplitudes

/// Where the uniform numbers are cut: at the thresholds and in the middle.
std::vector<double> quantile_panels(const PoissonPulses& pulses, double sigma, const std::vector<double>& up,
                                    const std::vector<double>& down) {
  const auto& quantile = pulses.options().quantile;
  std::vector<double> edges = {0, 0.5, 1};
  const auto place = [&](double b) {  // of an amplitude; what is below 1e-17 counts for nothing
    return numerics::first_where(1e-17, 1, [&](double u) {
      quantile({&u, 1});
      return !(sigma * u < b);
    });
  };
  for (const double b : up) edges.push_back(place(b));
  for (const double b : down) edges.push_back(place(-b));
  std::ranges::sort(edges);
  return edges;
}

void add_quantiles(std::vector<Node>& nodes, const PoissonPulses& pulses, double sigma,
                   const std::vector<double>& edges) {
  std::vector<double> u, w;
  const auto add = [&](double from, double to) {
    if (to > from)
      numerics::gauss_points<points>(from, to, [&](double x, double weight) {
        u.push_back(x);
        w.push_back(weight);
      });
  };
  constexpr int halvings = 40;  // toward 0 and 1, where an unbounded law has its tails
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
    const double from = edges[i], to = edges[i + 1], length = to - from;
    if (!(length > 0)) continue;
    if (from == 0)
      for (int k = 0; k < halvings; ++k) add(std::ldexp(to, -k - 1), std::ldexp(to, -k));
    else if (to == 1)
      for (int k = 0; k < halvings; ++k) add(1 - std::ldexp(length, -k), 1 - std::ldexp(length, -k - 1));
    else
      for (int k = 0; k < 8; ++k) add(from + k * length / 8, from + (k + 1) * length / 8);
  }
  std::vector<double> values = u;
  pulses.options().quantile(values);
  for (std::size_t i = 0; i < values.size(); ++i) nodes.push_back({sigma * values[i], w[i]});
}

// ---- means over the law

/// Amplitudes between two bounds, and the probability of one there.
struct Cell {
  double from, to;
  double probability;
};

constexpr int cells_of_panel = 4096;

/// Those of one sign above the first threshold.
void add_gaussian_cells(std::vector<Cell>& cells, const std::vector<Component>& components, std::vector<double> edges,
                        double sign) {
  if (edges.empty() || components.empty()) return;
  edges.push_back(std::hypot(edges.front(), std::sqrt(120.0) * components.back().sigma));
  const auto above = [&](double b) {
    double sum = 0;
    for (const Component& c : components)
      sum += std::exp(c.log_weight) / 2 * std::erfc(b / c.sigma / std::numbers::sqrt2);
    return sum;
  };
  for (std::size_t i = 0; i + 1 < edges.size() && edges[i] < edges.back(); ++i) {
    const double from = edges[i], width = std::min(edges[i + 1], edges.back()) - from;
    if (!(width > 0)) continue;
    double low = from, beyond = above(from);
    for (int k = 1; k <= cells_of_panel; ++k) {
      const double high = from + width * k / cells_of_panel, next = above(high);
      cells.push_back({sign * low, sign * high, beyond - next});
      low = high, beyond = next;
    }
  }
}

/// For any other law, by its quantiles; the outermost 2^-40 on either side are neglected.
void add_quantile_cells(std::vector<Cell>& cells, const PoissonPulses& pulses, double sigma,
                        const std::vector<double>& panels) {
  std::vector<double> u;
  const auto divide = [&](double from, double to, int count) {
    for (int k = 0; k < count; ++k) u.push_back(from + (to - from) * k / count);
  };
  constexpr int halvings = 40;
  for (std::size_t i = 0; i + 1 < panels.size(); ++i) {
    const double from = panels[i], to = panels[i + 1];
    if (!(from < to)) continue;
    if (from == 0)
      for (int k = halvings; k > 0; --k) divide(std::ldexp(to, -k), std::ldexp(to, 1 - k), cells_of_panel / 16);
    else if (to == 1)
      for (int k = 0; k < halvings; ++k)
        divide(1 - std::ldexp(1 - from, -k), 1 - std::ldexp(1 - from, -k - 1), cells_of_panel / 16);
    else
      divide(from, to, cells_of_panel);
  }
  std::vector<double> values = u;
  pulses.options().quantile(values);
  for (std::size_t i = 0; i + 1 < u.size(); ++i)
    cells.push_back({sigma * values[i], sigma * values[i + 1], u[i + 1] - u[i]});
}

/// The effect of pulses on a slider at one place, per second.
struct Rates {
  double drift = 0;            ///< of E[x] [m/s]
  double growth = 0;           ///< of Var[x] [m^2/s]
  double velocity_square = 0;  ///< stationary E[x'^2] [m^2/s^2]
  double lost = 0;             ///< fraction of the pulses that carry it off permanently, excluded from the others
};

/// The effect of the pulses that began by a given time.
struct History {
  double mean = 0, variance = 0;                    ///< of x [m], [m^2]
  double velocity_mean = 0, velocity_variance = 0;  ///< of x' [m/s], [m^2/s^2]
  double growth = 0;                                ///< of the variance of x [m^2/s]
};

class Pulses {
 public:
  Pulses(const detail::PulseSystem& system, const PoissonPulses& pulses, Overlap overlap,
         const std::function<void()>& progress)
      : system_(system), pulses_(pulses), overlap_(overlap), progress_(progress) {}

  /// The law of the amplitudes of rms `sigma` at x, where thresholds lie, and how many such pulses come in a second.
  struct Law {
    std::vector<double> up, down;         ///< amplitudes that just move it, of either sign
    std::vector<Component> components{};  ///< of Gaussian laws; empty of others
    double rate;                          ///< [1/s]
  };

  Law law(double x, double sigma) const {
    const double forward = system_.level(x, Direction::forward), backward = system_.level(x, Direction::backward);
    const PulseShape& shape = pulses_.options().shape;
    Law law{thresholds(shape, forward, backward, 1), thresholds(shape, forward, backward, -1), {}, pulses_.rate()};
    if (pulses_.options().quantile) return law;
    const double overlap = pulses_.rate() * pulses_.half_width();
    const double least =
        std::min(law.up.empty() ? infinity : law.up.front(), law.down.empty() ? infinity : law.down.front());
    law.components = {{0, sigma}};
    if (overlap_ != Overlap::none) law.components = composites(sigma, overlap, least);
    if (overlap_ == Overlap::renewal) law.rate /= 1 + overlap;
    return law;
  }

  std::vector<Node> nodes(const Law& law, double sigma) const {
    std::vector<Node> nodes;
    if (pulses_.options().quantile) {
      add_quantiles(nodes, pulses_, sigma, quantile_panels(pulses_, sigma, law.up, law.down));
      return nodes;
    }
    add_gaussian(nodes, law.components, law.up);
    const std::size_t count = nodes.size();
    if (law.up == law.down)
      nodes.resize(2 * count), std::copy_n(nodes.begin(), count, nodes.begin() + static_cast<std::ptrdiff_t>(count));
    else
      add_gaussian(nodes, law.components, law.down);
    for (std::size_t i = count; i < nodes.size(); ++i) nodes[i].b = -nodes[i].b;
    return nodes;
  }

  std::vector<Cell> cells(const Law& law, double sigma) const {
    std::vector<Cell> cells;
    if (pulses_.options().quantile) {
      add_quantile_cells(cells, pulses_, sigma, quantile_panels(pulses_, sigma, law.up, law.down));
    } else {
      add_gaussian_cells(cells, law.components, law.up, 1);
      add_gaussian_cells(cells, law.components, law.down, -1);
    }
    return cells;
  }

  /// At the times `times`, ascending: Campbell's theorem, (5.25) and (5.28), for responses of constant accelerations
  /// between their knots, whose displacement and velocity are squared and integrated in closed form.
  std::vector<History> histories(std::span<const double> times, double sigma) const {
    std::vector<History> histories(times.size());
    const Law law = this->law(0, sigma);
    for (const auto& [b, weight] : nodes(law, sigma)) {
      if (weight == 0) continue;
      if (progress_) progress_();
      const std::vector<detail::PulseKnot> knots = system_.motion(b);
      const double w = law.rate * weight;
      double sum = 0, square = 0, velocity_square = 0;  // integrals up to knot k
      std::size_t k = 0;
      for (std::size_t i = 0; i < times.size(); ++i) {
        const auto within = [&](double s) {  // what follows knot k, for a time s
          struct {
            double x, sum, square, velocity_square;
          } r;
          const bool last = k + 1 == knots.size();
          const double x = knots[k].ride.state.displacement, v = last ? 0 : knots[k].ride.state.velocity;
          const double length = last ? 0 : knots[k + 1].time - knots[k].time;
          const double a = length > 0 ? (knots[k + 1].ride.state.velocity - v) / length : 0;
          r.x = x + s * (v + s * a / 2);
          r.sum = s * (x + s * (v / 2 + s * a / 6));
          r.square = s * (x * x + s * (x * v + s * ((v * v + x * a) / 3 + s * (v * a / 4 + s * a * a / 20))));
          r.velocity_square = s * (v * v + s * (v * a + s * a * a / 3));
          return r;
        };
        for (; k + 1 < knots.size() && knots[k + 1].time <= times[i]; ++k) {
          const auto whole = within(knots[k + 1].time - knots[k].time);
          sum += whole.sum, square += whole.square, velocity_square += whole.velocity_square;
        }
        const auto part = within(times[i] - knots[k].time);
        histories[i].mean += w * (sum + part.sum);
        histories[i].variance += w * (square + part.square);
        histories[i].velocity_mean += w * part.x;
        histories[i].velocity_variance += w * (velocity_square + part.velocity_square);
        histories[i].growth += w * part.x * part.x;
      }
    }
    return histories;
  }

  /// At x, with amplitudes of rms `sigma`.
  Rates rates(double x, double sigma) const {
    if (progress_) progress_();
    const Law law = this->law(x, sigma);
    const double rate = law.rate;
    Rates rates;
    for (const auto& [b, weight] : nodes(law, sigma)) {
      if (weight == 0) continue;
      if (progress_ && !system_.constant_level) progress_();  // an event loop takes 20 us and more
      const detail::PulseEffect effect = system_.effect(b, x);
      if (!std::isfinite(effect.offset)) {
        rates.lost += weight;
        continue;
      }
      rates.drift += rate * weight * effect.offset;
      rates.growth += rate * weight * effect.offset * effect.offset;
      rates.velocity_square += rate * weight * effect.velocity_square;
    }
    return rates;
  }

 private:
  const detail::PulseSystem& system_;
  const PoissonPulses& pulses_;
  Overlap overlap_;
  const std::function<void()>& progress_;
};

/// Rates by position, computed on demand and interpolated by cubics.
class RatesByPosition {
 public:
  RatesByPosition(const Pulses& pulses, double sigma, double spacing)
      : pulses_(pulses), sigma_(sigma), spacing_(spacing) {}

  Rates operator()(double x) {
    const double place = x / spacing_, cell = std::floor(place), u = place - cell;
    const std::array<double, 4> c = {-u * (u - 1) * (u - 2) / 6, (u + 1) * (u - 1) * (u - 2) / 2,
                                     -(u + 1) * u * (u - 2) / 2, (u + 1) * u * (u - 1) / 6};
    Rates sum;
    for (int i = 0; i < 4; ++i) {
      const Rates& node = at(static_cast<int>(cell) + i - 1);
      const double w = c[static_cast<std::size_t>(i)];
      sum.drift += w * node.drift;
      sum.growth += w * node.growth;
      sum.velocity_square += w * node.velocity_square;
    }
    return sum;
  }

 private:
  const Rates& at(int i) {
    const auto found = nodes_.find(i);
    return found != nodes_.end() ? found->second : nodes_.emplace(i, pulses_.rates(i * spacing_, sigma_)).first->second;
  }

  const Pulses& pulses_;
  double sigma_;
  double spacing_;
  std::map<int, Rates> nodes_{};
};

/// Where the slip level has changed by half, at least one way; infinite where it does not, within 2^60 slips.
double reach_of(const detail::PulseSystem& system, double step) {
  const auto far = [&](double x) {
    const double here = system.level(0, Direction::forward);
    return std::max(std::abs(system.level(x, Direction::forward) - here),
                    std::abs(system.level(-x, Direction::backward) - here)) >= here / 2;
  };
  double high = step;
  for (int i = 0; i < 60 && !far(high); ++i) high *= 2;
  if (!far(high)) return infinity;
  return numerics::first_where(0, high, far);
}

/// The effect of overlaps, which the theory omits, at the slip level of the initial position: growth rates of the
/// displacement variance of a block on Coulomb friction by `PulseChain` and by the superposition.
struct Overlaps {
  double growth = nan;   ///< by the chain [m^2/s]; NaN where the chain does not cover the case
  double own = nan;      ///< by the superposition [m^2/s]
  double factor = nan;   ///< ratio of the rms displacements, chain over superposition
  std::string reason{};  ///< why the chain does not cover the case

  bool matter() const { return !(factor < 1.3 && factor > 1 / 1.3); }
};

Overlaps overlaps_of(const PulseSuperposition& theory, const detail::PulseSystem& system, const PoissonPulses& pulses,
                     const std::function<void()>& progress) {
  Overlaps found;
  try {
    const Slider block(Coulomb(system.level(0, Direction::forward), system.level(0, Direction::backward)));
    found.growth = PulseChain().predict(block, pulses, {}, progress).growth_rate.value;
    found.own = theory.predict(block, pulses, {}, progress).growth_rate.value;
    found.factor = found.growth == found.own ? 1 : std::sqrt(found.growth / found.own);
  } catch (const std::invalid_argument& refusal) {
    found.reason = refusal.what();
  } catch (const ConvergenceError& failure) {
    found.reason = failure.what();
  }
  return found;
}

/// Three digits: the estimate has no more.
std::string rounded(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

void remark(Moments& moments, const std::string& sentence) {
  moments.remark += (moments.remark.empty() ? "" : " ") + sentence;
}

}  // namespace

std::string PulseSuperposition::name() const {
  return std::string("PulseSuperposition, ") + (overlap_ == Overlap::none     ? "none"
                                                : overlap_ == Overlap::thesis ? "thesis"
                                                                              : "renewal");
}

void PulseSuperposition::check(bool constant_level, const PoissonPulses& pulses) const {
  const double overlap = pulses.rate() * pulses.half_width();
  if (overlap_ != Overlap::none) {
    require(overlap <= max_overlap,
            "PulseSuperposition: a series of overlaps means nothing where rate x half_width is above " +
                shortest(max_overlap),
            overlap);
    if (pulses.options().quantile)
      throw std::invalid_argument(
          "PulseSuperposition: composites of overlapping pulses are known for Gaussian amplitudes; with a quantile "
          "function overlap must be none");
  }
  if (pulses.options().envelope && !constant_level)
    throw std::invalid_argument("PulseSuperposition: an envelope is covered for constant slip levels only");
}

Moments PulseSuperposition::predict(const detail::PulseSystem& system, const PoissonPulses& pulses,
                                    std::span<const double> times, const std::function<void()>& progress) const {
  const double dt = pulses.half_width(), sigma = pulses.sigma(), overlap = pulses.rate() * dt;
  const PoissonOptions& options = pulses.options();
  for (const double time : times)
    require(std::isfinite(time) && time >= 0, "PulseSuperposition: times must be finite and at least 0", time, "s");
  const Pulses law(system, pulses, overlap_, progress);
  const Rates rest = law.rates(0, sigma);
  const double per_composite = overlap_ == Overlap::none ? 1 : 1 + overlap;  // at most: the mean square
  if (rest.lost > 1e-3)
    throw std::invalid_argument("PulseSuperposition: friction never stops the slider again after " +
                                rounded(100 * rest.lost) + " %" + " of the pulses");

  const std::size_t count = times.size();
  Moments moments;
  moments.time.assign(times.begin(), times.end());
  for (Estimates* e : {&moments.displacement_mean, &moments.displacement_variance, &moments.covariance,
                       &moments.velocity_mean, &moments.velocity_variance}) {
    e->value.assign(count, 0);
    e->error.assign(count, 0);
  }
  const auto set = [&](std::size_t i, double mean, double variance, const Rates& rates, double growth) {
    moments.displacement_mean.value[i] = mean;
    moments.displacement_variance.value[i] = variance;
    moments.covariance.value[i] = growth / 2;  // thesis (5.59)
    moments.velocity_mean.value[i] = rates.drift;
    moments.velocity_variance.value[i] = rates.velocity_square;
  };
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t i) { return times[i]; });

  if (system.constant_level && !options.envelope) {
    for (std::size_t i = 0; i < count; ++i) set(i, rest.drift * times[i], rest.growth * times[i], rest, rest.growth);
    moments.growth_rate = {rest.growth, 0};
  } else if (system.constant_level) {
    const double longest = std::max(pulses.duration() / 64, 4 * dt);
    double now = 0, mean = 0, variance = 0;
    for (const std::size_t i : order) {
      while (now < times[i]) {
        const double to = std::min(times[i], now + longest);
        numerics::gauss_points<points>(now, to, [&](double t, double weight) {
          const double strength = sigma * (*options.envelope)(t);
          if (strength == 0) return;
          const Rates rates = law.rates(0, strength);
          mean += weight * rates.drift;
          variance += weight * rates.growth;
        });
        now = to;
      }
      const double strength = sigma * (*options.envelope)(now);
      const Rates rates = strength > 0 ? law.rates(0, strength) : Rates{};
      set(i, mean, variance, rates, rates.growth);
    }
    moments.growth_rate = {nan, 0};
  } else {
    const double reach = reach_of(system, std::max(std::sqrt(rest.growth / pulses.rate()), sigma * dt * dt * 1e-6));
    // The range of validity is checked for the whole excitation, regardless of the times.
    const double end = std::max(pulses.duration(), times.empty() ? 0 : std::ranges::max(times));
    const std::string halves = "the " + rounded(reach) + " m over which the slip level halves";
    const auto escapes = [&](const std::string& why) {
      throw std::invalid_argument("PulseSuperposition: the slider escapes within " + shortest(end) + " s: " + why);
    };
    // A slider that is carried off continues at some sigma dt, and then dominates the variance.
    if (rest.lost * pulses.rate() * std::pow(sigma * dt * end, 2) / 3 > 0.1 * rest.growth)
      escapes("friction never stops it again after " + rounded(100 * rest.lost) +
              " % of the pulses, which make up the variance");
    const std::string outgrows = "its rms displacement exceeds four times " + halves;
    if (std::isfinite(reach) && std::sqrt(rest.growth * end) > 4 * reach) escapes(outgrows);
    const Overlaps overlaps = overlaps_of(*this, system, pulses, progress);
    if (!overlaps.reason.empty()) {
      remark(moments, "The effect of overlapping pulses is unknown: " + overlaps.reason + ".");
    } else {
      if (const double spread = std::sqrt(overlaps.growth * end); overlaps.matter() && spread > reach / 2)
        escapes("overlapping pulses move it by " + rounded(spread) + " m rms, more than half of " + halves);
      const double met = pulses.rate() * end * pulses.rate() * options.shape.length() * dt;
      const double ratio = rest.growth == overlaps.own ? 1 : rest.growth / overlaps.own;
      if (met > 0.1 && !(ratio > 0.7 && ratio < 1.3))
        throw std::invalid_argument("PulseSuperposition: " + rounded(met) + " pulses overlap within " + shortest(end) +
                                    " s, and single slips are not short against " + halves + ": no theory covers both");
      if (overlaps.matter())
        remark(moments, "Pulses overlap: under Coulomb friction of this level the rms displacement is " +
                            rounded(overlaps.factor) +
                            " times that of this theory (PulseChain); expect about as much here.");
    }
    RatesByPosition by_position(law, sigma, std::isinf(reach) ? 1 : reach / 4);
    struct Slopes {
      double mean, variance;
      Rates rates;
    };
    const auto slopes = [&](double mean, double variance) {
      if (std::isinf(reach)) return Slopes{rest.drift, rest.growth, rest};
      const double spread = std::sqrt(variance);
      Slopes s{0, 0, {}};
      double total = 0;
      for (int k = -20; k <= 20; ++k) {  // the trapezoidal rule, which is for Gaussian laws as good as any
        const double z = 0.3 * k, weight = std::exp(-z * z / 2);
        const Rates r = by_position(mean + spread * z);
        total += weight;
        s.mean += weight * r.drift;
        s.variance += weight * (2 * spread * z * r.drift + r.growth);
        s.rates.drift += weight * r.drift;
        s.rates.velocity_square += weight * r.velocity_square;
        if (spread == 0) break;
      }
      return Slopes{s.mean / total, s.variance / total, {s.rates.drift / total, 0, s.rates.velocity_square / total, 0}};
    };
    double now = 0, mean = 0, variance = 0, widest = 0;
    const double scale = std::isinf(reach) ? infinity : 0.05 * reach;
    const auto advance_to = [&](double time) {
      double most = infinity;
      while (now < time) {
        if (progress) progress();
        const Slopes k1 = slopes(mean, variance);
        const double step =
            std::min({time - now, most, scale * reach / std::abs(k1.variance), scale / std::abs(k1.mean)});
        const double h = now + step > now ? step : time - now;
        const auto positive = [](double v) { return std::max(v, 0.0); };
        const Slopes k2 = slopes(mean + h / 2 * k1.mean, positive(variance + h / 2 * k1.variance));
        const Slopes k3 = slopes(mean + h / 2 * k2.mean, positive(variance + h / 2 * k2.variance));
        const Slopes k4 = slopes(mean + h * k3.mean, positive(variance + h * k3.variance));
        // Where the slider is pulled back to its place, the equations are stiff.
        const double of_mean = h * std::abs(k4.mean - k1.mean), of_variance = h * std::abs(k4.variance - k1.variance);
        if (h == step && (of_variance > 0.2 * (variance + h * std::abs(k1.variance)) ||
                          of_mean > 0.2 * (std::abs(mean) + std::sqrt(variance) + h * std::abs(k1.mean)))) {
          most = h / 2;
          continue;
        }
        most = 2 * h;
        mean += h / 6 * (k1.mean + 2 * k2.mean + 2 * k3.mean + k4.mean);
        variance = positive(variance + h / 6 * (k1.variance + 2 * k2.variance + 2 * k3.variance + k4.variance));
        now = h == step ? now + h : time;
        if (time - now < 1e-12 * time) now = time;
        if (std::hypot(mean, std::sqrt(variance)) > 4 * reach) escapes(outgrows);
      }
    };
    for (const std::size_t i : order) {
      advance_to(times[i]);
      const Slopes s = slopes(mean, variance);
      set(i, mean, variance, s.rates, s.variance);
      widest = std::max(widest, std::hypot(mean, std::sqrt(variance)));
    }
    advance_to(end);
    if (variance < rest.growth * end / 4 && std::sqrt(rest.growth * end) > reach / 4)
      escapes("friction draws it back to its place until rare pulses carry it beyond " + halves);
    moments.growth_rate = {rest.growth, 0};
    if (widest > reach / 2)
      remark(moments, "The displacement is no longer small against the distance over which the slip level halves, " +
                          digits(reach) + " m: it is not Gaussian, as is assumed.");
  }

  if (rest.velocity_square == 0 && sigma > 0) {
    const double level = std::min(system.level(0, Direction::forward), system.level(0, Direction::backward));
    remark(moments, "Nothing slips: the slip level, " + digits(level) +
                        " m/s^2, is never exceeded by a pulse whose chance a double can hold.");
  }
  if (rest.lost > 0)
    remark(moments, "Left out: pulses that carry the slider off for good, " + digits(rest.lost / per_composite) +
                        " of all or less.");
  if (overlap > 1)
    remark(moments,
           "Pulses overlap much, rate x half_width = " + digits(overlap) + ": superposition was never right here.");
  const double early = 40 * dt;  // there a straight line from the origin is off by 3 % without friction
  if (const auto n = std::ranges::count_if(times, [&](double t) { return t > 0 && t < early; }); n > 0)
    remark(moments, std::to_string(n) + " of the times " + (n == 1 ? "is" : "are") + " below " + digits(early) +
                        " s, 40 half widths: too short for (5.39), which takes the velocity for stationary and the "
                        "offsets for all there is; from_rest has no such bound under Coulomb friction.");
  return moments;
}

Moments PulseSuperposition::from_rest(const detail::PulseSystem& system, const PoissonPulses& pulses,
                                      std::span<const double> times, const std::function<void()>& progress) const {
  if (pulses.options().envelope)
    throw std::invalid_argument("PulseSuperposition: from_rest does not cover an envelope, predict does");
  Moments moments = predict(system, pulses, {}, progress);  // the growth rate, and what is refused
  std::vector<std::size_t> order(times.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t i) { return times[i]; });
  std::vector<double> ascending;
  for (const std::size_t i : order) {
    require(std::isfinite(times[i]) && times[i] >= 0, "PulseSuperposition: times must be finite and at least 0",
            times[i], "s");
    ascending.push_back(times[i]);
  }
  const std::vector<History> histories =
      Pulses(system, pulses, overlap_, progress).histories(ascending, pulses.sigma());
  moments.time.assign(times.begin(), times.end());
  const auto fill = [&](Estimates& estimates, double History::*part, double factor) {
    estimates.value.resize(times.size());
    estimates.error.assign(times.size(), 0);
    for (std::size_t k = 0; k < order.size(); ++k) estimates.value[order[k]] = factor * histories[k].*part;
  };
  fill(moments.displacement_mean, &History::mean, 1);
  fill(moments.displacement_variance, &History::variance, 1);
  fill(moments.covariance, &History::growth, 0.5);  // thesis (5.59)
  fill(moments.velocity_mean, &History::velocity_mean, 1);
  fill(moments.velocity_variance, &History::velocity_variance, 1);
  if (pulses.options().stationary_start)
    remark(moments, "From rest as if no pulse had arrived before time zero: a stationary start is not followed.");
  return moments;
}

namespace {

/// The x that a compound Poisson sum exceeds with a probability below exp(-32): the least of Chernoff's bounds.
/// @param slips  (length, expected number), lengths of one sign the other way
double chernoff(const std::vector<std::pair<double, double>>& slips, double spread) {
  constexpr double tail = 32;
  double longest = spread, bound = infinity;
  for (const auto& [length, count] : slips) longest = std::max(longest, std::abs(length));
  for (double theta = 0.01 / longest;; theta *= 1.1) {
    double log_mean = 0;
    for (const auto& [length, count] : slips) log_mean += count * std::expm1(theta * length);
    const double here = (log_mean + tail) / theta;
    if (!(here < bound - 1e-6 * std::abs(bound)) && std::isfinite(bound)) return bound;
    bound = std::min(bound, here);
  }
}

/// What overlaps change, of which the superposition knows nothing.
/// @throws std::invalid_argument where they change the standard deviation by more than a factor of 2
std::string distribution_remark(const Overlaps& overlaps, const PoissonPulses& pulses, double time) {
  if (!overlaps.reason.empty()) {
    const double met = pulses.rate() * time * pulses.rate() * pulses.options().shape.length() * pulses.half_width();
    return met <= 0.1 ? "" : rounded(met) + " pulses overlap, with unknown effect: " + overlaps.reason + ".";
  }
  const double ratio = 1 / overlaps.factor;
  require(ratio >= 0.5 && ratio <= 2,
          "PulseSuperposition: for a distribution the standard deviation must be within a factor of 2 of that by "
          "PulseChain, which includes overlaps and has a distribution, too",
          ratio);
  if (std::abs(ratio - 1) <= 0.05) return "";
  return "Pulses overlap: the standard deviation is " + rounded(ratio) + " times that by PulseChain. " +
         detail::pulse_accuracy().rare;
}

}  // namespace

DisplacementDistribution PulseSuperposition::distribution(const detail::PulseSystem& system,
                                                          const PoissonPulses& pulses, double time) const {
  const double overlap = pulses.rate() * pulses.half_width();
  require(std::isfinite(time) && time >= 0, "PulseSuperposition: time must be finite and at least 0", time, "s");
  require(overlap <= max_overlap_of_distribution,
          "PulseSuperposition: a distribution is for rare pulses, rate x half_width at most " +
              shortest(max_overlap_of_distribution),
          overlap);
  if (!system.constant_level)
    throw std::invalid_argument("PulseSuperposition: a distribution is covered for constant slip levels only");
  if (pulses.options().envelope)
    throw std::invalid_argument("PulseSuperposition: a distribution under an envelope is not covered");

  const std::function<void()> no_progress;
  const std::string remark = distribution_remark(overlaps_of(*this, system, pulses, no_progress), pulses, time);
  const Pulses pulse(system, pulses, overlap_, no_progress);
  const Pulses::Law law = pulse.law(0, pulses.sigma());
  const double expected = law.rate * time;
  const auto offset = [&](double b) {
    const double dx = system.effect(b, 0).offset;
    if (!std::isfinite(dx))
      throw std::invalid_argument("PulseSuperposition: friction never stops the slider again after a pulse of " +
                                  shortest(b) + " m/s^2");
    return dx;
  };
  detail::Slips slips;
  for (const auto& [from, to, probability] : pulse.cells(law, pulses.sigma())) {
    const double count = expected * probability;
    if (!(count > 0) || offset((from + to) / 2) == 0) continue;
    slips.pieces.push_back({offset(from), offset(to), count});
    slips.count += count;
  }
  std::vector<std::pair<double, double>> right, left;
  for (const auto& [b, weight] : pulse.nodes(law, pulses.sigma())) {
    const double dx = offset(b);
    double power = expected * weight;
    if (dx != 0) right.emplace_back(dx, power), left.emplace_back(-dx, power);
    for (double& moment : slips.moments) moment += power *= dx;
  }
  if (slips.moments[1] > 0) {
    const double spread = std::sqrt(slips.moments[1]);
    slips.least = -chernoff(left, spread);
    slips.greatest = chernoff(right, spread);
  }
  return DisplacementDistribution(slips, remark);
}

double peak_from_growth(double growth_rate, double duration, double probability) {
  require(std::isfinite(growth_rate) && growth_rate >= 0, "peak_from_growth: growth_rate must be finite and at least 0",
          growth_rate, "m^2/s");
  require(std::isfinite(duration) && duration >= 0, "peak_from_growth: duration must be finite and at least 0",
          duration, "s");
  require(probability > 0 && probability < 1, "peak_from_growth: probability must lie in (0, 1)", probability);
  const double spread = std::sqrt(growth_rate) * std::sqrt(duration);
  // The probability as a function of z = L / spread: theta functions of each other's modulus.
  const auto below = [&](double z) {
    double sum = 0;
    for (int k = 0; k < 8; ++k) {
      const double j = 2 * k + 1, q = j * std::numbers::pi / z;
      sum += (k % 2 ? -1 : 1) / j * std::exp(-q * q / 8);
    }
    return 4 / std::numbers::pi * sum;
  };
  const auto above = [&](double z) {  // its complement
    double sum = 0;
    for (int k = 0; k < 8; ++k) sum += (k % 2 ? -1 : 1) * std::erfc((2 * k + 1) * z / std::numbers::sqrt2);
    return 2 * sum;
  };
  const bool rare = probability > 0.5;
  const auto reached = [&](double z) { return rare ? above(z) <= 1 - probability : below(z) >= probability; };
  double high = 1;
  while (!reached(high)) high *= 2;
  return numerics::first_where(0, high, reached) * spread;
}

}  // namespace stickslip::theory
