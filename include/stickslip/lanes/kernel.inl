// Shared by the kernels of vector lanes: the rule of stick and slip, the loop over events, the zero of a polynomial.
//
// Included by each kernel, in its namespace, where code is compiled for its instruction set. STICKSLIP_LANES_INLINE is
// the attribute that inlines a function there.

/// Sliders at rest: which of them slip, when and in which direction. The rule of `advance` (sliding/advance.hpp). A
/// reversal is a stick of zero duration, so the rule covers reversals too.
template <class Vector>
struct DepartureOfLanes {
  typename Vector::Mask at_once, later;  ///< neither: at rest until the end
  typename Vector::Mask forward;         ///< direction of the slip
  Vector level;                          ///< of the load at which it slips, with the sign of the direction

  /// @param net, last          load without friction, now and at the end of the segment; linear in time
  /// @param holds_forward, holds_backward  friction that holds against each direction
  STICKSLIP_LANES_INLINE DepartureOfLanes(const Vector& net, const Vector& last, const Vector& holds_forward,
                                          const Vector& holds_backward) {
    const auto above = net > holds_forward, below = net < -holds_backward;
    at_once = above | below;
    forward = above | ((last > net) & ~below);
    level = select(forward, holds_forward, -holds_backward);
    later = ((forward & (last > holds_forward)) | (~forward & (last < -holds_backward))) & ~at_once;
  }
};

/// Advances some members of a row through the events of their segments, packed so that vectors are full.
/// @param members  one bit per member, at least one set
/// @param start    ground acceleration of each member of the row at the start of its segment
/// @param end      the same at its end
/// @param move     done = move(queue, place, x, v, peak): advances the members from `place` in the queue and returns
///                 which of them reached the end; the others stay where they were
/// @param alone    alone(queue, place) advances one of those others by the event loop
template <class Vector, class Move, class Alone>
STICKSLIP_LANES_INLINE void go_through_events(std::uint64_t members, const double* start, const double* end,
                                              const LaneStates& states, const Move& move, const Alone& alone) {
  LaneQueue queue(members, start, end, states);
  std::uint64_t open = 0;
  for (std::size_t k = 0; k < queue.count; k += Vector::size) {
    Vector x = Vector::load(queue.displacement + k), v = Vector::load(queue.velocity + k);
    Vector peak = Vector::load(queue.peak + k);
    open |= bits(~move(queue, k, x, v, peak)) << k;
    x.store(queue.displacement + k);
    v.store(queue.velocity + k);
    peak.store(queue.peak + k);
  }
  queue.put_back(states);
  for (std::size_t k = 0; k < queue.count; ++k)
    if ((open >> k & 1) != 0) alone(queue, k);
}

/// The only zero in (0, 1) of polynomials that are positive before it: Newton's method, kept within its bracket.
/// @param coefficients  degree + 1 coefficients, the constant first
/// @param t             initial guess, in (0, 1)
/// @param wanted        lanes to solve; the result of the others is arbitrary
template <class Vector>
STICKSLIP_LANES_INLINE Vector zero_of_polynomials(const Vector* coefficients, int degree, Vector t,
                                                  const typename Vector::Mask& wanted) {
  typename Vector::Mask open = wanted;
  Vector low = 0.0, high = 1.0;
  for (int iteration = 0; iteration < 64; ++iteration) {
    Vector value = coefficients[degree], slope = 0.0;
#pragma GCC unroll 16
    for (int k = degree - 1; k >= 0; --k) {
      slope = multiply_add(slope, t, value);
      value = multiply_add(value, t, coefficients[k]);
    }
    const auto before = value > 0.0;
    low = select(before, t, low);
    high = select(before, high, t);
    const Vector newton = t - value / slope;
    const Vector next = select((newton >= low) & (newton <= high), newton, (low + high) * 0.5);
    const auto moves = abs(next - t) > 2 * std::numeric_limits<double>::epsilon();
    t = select(open, next, t);
    open = open & moves;
    if (!any(open)) break;
  }
  return t;
}
