// Records the events, the sums and the peaks of the motion of a structure with one sliding interface.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "stickslip/base/min_max.hpp"
#include "stickslip/ground/segment.hpp"
#include "stickslip/numerics/gauss_legendre.hpp"
#include "stickslip/run/detail/event_log.hpp"
#include "stickslip/structure/response.hpp"
#include "stickslip/structure/sliding_structure.hpp"
#include "structure/expansion.hpp"
#include "structure/floor_rows.hpp"
#include "structure/linear_step.hpp"
#include "structure/motion.hpp"

namespace stickslip::detail {

/// The largest magnitudes of the quantities of the floors, over all time.
class FloorMaxima {
 public:
  FloorMaxima(const ModalInterface& of, const FloorRows& rows)
      : of_(of),
        rows_(rows),
        forces_(Eigen::VectorXd::Zero(rows.forces.rows())),
        drifts_(Eigen::VectorXd::Zero(rows.drifts.rows())) {}

  void include(const Expansion& motion);
  void include(const LinearMove& move);
  /// Searches the segments in which bounds left it open whether they hold a maximum.
  void finish();

  double base_acceleration() const noexcept { return base_acceleration_; }  ///< absolute [m/s^2]
  auto accelerations() const { return forces_.head(rows_.floors); }         ///< absolute [m/s^2]
  auto shears() const { return forces_.segment(rows_.floors, rows_.stories); }
  double base_shear() const { return forces_[rows_.floors + rows_.stories]; }
  const Eigen::VectorXd& drifts() const noexcept { return drifts_; }  ///< [m]

 private:
  const ModalInterface& of_;
  const FloorRows& rows_;
  double base_acceleration_ = 0;
  template <class Use>
  void each(Use&& use);

  Eigen::VectorXd forces_, drifts_;  // in the order of the rows
  std::vector<LinearMove> open_{};
};

/// Reads a motion while it is integrated, in order.
class StructureReader {
 public:
  /// Before each segment, with the state at its beginning. Times are from `begin` to `end` [s].
  virtual void segment(double /*begin*/, double /*end*/, const LoadSegment&, const StructureState&) {}
  /// A part of a segment with one mode, if they are read: a series of all quantities.
  virtual void arc(double /*begin*/, double /*end*/, const Expansion&, Mode) {}
  bool reads_arcs() const noexcept { return reads_arcs_; }

 protected:
  explicit StructureReader(bool reads_arcs) noexcept : reads_arcs_(reads_arcs) {}
  ~StructureReader() = default;

 private:
  bool reads_arcs_;
};

/// `integrate`, while a reader reads the motion.
StructureResponse integrate(const SlidingStructure& system, const GroundMotion& motion,
                            const StructureIntegrateOptions& options, StructureReader* reader);

class StructureRecorder : public StructureSink, public EventLog<double>, public Pace<4096> {
 public:
  /// @param reader  of the arcs; may be null
  StructureRecorder(const ModalInterface& of, const FloorRows* rows, StructureReader* reader, double from,
                    std::size_t event_limit, const std::function<void()>& progress, StructureResponse& response);

  void begin_segment(double begin, double end) noexcept {
    EventLog::begin_segment(begin, end);
    now_ = begin;
  }

  void event(EventKind kind, double time, const InterfacePlace& place) override;
  void follow(const Expansion& motion, Mode mode) override;
  bool pass(const LinearMove& move, const StructureState& from, double level) override;
  /// After segments that were passed: what is missing in their energy is what dampers have taken.
  void balance(const StructureState& state);
  void lose(double energy) override { response_.energy.impact += energy; }
  void decide(double difference) override { response_.margin = std::min(response_.margin, difference); }
  /// Writes the events, and the peaks of the floors.
  void finish(StructureResponse& response);

 protected:
  ~StructureRecorder() = default;

 private:
  void add_work(const Expansion& motion, Mode mode);
  void show(const Expansion& motion, Mode mode);

  const ModalInterface& of_;
  std::optional<FloorMaxima> floors_{};
  StructureResponse& response_;
  std::optional<std::pair<double, Energy>> balance_{};  // the energy of the structure, and the sums, before them
  StructureReader* reader_;                             // of arcs; null for none
  double now_ = 0;                                      // the beginning of the next expansion [s]
};

/// Records nothing.
class NoStructureSink final : public StructureSink {
 public:
  void event(EventKind, double, const InterfacePlace&) override {}
  void follow(const Expansion&, Mode) override {}
};

}  // namespace stickslip::detail
