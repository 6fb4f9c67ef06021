#include "stickslip/ensemble/ensemble.hpp"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <concepts>
#include <cstdio>
#include <initializer_list>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "lanes/row_moments.hpp"
#include "stickslip/base/equal.hpp"
#include "stickslip/base/error.hpp"
#include "stickslip/statistics/binomial.hpp"

namespace stickslip {

namespace {

using detail::Tally;

void need_two(std::uint64_t members) {
  if (members < 2)
    throw std::domain_error("Ensemble: second moments need at least two members, got " + std::to_string(members));
}

// A description of the difference between two configurations; empty if there is none.
std::string differences(const Ensemble::Configuration& a, const Ensemble::Configuration& b) {
  std::string text;
  for (std::size_t i = 0; i < std::max(a.size(), b.size()); ++i) {
    if (i < a.size() && i < b.size() && a[i] == b[i]) continue;
    const auto say = [i](const Ensemble::Configuration& c) {
      return i < c.size() ? c[i].first + " " + c[i].second : std::string("nothing");
    };
    text += (text.empty() ? "" : "; ") + say(a) + " against " + say(b);
  }
  return text;
}

void add(Ensemble::Hits& sum, const Ensemble::Hits& more) {
  sum.either += more.either;
  sum.forward += more.forward;
  sum.backward += more.backward;
}

Ensemble::Hits hits_among(const std::map<std::uint64_t, Ensemble::Kept>& kept) {
  Ensemble::Hits hits;
  for (const auto& [block, values] : kept)
    for (const Impacts& one : values.impacts) {
      hits.either += one.any() ? 1 : 0;
      hits.forward += one.forward.count > 0 ? 1 : 0;
      hits.backward += one.backward.count > 0 ? 1 : 0;
    }
  return hits;
}

void check_probability(const char* rule, double value) { detail::require(value > 0 && value < 1, rule, value); }

}  // namespace

std::size_t Ensemble::block(std::size_t times) {
  std::size_t members = 64;
  for (std::size_t most = 16384; members > detail::row_padding && times > most; most *= 2) members /= 2;
  return members;
}

Ensemble::Ensemble(Parts parts) : parts_(std::move(parts)) {
  const auto expect = [](bool holds, const std::string& what) {
    if (!holds) throw std::invalid_argument("Ensemble: " + what);
  };
  const EnsembleTimes& times = parts_.times;
  if (times.count == 0) {
    expect(times.dt == 0 && !parts_.velocity_spectrum && !parts_.ground_acceleration,
           "without times there is no dt, got " + detail::shortest(times.dt) +
               " s, and neither velocity spectrum nor ground acceleration");
  } else {
    expect(std::isfinite(times.dt) && times.dt > 0,
           "dt must be positive and finite, got " + detail::shortest(times.dt) + " s");
    expect(times.count >= 2 && times.count <= max_times,
           "times must be 0 or 2 to " + std::to_string(max_times) + ", got " + std::to_string(times.count));
  }
  for (const auto& [name, text] : std::initializer_list<std::pair<std::string, std::string>>{
           {"dt", detail::shortest(times.dt)},
           {"times", std::to_string(times.count)},
           {"velocity_spectrum", parts_.velocity_spectrum ? "true" : "false"}})
    expect(std::ranges::find(parts_.configuration, std::pair(name, text)) != parts_.configuration.end(),
           "the configuration must say that " + name + " is " + text);
  // Statistics that were not requested are not mentioned, as in ensembles saved before these statistics existed.
  const bool says = std::ranges::any_of(parts_.configuration, [](const auto& entry) {
    return entry == std::pair<std::string, std::string>("ground_acceleration", "true");
  });
  expect(says == parts_.ground_acceleration,
         "the configuration must say whether there are statistics of the ground acceleration");
  const bool plane = std::ranges::any_of(parts_.configuration, [](const auto& entry) {
    return entry == std::pair<std::string, std::string>("plane", "true");
  });
  expect(plane == parts_.in_plane, "the configuration must say whether the sliders are in the plane");
  expect(!parts_.in_plane || !(parts_.velocity_spectrum || parts_.ground_acceleration),
         "sliders in the plane have neither velocity spectrum nor ground acceleration");

  const std::uint64_t size = block(times.count);
  const auto members_in = [&](std::uint64_t number) {
    const auto cut = parts_.cut.find(number);
    return cut == parts_.cut.end() ? size : cut->second;
  };
  const std::size_t frequencies = parts_.velocity_spectrum ? times.central() / 2 + 1 : 0;
  const auto bits = static_cast<unsigned>(64 - std::countr_zero(size));  // in the number of a block
  std::size_t cuts = 0;
  for (const auto& [place, tally] : parts_.tallies.nodes()) {
    expect(place.level < bits && place.number < std::uint64_t{1} << (bits - place.level),
           "part " + std::to_string(place.number) + " of 2^" + std::to_string(place.level) + " blocks is at no place");
    expect(tally.times() == times.count && tally.frequencies() == frequencies,
           "a part has " + std::to_string(tally.times()) + " times and " + std::to_string(tally.frequencies()) +
               " frequencies, the whole " + std::to_string(times.count) + " times and " + std::to_string(frequencies) +
               " frequencies");
    expect(tally.ground_acceleration() == parts_.ground_acceleration,
           "all parts must have statistics of the ground acceleration, or none");
    expect(tally.in_plane() == parts_.in_plane, "all parts must have moments of sliders in the plane, or none");
    const std::uint64_t begin = place.number << place.level, end = (place.number + 1) << place.level;
    std::uint64_t members = size << place.level;
    for (auto cut = parts_.cut.lower_bound(begin); cut != parts_.cut.end() && cut->first < end; ++cut, ++cuts) {
      expect(cut->second > 0 && cut->second < size, "a block that was cut must have 1 to " + std::to_string(size - 1) +
                                                        " members, got " + std::to_string(cut->second));
      members -= size - cut->second;
    }
    expect(tally.count == members, "the part from block " + std::to_string(begin) + " on must have " +
                                       std::to_string(members) + " members, got " + std::to_string(tally.count));
    expect(tally.is_possible(), "the part from block " + std::to_string(begin) + " on has sums that no members have");
  }
  expect(cuts == parts_.cut.size(), "a block that was cut is not there");

  std::uint64_t kept = parts_.peaks.count();
  expect(kept == 0 || parts_.kept.empty(), "peaks must be kept or counted, got both");
  for (const auto& [number, values] : parts_.kept) {
    kept += values.peak.size();
    expect(parts_.tallies.overlaps({0, number}) && values.peak.size() == members_in(number) &&
               values.residual.size() == members_in(number),
           "block " + std::to_string(number) + " has " + std::to_string(values.peak.size()) + " peaks and " +
               std::to_string(values.residual.size()) + " residuals, which do not belong to its members");
    expect(values.residual_transverse.size() == (parts_.in_plane ? values.residual.size() : 0),
           "sliders in the plane, and only they, must have transverse residuals");
    for (const double residual : values.residual_transverse)
      detail::require(std::isfinite(residual), "Ensemble: a residual must be finite", residual, "m");
    for (std::size_t i = 0; i < values.peak.size(); ++i) {
      detail::require(std::isfinite(values.peak[i]) && values.peak[i] >= 0,
                      "Ensemble: a peak must be finite and at least 0", values.peak[i], "m");
      detail::require(std::isfinite(values.residual[i]), "Ensemble: a residual must be finite", values.residual[i],
                      "m");
    }
    const std::size_t numbers = values.floor_peaks.size() / values.peak.size();
    expect(values.floor_peaks.size() == numbers * values.peak.size() &&
               (numbers == 0 || (numbers >= detail::floor_numbers(0) && numbers % 2 == 0)),
           "block " + std::to_string(number) + " has peaks of floors that do not belong to its members");
    for (std::size_t i = 0; i < values.floor_peaks.size(); ++i) {
      const double peak = values.floor_peaks[i];
      const bool is_drift = i % numbers >= 2 + detail::floors_of_numbers(numbers);
      detail::require((std::isfinite(peak) && peak >= 0) || (is_drift && detail::equal(peak, detail::no_drift)),
                      "Ensemble: a peak of a floor must be finite and at least 0", peak);
    }
    expect(numbers == numbers_per_member(), "all members must be structures with the same number of floors, or none");
    expect(values.impacts.empty() || values.impacts.size() == values.peak.size(),
           "block " + std::to_string(number) + " has impacts of " + std::to_string(values.impacts.size()) +
               " members, which do not belong to it");
    for (const Impacts& one : values.impacts)
      for (const auto& [side, gap] :
           {std::pair(one.forward, parts_.gaps.forward), {one.backward, parts_.gaps.backward}}) {
        detail::require(std::isfinite(side.speed) && side.speed >= 0,
                        "Ensemble: the speed of an impact must be finite and at least 0", side.speed, "m/s");
        expect(side.count > 0 ? std::isfinite(gap) : side.speed <= 0, "impacts must be on stops");
      }
  }
  for (const double gap : {parts_.gaps.forward, parts_.gaps.backward})
    detail::require(gap > 0, "Ensemble: the smallest gap of a stop must be positive", gap, "m");
  const Hits& hits = parts_.hits;
  expect(hits.either <= parts_.peaks.count() && hits.forward <= hits.either && hits.backward <= hits.either &&
             hits.either - hits.forward <= hits.backward,
         "impossible numbers of members that hit a stop: " + std::to_string(hits.forward) + " forward, " +
             std::to_string(hits.backward) + " backward, " + std::to_string(hits.either) + " on either side");
  expect(parts_.airborne <= members(), "more members end in flight than there are");
  expect(kept == members(),
         "the parts hold " + std::to_string(members()) + " members and " + std::to_string(kept) + " peaks");
}

std::uint64_t Ensemble::members() const { return parts_.tallies.count(); }

std::vector<double> Ensemble::time() const {
  std::vector<double> times(parts_.times.count);
  for (std::size_t i = 0; i < times.size(); ++i) times[i] = static_cast<double>(i) * parts_.times.dt;
  return times;
}

void Ensemble::insert(std::uint64_t block, detail::Tally tally, Kept kept, const SmallestGaps& gaps,
                      std::size_t airborne) {
  if (!parts_.kept.empty()) detail::need_same_floors(numbers_per_member(), kept.floor_peaks.size() / kept.peak.size());
  parts_.gaps.include(gaps);
  parts_.airborne += airborne;
  if (kept.peak.size() != Ensemble::block(parts_.times.count)) parts_.cut.emplace(block, kept.peak.size());
  parts_.tallies.insert({0, block}, std::move(tally));
  parts_.kept.emplace(block, std::move(kept));
  bound_memory();
}

void Ensemble::bound_memory() {
  if (parts_.peaks.count() == 0 && members() <= max_kept) return;
  for (const auto& [block, values] : parts_.kept)
    for (const double peak : values.peak) parts_.peaks.add(peak);
  add(parts_.hits, hits_among(parts_.kept));
  parts_.kept.clear();
}

void Ensemble::merge(const Ensemble& other) {
  const std::string difference = differences(parts_.configuration, other.parts_.configuration);
  if (!difference.empty()) throw std::invalid_argument("Ensemble: cannot merge what differs: " + difference);
  for (const auto& [place, tally] : other.parts_.tallies.nodes())
    if (parts_.tallies.overlaps(place)) {
      const std::uint64_t size = block(parts_.times.count);
      throw std::invalid_argument("Ensemble: cannot merge, both hold members from " +
                                  std::to_string((place.number << place.level) * size) + " to " +
                                  std::to_string(((place.number + 1) << place.level) * size - 1));
    }
  if (!parts_.kept.empty() && !other.parts_.kept.empty())
    detail::need_same_floors(numbers_per_member(), other.numbers_per_member());
  for (const auto& [place, tally] : other.parts_.tallies.nodes()) parts_.tallies.insert(place, tally);
  parts_.cut.insert(other.parts_.cut.begin(), other.parts_.cut.end());
  parts_.kept.insert(other.parts_.kept.begin(), other.parts_.kept.end());
  parts_.peaks.merge(other.parts_.peaks);
  add(parts_.hits, other.parts_.hits);
  parts_.gaps.include(other.parts_.gaps);
  parts_.airborne += other.parts_.airborne;
  bound_memory();
}

namespace {

// Value and standard error by time, from the number of members and the moments at one time.
template <class F>
Estimates by_time(const detail::TallyTree& tallies, F&& figure, Tally::Pair pair = Tally::along_axis) {
  const Tally total = tallies.total();
  Estimates result{std::vector<double>(total.times()), std::vector<double>(total.times())};
  const auto n = static_cast<double>(total.count);
  for (std::size_t i = 0; i < total.times(); ++i) {
    const auto moment = [&]<class M>(M m) {
      if constexpr (std::same_as<M, Tally::Moment>)
        return total.moment(m, pair)[i];
      else
        return total.moment(m)[i];
    };
    const auto [value, variance] = figure(n, moment);
    result.value[i] = value;
    result.error[i] = std::sqrt(std::max(0.0, variance));
  }
  return result;
}

struct ValueAndVariance {
  double value, variance;
};

// The unbiased covariance of two quantities (their variance, where they are the same) from the sums of their
// deviations, and an unbiased estimate of its own variance
//     kappa_22 / n + (kappa_20 kappa_02 + kappa_11^2) / (n - 1)
// by k-statistics (Kendall and Stuart, vol. 1, ch. 12, 13); biased for fewer than four members, who have no k_22.
ValueAndVariance covariance_of(double n, double s11, double s20, double s02, double s22) {
  const double k11 = s11 / (n - 1), k20 = s20 / (n - 1), k02 = s02 / (n - 1);
  if (n < 4) return {k11, (s22 / n - (n - 2) / (n - 1) * k11 * k11 + k20 * k02 / (n - 1)) / n};
  const double k22 = (n * (n + 1) * s22 - (n - 1) * (s20 * s02 + 2 * s11 * s11)) / ((n - 1) * (n - 2) * (n - 3));
  const double squares = ((n - 3) * k11 * k11 + (n - 1) * k20 * k02) / ((n - 2) * (n + 1));
  return {k11, (n - 1) / (n * (n + 1)) * k22 + squares};
}

}  // namespace

void Ensemble::need_times() const {
  if (parts_.times.count == 0)
    throw std::domain_error(
        "Ensemble: no statistics by time, for the ground motions differ in duration; peak, residual, quantile and "
        "exceedance are there");
  need_two(members());
}

void Ensemble::need_one_axis(const char* what) const {
  if (parts_.in_plane)
    throw std::domain_error(std::string("Ensemble: ") + what +
                            " not available for sliders in the plane; take the variances and covariances by time");
}

void Ensemble::need_plane() const {
  if (!parts_.in_plane)
    throw std::domain_error("Ensemble: sliders on one axis have no transverse displacement; run a PlanarSlider");
}

Tally::Pair Ensemble::pair_of(Component component) const {
  if (component == Component::axis) return Tally::along_axis;
  need_plane();
  if (component == Component::vertical)
    throw std::domain_error("Ensemble: sliders have no vertical displacement; component must be axis or transverse");
  return Tally::transverse;
}

void Ensemble::need_ground_acceleration() const {
  need_one_axis("the ground acceleration is");
  need_times();
  if (!parts_.ground_acceleration)
    throw std::domain_error("Ensemble: the ground acceleration was not asked for; run with ground_acceleration = true");
}

Estimates Ensemble::displacement_mean(Component component) const {
  need_times();
  const auto figure = [](double n, auto moment) {
    return ValueAndVariance{moment(Tally::x), moment(Tally::xx) / (n - 1) / n};
  };
  return by_time(parts_.tallies, figure, pair_of(component));
}

Estimates Ensemble::velocity_mean(Component component) const {
  need_times();
  const auto figure = [](double n, auto moment) {
    return ValueAndVariance{moment(Tally::v), moment(Tally::vv) / (n - 1) / n};
  };
  return by_time(parts_.tallies, figure, pair_of(component));
}

Estimates Ensemble::displacement_variance(Component component) const {
  need_times();
  const auto figure = [](double n, auto moment) {
    const double xx = moment(Tally::xx);
    return covariance_of(n, xx, xx, xx, moment(Tally::xxxx));
  };
  return by_time(parts_.tallies, figure, pair_of(component));
}

Estimates Ensemble::velocity_variance(Component component) const {
  need_times();
  const auto figure = [](double n, auto moment) {
    const double vv = moment(Tally::vv);
    return covariance_of(n, vv, vv, vv, moment(Tally::vvvv));
  };
  return by_time(parts_.tallies, figure, pair_of(component));
}

Estimates Ensemble::ground_acceleration_mean() const {
  need_ground_acceleration();
  return by_time(parts_.tallies, [](double n, auto moment) {
    return ValueAndVariance{moment(Tally::n), moment(Tally::nn) / (n - 1) / n};
  });
}

Estimates Ensemble::ground_acceleration_variance() const {
  need_ground_acceleration();
  return by_time(parts_.tallies, [](double n, auto moment) {
    const double nn = moment(Tally::nn);
    return covariance_of(n, nn, nn, nn, moment(Tally::nnnn));
  });
}

namespace {

// The covariance of the quantities of a pair.
Estimates covariance_by_time(const detail::TallyTree& tallies, Tally::Pair pair) {
  const auto figure = [](double n, auto moment) {
    return covariance_of(n, moment(Tally::xv), moment(Tally::xx), moment(Tally::vv), moment(Tally::xxvv));
  };
  return by_time(tallies, figure, pair);
}

}  // namespace

Estimates Ensemble::covariance(Component component) const {
  need_times();
  return covariance_by_time(parts_.tallies, pair_of(component));
}

Estimates Ensemble::displacement_covariance() const {
  need_times();
  need_plane();
  return covariance_by_time(parts_.tallies, Tally::displacements);
}

Estimates Ensemble::velocity_covariance() const {
  need_times();
  need_plane();
  return covariance_by_time(parts_.tallies, Tally::velocities);
}

Moments Ensemble::moments() const {
  const Stationary averages = stationary();
  return {.time = time(),
          .displacement_mean = displacement_mean(),
          .displacement_variance = displacement_variance(),
          .covariance = covariance(),
          .velocity_mean = velocity_mean(),
          .velocity_variance = velocity_variance(),
          .growth_rate = averages.growth_rate,
          .remark = averages.remark};
}

namespace {

// The evidence against taking averages over the central half for stationary values.
std::string remark_on(const Stationary& averages, std::uint64_t members, std::size_t times) {
  if (members < Stationary::fewest_members || times < 2)
    return "cannot tell whether the velocity is stationary: needs at least " +
           std::to_string(Stationary::fewest_members) + " members and 2 times in the central half, got " +
           std::to_string(members) + " members and " + std::to_string(times) + (times == 1 ? " time" : " times");
  const auto [trend, error] = averages.velocity_trend;
  if (trend == 0 ||
      gsl_cdf_tdist_Q(std::abs(trend) / error, static_cast<double>(members) - 2) >= Stationary::false_alarm / 2)
    return {};
  const auto percent = [&](double part) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.3g %%", 100 * part / averages.velocity_variance.value);
    return std::string(text.data());
  };
  return "the velocity is not stationary: from the first to the second half of " + detail::shortest(averages.begin) +
         " to " + detail::shortest(averages.end) + " s its variance " + (trend > 0 ? "grows" : "falls") + " by " +
         percent(std::abs(trend)) + " +- " + percent(error) + " of the average";
}

}  // namespace

