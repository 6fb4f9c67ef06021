// One member of an ensemble that slides on an axis.
#include "stickslip/ensemble/detail/simulator.hpp"
#include "stickslip/sliding/integrate.hpp"

namespace stickslip::detail {
namespace {

/// The segments of a member, whose state is kept at the times of the statistics.
template <class Pieces, class AnySegment = decltype(std::declval<const Pieces&>().segment(0))>
class MemberSegments final : public Segments<AnySegment> {
 public:
  MemberSegments(const Pieces& pieces, std::size_t segments, const MemberPlace& place)
      : divided_(pieces, segments, place.block), place_(place) {}

  bool next(const StateView& now, AnySegment& segment) override {
    return divided_.next(segment, [&](std::size_t time) { place_.keep(time, now.displacement, now.velocity); });
  }

 private:
  DividedSegments<Pieces> divided_;
  const MemberPlace& place_;
};

}  // namespace

void settle_member(const Engine& engine, bool loaded, Contact contact, State& state, PeakObserver& observer,
                   const Block& block) {
  settle(engine, state, [&](double duration) {
    block.check_stopped();
    advance(engine, Segment{duration, 0, 0}, loaded, contact, state, observer);
  });
}

void simulate_member(const Engine& engine, const GroundMotion& motion, bool settle, Contact contact,
                     const MemberPlace& place) {
  Block& block = place.block;
  const bool loaded = engine.loaded(motion);
  const Stops& stops = engine.mounting().stops;
  State state = engine.started({});
  PeakObserver observer(block, max_events(motion.segments() + block.times().count));
  if (loaded) {
    MemberSegments segments(LoadPieces(motion, engine.mounting().slope()), motion.segments(), place);
    engine.move(segments, motion.dt(), contact, state, observer);
  } else {
    MemberSegments segments(GroundMotion::Pieces(motion), motion.segments(), place);
    engine.move(segments, motion.dt(), state, observer);
  }
  if (settle) settle_member(engine, loaded, contact, state, observer, block);
  place.end(observer.peak(), state.displacement);
  if (stops) block.impacts(place.index, gaps_of(stops), observer.impacts());
  if (state.in_flight) block.ends_airborne();
}

}  // namespace stickslip::detail
