#include "theory/transport/rocking_chain.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "stickslip/base/equal.hpp"

namespace stickslip::detail {
namespace {

constexpr double unreached = std::numeric_limits<double>::infinity();

/// y = A e^t + B e^-t + C, from a place on a side under a load toward it.
struct RockingArc {
  double rising, falling, middle;

  RockingArc(double alpha, const RockingPlace& from, double toward) {
    const double acceleration = from.y - alpha + toward;
    rising = (acceleration + from.v) / 2;
    falling = (acceleration - from.v) / 2;
    middle = from.y - acceleration;
  }

  double y(double grown) const noexcept { return rising * grown + falling / grown + middle; }
  double v(double grown) const noexcept { return rising * grown - falling / grown; }

  /// e^t of the first impact after the start; infinite if there is none.
  double impact(const RockingPlace& from) const noexcept {
    if (!(from.y > 0)) {  // one root is the start
      const double other = falling / rising;
      return other > 1 ? other : unreached;
    }
    const double discriminant = middle * middle - 4 * rising * falling;
    if (!(discriminant > 0)) return unreached;
    const double q = -(middle + std::copysign(std::sqrt(discriminant), middle)) / 2;
    double first = unreached;
    for (const double root : {q / rising, falling / q})
      if (root > 1) first = std::min(first, root);
    return first;
  }

