#include "stickslip/sliding/detail/pieces.hpp"

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <memory>

#include "lanes/coulomb_lanes.hpp"
#include "stickslip/base/equal.hpp"
#include "stickslip/friction/coulomb.hpp"
#include "stickslip/lanes/transpose.hpp"
#include "stickslip/sliding/detail/engine_of.hpp"
#include "stickslip/sliding/detail/recorder.hpp"
#include "stickslip/sliding/detail/run.hpp"

namespace stickslip::detail {
namespace {

constexpr std::size_t pieces = max_lanes;
// Maximum number of segments of a piece: the data of all pieces then stay in the cache.
constexpr std::size_t max_lines = 127, longest = max_lines * row_padding;

/// Consecutive pieces of a record, all of one length.
/// @tparam RecorderType  a Recorder or NoRecorder
template <class RecorderType>
class SideBySide {
  static constexpr bool recorded = std::same_as<RecorderType, Recorder>;

 public:
  SideBySide(const Coulomb& law, const GroundMotion& motion, const HistorySpans& histories, RecorderType& recorder)
      : law_(law),
        motion_(motion),
        ground_(motion),
        histories_(histories),
        recorder_(recorder),
        max_segments_(std::min(longest, motion.segments() / pieces)) {
    if constexpr (recorded) {
      events_ = std::make_unique_for_overwrite<LaneEvent[]>(LaneAccount::max_events * max_segments_ * pieces);
      work_ = std::make_unique_for_overwrite<double[]>((max_segments_ + 1) * pieces);
      std::fill_n(work_.get(), pieces, 0.0);
    }
  }

  /// The histories of all pieces, each from rest at x = 0. Eight segments at a time: sample k of piece p is column p of
  /// row k.
  void start(std::size_t begin, std::size_t length) {
    length_ = length;
    const double* const ground = motion_.acceleration().data() + begin;
    const bool linear = motion_.interpolation() == Interpolation::linear;
    const CoulombLanes lanes{law_.forward(), law_.backward(), motion_.dt()};
    double* const x = histories_.displacement.data() + begin;
    double* const v = histories_.velocity.data() + begin;
    constexpr std::size_t last = row_padding * pieces;  // the ninth row, which is the first of the next eight segments
    std::fill_n(&xs_[last], pieces, 0.0);
    std::fill_n(&vs_[last], pieces, 0.0);
    account_.indistinct = 0;
    for (std::size_t p = 0; p < pieces; ++p) {
      loads_[last + p] = ground[p * length_];
      if constexpr (recorded) next_[p] = events_of(p);
    }
    for (std::size_t k = 0; k < length_; k += row_padding) {
      for (double* const rows : {loads_, xs_, vs_}) std::copy_n(rows + last, pieces, rows);
      transpose(&ground[k + 1], pieces, row_padding, length_, &loads_[pieces], pieces);
      for (std::size_t i = 0; i < row_padding; ++i) {
        const double *const from = &loads_[i * pieces], *const to = linear ? from + pieces : from;
        if constexpr (recorded) {
          account_.segment = static_cast<std::uint32_t>(k + i);
          account_.work_before = &work_[(k + i) * pieces];
          account_.work_after = &work_[(k + i + 1) * pieces];
        }
        advance_lanes(lanes, from, to, row(i), row(i + 1), recorded ? &account_ : nullptr);
      }
      transpose(&xs_[pieces], row_padding, pieces, pieces, &x[k + 1], length_);
      transpose(&vs_[pieces], row_padding, pieces, pieces, &v[k + 1], length_);
    }
  }

  /// Integrates one piece from its true initial state: segment by segment, until it sticks at the same time as its
  /// motion from rest; from there on, it follows that motion.
  void join(std::size_t piece, std::size_t begin, State& state) {
    double* const x = histories_.displacement.data() + begin;
    double* const v = histories_.velocity.data() + begin;
    const bool clear = (account_.indistinct >> piece & 1) == 0;
    bool met = clear && state.mode == Mode::stuck;
    double from_rest = 0;  // x of the motion from rest
    std::size_t i = 0;
    for (; i < length_ && !met; ++i) {
      from_rest = x[i + 1];
      met = clear && v[i + 1] == 0;
      step(begin + i, state);
      met = met && state.mode == Mode::stuck;
    }
    if (!met) return;
    const auto moved = [from_rest, to = state.displacement](double displacement) {
      return (displacement - from_rest) + to;  // exact where both are stuck
    };
    for (std::size_t k = i; k < length_; ++k) x[k + 1] = moved(x[k + 1]);
    if constexpr (recorded) record(piece, begin, i, moved);
    state = State::at(x[length_], v[length_]);
  }

  void step(std::size_t segment, State& state) {
    recorder_.begin_segment(ground_.time(segment), ground_.time(segment + 1));
    BareState moving(state);
    ToSink observer(recorder_);
    advance(BlockFlows(law_, Polynomial{}), ground_.segment(segment), moving, observer);
    histories_.keep(segment + 1, moving);
    moving.store(state);
  }

