// The event loop of structures, for each law of an interface.
#include "stickslip/sliding/any_slider.hpp"
#include "stickslip/sliding/detail/loop.hpp"
#include "structure/motion.hpp"
#include "structure/move.hpp"

namespace stickslip::detail {

template <FrictionLaw Law>
void move_structure(const ModalInterface& of, const Law& law, const LoadSegment& segment, StructureState& state,
                    LawExpansion<Law>& expansion, StructureSink& sink) {
  by_weight(segment, [&](const GroundLoad& load, double begin) {
    if (!(load.duration > 0)) return;
    WithinStructureSegment within(sink, begin);
    StructureMotion<Law> motion(of, law, load, state, expansion, within);
    advance(motion, within);
  });
}

template void move_structure(const ModalInterface&, const Coulomb&, const LoadSegment&, StructureState&,
                             LawExpansion<Coulomb>&, StructureSink&);
template void move_structure(const ModalInterface&, const Caster&, const LoadSegment&, StructureState&,
                             LawExpansion<Caster>&, StructureSink&);
template void move_structure(const ModalInterface&, const VelocityDependent&, const LoadSegment&, StructureState&,
                             LawExpansion<VelocityDependent>&, StructureSink&);
template void move_structure(const ModalInterface&, const Stribeck&, const LoadSegment&, StructureState&,
                             LawExpansion<Stribeck>&, StructureSink&);
template void move_structure(const ModalInterface&, const Degrading&, const LoadSegment&, StructureState&,
                             LawExpansion<Degrading>&, StructureSink&);
template void move_structure(const ModalInterface&, const MultiPendulum&, const LoadSegment&, StructureState&,
                             LawExpansion<MultiPendulum>&, StructureSink&);
template void move_structure(const ModalInterface&, const KumarFriction&, const LoadSegment&, StructureState&,
                             LawExpansion<KumarFriction>&, StructureSink&);
template void move_structure(const ModalInterface&, const StaticKinetic<Coulomb>&, const LoadSegment&, StructureState&,
                             LawExpansion<StaticKinetic<Coulomb>>&, StructureSink&);
template void move_structure(const ModalInterface&, const StaticKinetic<Caster>&, const LoadSegment&, StructureState&,
                             LawExpansion<StaticKinetic<Caster>>&, StructureSink&);
template void move_structure(const ModalInterface&, const StaticKinetic<VelocityDependent>&, const LoadSegment&,
                             StructureState&, LawExpansion<StaticKinetic<VelocityDependent>>&, StructureSink&);
template void move_structure(const ModalInterface&, const StaticKinetic<Degrading>&, const LoadSegment&,
                             StructureState&, LawExpansion<StaticKinetic<Degrading>>&, StructureSink&);

}  // namespace stickslip::detail