Stationary Ensemble::stationary() const {
  need_one_axis("stationary averages are");
  need_times();
  const Tally total = parts_.tallies.total();
  const auto n = static_cast<double>(total.count);
  const std::size_t begin = parts_.times.begin(), length = parts_.times.central();
  const auto average = [&](Tally::Moment m, std::size_t first, std::size_t count) {
    double sum = 0;
    for (std::size_t i = first; i < first + count; ++i) sum += total.moment(m)[i];
    return sum / static_cast<double>(count);
  };
  const auto error = [&](std::size_t feature) { return std::sqrt(total.scatter(feature, feature) / (n - 1) / n); };

  Stationary result{};
  result.begin = static_cast<double>(begin) * parts_.times.dt;
  result.end = static_cast<double>(begin + length) * parts_.times.dt;
  result.velocity_mean = {total.mean(detail::velocity), error(detail::velocity)};
  result.velocity_variance = {average(Tally::vv, begin, length) / (n - 1), error(detail::velocity_square)};
  result.covariance = {average(Tally::xv, begin, length) / (n - 1), error(detail::product)};

  // m4 / m2^2: its error follows from those of m4 and m2 and from their covariance.
  const double m2 = average(Tally::vv, begin, length) / n, m4 = average(Tally::vvvv, begin, length) / n;
  if (m4 > 0) {
    // Relative to m4 and m2, one after the other, so that no product of them overflows.
    const auto relative = [&](std::size_t a, double of_a, std::size_t b, double of_b) {
      return total.scatter(a, b) / of_a / of_b;
    };
    const double variance = relative(detail::velocity_fourth, m4, detail::velocity_fourth, m4) -
                            4 * relative(detail::velocity_fourth, m4, detail::velocity_square, m2) +
                            4 * relative(detail::velocity_square, m2, detail::velocity_square, m2);
    const double kurtosis = m4 / m2 / m2;
    result.velocity_kurtosis = {kurtosis, kurtosis * std::sqrt(std::max(0.0, variance) / (n - 1) / n)};
  } else {
    result.velocity_kurtosis = {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN()};
  }

  const double second_half = static_cast<double>(length - length / 2) * parts_.times.dt;
  const auto variance = [&](std::size_t feature) { return total.scatter(feature, feature) / (n - 1); };
  result.growth_rate = {(variance(detail::increment_whole) - variance(detail::increment_half)) / second_half,
                        error(detail::growth)};

  const std::size_t half = length / 2;
  if (half > 0) {
    const double first = average(Tally::vv, begin, half), second = average(Tally::vv, begin + half, length - half);
    // Squares of b normal numbers about their sample mean scatter too little, by the factor (b - 2) / (b - 1).
    const double b = std::min(n, static_cast<double>(block(parts_.times.count)));
    result.velocity_trend = {(second - first) / (n - 1),
                             error(detail::trend) * std::sqrt((b - 1) / std::max(b - 2, 0.0))};
  } else {
    result.velocity_trend = {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN()};
  }
  result.remark = remark_on(result, total.count, length);
  return result;
}