 private:
  LaneEvent* events_of(std::size_t piece) { return &events_[LaneAccount::max_events * max_segments_ * piece]; }
  LaneStates row(std::size_t i) { return {&xs_[i * pieces], &vs_[i * pieces], peaks_}; }

  // Passes a piece to the recorder from a segment on at whose start it is stuck.
  template <class Moved>
  void record(std::size_t piece, std::size_t begin, std::size_t segment, const Moved& moved) {
    const LaneEvent *event = events_of(piece), *const end = next_[piece];
    while (event != end && event->segment < segment) ++event;
    const auto at = [&](const LaneEvent& e) {
      const std::size_t i = begin + e.segment;
      return std::min(ground_.time(i) + e.time, ground_.time(i + 1));
    };
    recorder_.events(static_cast<std::size_t>(end - event), [&](std::size_t k) {
      return Event{at(event[k]), moved(event[k].displacement), 0, event[k].kind};
    });
    const double work = work_[length_ * pieces + piece] - work_[segment * pieces + piece];
    if (event == end || end[-1].kind == EventKind::arrest) {
      recorder_.slide(Slip{Direction::forward, 0, 0, 0, work}, SlipFlow{});
    } else {
      const double from = moved(end[-1].displacement), to = histories_.displacement[begin + length_];
      recorder_.slide(Slip{to < from ? Direction::backward : Direction::forward, from, std::abs(to - from),
                           ground_.time(begin + length_) - at(end[-1]), work},
                      SlipFlow{});
    }
  }

  const Coulomb& law_;
  const GroundMotion& motion_;
  GroundMotion::Pieces ground_;
  std::size_t length_ = 0;
  HistorySpans histories_;
  RecorderType& recorder_;
  std::size_t max_segments_;  // segments of a piece
  // Nine samples of all pieces, of ground acceleration, x and v.
  alignas(64) double loads_[(row_padding + 1) * pieces], xs_[(row_padding + 1) * pieces],
      vs_[(row_padding + 1) * pieces];
  double peaks_[pieces] = {};              // not used
  std::unique_ptr<double[]> work_{};       // of the ground, at each sample of each piece
  std::unique_ptr<LaneEvent[]> events_{};  // of all pieces,
  LaneEvent* next_[pieces] = {};           // up to these
  LaneAccount account_{.next = next_};
};

/// Whether pieces side by side take less time than segments in order, where rests are passed: as measured, if a block
/// moves in a third of the parts of a motion.
bool moves_often(const Coulomb& law, const GroundMotion& motion) {
  const GroundMotion::Pieces ground(motion);
  constexpr std::size_t part = 32;
  if (!(motion.peak_acceleration() > std::min(law.forward(), law.backward()))) return false;
  std::size_t parts = 0, moves = 0;
  for (std::size_t i = 0; i < motion.segments(); i += part, ++parts) {
    const Segment around = ground.around(i, std::min(part, motion.segments() - i))[0];
    moves += -around.start > law.forward() || around.end > law.backward();
  }
  return 3 * moves > parts;
}

template <class RecorderType>
bool run(const Engine& engine, const GroundMotion& motion, State& state, RecorderType& recorder,
         const HistorySpans& histories) {
  const Mounting& mounting = engine.mounting();
  if (!engine.law().coulomb || !equal(mounting.natural_frequency, 0) || !equal(mounting.damping, 0)) return false;
  const Coulomb law(engine.resist({}, 1, Direction::forward), engine.resist({}, 1, Direction::backward));
  // The lanes square speeds and accelerations, which must not underflow; above this slip level no relevant load does.
  constexpr double smallest = 1e-100;
  if (!std::isfinite(motion.dt()) || motion.samples() < 8192 || !(std::min(law.forward(), law.backward()) > smallest) ||
      !(motion.peak_acceleration() > smallest) || !(motion.dt() > smallest))
    return false;
  if (!moves_often(law, motion)) return false;
  constexpr std::size_t most = pieces * longest;
  const std::size_t segments = motion.segments();
  SideBySide<RecorderType> side_by_side(law, motion, histories, recorder);
  std::size_t i = 0;
  for (std::size_t rounds = (segments + most - 1) / most; rounds > 0; --rounds) {
    // An odd number of cache lines: otherwise the same samples of all pieces would compete for a few places in the
    // cache.
    const std::size_t lines = std::min(max_lines, (segments - i) / (pieces * rounds * row_padding));
    const std::size_t length = (lines % 2 == 0 ? lines - 1 : lines) * row_padding;
    recorder.report_progress();
    side_by_side.start(i, length);
    for (std::size_t p = 0; p < pieces; ++p, i += length) side_by_side.join(p, i, state);
  }
  for (; i < segments; ++i) side_by_side.step(i, state);
  return true;
}

}  // namespace

bool recorded_by_pieces(const Engine& engine, const GroundMotion& motion, State& state, Recorder& recorder,
                        const HistorySpans& histories) {
  return run(engine, motion, state, recorder, histories);
}
bool recorded_by_pieces(const Engine& engine, const GroundMotion& motion, State& state, NoRecorder& none,
                        const HistorySpans& histories) {
  return run(engine, motion, state, none, histories);
}

}  // namespace stickslip::detail
