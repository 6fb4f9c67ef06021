// Explicit instantiations of the lanes for the usual laws.
#include "stickslip/lanes/series_lanes.hpp"

namespace stickslip::detail {

template void advance_lanes(const SeriesLanes<Coulomb>&, std::size_t, const double*, const double*, const LaneStates&);
template void advance_lanes(const SeriesLanes<Caster>&, std::size_t, const double*, const double*, const LaneStates&);
template void advance_lanes(const SeriesLanes<VelocityDependent>&, std::size_t, const double*, const double*,
                            const LaneStates&);

}  // namespace stickslip::detail