VelocitySpectrum Ensemble::velocity_spectrum() const {
  need_one_axis("the spectrum of the velocity is");
  need_times();
  if (!parts_.velocity_spectrum)
    throw std::domain_error("Ensemble: the velocity's spectrum was not asked for; run with velocity_spectrum = true");
  const Tally total = parts_.tallies.total();
  const auto n = static_cast<double>(total.count);
  VelocitySpectrum result;
  const double step = 2 * std::numbers::pi / (static_cast<double>(parts_.times.central()) * parts_.times.dt);
  for (std::size_t k = 0; k < total.frequencies(); ++k) {
    result.omega.push_back(static_cast<double>(k) * step);
    result.density.push_back(total.density_mean()[k]);
    result.error.push_back(std::sqrt(total.density_scatter()[k] / (n - 1) / n));
  }
  return result;
}

// ---- peak and residual

namespace {

void need_single_members(const Ensemble::Parts& parts) {
  if (parts.peaks.count() != 0)
    throw std::domain_error("Ensemble: the single members of more than " + std::to_string(Ensemble::max_kept) +
                            " are not kept; quantile, exceedance and impact_probability know their distribution");
}

std::vector<double> gathered(const Ensemble::Parts& parts, std::vector<double> Ensemble::Kept::*what) {
  need_single_members(parts);
  std::vector<double> all;
  for (const auto& [block, values] : parts.kept) all.insert(all.end(), (values.*what).begin(), (values.*what).end());
  return all;
}

// The number k of n members with which the binomial law of probability p reaches `share`: P(X <= k) >= share.
std::uint64_t binomial_quantile(double share, double p, std::uint64_t n) {
  // P(X <= k) = P(Beta(k + 1, n - k) > p); the beta law takes any number of members.
  const auto at_most = [&](std::uint64_t k) {
    return k >= n ? 1.0 : gsl_cdf_beta_Q(p, static_cast<double>(k) + 1, static_cast<double>(n - k));
  };
  std::uint64_t low = 0, high = n;
  while (low < high) {
    const std::uint64_t middle = low + (high - low) / 2;
    if (at_most(middle) >= share)
      high = middle;
    else
      low = middle + 1;
  }
  return low;
}

// The value of a rank, from 0; changes the order.
double value_at(std::vector<double>& values, std::uint64_t rank) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(rank), values.end());
  return values[rank];
}

