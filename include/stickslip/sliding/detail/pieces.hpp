// Long records, divided into pieces that are integrated in parallel; part of the compiled library.
#pragma once

#include "stickslip/ground/ground_motion.hpp"
#include "stickslip/sliding/detail/engine.hpp"
#include "stickslip/state/state.hpp"

namespace stickslip::detail {

/// A block with Coulomb friction and no spring loses its memory when it sticks: two motions that are stuck at the same
/// sample are identical from then on, except for a constant in x. A long record is therefore divided into pieces, which
/// start from rest and are integrated in parallel vector lanes. Each piece is then integrated again from its true
/// initial state, until both motions are stuck.
/// @return false, and nothing done, if that is not possible or not faster: another law, a spring or a damper, a time
/// step
///         that varies, a short motion, or numbers whose squares the lanes would lose to underflow
bool recorded_by_pieces(const Engine& engine, const GroundMotion& motion, State& state, Recorder& recorder,
                        const HistorySpans& histories);
bool recorded_by_pieces(const Engine& engine, const GroundMotion& motion, State& state, NoRecorder& none,
                        const HistorySpans& histories);

}  // namespace stickslip::detail
