// Sums over the members of an ensemble: one pass, numerically stable, mergeable.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "stickslip/base/requirements.hpp"

namespace stickslip {

/// A value and its standard error, in the same unit.
struct Estimate {
  double value = 0;
  double error = 0;
};

/// Values and their standard errors, one for each time or frequency.
struct Estimates {
  std::vector<double> value;
  std::vector<double> error;
};

/// A value and its confidence bounds, in the same unit.
struct Interval {
  double value = 0;
  double low = 0;
  double high = 0;
};

namespace detail {

/// The features of a member in the central part of the motion, of which an ensemble keeps means and covariances.
enum Feature : std::size_t {
  velocity,         ///< mean of x' [m/s]
  increment_half,   ///< x in the middle minus x at the beginning [m]
  increment_whole,  ///< x at the end minus x at the beginning [m]
  velocity_square,  ///< mean of (x' - its mean over members)^2 [m^2/s^2]
  velocity_fourth,  ///< ... of the fourth power [m^4/s^4]
  product,          ///< mean of both deviations' product [m^2/s]
  growth,           ///< growth rate of the squared displacement [m^2/s], see Stationary::growth_rate
  trend,            ///< velocity_square over the second half minus that over the first [m^2/s^2]
  features
};

/// The sums over a set of members: for each time the joint moments of displacement and velocity about their means,
/// for each frequency the mean and scatter of the velocity periodogram, mean and scatter of the features, and, if
/// requested, for each time the moments of the ground acceleration. Of members in the plane, the joint moments are
/// those of several pairs of quantities.
///
/// Two sets merge into their union: each is shifted to the common mean and the sums are added (Pebay 2008,
/// SAND2008-6212).
class Tally {
 public:
  /// The order of the moments at one time: sums of (x - mean)^p (x' - mean)^q, after the two means.
  enum Moment : std::size_t { x, v, xx, xv, vv, xxx, xxv, xvv, vvv, xxxx, xxvv, vvvv, moments };

  /// The pairs of quantities whose joint moments are kept, in place of x and x' above. On one axis only the first.
  enum Pair : std::size_t {
    along_axis,     ///< displacement and velocity along the axis
    transverse,     ///< the same along the transverse direction
    displacements,  ///< displacements along the axis and the transverse direction
    velocities,     ///< velocities along the axis and the transverse direction
    pairs_in_plane,
    pairs_on_axis = 1
  };

  /// The moments of the ground acceleration n at one time: its mean, and sums of (n - mean)^p.
  enum GroundMoment : std::size_t { n, nn, nnn, nnnn, ground_moments };

  Tally() = default;
  Tally(std::size_t times, std::size_t frequencies, bool ground_acceleration = false, bool in_plane = false)
      : times_(times),
        frequencies_(frequencies),
        ground_times_(ground_acceleration ? times : 0),
        pairs_(pairs(in_plane)),
        sums_(size(times, frequencies, ground_acceleration, in_plane)) {}

  /// Number of sums.
  static constexpr std::size_t size(std::size_t times, std::size_t frequencies, bool ground_acceleration = false,
                                    bool in_plane = false) noexcept {
    return pairs(in_plane) * moments * times + 2 * frequencies + features * (features + 1) +
           (ground_acceleration ? ground_moments * times : 0);
  }

  std::size_t times() const noexcept { return times_; }
  std::size_t frequencies() const noexcept { return frequencies_; }
  bool ground_acceleration() const noexcept { return ground_times_ > 0; }
  bool in_plane() const noexcept { return pairs_ == pairs_in_plane; }

  /// Number of members.
  std::uint64_t count = 0;

  /// One moment of a pair at all times.
  std::span<double> moment(Moment m, Pair pair = along_axis) noexcept {
    return {sums_.data() + place(m, pair) * times_, times_};
  }
  std::span<const double> moment(Moment m, Pair pair = along_axis) const noexcept {
    return {sums_.data() + place(m, pair) * times_, times_};
  }

  /// Mean of the periodogram, and sum of the squared deviations from it.
  std::span<double> density_mean() noexcept { return {after_moments(), frequencies_}; }
  std::span<double> density_scatter() noexcept { return {density_mean().data() + frequencies_, frequencies_}; }
  std::span<const double> density_mean() const noexcept { return {after_moments(), frequencies_}; }
  std::span<const double> density_scatter() const noexcept {
    return {density_mean().data() + frequencies_, frequencies_};
  }

  /// One moment of the ground acceleration at all times; empty if not requested.
  std::span<double> moment(GroundMoment m) noexcept { return {ground() + m * ground_times_, ground_times_}; }
  std::span<const double> moment(GroundMoment m) const noexcept {
    return {ground() + m * ground_times_, ground_times_};
  }

