#include "stickslip/histories.hpp"

#include <algorithm>

#include "coulomb_lanes.hpp"

namespace stickslip::detail {
Histories histories_by_pieces(const Coulomb& law, const GroundMotion& motion, const std::function<void()>& heartbeat) {
  constexpr std::size_t pieces = most_lanes;
  const std::size_t segments = motion.segments();
  const std::size_t length = segments / pieces / row_padding * row_padding;  // of a piece; what is left comes last
  const std::span<const double> ground = motion.acceleration();
  const bool linear = motion.interpolation() == Interpolation::linear;
  Histories result;
  std::vector<double>&x = result.displacement, &v = result.velocity;
  x.resize(motion.samples());
  v.resize(motion.samples());

  // All pieces from rest, eight segments at a time: sample k of piece p is column p of row k.
  std::vector<double> displacement(pieces), velocity(pieces), peak(pieces);
  const LaneStates states{displacement.data(), velocity.data(), peak.data()};
  const CoulombLanes lanes{law.forward(), law.backward(), motion.dt()};
  std::vector<double> loads((row_padding + 1) * pieces), xs(row_padding * pieces), vs(row_padding * pieces);
  for (std::size_t p = 0; p < pieces; ++p) loads[row_padding * pieces + p] = ground[p * length];
  for (std::size_t k = 0; k < length; k += row_padding) {
    if (heartbeat && k % 4096 == 0) heartbeat();
    std::copy_n(&loads[row_padding * pieces], pieces, loads.data());
    for (std::size_t p = 0; p < pieces; p += row_padding)
      transpose(&ground[p * length + k + 1], length, row_padding, &loads[pieces + p], pieces);
    for (std::size_t i = 0; i < row_padding; ++i) {
      const double* const start = &loads[i * pieces];
      advance_lanes(lanes, pieces, start, linear ? start + pieces : start, states);
      std::copy_n(displacement.data(), pieces, &xs[i * pieces]);
      std::copy_n(velocity.data(), pieces, &vs[i * pieces]);
    }
    for (std::size_t p = 0; p < pieces; p += row_padding) {
      transpose(&xs[p], pieces, row_padding, &x[p * length + k + 1], length);
      transpose(&vs[p], pieces, row_padding, &v[p * length + k + 1], length);
    }
  }

  // Each piece again from where the one before has truly come to, until both are stuck. The first was true, and what is
  // left over has nothing to meet.
  State state;
  const NoObserver observer;
  for (std::size_t p = 0; p <= pieces; ++p) {
    const std::size_t begin = p * length, end = p < pieces ? begin + length : segments;
    bool met = p == 0;
    std::size_t i = begin;
    double ahead = 0;  // of the piece's motion
    for (; i < end && !met; ++i) {
      if (heartbeat && (i + 1) % 4096 == 0) heartbeat();
      advance(law, Polynomial{}, motion.segment(i), state, observer);
      met = p < pieces && state.velocity == 0 && v[i + 1] == 0;
      ahead = state.displacement - x[i + 1];
      x[i + 1] = state.displacement;
      v[i + 1] = state.velocity;
    }
    for (; i < end; ++i) x[i + 1] += ahead;
    state = State::at(x[end], v[end]);
  }
  return result;
}

}  // namespace stickslip::detail
