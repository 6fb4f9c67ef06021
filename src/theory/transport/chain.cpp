#include "theory/transport/chain.hpp"
#include "theory/transport/spline_density.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <utility>

#include "lanes/matrix_product.hpp"
#include "stickslip/base/equal.hpp"
#include "stickslip/numerics/gauss_legendre.hpp"
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
      ends_.emplace_back();
      load_.average(i, corners(from, speed, i), [&](double n, double weight) { land(from, speed, n, weight, row); });
      if (load_.pulses()) see(from, speed, load_.load(i));
      keep(row);
    }
  }
  start_ = Vector::Zero(index(size()));
  const std::size_t rest = x_.node_at(0) * speeds() + v_.size();
  start_.segment(index(rest * load_.size()), index(load_.size())) = load_.start();
}

namespace {

void add(Chain::Means& means, double weight, double x, double v) {
  means.x += weight * x;
  means.xx += weight * x * x;
  means.xv += weight * x * v;
  means.v += weight * v;
  means.vv += weight * v * v;
  if (equal(v, 0)) means.rest += weight;
}

}  // namespace

/// Displacement and velocity of a place.
std::pair<double, double> Chain::at(std::size_t place) const {
  const std::size_t speed = place % speeds();
  return {x_.node(place / speeds()), speed < v_.size() ? v_.node(speed) : 0};
}

void Chain::land(double x, double v, double load, double weight, Row& row) {
  const auto [to, speed, farthest] = motion_(x, v, load, step_);
  if (farthest > wall_) return;
  landings_.push_back({weight, to, speed});
  add(ends_.back(), weight, to, speed);
  each_place(landings_.back(), [&](std::size_t place, bool mirrored, double part) {
    const std::size_t leads = place + (mirrored ? places() : 0);
    auto& [sum, moving] = row.weights[leads];
    if (equal(sum, 0) && equal(moving, 0)) row.places.push_back(leads);
    sum += part;
    moving += part * (to - x);
  });
}

