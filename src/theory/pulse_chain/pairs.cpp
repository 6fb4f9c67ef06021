#include "theory/pulse_chain/pairs.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "stickslip/numerics/gauss_legendre.hpp"
#include "stickslip/theory/pulse_response.hpp"

namespace stickslip::detail::pulse_chain {

double chance_to_move(const Coulomb& law, double load) {
  constexpr double tiny = 1e-9;
  const double excess = std::max(-load - law.forward(), load - law.backward());
  return excess > tiny ? 1 : excess > -tiny ? 0.5 : 0;
}

namespace {

constexpr std::size_t points = 4;  // of Gauss and Legendre, on each panel

/// The effect of two pulses: the final displacement and the largest one on the way, without its sign.
struct Farthest {
  double last = 0, largest = 0;
};

/// The joint effect of two pulses if each acted alone: the part of their moments that involves both.
Moment crossed(const Moment& a, const Moment& b) {
  return {
      0, 2 * a[0] * b[0],         3 * (a[0] * b[1] + a[1] * b[0]), 4 * (a[0] * b[2] + a[2] * b[0]) + 6 * a[1] * b[1],
      0, -a[slipped] * b[slipped]};
}

/// The moments of two pulses, the second one `offset` later, after each half of a step.
void pair(const Slider<Coulomb>& block, const Steps& steps, double b1, double b2, double offset,
          std::span<Moment> found, Farthest* farthest = nullptr) {
  detail::Ride ride;
  double largest = 0;
  const auto look = [&](double, const detail::Ride& there) {
    largest = std::max(largest, std::abs(there.state.displacement));
  };
  double moved = 0;
  const auto moment_of = [&] {
    const double x = ride.state.displacement;
    return Moment{x, x * x, x * x * x, x * x * x * x, ride.velocity_square, moved};
  };
  const auto hold = [&](double n, double duration) {
    if (duration <= 0) return;
    moved = std::max(moved, chance_to_move(block.law(), n));
    detail::hold(block, n, duration, ride, look);
    look(0, ride);
  };
  const auto count = static_cast<int>(steps.values.size());
  const double whole = std::floor(offset), part = offset - whole;
  const auto value = [&](int i) {
    return i >= 0 && i < count ? steps.unit * steps.values[static_cast<std::size_t>(i)] : 0;
  };
  const int shift = static_cast<int>(whole);
  const int ended = 2 * (count + shift + 1);
  found.front() = {};
  for (int half = 0; static_cast<std::size_t>(half) + 1 < found.size(); ++half) {
    Moment& moment = found[static_cast<std::size_t>(half) + 1];
    moment = moment_of();
    if (half >= ended && ride.state.velocity == 0) continue;
    // Within step i of the first pulse the second one goes from its step i - shift - 1 to the next.
    const int i = half / 2;
    const double change = std::clamp(part - 0.5 * (half % 2), 0.0, 0.5), n = b1 * value(i);
    hold(n + b2 * value(i - shift - 1), change);
    hold(n + b2 * value(i - shift), 0.5 - change);
    moment = moment_of();
  }
  if (farthest) *farthest = {ride.state.displacement, largest};
}

}  // namespace

std::vector<PairMoments> Pairs::table(int slots, bool limit) {
  std::vector<Sums> integral(single_.size()), lattice(single_.size());
  const int count = static_cast<int>(steps_.values.size()), most = 2 * count;
  for (double from = 0; from < most;) {
    const double length = from < count ? 0.5 : 1;
    numerics::gauss_points<points>(from, from + length,
                                   [&](double offset, double weight) { add_pairs(integral, offset, weight, true); });
    from += length;
  }
  for (int k = 0; k < most * slots; ++k)
    add_pairs(lattice, static_cast<double>(k) / slots, (k == 0 ? 0.5 : 1.0) / slots, limit);
  std::vector<PairMoments> tables(single_.size());
  for (std::size_t k = 0; k < tables.size(); ++k)
    for (std::size_t i = 0; i < tables[k].size(); ++i)
      tables[k][i] = {single_[k].limit(i), integral[k].limit(i), limit ? lattice[k].limit(i) : lattice[k].coarse[i]};
  return tables;
}

std::vector<detail::SlipExcursion::Example> Pairs::examples(double rate, const Weights& alone) {
  std::vector<detail::SlipExcursion::Example> found;
  const auto add = [&](double b1, double b2, double offset, double weight) {
    Farthest farthest;
    pair(block_, steps_, b1, b2, offset, both_, &farthest);
    if (farthest.largest > 0 && weight > 0) found.push_back({farthest.last, farthest.largest, weight});
  };
  for (int i = -alone.reach; i <= alone.reach; ++i) add(i * alone.spacing, 0, 0, alone[i]);
  const int reach = coarse_.reach, length = static_cast<int>(steps_.values.size());
  for (int s = 0; s < length; ++s)
    numerics::gauss_points<points>(s, s + 1.0, [&](double offset, double weight) {
      for (int i = -reach; i <= reach; ++i)
        for (int j = -reach; j <= reach; ++j)
          add(i * coarse_.spacing, j * coarse_.spacing, offset, rate * weight * coarse_[i] * coarse_[j]);
    });
  return found;
}

void Pairs::add(std::vector<Sums>& sums, int i, int j, double fine, double coarse, double offset) {
  pair(block_, steps_, i * fine_.spacing, j * fine_.spacing, offset, both_);
  for (std::size_t k = 0; k < both_.size(); ++k)
    for (std::size_t m = 0; m < both_[k].size(); ++m) {
      sums[k].fine[m] += fine * both_[k][m];
      sums[k].coarse[m] += coarse * both_[k][m];
    }
}

std::vector<Pairs::Sums> Pairs::alone(double offset, int step) {
  std::vector<Sums> sums(both_.size());
  for (int j = -fine_.reach; j <= fine_.reach; j += step)
    add(sums, 0, j, fine_[j], j % 2 == 0 ? coarse_[j / 2] : 0, offset);
  return sums;
}

void Pairs::add_pairs(std::vector<Sums>& sums, double offset, double weight, bool fine) {
  const int step = fine ? 1 : 2;
  const double least = 1 / fine_.spacing;  // the sum of two amplitudes below which nothing moves
  for (int i = -fine_.reach; i <= fine_.reach; i += step)
    for (int j = mirrored_ ? 0 : -fine_.reach; j <= fine_.reach; j += step) {
      if (std::abs(i) + std::abs(j) < least - 1e-6) continue;
      const double twice = (mirrored_ && j != 0 ? 2 : 1) * weight;  // the mirror image
      const bool even = i % 2 == 0 && j % 2 == 0;
      add(sums, i, j, twice * fine_[i] * fine_[j], even ? twice * coarse_[i / 2] * coarse_[j / 2] : 0, offset);
    }
  const std::vector<Sums> first = alone(0, step), later = alone(offset, step);
  for (std::size_t k = 0; k < sums.size(); ++k)
    for (Moment Sums::*const part : {&Sums::coarse, &Sums::fine}) {
      const Moment cross = crossed(first[k].*part, later[k].*part);
      for (std::size_t m = 0; m < cross.size(); ++m) {
        (sums[k].*part)[m] -= weight * ((first[k].*part)[m] + (later[k].*part)[m] + cross[m]);
        if (mirrored_ && m < orders && m % 2 == 0) (sums[k].*part)[m] = 0;
      }
    }
}

}  // namespace stickslip::detail::pulse_chain

namespace stickslip::detail {

PairTable pair_coefficients(double sigma, int slots) {
  using namespace pulse_chain;
  const double spacing = lattice_spacing(sigma, 3);
  const int reach = static_cast<int>(std::ceil(6 * sigma / spacing));
  const Steps steps{{1, -1}, 1};
  const Slider<Coulomb> block(Coulomb(1));
  const PairMoments found =
      Pairs(block, steps, true, gaussian(sigma, spacing, reach, 1), gaussian(sigma, spacing / 2, 2 * reach, 1))
          .table(slots, true)
          .back();
  return {found[1], found[squared_velocity]};
}

}  // namespace stickslip::detail
