// The event loops in the plane that the library contains: those of the laws of AnyPlanarSlider.
#pragma once

#include "stickslip/friction/coulomb.hpp"
#include "stickslip/friction/degrading.hpp"
#include "stickslip/friction/kumar.hpp"
#include "stickslip/friction/static_kinetic.hpp"
#include "stickslip/friction/stribeck.hpp"
#include "stickslip/friction/velocity_dependent.hpp"
#include "stickslip/planar/advance.hpp"

namespace stickslip::detail {

extern template void advance_plane(const PlanarSlider<Coulomb>&, const PlanarLoadSegment&, Contact, PlanarState&,
                                   PlanarSink&);
extern template void advance_plane(const PlanarSlider<VelocityDependent>&, const PlanarLoadSegment&, Contact,
                                   PlanarState&, PlanarSink&);
extern template void advance_plane(const PlanarSlider<Stribeck>&, const PlanarLoadSegment&, Contact, PlanarState&,
                                   PlanarSink&);
extern template void advance_plane(const PlanarSlider<Degrading>&, const PlanarLoadSegment&, Contact, PlanarState&,
                                   PlanarSink&);
extern template void advance_plane(const PlanarSlider<KumarFriction>&, const PlanarLoadSegment&, Contact, PlanarState&,
                                   PlanarSink&);
extern template void advance_plane(const PlanarSlider<StaticKinetic<Coulomb>>&, const PlanarLoadSegment&, Contact,
                                   PlanarState&, PlanarSink&);
extern template void advance_plane(const PlanarSlider<StaticKinetic<VelocityDependent>>&, const PlanarLoadSegment&,
                                   Contact, PlanarState&, PlanarSink&);
extern template void advance_plane(const PlanarSlider<StaticKinetic<Degrading>>&, const PlanarLoadSegment&, Contact,
                                   PlanarState&, PlanarSink&);

}  // namespace stickslip::detail