// A quantile of n values, of which `at` gives that of a rank.
template <class At>
Interval quantile_of(std::uint64_t n, double probability, double confidence, const std::string& who, At&& at) {
  check_probability((who + ": probability must lie between 0 and 1").c_str(), probability);
  check_probability((who + ": confidence must lie between 0 and 1").c_str(), confidence);
  need_two(n);
  // The rank, from 0, of the value with a fraction `probability` of all values at or below it; and ranks that enclose
  // it.
  const auto rank = static_cast<std::uint64_t>(
      std::clamp(std::ceil(probability * static_cast<double>(n)) - 1, 0.0, static_cast<double>(n - 1)));
  const double tail = (1 - confidence) / 2;
  const std::uint64_t below = binomial_quantile(tail, probability, n);
  const std::uint64_t above = binomial_quantile(1 - tail, probability, n);
  return {at(rank), below == 0 ? 0 : at(below - 1), above >= n ? std::numeric_limits<double>::infinity() : at(above)};
}

}  // namespace

void Ensemble::need_impacts(double gap, const char* side) const {
  if (!std::isfinite(gap)) throw std::domain_error(std::string("Ensemble: no member has a stop") + side);
}

std::vector<Impacts> Ensemble::impacts() const {
  need_impacts(parts_.gaps.smallest(), "");
  need_single_members(parts_);
  std::vector<Impacts> all;
  for (const auto& [block, values] : parts_.kept) {
    all.insert(all.end(), values.impacts.begin(), values.impacts.end());
    if (values.impacts.empty()) all.resize(all.size() + values.peak.size());
  }
  return all;
}

