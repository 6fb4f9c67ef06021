// The motion of a structure over a whole segment as a linear map, with bounds of it within the segment.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "structure/floor_rows.hpp"
#include "structure/modal_interface.hpp"

namespace stickslip::detail {

class Expansion;

/// Between events a structure obeys linear equations with constant coefficients, stuck or sliding against constant
/// friction. A step of one duration is a linear map, which is computed once, from power series. It acts on the state and
/// on what drives it,
///
///     (y, y', [x, x',] n, change of n, [s F])
///
/// where y are the modes, n is the ground acceleration at the start, and entries in brackets are those of sliding.
class LinearStep {
 public:
  using Index = Eigen::Index;
  static constexpr Index most_modes = 200;  ///< a map of sliding has 1.3 MB

  /// Whether its computation, as long as that of some hundred steps by series, is worth while for a number of steps.
  static bool pays(const ModalInterface& of, double step, bool sliding, bool floors, std::size_t steps);

  /// @param rows  null: floors are not watched
  LinearStep(const ModalInterface& of, double step, bool sliding, const FloorRows* rows);

  double duration() const noexcept { return duration_; }  ///< [s]
  bool sliding() const noexcept { return sliding_; }
  Index modes() const noexcept { return modes_; }
  Index states() const noexcept { return states_; }          ///< entries of the state
  Index size() const noexcept { return states_ + drives_; }  ///< entries in all
  Index watched() const noexcept { return watched_; }

 private:
  friend class LinearMove;
  // A quantity at the ends of equal parts, and its largest distance from the chord in each: one row each.
  struct Chords {
    Index count;
    Eigen::MatrixXd ends{}, apart{};
  };

  struct Source;
  std::vector<Eigen::MatrixXd> run(const ModalInterface& of, const Source& source) const;
  void watch_ends(Index entry, const std::vector<Eigen::MatrixXd>& values);
  void watch_departures(Index entry, const std::vector<Eigen::MatrixXd>& values);

  double duration_;
  bool sliding_;
  Index modes_, states_, drives_, parts_, watched_;
  Eigen::MatrixXd map_{};     // the state at the end; for x its change
  Eigen::ArrayXXd single_{};  // or of modes that do not feel each other: y and y' from y, y', n and its change
  Eigen::MatrixXd steady_{};  // modes that n and s F alone would hold
  Eigen::VectorXd moved_{};   // mean of the displacement on which the ground works, from its start
  // What is watched, at the start and at the end, and its largest distance from the chord: one row each.
  Eigen::MatrixXd ends_{}, apart_{};
  std::vector<std::vector<Chords>> chords_{};  // of each, the coarsest first
};

/// One segment by a step.
class LinearMove {
 public:
  explicit LinearMove(std::shared_ptr<const LinearStep> step);

  const LinearStep& step() const noexcept { return *step_; }

  /// @param friction  s F [m/s^2]
  void begin(const StructureState& state, double n_start, double n_end, double friction);
  void finish();

  /// A quantity at both ends: 0 is the velocity, or the demand without the spring while it is stuck; the others are those
  /// of FloorRows::of_state.
  std::pair<double, double> ends(Eigen::Index quantity) const {
    return {ends_[quantity], ends_[step_->watched() + quantity]};
  }
  /// Whether it is certain to remain between two limits.
  /// @param first, last  its ends
  bool remains(Eigen::Index quantity, double first, double last, double low, double high) const;
  bool remains(Eigen::Index quantity, double low, double high) const {
    const auto [first, last] = ends(quantity);
    return remains(quantity, first, last, low, high);
  }
  /// Calls `use(motion)` with expansions of the segment.
  void expand(const ModalInterface& of, const std::function<void(const Expansion&)>& use) const;

  double distance() const noexcept { return change_; }  ///< x at the end less x at the start [m]
  double work(const ModalInterface& of) const;          ///< of the ground
  void write(StructureState& state) const;

 private:
  std::shared_ptr<const LinearStep> step_;
  Eigen::VectorXd from_, beside_, to_;  // the vector, magnitudes of it beside a steady motion, and the state at the end
  Eigen::VectorXd ends_, apart_;        // of what is watched
  mutable Eigen::VectorXd chord_ends_{}, chord_apart_{};
  double displacement_ = 0;  // at the start
  double change_ = 0;
};

/// The steps of a structure that have been computed, for any number of threads.
class LinearSteps {
 public:
  /// @return null if it does not pay
  std::shared_ptr<const LinearStep> get(const ModalInterface& of, double step, bool sliding, bool floors,
                                        std::size_t steps);

 private:
  static constexpr std::size_t most = 8;
  std::mutex mutex_{};
  std::vector<std::pair<bool, std::shared_ptr<const LinearStep>>> known_{};  // with floors or without
};

}  // namespace stickslip::detail
