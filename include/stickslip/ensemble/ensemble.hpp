// Statistics over the members of an ensemble, with their standard errors.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "stickslip/ensemble/configuration.hpp"
#include "stickslip/ensemble/stationary.hpp"
#include "stickslip/ensemble/times.hpp"
#include "stickslip/ensemble/velocity_spectrum.hpp"
#include "stickslip/statistics/moments.hpp"
#include "stickslip/statistics/tally.hpp"

namespace stickslip {

class Ensemble;
struct EnsembleOptions;

namespace detail {
class Simulator;
using MakeSimulator = std::function<std::unique_ptr<Simulator>()>;
Ensemble run_ensemble(EnsembleConfiguration configuration, const EnsembleTimes& times, const EnsembleOptions& options,
                      const Ensemble* start, const MakeSimulator& make_simulator);
}  // namespace detail

/// Statistics over the members of an ensemble, each with its standard error, from the scatter between members.
///
/// All sums are taken in one pass, about means, and merge pair by pair in an order that the members' numbers fix: the
/// same members give the same bits on any number of threads and in any parts that end on whole blocks.
///
/// Statistics by time, stationary averages and the velocity's spectrum exist only where all ground motions have one
/// duration; elsewhere asking for them throws std::domain_error. Peaks, residuals, quantiles and exceedances always do.
class Ensemble {
 public:
  /// What the members depend on, name by name.
  using Configuration = EnsembleConfiguration;

  /// Of each member of a block.
  struct Kept {
    std::vector<double> peak, residual;  ///< [m]
    friend bool operator==(const Kept&, const Kept&) = default;
  };

  /// All that an ensemble holds, to be put into a file and read back.
  struct Parts {
    Configuration configuration;
    EnsembleTimes times;
    bool velocity_spectrum = false;
    bool ground_acceleration = false;
    detail::TallyTree tallies;
    std::map<std::uint64_t, std::size_t> cut;  ///< blocks that are not whole, and how many members they have
    std::map<std::uint64_t, Kept> kept;        ///< by the block's number; empty once there are more than `max_kept`
    detail::Sketch peaks;                      ///< then this counts them
    friend bool operator==(const Parts&, const Parts&) = default;
  };

  /// Of more members than these no single peak and residual is kept; peaks are then counted in bins 0.1 % wide.
  static constexpr std::uint64_t max_kept = std::uint64_t{1} << 24;

  /// Times of the statistics there may be.
  static constexpr std::size_t max_times = std::size_t{1} << 24;

  /// Members are simulated and summed in blocks of this many, which the parts of an ensemble may not cut: 64, and fewer
  /// for motions of more than 16,384 times, so that a block's memory stays bounded.
  static std::size_t block(std::size_t times);

  /// @throws std::invalid_argument where the parts do not fit together, or no members can have left them: what is not
  ///         finite, a negative peak or sum of squares
  explicit Ensemble(Parts parts);
  const Parts& parts() const noexcept { return parts_; }

  /// Whether they are of one configuration and hold the same members with the same figures.
  friend bool operator==(const Ensemble&, const Ensemble&) = default;

  const Configuration& configuration() const noexcept { return parts_.configuration; }
  std::uint64_t members() const;

  /// Times of the statistics [s]; empty where the ground motions differ in duration.
  std::vector<double> time() const;

  Estimates displacement_mean() const;  ///< of x [m], by time
  /// Of x about its mean, with the divisor members - 1 [m^2], by time.
  /// @throws std::domain_error with fewer than two members, or without times; so do all that follow up to the spectrum
  Estimates displacement_variance() const;
  Estimates covariance() const;         ///< of x and x' [m^2/s], by time
  Estimates velocity_mean() const;      ///< of x' [m/s], by time
  Estimates velocity_variance() const;  ///< of x' [m^2/s^2], by time

  /// Of the ground acceleration n [m/s^2], by time; where it jumps, of what it is from then on.
  /// @throws std::domain_error where it was not asked for, or without times
  Estimates ground_acceleration_mean() const;
  /// Of n about its mean, with the divisor members - 1 [m^2/s^4], by time; thesis 4.4.
  /// @throws std::domain_error also with fewer than two members
  Estimates ground_acceleration_variance() const;

  /// All of these and the stationary growth rate, as a theory answers.
  Moments moments() const;

  Stationary stationary() const;
  /// @throws std::domain_error also where it was not asked for
  VelocitySpectrum velocity_spectrum() const;

  /// Largest |x| of each member [m], between samples too, in the order of the members.
  /// @throws std::domain_error where there are more than `max_kept`
  std::vector<double> peak() const;
  /// Last x of each member [m].
  std::vector<double> residual() const;

  /// The peak that a share of the members does not exceed [m]; bounds from order statistics (binomial law), 0 and
  /// infinity where the members are too few to bound it.
  /// @param probability  the share, in (0, 1)
  /// @param confidence   of the bounds, in (0, 1)
  /// @throws std::domain_error with fewer than two members
  Interval quantile(double probability, double confidence = 0.95) const;
  /// The share of members whose peak exceeds a level; bounds of Clopper and Pearson (1934).
  /// @throws std::domain_error with fewer than two members
  /// @param level  [m], at least 0
  Interval exceedance(double level, double confidence = 0.95) const;

  /// Takes in the members of another part of the same ensemble.
  /// @throws std::invalid_argument where it is of another configuration (says what differs), or holds members that are
  ///         here already; nothing has changed then
  void merge(const Ensemble& other);

 private:
  friend Ensemble detail::run_ensemble(Configuration, const EnsembleTimes&, const EnsembleOptions&, const Ensemble*,
                                       const detail::MakeSimulator&);
  void insert(std::uint64_t block, detail::Tally tally, Kept kept);
  void bound_memory();
  void need_times() const;
  void need_ground_acceleration() const;

  Parts parts_;
};

}  // namespace stickslip
