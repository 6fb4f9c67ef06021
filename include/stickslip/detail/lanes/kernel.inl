// What the kernels of lanes share: the rule of stick and slip, the way through events, the zero of a polynomial.
//
// Included by each kernel, in its namespace, where code is compiled for its instruction set. STICKSLIP_LANES_INLINE is
// what makes a function part of its caller there.

/// Sliders at rest: which of them slip, when and which way. The rule of `advance` (sliding/advance.hpp); a reversal is
/// a rest of no length, so this is both.
template <class Vector>
struct DepartureOfLanes {
  typename Vector::Mask at_once, later;  ///< where neither, it rests to the end
  typename Vector::Mask forward;         ///< which way, where it slips
  Vector level;                          ///< of the load that it slips under, with the sign of the way

  /// @param net, last          what pulls, but friction, now and at the end; straight in between
  /// @param holds_forward, holds_backward  what holds against either way
  STICKSLIP_LANES_INLINE DepartureOfLanes(const Vector& net, const Vector& last, const Vector& holds_forward,
                                          const Vector& holds_backward) {
    const auto above = net > holds_forward, below = net < -holds_backward;
    at_once = above | below;
    forward = above | ((last > net) & ~below);
    level = select(forward, holds_forward, -holds_backward);
    later = ((forward & (last > holds_forward)) | (~forward & (last < -holds_backward))) & ~at_once;
  }
};

/// Takes some members of a row through the events of their segments, packed so that vectors are full.
/// @param members  a bit for each, at least one
/// @param start  ground acceleration of each of the row at the beginning of its segment, and
/// @param end    at its end
/// @param move   done = move(queue, place, x, v, peak): moves those that stand from `place` in the queue, and says
/// which
///               came to the end; the others it leaves where they were
/// @param alone  alone(queue, place) moves one of those by the event loop
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
/// @param coefficients  degree + 1 of them, the constant first
/// @param t             where to start, in (0, 1)
/// @param wanted        the others may get any number
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
