// Members that are structures with a sliding interface.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "stickslip/ensemble/detail/simulator.hpp"
#include "stickslip/ensemble/floor_peaks.hpp"
#include "stickslip/structure/flexible_slope.hpp"
#include "stickslip/structure/sliding_structure.hpp"
#include "structure/linear_path.hpp"
#include "structure/move.hpp"
#include "structure/recorder.hpp"

namespace stickslip::detail {
namespace {

class StructurePeakObserver final : public StructureSink, public MemberTally {
 public:
  StructurePeakObserver(const ModalInterface& of, const FloorRows& rows, const Block& block, std::size_t event_limit)
      : MemberTally(block, event_limit), floors_(of, rows) {}

  std::vector<double> floor_peaks() {
    floors_.finish();
    std::vector<double> numbers{floors_.base_acceleration(), floors_.base_shear()};
    const auto add = [&](const auto& values) { numbers.insert(numbers.end(), values.begin(), values.end()); };
    add(floors_.accelerations());
    add(floors_.drifts());
    numbers.resize(floor_numbers(static_cast<std::size_t>(floors_.accelerations().size())), no_drift);
    return numbers;
  }

  void event(EventKind kind, double, const InterfacePlace& place) override {
    reach(std::abs(place.displacement));  // x is monotonic between events
    count_event(kind, place.displacement, place.velocity);
  }
  void follow(const Expansion& motion, Mode) override {
    count_work();
    floors_.include(motion);
  }
  bool pass(const LinearMove& move, const StructureState&, double) override {
    count_work();
    floors_.include(move);
    return true;
  }

 private:
  FloorMaxima floors_;
};

}  // namespace

void simulate_member(const SlidingStructure& system, const GroundMotion& motion, bool settle, Contact,
                     const MemberPlace& place) {
  Block& block = place.block;
  const ModalInterface& of = system.modal();
  const FloorRows rows(of);
  StructureState state = system.rest();
  StructurePeakObserver observer(of, rows, block, max_events(motion.segments() + block.times().count));
  with_interface_law(system.slider(), [&](const auto& law) {
    LawExpansion expansion(of, law, mean_step(motion));
    LinearPath path(system, law, motion, true);
    const auto go = [&](const LoadSegment& segment) {
      if (!path.pass(segment, state, observer)) move_structure(of, law, segment, state, expansion, observer);
    };
    const auto keep = [&](std::size_t time) { place.keep(time, state.displacement, state.velocity); };
    go_through(LoadPieces(motion, 0), motion.segments(), block, go, keep);
    if (settle)
      settle_structure(of, law, motion.last_step(), state, [&](const LoadSegment& calm) {
        block.check_stopped();
        go(calm);
      });
  });
  observer.reach(std::abs(state.displacement));
  place.end(observer.peak(), state.displacement);
  if (of.stops) block.impacts(place.index, gaps_of(of.stops), observer.impacts());
  block.floors(place.index, observer.floor_peaks());
}

void simulate_member(const FlexibleSlope& slope, const GroundMotion& motion, bool settle, Contact contact,
                     const MemberPlace& place) {
  simulate_member(sliding_structure(slope, properties(slope, motion)), motion, settle, contact, place);
}

}  // namespace stickslip::detail
