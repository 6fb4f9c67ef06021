#include "theory/pulse_chain/growth.hpp"

#include "stickslip/theory/pulse_response.hpp"

namespace stickslip::detail::pulse_chain {

namespace {

/// The same lattice without friction, one slot to a step.
std::vector<Slot> frictionless(const Steps& steps, const Arrivals& arrivals, std::size_t slots) {
  const Slider<Coulomb> free(Coulomb(0));
  const double second = arrivals.rate * arrivals.sigma * arrivals.sigma;
  const double fourth = arrivals.rate * arrivals.fourth * std::pow(arrivals.sigma, 4);
  std::vector<Slot> found;
  detail::Ride ride;
  Slot sum;
  sum.slips = arrivals.rate;
  for (std::size_t i = 0; i < slots; ++i) {
    if (i < steps.values.size()) {
      const double x = ride.state.displacement, v = ride.state.velocity, before = ride.velocity_square;
      sum.displacement[1].slope += second * 2 * x * v;
      sum.displacement[3].slope += fourth * 4 * x * x * x * v;
      sum.velocity.slope += second * v * v;
      for (double Rise::*const end : {&Rise::half, &Rise::whole}) {
        detail::hold(free, steps.unit * steps.values[i], 0.5, ride, detail::NoKnot{});
        const double y = ride.state.displacement;
        sum.displacement[1].*end += second * (y * y - x * x);
        sum.displacement[3].*end += fourth * (y * y * y * y - x * x * x * x);
        sum.velocity.*end += second * (ride.velocity_square - before);
      }
    }
    found.push_back(sum);
  }
  return found;
}

/// @tparam Order  number of cumulants of the displacement
/// @param slots   number per step
template <std::size_t Order>
ChainGrowth chain_growth(const Problem& problem, int slots, const std::function<void()>& progress) {
  const Steps steps = steps_of(problem.shape, slots);
  const Chain chain(problem.block, steps, problem.arrivals, slots, problem.drifting());
  std::vector<Slot> solution = chain.solve<Order>(progress);
  if (Order > 2) chain.add_slips(solution);
  Correction correction;
  if (!problem.drifting()) correction = {chain.pairs().table(slots, false), problem.arrivals.rate, solution, slots};
  if (problem.sigma > strongest) {
    const std::vector<Slot> free = frictionless(steps, problem.arrivals, solution.size());
    const double part = strongest / problem.sigma;
    for (std::size_t i = 0; i < solution.size(); ++i) {
      Slot faded;
      faded.add(part, solution[i]);
      faded.add(1 - part, free[i]);
      solution[i] = faded;
    }
  }
  return {std::move(solution), 1.0 / slots, std::move(correction)};
}

/// Weight of Richardson's extrapolation: the error of the effect of three or more pulses is of second order in the
/// slot. Full where these cause the slips, zero where the errors of the grids are as large.
double extrapolation(double sigma) { return std::clamp((0.5 - sigma) / (0.5 - 1.0 / 3), 0.0, 1.0) / 3; }

}  // namespace

template <std::size_t Order>
Growth growth_of(const Problem& problem, bool refined, const std::function<void()>& progress) {
  Growth growth;
  const bool two = two_slots(problem.sigma, refined);
  const double more = two ? extrapolation(problem.sigma) : -1;
  if (more != 0) growth.add(-more, chain_growth<Order>(problem, 1, progress));
  if (two) growth.add(1 + more, chain_growth<Order>(problem, 2, progress));
  return growth;
}

template Growth growth_of<2>(const Problem&, bool, const std::function<void()>&);
template Growth growth_of<4>(const Problem&, bool, const std::function<void()>&);

}  // namespace stickslip::detail::pulse_chain
