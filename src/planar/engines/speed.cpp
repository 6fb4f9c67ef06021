// Event loops in the plane for laws of the library; see engines.hpp.
#include "stickslip/planar/detail/engines.hpp"

namespace stickslip::detail {

template void advance_plane(const PlanarSlider<VelocityDependent>&, const PlanarLoadSegment&, Contact, PlanarState&,
                            PlanarSink&);
template void advance_plane(const PlanarSlider<StaticKinetic<VelocityDependent>>&, const PlanarLoadSegment&, Contact,
                            PlanarState&, PlanarSink&);
template void advance_plane(const PlanarSlider<Stribeck>&, const PlanarLoadSegment&, Contact, PlanarState&,
                            PlanarSink&);
template void advance_plane(const PlanarSlider<KumarFriction>&, const PlanarLoadSegment&, Contact, PlanarState&,
                            PlanarSink&);

}  // namespace stickslip::detail
