// The event loop of structures, for each law of an interface.
#include "stickslip/friction/laws.hpp"
#include "stickslip/run/detail/loop.hpp"
#include "structure/motion.hpp"
#include "structure/move.hpp"

namespace stickslip::detail {

template <FrictionLaw Law>
void StructureEngine<Law, true>::move(const ModalInterface& of, const Law& law, const LoadSegment& segment,
                                      StructureState& state, LawExpansion<Law>& expansion, StructureSink& sink) {
  by_weight(segment, [&](const GroundLoad& load, double begin) {
    if (!(load.duration > 0)) return;
    WithinStructureSegment within(sink, begin);
    StructureMotion<Law> motion(of, law, load, state, expansion, within);
    advance(motion, within);
  });
}

#define STICKSLIP_STRUCTURE_ENGINE(...) template struct StructureEngine<__VA_ARGS__>;
STICKSLIP_LAWS(STICKSLIP_STRUCTURE_ENGINE)

}  // namespace stickslip::detail
