// A block at rest that breaks away and stops in one segment under vertical motion. Where a compiler contracts
// multiplication and addition, what decides that it departs and what decides that it has stopped must not differ: it would
// do both without an end.
#include <cmath>
#include <cstdio>

#include "stickslip/core.hpp"

using namespace stickslip;

int main() {
#if defined(__FMA__)
  if (!__builtin_cpu_supports("fma")) return std::puts("skipped: this processor has no FMA"), 0;
#endif
  const double level = 0.2 * standard_gravity;
  const LoadSegment s{0.02, -1.6277469935999997, -2.3716206226999996, standard_gravity + 0.0070447704716666663,
                      standard_gravity + 0.012225035267666667};
  State state;
  advance(Slider(Coulomb(level)), s, state);  // without an observer, which would change what is inlined
  // The net force grows linearly from zero at a time t, and x with the third power of the time since.
  const auto beyond = [&](double load, double normal) { return -load - level * normal / standard_gravity; };
  const double first = beyond(s.load_start, s.normal_start), last = beyond(s.load_end, s.normal_end);
  const double slides = s.duration * (last / (last - first));
  const double expected = -last * slides * slides / 6;
  std::printf("x = %.17g m, expected %.17g m\n", state.displacement, expected);
  return std::abs(state.displacement - expected) < 1e-13 * std::abs(expected) && state.velocity < 0 ? 0 : 1;
}