Interval Ensemble::impact_probability(double confidence) const {
  need_impacts(parts_.gaps.smallest(), "");
  return fraction(hits_among(parts_.kept).either + parts_.hits.either, confidence);
}

Interval Ensemble::impact_probability(Direction side, double confidence) const {
  const bool forward = side == Direction::forward;
  need_impacts(forward ? parts_.gaps.forward : parts_.gaps.backward, forward ? " forward" : " backward");
  const Hits kept = hits_among(parts_.kept);
  return fraction(forward ? kept.forward + parts_.hits.forward : kept.backward + parts_.hits.backward, confidence);
}

std::size_t Ensemble::numbers_per_member() const noexcept {
  if (parts_.kept.empty()) return 0;
  const Kept& first = parts_.kept.begin()->second;
  return first.floor_peaks.size() / first.peak.size();
}

bool Ensemble::has_floors() const noexcept { return numbers_per_member() > 0; }

void Ensemble::need_floors() const {
  need_single_members(parts_);
  if (!has_floors())
    throw std::domain_error(
        "Ensemble: sliders have no floors; run an IsolatedStructure, EquipmentOnFloor or "
        "FlexibleSlope");
}

// Some of the numbers of each member.
std::vector<double> Ensemble::floor_numbers(std::size_t first, std::size_t count) const {
  std::vector<double> all;
  const std::size_t width = numbers_per_member();
  for (const auto& [block, values] : parts_.kept)
    for (std::size_t i = first; i < values.floor_peaks.size(); i += width) {
      const auto from = values.floor_peaks.begin() + static_cast<std::ptrdiff_t>(i);
      all.insert(all.end(), from, from + static_cast<std::ptrdiff_t>(count));
    }
  return all;
}

