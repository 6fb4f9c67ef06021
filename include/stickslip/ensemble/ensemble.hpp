// Statistics over the members of an ensemble, with standard errors.
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
#include "stickslip/ensemble/floor_peaks.hpp"
#include "stickslip/ensemble/smallest_gaps.hpp"
#include "stickslip/ensemble/stationary.hpp"
#include "stickslip/ensemble/times.hpp"
#include "stickslip/ensemble/velocity_spectrum.hpp"
#include "stickslip/ground/ground_motion.hpp"
#include "stickslip/sliding/impacts.hpp"
#include "stickslip/statistics/moments.hpp"
#include "stickslip/statistics/tally.hpp"

namespace stickslip {

class Ensemble;
struct EnsembleOptions;

namespace detail {
class Simulator;
using MakeSimulator = std::function<std::unique_ptr<Simulator>()>;
Ensemble run_ensemble(EnsembleConfiguration configuration, const EnsembleTimes& times, const EnsembleOptions& options,
                      bool in_plane, const Ensemble* start, const MakeSimulator& make_simulator);
}  // namespace detail

/// Statistics over the members of an ensemble, each with its standard error, from the scatter between members.
///
/// All sums are computed in one pass, about means, and merged in pairs in an order that depends only on the numbers of
/// the members: the same members give the same bits for any number of threads and any division into parts of whole
/// blocks.
///
/// Sliders in the plane (PlanarSlider) have a displacement vector r = (x, y): statistics of its components along the
/// axis and along the transverse direction, by a Component, and their covariances. Their peak is the largest |r|, and
/// they have neither stationary averages nor a spectrum of the velocity. Their impacts on the circular stop count as
/// impacts forward.
///
/// Structures (SlidingStructure, FlexibleSlope) have the statistics of the displacement of their interface, and peaks
/// of the base and of each floor.
///
/// Statistics by time, stationary averages and the spectrum of the velocity exist only if all ground motions have the
/// same duration; otherwise these functions throw std::domain_error. Peaks, residuals, quantiles and exceedances always
/// exist.
class Ensemble {
 public:
  /// Everything that the members depend on, by name.
  using Configuration = EnsembleConfiguration;

  /// Results of each member of a block.
  struct Kept {
    std::vector<double> peak, residual;         ///< [m]
    std::vector<Impacts> impacts{};             ///< empty if no slider of the block has stops
    std::vector<double> residual_transverse{};  ///< [m]; empty on one axis
    /// Of each member that is a structure: peak acceleration of the base [m/s^2], peak base shear, peak accelerations
    /// of the floors [m/s^2] and peak drifts [m], or `no_drift`; empty for sliders.
    std::vector<double> floor_peaks{};
    friend bool operator==(const Kept&, const Kept&) = default;
  };

  /// Numbers of members that hit a stop.
  struct Hits {
    std::uint64_t either = 0, forward = 0, backward = 0;
    friend bool operator==(const Hits&, const Hits&) = default;
  };

  /// The complete content of an ensemble, for storage in a file.
  struct Parts {
    Configuration configuration;
    EnsembleTimes times;
    bool velocity_spectrum = false;
    bool ground_acceleration = false;
    detail::TallyTree tallies;
    std::map<std::uint64_t, std::size_t> cut;  ///< incomplete blocks and their numbers of members
    std::map<std::uint64_t, Kept>
        kept;              ///< by the number of the block; empty if there are more than `max_kept` members
    detail::Sketch peaks;  ///< counts the peaks in that case,
    Hits hits{};           ///< and these the impacts
    SmallestGaps gaps{};   ///< of the sliders of all members
    std::uint64_t airborne = 0;
    bool in_plane = false;  ///< whether the sliders are in the plane
    friend bool operator==(const Parts&, const Parts&) = default;
  };

  /// With more members, single peaks and residuals are not kept; peaks are then counted in bins 0.1 % wide.
  static constexpr std::uint64_t max_kept = std::uint64_t{1} << 24;

  /// Maximum number of times of the statistics.
  static constexpr std::size_t max_times = std::size_t{1} << 24;

  /// Number of members per block, which the parts of an ensemble must not divide: 64, and fewer for motions with more
  /// than 16,384 times, to bound the memory of a block.
  static std::size_t block(std::size_t times);

  /// @throws std::invalid_argument if the parts do not fit together or are impossible: values that are not finite, a
  ///         negative peak or sum of squares
  explicit Ensemble(Parts parts);
  const Parts& parts() const noexcept { return parts_; }

  /// Whether the configurations, the members and all values are equal.
  friend bool operator==(const Ensemble&, const Ensemble&) = default;

  const Configuration& configuration() const noexcept { return parts_.configuration; }
  std::uint64_t members() const;

  /// Times of the statistics [s]; empty if the ground motions differ in duration.
  std::vector<double> time() const;

  bool in_plane() const noexcept { return parts_.in_plane; }

