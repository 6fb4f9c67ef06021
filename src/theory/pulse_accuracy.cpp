#include "stickslip/theory/detail/pulse_accuracy.hpp"

#include <limits>

namespace stickslip::detail {

const PulseAccuracy& pulse_accuracy() {
  static constexpr PulseAccuracy accuracy{
      .weak =
          "More than two pulses at once then cause the slips, and the growth rate is too high: by up to 19 % at "
          "sigma / a = 1/4, 41 % at 1/5, 80 % at 0.15 and a factor of two at 1/8; refined, from 0.12 on, it is "
          "within 10 %.",
      .near_levels =
          "Where slip levels differ by less than a third, the refined drift is off by up to 27 % at a difference of a "
          "tenth and 39 % at a twentieth, because the second level is then not a node of the lattice; the plain chain "
          "is within 12 % and 20 %. Smaller differences were not measured: the drift is then a small difference of "
          "large numbers.",
      .distribution =
          "The error of a probability is below 0.03 for sigma / a from 1/2 to 20 (refined: from 1/3 on), and "
          "below 0.07 at 1/4 and 1/5 if refined, for lambda dt from 0.05 to 2 at 10, 40 and 160 dt; it is "
          "below 0.09 where slip levels differ.",
      .weakest =
          "At 160 dt and lambda dt of 1/2 and 2, probabilities by the plain chain were off by up to 0.06 "
          "for sigma / a from 1/5 to 1/3, that of no slip by up to 0.11; by the refined chain at 0.15 they "
          "were off by up to 0.11, that of no slip by up to 0.2.",
      .peak =
          "For at least 10 expected slips, the ratio of the estimate to the simulated peak is 0.83 to 1.07 at "
          "probabilities from 0.5 to 0.99; for 3 to 10 slips it is 0.63 to 1.3. This was measured for "
          "lambda dt from 0.02 to 2, sigma / a from 1/3 to 20, equal levels and some that differ, and motions of at "
          "least 10 dt.",
      .rare =
          "For 200 pulses and sigma / a of 1/2, 1 and 3, the error of a probability is at most 0.01 at lambda dt = "
          "0.001, 0.06 at 0.01 and 0.1 at 0.1; the standard deviation is 0.92 to 1.00, 0.63 to 1.00 and 0.67 to 1.03 "
          "times the simulated one. At lambda dt = 0.1, sigma / a = 1/2 is rejected.",
  };
  return accuracy;
}

RatioRange peak_ratio(double slips) {
  if (slips >= 10) return {0.83, 1.07};
  if (slips >= 3) return {0.63, 1.3};
  return {0, std::numeric_limits<double>::infinity()};
}

}  // namespace stickslip::detail
