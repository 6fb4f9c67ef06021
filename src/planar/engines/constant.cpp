// Event loops in the plane for laws of the library; see engines.hpp.
#include "stickslip/planar/detail/engines.hpp"

namespace stickslip::detail {

template void advance_plane(const PlanarSlider<Coulomb>&, const PlanarLoadSegment&, Contact, PlanarState&, PlanarSink&);
template void advance_plane(const PlanarSlider<StaticKinetic<Coulomb>>&, const PlanarLoadSegment&, Contact,
                            PlanarState&, PlanarSink&);
template void advance_plane(const PlanarSlider<Degrading>&, const PlanarLoadSegment&, Contact, PlanarState&,
                            PlanarSink&);
template void advance_plane(const PlanarSlider<StaticKinetic<Degrading>>&, const PlanarLoadSegment&, Contact,
                            PlanarState&, PlanarSink&);

}  // namespace stickslip::detail
