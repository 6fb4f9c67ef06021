// What is compiled once for all laws.
#include "stickslip/sliding/integrate.hpp"
#include "stickslip/sliding/trajectory.hpp"

namespace stickslip::detail {

template Response integrate(const Engine&, const GroundMotion&, const IntegrateOptions&, Response, bool);
template Response integrate(const Engine&, const HarmonicMotion&, const IntegrateOptions&, Response, bool);
template class TrajectoryUnder<GroundMotion>;
template class TrajectoryUnder<HarmonicMotion>;

}  // namespace stickslip::detail