  /// Mean of x [m], by time.
  /// @param component  in the plane also Component::transverse, for y
  /// @throws std::domain_error  a component that the sliders do not have; the following functions also do
  Estimates displacement_mean(Component component = Component::axis) const;
  /// Variance of x, with the divisor members - 1 [m^2], by time.
  /// @throws std::domain_error with fewer than two members, or without times; the following functions, up to the
  ///         spectrum, also do
  Estimates displacement_variance(Component component = Component::axis) const;
  Estimates covariance(Component component = Component::axis) const;         ///< of x and x' [m^2/s], by time
  Estimates velocity_mean(Component component = Component::axis) const;      ///< of x' [m/s], by time
  Estimates velocity_variance(Component component = Component::axis) const;  ///< of x' [m^2/s^2], by time

  /// Covariances of the components of sliders in the plane, with the divisor members - 1, by time.
  /// @throws std::domain_error also for sliders on one axis
  Estimates displacement_covariance() const;  ///< of x and y [m^2]
  Estimates velocity_covariance() const;      ///< of x' and y' [m^2/s^2]

  /// Mean of the ground acceleration n [m/s^2], by time; at a jump, of the value after it.
  /// @throws std::domain_error if it was not requested, or without times
  Estimates ground_acceleration_mean() const;
  /// Variance of n, with the divisor members - 1 [m^2/s^4], by time; thesis 4.4.
  /// @throws std::domain_error also with fewer than two members
  Estimates ground_acceleration_variance() const;

  /// Means, variances and covariance by time and the stationary growth rate, in the form that theories return.
  /// @throws std::domain_error also for sliders in the plane; the following two also do
  Moments moments() const;

  Stationary stationary() const;
  /// @throws std::domain_error also if it was not requested
  VelocitySpectrum velocity_spectrum() const;

  /// Largest |x|, in the plane |r|, of each member over all time [m], in the order of the members.
  /// @throws std::domain_error for more than `max_kept` members
  std::vector<double> peak() const;
  /// Last x of each member [m]; in the plane also Component::transverse, for y.
  std::vector<double> residual(Component component = Component::axis) const;

  /// Whether the members are structures, whose peaks are kept: not with more than `max_kept` members.
  bool has_floors() const noexcept;
  /// Largest absolute acceleration on each floor of each member, over all time [m/s^2]. Without shapes of the structure
  /// there are no floors.
  /// @throws std::domain_error for sliders, and for more than `max_kept` members; the following three also do
  FloorPeaks peak_floor_acceleration() const;
  /// Largest drift of each floor relative to the one below [m].
  /// @throws std::domain_error  also if the `influence` of a structure is not ones
  FloorPeaks peak_floor_drift() const;
  /// Largest absolute acceleration of what the structure stands on [m/s^2], by member: its base, or the ground.
  std::vector<double> peak_base_acceleration() const;
  /// Largest sum of the inertia forces of the structure, as StructureResponse::peak_base_shear, by member.
  std::vector<double> peak_base_shear() const;

  /// The impacts of each member on its stops, in the order of the members.
  /// @throws std::domain_error if no member has stops; for more than `max_kept` members
  std::vector<Impacts> impacts() const;
  /// The fraction of members that hit a stop, on either side or on one; bounds of Clopper and Pearson (1934).
  /// @throws std::domain_error with fewer than two members; if no member has a stop, or none on that side; as `impacts`
  Interval impact_probability(double confidence = 0.95) const;
  Interval impact_probability(Direction side, double confidence = 0.95) const;

  /// Number of members that end in flight, without having landed; their residual is x at the end of the motion.
  std::uint64_t airborne() const noexcept { return parts_.airborne; }

  /// Quantile of the peaks [m]. The bounds are order statistics (binomial distribution), 0 and infinity if there are
  /// too few members.
  /// @param probability  fraction of members that do not exceed it, in (0, 1)
  /// @param confidence   of the bounds, in (0, 1)
  /// @throws std::domain_error with fewer than two members
  Interval quantile(double probability, double confidence = 0.95) const;
  /// The fraction of members whose peak exceeds a level; bounds of Clopper and Pearson (1934). At the smallest gap of a
  /// stop, which |x| can reach but not exceed there, the fraction of members that exceed the level or hit a stop.
  /// @param level  [m], at least 0 and at most the smallest gap of a stop of any member
  /// @throws std::domain_error with fewer than two members; a level at a stop for more than `max_kept` members
  /// @throws std::invalid_argument  a level out of range: at or beyond a stop the peaks say nothing
  Interval exceedance(double level, double confidence = 0.95) const;

  /// Add the members of another part of the same ensemble.
  /// @throws std::invalid_argument if the configurations differ (the message names the difference) or members occur
  ///         twice; this ensemble is then unchanged
  void merge(const Ensemble& other);

 private:
  friend Ensemble detail::run_ensemble(Configuration, const EnsembleTimes&, const EnsembleOptions&, bool,
                                       const Ensemble*, const detail::MakeSimulator&);
  void insert(std::uint64_t block, detail::Tally tally, Kept kept, const SmallestGaps& gaps, std::size_t airborne);
  void bound_memory();
  void need_times() const;
  void need_ground_acceleration() const;
  void need_one_axis(const char* what) const;
  void need_plane() const;
  detail::Tally::Pair pair_of(Component component) const;
  std::vector<double> floor_numbers(std::size_t first, std::size_t count) const;
  std::size_t numbers_per_member() const noexcept;
  void need_floors() const;
  void need_impacts(double gap, const char* side) const;
  Interval fraction(std::uint64_t count, double confidence) const;

  Parts parts_;
};

}  // namespace stickslip