std::vector<double> Ensemble::peak_base_acceleration() const {
  need_floors();
  return floor_numbers(0, 1);
}
std::vector<double> Ensemble::peak_base_shear() const {
  need_floors();
  return floor_numbers(1, 1);
}
FloorPeaks Ensemble::peak_floor_acceleration() const {
  need_floors();
  const std::size_t floors = detail::floors_of_numbers(numbers_per_member());
  return {floor_numbers(2, floors), floors};
}
FloorPeaks Ensemble::peak_floor_drift() const {
  need_floors();
  const std::size_t floors = detail::floors_of_numbers(numbers_per_member());
  FloorPeaks drifts{floor_numbers(2 + floors, floors), floors};
  if (std::ranges::any_of(drifts.values, [](double drift) { return drift < 0; }))
    throw std::domain_error("Ensemble: drifts need an influence of ones, by which one floor is above another");
  return drifts;
}

std::vector<double> FloorPeaks::on_floor(std::size_t floor) const {
  if (floor < 1 || floor > floors)
    throw std::invalid_argument("FloorPeaks: floor must be from 1 to " + std::to_string(floors) + ", got " +
                                std::to_string(floor));
  std::vector<double> result;
  for (std::size_t i = floor - 1; i < values.size(); i += floors) result.push_back(values[i]);
  return result;
}