void Chain::see(double x, double v, double load) {
  Means& means = seen_means_.emplace_back();
  numerics::gauss_points<views>(0.0, 1.0, [&](double part, double weight) {
    const auto [to, speed, farthest] = motion_(x, v, load, part * step_);
    seen_.push_back({weight, to, speed});
    add(means, weight, to, speed);
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

/// The loads, of those for which one stands, at which the landing has corners: where the slider just comes to rest, and
/// where it just leaves again.
std::vector<double> Chain::corners(double x, double v, std::size_t i) const {
  std::vector<double> found;
  const double far = load_.reach(i), least = load_.load(i) - far, most = load_.load(i) + far, tiny = 1e-9 * far * step_;
  if (equal(far, 0)) return found;
  const double fastest = motion_(x, v, least, step_).velocity, slowest = motion_(x, v, most, step_).velocity;
  for (const double speed : {tiny, -tiny}) {
    if (!(slowest < speed && speed < fastest)) continue;
    const auto excess = [&](double load) { return speed - motion_(x, v, load, step_).velocity; };
    found.push_back(numerics::root(excess, least, speed - fastest, most, speed - slowest, 1e-7 * far));
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
  const std::size_t loads = load_.loads(), block = load_.size();
  Vector landed = Vector::Zero(index(size()));
  std::vector<double> given(load_.largest_share()), turned(given);
  for (const Term& term : terms)
    for (std::size_t row = 0; row < rows(); ++row) {
      const std::size_t i = row % loads;
      const auto [first, count] = load_.share(i);
      load_.give(i, term.nodes.data() + row / loads * block, given.data());
      const auto land = [&](std::size_t entry, std::size_t last, std::size_t state) {
        for (; entry < last; ++entry) {
          double* const to = landed.data() + place_[entry] * block + state;
          const double weight = term.entries[entry];
          for (std::size_t j = 0; j < count; ++j) to[j] += weight * given[j];
        }
      };
      land(first_entry_[row], first_mirrored_[row], first);
      if (first_mirrored_[row] == first_entry_[row + 1]) continue;
      for (std::size_t j = 0; j < count; ++j) turned[load_.mirror(i, j)] = static_cast<double>(parity) * given[j];
      std::swap(given, turned);
      land(first_mirrored_[row], first_entry_[row + 1], load_.share(load_.mirrored(i)).first);
    }
  if (!load_.adjoint_step()) return landed;
  Vector result(index(size()));
  matrix_product(load_.adjoint_step()->data(), block, landed.data(), places(), result.data());
  return result;
}

Chain::Vector Chain::carry(const Vector& p, Parity parity) const { return carry({{p, weight_}}, parity); }

Chain::Vector Chain::carry(const Vector& q, const Vector& p, double drift, Parity parity) const {
  const Vector still = q - drift * p;
  return carry({{still, weight_}, {p, moving_}}, parity);
}

/// The probability of a row.
double Chain::weight(std::size_t row, const Vector& p) const {
  return load_.weight(row % load_.loads(), p.data() + row / load_.loads() * load_.size());
}

std::vector<double> Chain::below(const Vector& p, std::span<const double> points) const {
  Vector means = Vector::Zero(index(x_.size()));  // of the functions of the nodes of x
  for (std::size_t row = 0; row < rows(); ++row) {
    const double weight = this->weight(row, p);
    const auto add = [&](const Landing& to) {
      const Panels::Stencil in_x = x_.at(to.to);
      for (std::size_t k = 0; k <= x_.degree(); ++k)
        means[index(in_x.first + k)] += weight * to.weight * in_x.weights[k];
    };
    if (load_.pulses())
      std::for_each_n(seen_.begin() + static_cast<std::ptrdiff_t>(row * views), views, add);
    else
      for (std::size_t l = first_landing_[row]; l < first_landing_[row + 1]; ++l) add(landings_[l]);
  }
  if (mirrored()) means = (means + means.reverse().eval()) / 2;
  return SplineDensity(x_, means, 0).below(points);
}

Chain::Speeds Chain::speeds(const Vector& p, std::span<const double> sizes) const {
  const std::vector<double>& edges = v_.edges();
  const auto rest = std::ranges::lower_bound(edges, 0.0);
  std::vector<double> of_backward(std::make_reverse_iterator(rest + 1), edges.rend());
  for (double& edge : of_backward) edge = -edge;
  const Panels forward({rest, edges.end()}, v_.degree());
  const Panels backward = rest == edges.begin() ? forward : Panels(of_backward, v_.degree());
  Vector ahead = Vector::Zero(index(forward.size())), back = Vector::Zero(index(backward.size()));
  Speeds found;
  for (std::size_t row = 0; row < rows(); ++row) {
    const double weight = this->weight(row, p);
    std::for_each_n(seen_.begin() + static_cast<std::ptrdiff_t>(row * views), views, [&](const Landing& to) {
      const double part = weight * to.weight;
      if (equal(to.speed, 0)) {
        found.rest += part;
        return;
      }
      const bool turned = to.speed < 0 && !mirrored();
      const Panels::Stencil in_v = (turned ? backward : forward).at(std::abs(to.speed));
      for (std::size_t k = 0; k <= v_.degree(); ++k)
        (turned ? back : ahead)[index(in_v.first + k)] += part * in_v.weights[k];
    });
  }
  if (mirrored()) back = ahead = ahead / 2;
  found.forward = ahead.sum();
  found.backward = back.sum();
  found.forward_to = SplineDensity(forward, ahead, 0).below(sizes);
  found.backward_to = SplineDensity(backward, back, 0).below(sizes);
  return found;
}

Chain::Means Chain::sum(const std::vector<Means>& of_rows, const Vector& p) const {
  Means sum;
  for (std::size_t row = 0; row < rows(); ++row) {
    const double weight = this->weight(row, p);
    const Means& one = of_rows[row];
    sum.x += weight * one.x;
    sum.xx += weight * one.xx;
    sum.xv += weight * one.xv;
    sum.v += weight * one.v;
    sum.vv += weight * one.vv;
    sum.rest += weight * one.rest;
  }
  return sum;
}

double Chain::below(const Vector& p, double v, bool or_equal) const {
  double sum = 0;
  std::vector<double> probabilities, given(load_.largest_share());
  const auto add = [&](std::size_t row, double weight, double from, double speed) {
    const std::size_t load = row % load_.loads();
    load_.below(load_for(from, speed, v, or_equal), load, probabilities);
    load_.give(load, p.data() + row / load_.loads() * load_.size(), given.data());
    for (std::size_t j = 0; j < probabilities.size(); ++j) sum += weight * given[j] * (1 - probabilities[j]);
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