  double& mean(std::size_t feature) noexcept { return tail()[feature]; }
  double& scatter(std::size_t a, std::size_t b) noexcept { return tail()[features + a * features + b]; }
  double mean(std::size_t feature) const noexcept { return tail()[feature]; }
  double scatter(std::size_t a, std::size_t b) const noexcept { return tail()[features + a * features + b]; }

  /// All sums in one array, for storage.
  std::span<double> sums() noexcept { return sums_; }
  std::span<const double> sums() const noexcept { return sums_; }

  /// Largest root mean square over members: of x [m] and x' [m/s], and of a density or feature, which has up to fourth
  /// powers of these. Tallies of 2^64 members within these bounds merge without overflow.
  static constexpr double max_motion = 1e34, max_feature = 1e142;

  /// The first time at which a root mean square exceeds its bound or is NaN; `times()` if it is that of a density or
  /// feature; nothing if all are within bounds.
  std::optional<std::size_t> out_of_range() const;

  /// Whether these sums are possible for a set of members: all finite, those of even powers not negative, none so large
  /// that merging could overflow.
  bool is_possible() const;

  /// Merge with another tally. The order of the two affects the last bits.
  void merge(const Tally& right);

  friend bool operator==(const Tally&, const Tally&) = default;

 private:
  static constexpr std::size_t pairs(bool in_plane) noexcept { return in_plane ? pairs_in_plane : pairs_on_axis; }
  static constexpr std::size_t place(std::size_t moment, std::size_t pair) noexcept { return pair * moments + moment; }

  double* after_moments() noexcept { return sums_.data() + pairs_ * moments * times_; }
  const double* after_moments() const noexcept { return sums_.data() + pairs_ * moments * times_; }

  double* tail() noexcept { return after_moments() + 2 * frequencies_; }
  const double* tail() const noexcept { return after_moments() + 2 * frequencies_; }

  double* ground() noexcept { return tail() + features * (features + 1); }
  const double* ground() const noexcept { return tail() + features * (features + 1); }

  std::size_t times_ = 0;
  std::size_t frequencies_ = 0;
  std::size_t ground_times_ = 0;  // 0 or times_
  std::size_t pairs_ = pairs_on_axis;
  std::vector<double> sums_;
};

/// Tallies of blocks of members, merged in pairs in a binary tree over the number of the block. A pair is merged as
/// soon as both halves exist, and never otherwise. The sums therefore have the same bits for any order of the blocks
/// and any division into parts.
class TallyTree {
 public:
  struct Place {
    unsigned level;        ///< of 2^level blocks
    std::uint64_t number;  ///< the first block is number * 2^level
    friend auto operator<=>(const Place&, const Place&) = default;
  };

  /// @pre `place` does not overlap with the blocks already added
  void insert(Place place, Tally tally);

  /// Whether it has blocks of that place.
  bool overlaps(Place place) const;

  /// Number of members.
  std::uint64_t count() const;

  /// All blocks, merged in the order of the members.
  Tally total() const;

  const std::map<Place, Tally>& nodes() const noexcept { return nodes_; }

  friend bool operator==(const TallyTree&, const TallyTree&) = default;

 private:
  std::map<Place, Tally> nodes_;
};

/// Counts of positive values in bins of constant relative width, for more values than can be stored. Quantiles are
/// accurate to 0.05 % (DDSketch: Masson, Rim and Lee 2019, doi:10.14778/3352063.3352135). Counts merge exactly, in any
/// order.
class Sketch {
 public:
  static constexpr double accuracy = 5e-4;

  /// @param value  at least 0
  void add(double value);
  void merge(const Sketch& other);

  std::uint64_t count() const noexcept { return count_; }
  /// The value with `rank` smaller values before it in ascending order.
  double value_at(std::uint64_t rank) const;
  /// Number of values that exceed the level.
  std::uint64_t above(double level) const;

  /// Counts by bin: bin i holds the values about ((1 + accuracy) / (1 - accuracy))^i, the lowest one the zeros.
  std::map<std::int32_t, std::uint64_t> bins() const { return bins_; }
  /// @throws std::invalid_argument for a bin that contains no double, a count of 0, or 2^64 values and more
  static Sketch from_bins(std::map<std::int32_t, std::uint64_t> bins);

  friend bool operator==(const Sketch&, const Sketch&) = default;

 private:
  std::map<std::int32_t, std::uint64_t> bins_;
  std::uint64_t count_ = 0;
};

}  // namespace detail
}  // namespace stickslip