namespace {

// Calls `statistic` with the peaks on each floor.
template <class Statistic>
void by_floor(const FloorPeaks& peaks, Statistic&& statistic) {
  need_two(peaks.floors > 0 ? peaks.members() : 2);
  for (std::size_t floor = 1; floor <= peaks.floors; ++floor) statistic(peaks.on_floor(floor));
}

// Mean and sums of even powers of the deviations from it.
struct SampleMoments {
  double n, mean = 0, second = 0, fourth = 0;
  explicit SampleMoments(const std::vector<double>& values) : n(static_cast<double>(values.size())) {
    for (const double value : values) mean += value / n;
    for (const double value : values) {
      const double square = (value - mean) * (value - mean);
      second += square;
      fourth += square * square;
    }
  }
};

}  // namespace

Estimates FloorPeaks::mean() const {
  Estimates result;
  by_floor(*this, [&](const std::vector<double>& peaks) {
    const SampleMoments m(peaks);
    result.value.push_back(m.mean);
    result.error.push_back(std::sqrt(m.second / (m.n - 1) / m.n));
  });
  return result;
}

Estimates FloorPeaks::deviation() const {
  Estimates result;
  by_floor(*this, [&](const std::vector<double>& peaks) {
    const SampleMoments m(peaks);
    const auto [variance, scatter] = covariance_of(m.n, m.second, m.second, m.second, m.fourth);
    const double deviation = std::sqrt(variance);
    result.value.push_back(deviation);
    result.error.push_back(deviation > 0 ? std::sqrt(std::max(scatter, 0.0)) / (2 * deviation) : 0);
  });
  return result;
}