  /// The largest y up to e^t.
  double peak(const RockingPlace& from, double grown) const noexcept {
    const double turn = falling / rising;  // e^(2t)
    const double ends = std::max(from.y, y(grown));
    return from.v > 0 && turn > 1 && turn < grown * grown ? std::max(ends, y(std::sqrt(turn))) : ends;
  }
};

}  // namespace

std::optional<RockingPlace> rocked(const RockingScales& scales, RockingPlace at, double load, double time) {
  constexpr int most_bounces = 10'000;
  constexpr double slow = 1e-6;
  const auto alpha = [&](std::size_t side) { return scales.alpha[side]; };
  const auto toward = [&](std::size_t side) { return side == 0 ? load : -load; };
  const auto held_down = [&](std::size_t side) { return alpha(side) - toward(side); };
  double left = std::exp(time);  // e^ of the time that is left
  for (int bounces = 0; bounces < most_bounces; ++bounces) {
    if (!(at.y > 0) && !(at.v > 0)) {  // at rest, or an impact at the start
      if (at.v < 0) at = {1 - at.side, 0, -scales.restitution * at.v};
      // Small bounces end, as those of the block do.
      const double fast = scales.restitution < 1 ? slow : 0;
      if (!(at.v > fast)) {
        at.v = 0;
        if (held_down(at.side) >= 0) at.side = 1 - at.side;
        if (held_down(at.side) >= 0) return RockingPlace{0, 0, 0};
      }
    }
    const RockingArc arc(alpha(at.side), at, toward(at.side));
    const double impact = arc.impact(at), grown = std::min(impact, left);
    if (arc.peak(at, grown) >= scales.level) return std::nullopt;
    if (!(impact < left)) {
      at.y = std::max(arc.y(left), 0.0);
      at.v = arc.v(left);
      if (at.v + at.y - alpha(at.side) >= scales.lost) return std::nullopt;
      return at;
    }
    at = {at.side, 0, std::min(arc.v(impact), 0.0)};
    left /= impact;
  }
  return RockingPlace{0, 0, 0};
}

namespace {

/// After a push that changes the velocity to the right; at rest it lifts a block on either side.
RockingPlace pushed(RockingPlace at, double change) {
  if (!(at.y > 0) && equal(at.v, 0)) return {change < 0 ? 1U : 0U, 0, std::abs(change)};
  at.v += at.side == 0 ? change : -change;
  return at;
}

}  // namespace

RockingChain::RockingChain(const RockingScales& scales, Panels y, Panels v, const LoadGrid& loads, double unit,
                           double step, bool kicked, const std::function<void()>& progress)
    : scales_(scales), y_(std::move(y)), v_(std::move(v)), loads_(loads) {
  const auto count = static_cast<Eigen::Index>(places());
  // A row of each matrix, where many loads lead to the same values.
  Eigen::VectorXd same_row = Eigen::VectorXd::Zero(count), mirrored_row = same_row;
  std::vector<Eigen::Index> columns;
  const auto write = [&](Step& step_matrix, Eigen::Index row, Eigen::VectorXd& values) {
    step_matrix.startVec(row);
    for (const Eigen::Index column : columns)
      if (const double value = std::exchange(values[column], 0.0); value < 0 || value > 0)
        step_matrix.insertBack(row, column) = value;
  };
  for (std::size_t i = 0; i < loads_.loads(); ++i) {
    if (progress) progress();
    Motion motion{Step(count, count), Step(count, count), Eigen::VectorXd::Zero(count)};
    for (Eigen::Index row = 0; row < count; ++row) {
      const RockingPlace from = place(static_cast<std::size_t>(row));
      columns.clear();
      if (is_lost(from)) {
        motion.lost[row] = 1;
      } else {
        loads_.average(i, {}, [&](double n, double weight) {
          const auto there = kicked ? rocked(scales_, pushed(from, -n / unit * step), 0, step)
                                    : rocked(scales_, from, -n / unit, step);
          if (!there) {
            motion.lost[row] += weight;
            return;
          }
          const bool turns = scales_.symmetric() && there->side == 1;
          const std::size_t side = scales_.symmetric() ? 0 : there->side;
          const Panels::Stencil in_y = y_.at(there->y), in_v = v_.at(there->v);
          for (std::size_t a = 0; a <= y_.degree(); ++a)
            for (std::size_t b = 0; b <= v_.degree(); ++b) {
              const auto to =
                  static_cast<Eigen::Index>((side * y_.size() + in_y.first + a) * v_.size() + in_v.first + b);
              (turns ? mirrored_row : same_row)[to] += weight * in_y.weights[a] * in_v.weights[b];
              columns.push_back(to);
            }
        });
        std::ranges::sort(columns);
      }
      write(motion.same, row, same_row);
      write(motion.mirrored, row, mirrored_row);
    }
    motion.same.finalize();
    motion.mirrored.finalize();
    motions_.push_back(std::move(motion));
  }
}

RockingPlace RockingChain::place(std::size_t i) const noexcept {
  const std::size_t of_side = y_.size() * v_.size();
  return {i / of_side, y_.node(i % of_side / v_.size()), v_.node(i % v_.size())};
}

bool RockingChain::is_lost(const RockingPlace& at) const noexcept {
  return at.y >= scales_.level || at.v + at.y - scales_.alpha[at.side] >= scales_.lost;
}

RockingChain::Values RockingChain::lost() const {
  Values f = Values::Zero(static_cast<Eigen::Index>(places()), static_cast<Eigen::Index>(loads_.size()));
  for (std::size_t i = 0; i < places(); ++i)
    if (is_lost(place(i))) f.row(static_cast<Eigen::Index>(i)).setOnes();
  return f;
}

RockingChain::Values RockingChain::carry(const Values& f) const {
  Values after = f;
  if (loads_.adjoint_step()) after.noalias() = f * *loads_.adjoint_step();
  const Values mirrored = scales_.symmetric() ? Values(after.rowwise().reverse()) : Values();
  Values before(f.rows(), f.cols());
  for (std::size_t i = 0; i < motions_.size(); ++i) {
    const auto first = static_cast<Eigen::Index>(loads_.share(i).first),
               count = static_cast<Eigen::Index>(loads_.share(i).count);
    const Values part = after.middleCols(first, count);
    Values carried = motions_[i].same * part;
    if (scales_.symmetric()) {
      const Values other = mirrored.middleCols(first, count);
      carried += motions_[i].mirrored * other;
    }
    carried.colwise() += motions_[i].lost;
    before.middleCols(first, count) = carried;
  }
  return before;
}

double RockingChain::at_rest(const Values& f) const {
  const std::size_t rest = y_.node_at(0) * v_.size() + v_.node_at(0);
  return f.row(static_cast<Eigen::Index>(rest)).dot(loads_.start());
}

}  // namespace stickslip::detail
