#include "theory/transport/chain.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "lanes/matrix_product.hpp"
#include "stickslip/base/equal.hpp"
#include "stickslip/ground/segment.hpp"
#include "stickslip/numerics/root.hpp"
#include "stickslip/sliding/advance.hpp"
#include "stickslip/state.hpp"

namespace stickslip::detail {
namespace {

/// The largest |x| of a motion: it is at its ends or where the velocity is zero.
struct Farthest {
  double distance;

  void slide(const Slip&) const noexcept {}
  void event(EventKind, double, const State& state) noexcept {
    distance = std::max(distance, std::abs(state.displacement));
  }
};

Eigen::Index index(std::size_t i) { return static_cast<Eigen::Index>(i); }

}  // namespace

bool Chain::mirrors(const Slider<Coulomb>& slider) noexcept {
  return equal(slider.law().forward(), slider.law().backward());
}

Chain::Chain(const Slider<Coulomb>& slider, Panels x, Panels v, LoadGrid load, double step, double wall)
    : slider_(slider), x_(std::move(x)), v_(std::move(v)), load_(std::move(load)), step_(step), wall_(wall) {
  Row row;
  for (std::size_t place = 0; place < places(); ++place) {
    const double from = x_.node(place / v_.size()), speed = v_.node(place % v_.size());
    for (std::size_t i = 0; i < load_.loads(); ++i) {
      row.clear();
      means_.emplace_back();
      if (load_.white()) {
        // The landing has corners where the slider just comes to rest and where it just leaves again.
        const std::vector<double> corners = {load_for(from, speed, 0, true), load_for(from, speed, 0, false)};
        std::vector<std::array<double, 2>> points;
        double sum = 0;
        gaussian_points(0, load_.deviation(), corners, [&](double n, double weight) {
          points.push_back({n, weight});
          sum += weight;
        });
        for (const auto& [n, weight] : points) land(from, speed, n, weight / sum, row);
      } else {
        land(from, speed, load_.load(i), 1, row);
      }
      keep(row);
    }
  }
  start_ = Vector::Zero(index(size()));
  const std::size_t rest = x_.node_at(0) * v_.size() + v_.node_at(0);
  start_.segment(index(rest * load_.size()), index(load_.size())) = load_.stationary();
}

void Chain::land(double x, double v, double load, double weight, Row& row) {
  State state = State::at(x, v);
  Farthest farthest{std::abs(x)};
  advance(slider_, Segment{step_, load, load}, state, farthest);
  const double to = state.displacement, speed = state.velocity;
  if (std::max(farthest.distance, std::abs(to)) > wall_) return;
  landings_.push_back({weight, to, speed});
  Means& means = means_.back();
  means.x += weight * to;
  means.xx += weight * to * to;
  means.xv += weight * to * speed;
  means.v += weight * speed;
  means.vv += weight * speed * speed;
  each_place(landings_.back(), [&](std::size_t place, bool mirrored, double part) {
    auto& [sum, moving] = row[{place, mirrored}];
    sum += part;
    moving += part * (to - x);
  });
}

/// Calls `use(place, mirrored, weight)` for the nodes of the stencil of a landing.
template <class Use>
void Chain::each_place(const Landing& landing, const Use& use) const {
  const bool mirrored = this->mirrored() && landing.speed < 0;
  const double side = mirrored ? -1 : 1;
  const Panels::Stencil in_x = x_.at(side * landing.to), in_v = v_.at(side * landing.speed);
  for (std::size_t a = 0; a <= x_.degree(); ++a)
    for (std::size_t b = 0; b <= v_.degree(); ++b) {
      const double part = landing.weight * in_x.weights[a] * in_v.weights[b];
      if (!equal(part, 0)) use((in_x.first + a) * v_.size() + in_v.first + b, mirrored, part);
    }
}

void Chain::keep(const Row& row) {
  for (const bool mirrored : {false, true}) {
    if (mirrored) first_mirrored_.push_back(place_.size());
    for (const auto& [to, weights] : row) {
      if (to.second != mirrored) continue;
      place_.push_back(static_cast<std::uint32_t>(to.first));
      weight_.push_back(weights[0]);
      if (x_.degree() == 0) moving_.push_back(weights[1]);
    }
  }
  first_entry_.push_back(place_.size());
  first_landing_.push_back(landings_.size());
}

double Chain::speed_after(double x, double v, double load) const {
  State state = State::at(x, v);
  advance(slider_, Segment{step_, load, load}, state);
  return state.velocity;
}

/// The load above which the velocity after a step is at most, or below, `speed`: the velocity decreases with the load.
double Chain::load_for(double x, double v, double speed, bool or_equal) const {
  // A load beyond which the change of velocity during a step exceeds all that friction and spring can do.
  const auto reached = [&](double load) {
    const double after = speed_after(x, v, load);
    return after < speed || (or_equal && equal(after, speed));
  };
  double most = (std::abs(v) + std::abs(speed)) / step_ + slider_.stiffness() * std::abs(x) + slider_.law().forward();
  for (int i = 0; i < 60 && !(reached(most) && !reached(-most)); ++i) most *= 2;
  if (!equal(speed, 0)) {  // apart from rest it is continuous and decreases
    const auto excess = [&](double load) { return speed - speed_after(x, v, load); };
    const double low = excess(-most), high = excess(most);
    if (low < 0 && high > 0) return numerics::root(excess, -most, low, most, high, 1e-10 * most);
  }
  return numerics::first_where(-most, most, reached);
}

/// Carries the sum of the weights of nodes in each term, times its weights of entries.
Chain::Vector Chain::carry(std::initializer_list<Term> terms, Parity parity) const {
  const std::size_t hidden = load_.hidden(), loads = load_.loads(), block = load_.size();
  Vector landed = Vector::Zero(index(size()));
  std::array<double, LoadGrid::max_hidden> given{};
  for (const Term& term : terms)
    for (std::size_t row = 0; row < rows(); ++row) {
      const std::size_t i = row % loads;
      for (const bool mirrored : {false, true}) {
        const std::size_t first = mirrored ? first_mirrored_[row] : first_entry_[row];
        const std::size_t last = mirrored ? first_entry_[row + 1] : first_mirrored_[row];
        if (first == last) continue;
        const double sign = mirrored ? static_cast<double>(parity) : 1;
        for (std::size_t j = 0; j < hidden; ++j)
          given[j] = sign * term.nodes[index(row * hidden + (mirrored ? hidden - 1 - j : j))];
        double* const into = landed.data() + (mirrored ? loads - 1 - i : i) * hidden;
        for (std::size_t entry = first; entry < last; ++entry) {
          double* const to = into + place_[entry] * block;
          const double weight = term.entries[entry];
          for (std::size_t j = 0; j < hidden; ++j) to[j] += weight * given[j];
        }
      }
    }
  if (load_.white()) return landed;
  Vector result(index(size()));
  matrix_product(load_.adjoint_step().data(), block, landed.data(), places(), result.data());
  return result;
}

Chain::Vector Chain::carry(const Vector& p, Parity parity) const { return carry({{p, weight_}}, parity); }

Chain::Vector Chain::carry(const Vector& q, const Vector& p, double drift, Parity parity) const {
  const Vector still = q - drift * p;
  return carry({{still, weight_}, {p, moving_}}, parity);
}

Chain::Complex Chain::carry(const Complex& p, const Turn& turn) const {
  const Vector opposite = -p.im;
  return {carry({{p.re, turn.cosine_}, {opposite, turn.sine_}}, Parity::even),
          carry({{p.re, turn.sine_}, {p.im, turn.cosine_}}, Parity::odd)};
}

Chain::Turn::Turn(const Chain& chain, double wave) : cosine_(chain.weight_.size()), sine_(chain.weight_.size()) {
  for (std::size_t row = 0; row < chain.rows(); ++row)
    for (std::size_t l = chain.first_landing_[row]; l < chain.first_landing_[row + 1]; ++l) {
      const Landing& to = chain.landings_[l];
      const double even = std::cos(wave * to.to), odd = std::sin(wave * to.to);
      chain.each_place(to, [&](std::size_t place, bool mirrored, double part) {
        const auto begin = chain.place_.begin();
        const auto first = static_cast<std::ptrdiff_t>(mirrored ? chain.first_mirrored_[row] : chain.first_entry_[row]);
        const auto last =
            static_cast<std::ptrdiff_t>(mirrored ? chain.first_entry_[row + 1] : chain.first_mirrored_[row]);
        const auto at = static_cast<std::size_t>(
            std::lower_bound(begin + first, begin + last, static_cast<std::uint32_t>(place)) - begin);
        cosine_[at] += part * even;
        sine_[at] += part * odd;
      });
    }
}

std::complex<double> Chain::characteristic(const Vector& p, double wave) const {
  std::complex<double> sum = 0;
  const std::size_t hidden = load_.hidden();
  for (std::size_t row = 0; row < rows(); ++row) {
    const double weight = p.segment(index(row * hidden), index(hidden)).sum();
    for (std::size_t l = first_landing_[row]; l < first_landing_[row + 1]; ++l)
      sum += weight * landings_[l].weight * std::polar(1.0, wave * landings_[l].to);
  }
  return mirrored() ? sum.real() : sum;
}

Chain::Means Chain::means(const Vector& p) const {
  Means sum;
  const std::size_t hidden = load_.hidden();
  for (std::size_t row = 0; row < rows(); ++row) {
    const double weight = p.segment(index(row * hidden), index(hidden)).sum();
    const Means& one = means_[row];
    sum.x += weight * one.x;
    sum.xx += weight * one.xx;
    sum.xv += weight * one.xv;
    sum.v += weight * one.v;
    sum.vv += weight * one.vv;
  }
  return sum;
}

double Chain::below(const Vector& p, double v, bool or_equal) const {
  double sum = 0;
  const std::size_t hidden = load_.hidden();
  std::vector<double> probabilities(hidden);
  for (std::size_t row = 0; row < rows(); ++row)
    for (std::size_t l = first_landing_[row]; l < first_landing_[row + 1]; ++l) {
      const double load = load_for(landings_[l].to, landings_[l].speed, v, or_equal);
      load_.below(load, row % load_.loads(), probabilities);
      for (std::size_t j = 0; j < hidden; ++j)
        sum += landings_[l].weight * p[index(row * hidden + j)] * (1 - probabilities[j]);
    }
  return sum;
}

}  // namespace stickslip::detail