std::vector<Interval> FloorPeaks::quantile(double probability, double confidence) const {
  std::vector<Interval> result;
  by_floor(*this, [&](std::vector<double> peaks) {
    result.push_back(quantile_of(peaks.size(), probability, confidence, "FloorPeaks",
                                 [&](std::uint64_t place) { return value_at(peaks, place); }));
  });
  return result;
}

std::vector<double> Ensemble::peak() const { return gathered(parts_, &Kept::peak); }
std::vector<double> Ensemble::residual(Component component) const {
  return gathered(parts_, pair_of(component) == Tally::transverse ? &Kept::residual_transverse : &Kept::residual);
}

Interval Ensemble::quantile(double probability, double confidence) const {
  std::vector<double> peaks;
  if (parts_.peaks.count() == 0) peaks = peak();
  return quantile_of(members(), probability, confidence, "Ensemble", [&](std::uint64_t place) {
    return peaks.empty() ? parts_.peaks.value_at(place) : value_at(peaks, place);
  });
}

Interval Ensemble::exceedance(double level, double confidence) const {
  detail::require(level >= 0 && std::isfinite(level), "Ensemble: level must be finite and at least 0", level, "m");
  const double gap = parts_.gaps.smallest();
  if (level > gap)
    throw std::invalid_argument("Ensemble: level must be at most " + detail::shortest(gap) +
                                " m, the smallest gap of a stop, which keeps |x| from exceeding it, got " +
                                detail::shortest(level) +
                                " m; impact_probability is the fraction of members that hit a stop");
  std::uint64_t exceeding = 0;
  if (parts_.peaks.count() != 0) {
    if (!(level < gap)) need_single_members(parts_);
    exceeding = parts_.peaks.above(level);
  }
  for (const auto& [block, values] : parts_.kept)
    for (std::size_t i = 0; i < values.peak.size(); ++i) {
      // A member that hit a stop was at least as far as the level.
      const bool hit = !values.impacts.empty() && values.impacts[i].any();
      exceeding += values.peak[i] > level || hit ? 1 : 0;
    }
  return fraction(exceeding, confidence);
}

Interval Ensemble::fraction(std::uint64_t count, double confidence) const {
  check_probability("Ensemble: confidence must lie between 0 and 1", confidence);
  const std::uint64_t members_all = members();
  need_two(members_all);
  return binomial_interval(count, members_all, confidence);
}

}  // namespace stickslip
