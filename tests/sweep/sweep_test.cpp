// A sweep does what `integrate` does, combination by combination.
#include "stickslip/sweep/sweep.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <random>
#include <stdexcept>
#include <variant>
#include <vector>

#include "simd/instruction_sets.hpp"
#include "stickslip/friction/caster.hpp"
#include "stickslip/friction/velocity_dependent.hpp"
#include "support/catch.hpp"
#include "support/motions.hpp"

using namespace stickslip;
using namespace test;

namespace {

/// A record like a real one: noise within an envelope, with quiet before and after, of a random strength and step.
GroundMotion quake(std::uint64_t seed) {
  std::mt19937_64 bits(seed);
  const auto draw = [&](double from, double to) { return std::uniform_real_distribution<double>(from, to)(bits); };
  const auto samples = static_cast<std::size_t>(draw(40, 1500));
  const double strength = std::exp(draw(-2, 2)), peak = draw(0.1, 0.6) * static_cast<double>(samples);
  std::vector<double> n = gaussian(seed, samples, strength, bits() % 2 == 0);
  for (std::size_t i = 0; i < samples; ++i) {
    const double t = static_cast<double>(i) / peak;
    n[i] *= t * std::exp(1 - t);
    if (bits() % 64 == 0) n[i] = 0;
  }
  return {std::move(n), draw(0.002, 0.1), bits() % 4 == 0 ? Interpolation::constant : Interpolation::linear};
}

/// Levels one way and the other: alike, one-way, unlike.
Coulomb block(std::mt19937_64& bits) {
  const auto level = [&] { return std::exp(std::uniform_real_distribution<double>(-4, 1.5)(bits)); };
  const double forward = bits() % 50 == 0 ? 0 : level();
  switch (bits() % 3) {
    case 0:
      return Coulomb(forward);
    case 1:
      return Coulomb(forward, infinity);
    default:
      return Coulomb(forward, level());
  }
}

/// The largest error of a sweep against `integrate`, as a part of the way slid and of what moves the slider, and how
/// many numbers of events differ.
struct Differences {
  double error = 0;
  std::size_t combinations = 0, events = 0, moved = 0;
};

template <class S>
Differences differences(const SweepTable& table, const std::vector<S>& sliders,
                        const std::vector<GroundMotion>& motions, const SweepOptions& options) {
  Differences d;
  for (std::size_t s = 0; s < sliders.size(); ++s)
    for (std::size_t r = 0; r < motions.size(); ++r)
      for (std::size_t p = 0; p < table.polarities; ++p) {
        const bool flipped = options.polarity == Polarity::flipped || p == 1;
        const Response expected =
            integrate(sliders[s], motions[r].scaled(flipped ? -1 : 1), {.settle = options.settle});
        const std::size_t i = table.at(s, r, p);
        const double reach = expected.sliding_distance + motions[r].dt() * motions[r].dt();
        for (const double error :
             {table.peak[i] - expected.peak, table.residual[i] - expected.residual,
              table.sliding_distance[i] - expected.sliding_distance})
          d.error = std::max(d.error, std::isfinite(error) ? std::abs(error) / reach : infinity);
        d.events += table.events[i] != expected.events.size() - 1;
        d.moved += expected.sliding_distance > 0;
        ++d.combinations;
      }
  return d;
}

}  // namespace

TEST_CASE("a sweep is what integrate says of each combination, events counted", "[sweep]") {
  std::mt19937_64 bits(1);
  std::vector<Slider<Coulomb>> sliders;
  for (int i = 0; i < 50; ++i) sliders.emplace_back(block(bits));
  std::vector<GroundMotion> motions;
  for (std::uint64_t seed = 0; seed < 100; ++seed) motions.push_back(quake(seed));
  on_each_instruction_set([&](const std::string& name) {
    const SweepOptions options{.threads = 1};
    const SweepTable table = sweep(sliders, motions, options);
    const Differences d = differences(table, sliders, motions, options);
    INFO(name);
    CHECK(d.combinations == 10'000);
    CHECK(d.moved > 5'000);
    CHECK(d.events == 0);
    CHECK(d.error < 1e-12);
    CHECK(table.failures.empty());
  });
}
