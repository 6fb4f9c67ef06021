#include "theory/transport/chain.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "lanes/matrix_product.hpp"
#include "stickslip/base/equal.hpp"
#include "stickslip/numerics/root.hpp"

namespace stickslip::detail {
namespace {

Eigen::Index index(std::size_t i) { return static_cast<Eigen::Index>(i); }

}  // namespace

Chain::Chain(HeldMotion motion, Panels x, Panels v, LoadGrid load, double step, double wall)
    : motion_(std::move(motion)), x_(std::move(x)), v_(std::move(v)), load_(std::move(load)), step_(step), wall_(wall) {
  Row row{std::vector<std::array<double, 2>>(2 * places()), {}};
  for (std::size_t place = 0; place < places(); ++place) {
    const auto [from, speed] = at(place);
    for (std::size_t i = 0; i < load_.loads(); ++i) {
      means_.emplace_back();
      if (load_.white()) {
        std::vector<std::array<double, 2>> points;
        double sum = 0;
        gaussian_points(0, load_.deviation(), corners(from, speed), [&](double n, double weight) {
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
  const std::size_t rest = x_.node_at(0) * speeds() + v_.size();
  start_.segment(index(rest * load_.size()), index(load_.size())) = load_.stationary();
}

/// Displacement and velocity of a place.
std::pair<double, double> Chain::at(std::size_t place) const {
  const std::size_t speed = place % speeds();
  return {x_.node(place / speeds()), speed < v_.size() ? v_.node(speed) : 0};
}

void Chain::land(double x, double v, double load, double weight, Row& row) {
  const auto [to, speed, farthest] = motion_(x, v, load, step_);
  if (farthest > wall_) return;
  landings_.push_back({weight, to, speed});
  Means& means = means_.back();
  means.x += weight * to;
  means.xx += weight * to * to;
  means.xv += weight * to * speed;
  means.v += weight * speed;
  means.vv += weight * speed * speed;
  each_place(landings_.back(), [&](std::size_t place, bool mirrored, double part) {
    const std::size_t leads = place + (mirrored ? places() : 0);
    auto& [sum, moving] = row.weights[leads];
    if (equal(sum, 0) && equal(moving, 0)) row.places.push_back(leads);
    sum += part;
    moving += part * (to - x);
  });
}

/// Calls `use(place, mirrored, weight)` for the nodes of the stencil of a landing.
template <class Use>
void Chain::each_place(const Landing& landing, const Use& use) const {
  const bool mirrored = this->mirrored() && landing.speed < 0;
  const double side = mirrored ? -1 : 1;
  const Panels::Stencil in_x = x_.at(side * landing.to);
  const bool rests = equal(landing.speed, 0);
  const Panels::Stencil in_v = rests ? Panels::Stencil{v_.size(), {1}} : v_.at(side * landing.speed);
  for (std::size_t a = 0; a <= x_.degree(); ++a)
    for (std::size_t b = 0; b <= (rests ? 0 : v_.degree()); ++b) {
      const double part = landing.weight * in_x.weights[a] * in_v.weights[b];
      if (!equal(part, 0)) use((in_x.first + a) * speeds() + in_v.first + b, mirrored, part);
    }
}

/// Stores a row, and clears it.
void Chain::keep(Row& row) {
  std::ranges::sort(row.places);
  row.places.erase(std::ranges::unique(row.places).begin(), row.places.end());  // a sum can be 0 in between
  const auto mirrored = std::ranges::lower_bound(row.places, places());
  first_mirrored_.push_back(place_.size() + static_cast<std::size_t>(mirrored - row.places.begin()));
  for (const std::size_t leads : row.places) {
    const auto [weight, moving] = std::exchange(row.weights[leads], {});
    place_.push_back(static_cast<std::uint32_t>(leads % places()));
    weight_.push_back(weight);
    if (!with_displacement()) moving_.push_back(moving);
  }
  row.places.clear();
  first_entry_.push_back(place_.size());
  first_landing_.push_back(landings_.size());
}

/// The loads of white noise at which the landing has corners: where the slider just comes to rest, and where it just
/// leaves again.
std::vector<double> Chain::corners(double x, double v) const {
  std::vector<double> found;
  const double far = gaussian_reach * load_.deviation(), tiny = 1e-9 * load_.deviation() * step_;
  const double fastest = motion_(x, v, -far, step_).velocity, slowest = motion_(x, v, far, step_).velocity;
  for (const double speed : {tiny, -tiny}) {
    if (!(slowest < speed && speed < fastest)) continue;
    const auto excess = [&](double load) { return speed - motion_(x, v, load, step_).velocity; };
    found.push_back(numerics::root(excess, -far, speed - fastest, far, speed - slowest, 1e-7 * far));
  }
  return found;
}

/// The load above which the velocity after a step is at most, or below, `speed`: the velocity decreases with the load.
double Chain::load_for(double x, double v, double speed, bool or_equal) const {
  // A load beyond which the change of velocity during a step exceeds all that friction and spring can do.
  const auto reached = [&](double load) {
    const double after = motion_(x, v, load, step_).velocity;
    return after < speed || (or_equal && equal(after, speed));
  };
  double most =
      (std::abs(v) + std::abs(speed)) / step_ + motion_.stiffness() * std::abs(x) + motion_.hold(Direction::forward);
  for (int i = 0; i < 60 && !(reached(most) && !reached(-most)); ++i) most *= 2;
  if (!equal(speed, 0)) {  // apart from rest it is continuous and decreases
    const auto excess = [&](double load) { return speed - motion_(x, v, load, step_).velocity; };
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
        if (hidden == 1) {
          const double weight = sign * term.nodes[index(row)];
          for (std::size_t entry = first; entry < last; ++entry)
            landed[index(place_[entry])] += weight * term.entries[entry];
          continue;
        }
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
  const auto add = [&](std::size_t row, double weight, double from, double speed) {
    load_.below(load_for(from, speed, v, or_equal), row % load_.loads(), probabilities);
    for (std::size_t j = 0; j < hidden; ++j) sum += weight * p[index(row * hidden + j)] * (1 - probabilities[j]);
  };
  for (std::size_t row = 0; row < rows(); ++row) {
    if (load_.white()) {
      const auto [from, speed] = at(row);
      add(row, 1, from, speed);
      continue;
    }
    for (std::size_t l = first_landing_[row]; l < first_landing_[row + 1]; ++l)
      add(row, landings_[l].weight, landings_[l].to, landings_[l].speed);
  }
  return sum;
}

}  // namespace stickslip::detail
