#include "structure/stuck_motion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "stickslip/base/units.hpp"
#include "stickslip/friction/coulomb.hpp"
#include "stickslip/sliding/detail/run.hpp"
#include "structure/expansion.hpp"

namespace stickslip::detail {

StuckSpan pass_step(const StuckFlow& flow, double* state, double n_start, double n_end) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  StuckSpan span{infinity, -infinity, 1};
  double now = flow.demand().at(state, n_start);
  flow.each_part(n_start, n_end, [&](double n, double change) {
    const double between = flow.demand().departure(state, n, change);
    flow.advance(state, n, change);
    const double next = flow.demand().at(state, n + change);
    span.lowest = std::min(span.lowest, std::min(now, next) - between);
    span.highest = std::max(span.highest, std::max(now, next) + between);
    now = next;
  });
  return span;
}

StuckMotion::StuckMotion(const ModalInterface& of, const GroundMotion& motion) {
  if (!StuckFlow::covers(of, motion.dt())) return;
  flow_.emplace(of, motion.dt());
  const std::size_t size = 2 * flow_->modes(), segments = motion.segments();
  states_.assign((segments + 1) * size, 0);
  segments_.reserve(segments);
  std::vector<double> now(size);
  const LoadPieces pieces(motion, 0);
  for (std::size_t i = 0; i < segments; ++i) {
    const LoadSegment segment = pieces.segment(i);
    StuckSpan span = pass_step(*flow_, now.data(), -segment.load_start, -segment.load_end);
    const double first = std::max(segment.normal_start, 0.0) / standard_gravity;
    const double last = std::max(segment.normal_end, 0.0) / standard_gravity;
    span.least_weight = std::min(first, last);
    largest_weight_ = std::max({largest_weight_, first, last});
    largest_ = std::max({largest_, -span.lowest, span.highest});
    std::ranges::copy(now, states_.begin() + static_cast<std::ptrdiff_t>((i + 1) * size));
    segments_.push_back(span);
    if (i % block == 0) {
      blocks_.push_back(span);
    } else {
      StuckSpan& all = blocks_.back();
      all = {std::min(all.lowest, span.lowest), std::max(all.highest, span.highest),
             std::min(all.least_weight, span.least_weight)};
    }
  }
}

std::optional<double> largest_top(const ModalInterface& of, const GroundMotion& motion) {
  if (!StuckFlow::covers(of, motion.dt())) return std::nullopt;
  const StuckFlow flow(of, motion.dt());
  const GroundMotion::Pieces pieces(motion);
  const auto size = static_cast<Eigen::Index>(flow.modes());
  Eigen::VectorXd now(2 * size);
  const auto top = [&](double n) { return std::abs(flow.top().at(now.data(), n)); };
  const auto pass = [&](auto&& part) {
    now.setZero();
    for (std::size_t i = 0; i < motion.segments(); ++i) {
      const Segment segment = pieces.segment(i);
      flow.each_part(segment.start, segment.end, part);
    }
  };
  // First at the ends of the parts, then within those parts that may go beyond.
  double largest = 0;
  pass([&](double n, double change) {
    flow.advance(now.data(), n, change);
    largest = std::max(largest, top(n + change));
  });
  Expansion expansion(of, flow.part());
  StructureState start;
  pass([&](double n, double change) {
    const double begin = top(n), between = flow.top().departure(now.data(), n, change);
    start.modal_displacement = values(now.head(size));
    start.modal_velocity = values(now.tail(size));
    flow.advance(now.data(), n, change);
    if (std::max(begin, top(n + change)) + between <= largest) return;
    expansion.expand(start, GroundLoad{flow.part(), n, n + change}, flow.part(), flow.part(), 0, Coulomb(1));
    const Eigen::VectorXd values = expansion.modal_displacement() * of.shapes.row(0).transpose();
    largest = largest_magnitude(values.data(), expansion.order(), largest);
  });
  return largest;
}

}  // namespace stickslip::detail
