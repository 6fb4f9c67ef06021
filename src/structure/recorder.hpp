// Records the events, the sums and the peaks of the motion of a structure with one sliding interface.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "stickslip/base/min_max.hpp"
#include "stickslip/numerics/gauss_legendre.hpp"
#include "stickslip/run/detail/event_log.hpp"
#include "stickslip/structure/response.hpp"
#include "structure/expansion.hpp"
#include "structure/motion.hpp"

namespace stickslip::detail {

/// The quantities of the floors, each of which is a row times the modes.
struct FloorRows {
  explicit FloorRows(const ModalInterface& of);

  // Of the modal accelerations, plus `with_base` times the acceleration of the base and `with_slider` times x'':
  // floors, stories (if the masses are known by floor), and the base shear last.
  Eigen::MatrixXd forces;
  Eigen::VectorXd with_base, with_slider;
  Eigen::MatrixXd drifts;  // of the modal displacements
  Eigen::Index floors, stories;
};

/// The largest magnitudes of the quantities of the floors, over all time.
class FloorMaxima {
 public:
  FloorMaxima(const ModalInterface& of, const FloorRows& rows)
      : of_(of),
        rows_(rows),
        forces_(Eigen::VectorXd::Zero(rows.forces.rows())),
        drifts_(Eigen::VectorXd::Zero(rows.drifts.rows())) {}

  void include(const Expansion& motion);

  double base_acceleration() const noexcept { return base_acceleration_; }  ///< absolute [m/s^2]
  auto accelerations() const { return forces_.head(rows_.floors); }         ///< absolute [m/s^2]
  auto shears() const { return forces_.segment(rows_.floors, rows_.stories); }
  double base_shear() const { return forces_[rows_.floors + rows_.stories]; }
  const Eigen::VectorXd& drifts() const noexcept { return drifts_; }  ///< [m]

 private:
  const ModalInterface& of_;
  const FloorRows& rows_;
  double base_acceleration_ = 0;
  Eigen::VectorXd forces_, drifts_;  // in the order of the rows
};

class StructureRecorder : public StructureSink, public EventLog<double>, public Pace<4096> {
 public:
  /// @param loops  whether to keep StructureResponse::loops
  StructureRecorder(const ModalInterface& of, const FloorRows* rows, bool loops, double from, std::size_t event_limit,
                    const std::function<void()>& progress, StructureResponse& response);

  void begin_segment(double begin, double end) noexcept {
    EventLog::begin_segment(begin, end);
    now_ = begin;
  }

  void event(EventKind kind, double time, const InterfacePlace& place) override;
  void follow(const Expansion& motion, Mode mode) override;
  void lose(double energy) override { response_.energy.impact += energy; }
  void decide(double difference) override { response_.margin = std::min(response_.margin, difference); }
  /// Writes the events, and the peaks of the floors.
  void finish(StructureResponse& response);

 protected:
  ~StructureRecorder() = default;

 private:
  void add_work(const Expansion& motion, Mode mode);
  void draw(const Expansion& motion, Mode mode);

  const ModalInterface& of_;
  std::optional<FloorMaxima> floors_{};
  StructureResponse& response_;
  bool loops_;
  double now_ = 0;  // the beginning of the next expansion [s]
};

/// Records nothing.
class NoStructureSink final : public StructureSink {
 public:
  void event(EventKind, double, const InterfacePlace&) override {}
  void follow(const Expansion&, Mode) override {}
};

}  // namespace stickslip::detail
