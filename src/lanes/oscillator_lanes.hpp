// Linear oscillators in parallel, all under one ground motion.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace stickslip::detail {

/// Oscillators x'' + c x' + wn^2 x = -n(t), and of each a quantity f = (of_displacement) x + (of_velocity) x'. Arrays
/// over the oscillators, padded to a multiple of `row_padding` (detail/lanes/row.hpp).
///
/// Within a segment f'' is a free oscillation, whose size bounds how far f rises above its values at the ends.
struct OscillatorLanes {
  explicit OscillatorLanes(std::size_t lanes)
      : damping(lanes),
        stiffness(lanes),
        softness(lanes),
        of_displacement(lanes),
        of_velocity(lanes),
        soon(lanes),
        state(lanes),
        peak(lanes) {
    for (auto* row : {&x_of, &v_of})
      for (auto& column : *row) column.resize(lanes);
    for (auto& row : rise) row.resize(lanes);
  }

  struct State {
    explicit State(std::size_t lanes) : x(lanes), v(lanes) {}
    std::vector<double> x, v;  ///< [m], [m/s]
  };

  std::vector<double> damping, stiffness, softness;  ///< c [1/s], wn^2 [1/s^2], 1 / wn^2 [s^2]
  std::vector<double> of_displacement, of_velocity;  ///< the quantity f
  std::array<std::vector<double>, 4> x_of, v_of;     ///< after a segment, of x, v, n at its start, n at its end
  std::array<std::vector<double>, 2> rise;           ///< bound of f above its ends, of |f''| and |f'''| at the start
  std::vector<double> soon;                          ///< |f''| grows by this times |f'''| at the start, at most [s]
  State state;
  std::vector<double> peak;  ///< the largest |f| so far
};

/// Segments of one duration.
struct SegmentRow {
  double duration;            ///< [s], positive
  const double *start, *end;  ///< ground acceleration at the beginnings and ends [m/s^2]
  std::size_t count;
};

/// The largest |f| of an oscillator within a segment, from its state at the beginning.
struct Inspector {
  double (*inspect)(const void* context, std::size_t lane, const SegmentRow& row, std::size_t segment, double x,
                    double v);
  const void* context;
};

/// Moves all oscillators through the segments; `peak` grows to the largest |f| at their ends.
void sweep_ends(OscillatorLanes& lanes, const SegmentRow& row);

/// The same, and calls the inspector for every segment within which |f| may exceed `peak`.
void sweep_within(OscillatorLanes& lanes, const SegmentRow& row, const Inspector& inspector);

}  // namespace stickslip::detail
