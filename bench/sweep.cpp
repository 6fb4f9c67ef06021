// A database of records with many levels: 2,133 synthetic records of 8,700 samples (43.5 s), 100 yield accelerations
// from 0.01 to 1 g, one-way, both polarities, integrated until rest after the record: 426,600 analyses. And the sliding
// spectrum of one record. The peers: a loop over `integrate`, and a plain hand-written loop in C++.
//
// sweep [--check] [--json] [--rounds N]
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <numbers>
#include <random>
#include <stickslip/stickslip.hpp>
#include <string>
#include <vector>

#include "bench.hpp"

using namespace stickslip;

namespace {

constexpr std::size_t samples = 8700, levels = 100;
constexpr double dt = 0.005;

/// Filtered noise in an envelope that rises in 2 to 8 s and decays, much like recorded motions: as the records of
/// pyslammer, it has center frequencies from 1.5 to 4 Hz, and 5 to 95 % of its energy within 4 to 15 s. The peak
/// accelerations are lognormal, with a median of 0.15 g and a logarithmic standard deviation of 0.8.
GroundMotion record(std::uint64_t seed) {
  std::mt19937_64 bits(seed);
  std::normal_distribution<double> normal;
  const auto uniform = [&](double from, double to) { return std::uniform_real_distribution<double>(from, to)(bits); };
  const double wn = 2 * std::numbers::pi * uniform(0.6, 2.4), damping = 0.5, rise = uniform(2, 8);
  const double a1 = 2 * std::exp(-damping * wn * dt) * std::cos(wn * std::sqrt(1 - damping * damping) * dt);
  const double a2 = -std::exp(-2 * damping * wn * dt), peak = 0.15 * std::exp(0.8 * normal(bits)) * standard_gravity;
  std::vector<double> n(samples);
  double y1 = 0, y2 = 0, largest = 0;
  for (std::size_t i = 0; i < samples; ++i) {
    const double y = a1 * y1 + a2 * y2 + normal(bits), t = static_cast<double>(i) * dt / rise;
    n[i] = (y - y1) * t * t * std::exp(2 * (1 - t));  // a first difference, which leaves no lasting velocity
    largest = std::max(largest, std::abs(n[i]));
    y2 = y1;
    y1 = y;
  }
  for (double& value : n) value *= peak / largest;
  return {std::move(n), dt};
}

std::vector<GroundMotion> database(std::size_t records) {
  std::vector<GroundMotion> result;
  for (std::size_t i = 0; i < records; ++i) result.push_back(record(i));
  return result;
}

std::vector<Slider<Coulomb>> one_way() {
  std::vector<Slider<Coulomb>> sliders;
  for (std::size_t i = 1; i <= levels; ++i)
    sliders.emplace_back(
        Coulomb(0.01 * static_cast<double>(i) * standard_gravity, std::numeric_limits<double>::infinity()));
  return sliders;
}

/// The same with vertical motion: another record, two thirds as strong as the horizontal one.
std::vector<GroundMotion> with_vertical(const std::vector<GroundMotion>& motions) {
  std::vector<GroundMotion> result;
  for (std::size_t i = 0; i < motions.size(); ++i) {
    const GroundMotion& other = motions[(i + 1) % motions.size()];
    const double factor = 2.0 / 3 * motions[i].peak_acceleration() / other.peak_acceleration();
    const GroundMotion up = other.scaled(factor);
    result.push_back(motions[i].with_components({}, {up.acceleration().begin(), up.acceleration().end()}));
  }
  return result;
}

/// One-way blocks on a slope of 10 degrees, whose friction exceeds the level needed for equilibrium by the given
/// levels.
std::vector<Slider<Coulomb>> on_slope() {
  std::vector<Slider<Coulomb>> sliders;
  const double slope = std::numbers::pi / 18;
  for (std::size_t i = 1; i <= levels; ++i)
    sliders.emplace_back(
        Coulomb((std::tan(slope) + 0.01 * static_cast<double>(i) / std::cos(slope)) * standard_gravity),
        Mounting{.slope_degrees = 10, .one_way = true});
  return sliders;
}

/// One-way blocks whose static friction is a third above the kinetic one.
std::vector<Slider<StaticKinetic<Coulomb>>> with_static() {
  std::vector<Slider<StaticKinetic<Coulomb>>> sliders;
  for (const auto& slider : one_way()) {
    const Coulomb& law = slider.law();
    sliders.emplace_back(StaticKinetic(law, law.forward() * 4 / 3, law.backward()));
  }
  return sliders;
}

/// One-way displacement by a hand-written loop: exact on segments, and until rest after the record.
double by_hand(const std::vector<double>& n, double sign, double level) {
  double x = 0, v = 0;
  for (std::size_t i = 0; i + 1 < n.size(); ++i) {
    double a = -sign * n[i] - level, left = dt;
    const double last = -sign * n[i + 1] - level, slope = (last - a) / dt;
    if (v == 0) {
      if (a <= 0) {
        if (last <= 0) continue;
        left = last / slope;
        a = 0;
      }
    }
    const double end = v + left * (a + slope * left / 2);
    const double square = a * a - 2 * slope * v;
    double stop = left;
    bool stops = false;
    if (square >= 0 && (end <= 0 || a < 0)) {
      const double root = std::sqrt(square);
      const double t = a < 0 ? 2 * v / (root - a) : -(a + root) / slope;
      stops = t > 0 && t < left;
      if (stops) stop = t;
    }
    x += stop * (v + stop * (a / 2 + slope * stop / 6));
    v = stops ? 0 : std::max(end, 0.0);
    if (stops && last > 0) {  // it continues within the segment, from where the load meets the level again
      const double again = last / slope;
      x += slope * again * again * again / 6;
      v = slope * again * again / 2;
    }
  }
  return x + (v > 0 ? v * v / (2 * level) : 0);
}

}  // namespace

int main(int argc, char** argv) {
  const bench::Options options = bench::options(argc, argv, "sweep");
  const std::vector<GroundMotion> motions = database(options.check ? 8 : 2133),
                                  few(motions.begin(), motions.begin() + 8);
  const std::vector<Slider<Coulomb>> sliders = one_way();
  const SweepOptions one{.settle = true, .threads = 1}, two{.settle = true, .threads = 2};

  double worst = 0, apart = 0;
  std::size_t events = 0, moved = 0;
  const auto compare = [&](const auto& these, const std::vector<GroundMotion>& those, auto&& peer) {
    const SweepTable table = sweep(these, those, one);
    for (std::size_t s = 0; s < levels; ++s)
      for (std::size_t r = 0; r < those.size(); ++r)
        for (std::size_t p = 0; p < 2; ++p) {
          const Response expected = integrate(these[s], those[r].scaled(p == 0 ? 1 : -1), {.settle = true});
          const std::size_t i = table.at(s, r, p);
          worst = std::max(worst, std::abs(table.peak[i] - expected.peak) / (1e-6 + expected.peak));
          events += table.events[i] != expected.events.size() - 1;
          moved += expected.peak > 0;
          peer(those[r], p == 0 ? 1 : -1, s, expected);
        }
  };
  compare(sliders, few, [&](const GroundMotion& motion, double sign, std::size_t s, const Response& expected) {
    const std::vector<double> n(motion.acceleration().begin(), motion.acceleration().end());
    const double hand = by_hand(n, sign, sliders[s].law().forward());
    apart = std::max(apart, std::abs(hand - expected.peak) / (1e-6 + expected.peak));
  });
  const std::vector<GroundMotion> shaken = with_vertical(few);
  const auto sloping = on_slope();
  const auto stuck_faster = with_static();
  const auto nobody = [](const GroundMotion&, double, std::size_t, const Response&) {};
  compare(sliders, shaken, nobody);
  compare(sloping, few, nobody);
  compare(stuck_faster, few, nobody);
  bench::require_below("peaks against integrate", worst, 1e-11);
  bench::require_below("numbers of events that differ from integrate's", static_cast<double>(events), 0);
  bench::require_below("peaks of the plain loop against integrate", apart, 1e-9);
  bench::require(moved > 800, "combinations that slide", static_cast<double>(moved), 800);
  if (options.check) return 0;

  const double analyses = static_cast<double>(2 * levels * motions.size());
  const auto run = [&](const std::vector<GroundMotion>& these, const SweepOptions& how) {
    bench::keep(sweep(sliders, these, how).peak);
  };
  bench::Bench wall(1, bench::wall_time);
  const double in_ms = 1e6;
  wall.add("426,600 analyses, one thread [ms]", in_ms, [&] { run(motions, one); });
  wall.add("the same, two threads [ms]", in_ms, [&] { run(motions, two); });
  const std::vector<GroundMotion> single{motions[3]};
  wall.add("sliding spectrum, 100 levels, both ways [us]", 1e3, [&] { run(single, one); });
  const auto times = wall.run(std::min(options.rounds, 7));

  const double items = static_cast<double>(2 * levels * few.size() * samples);
  bench::Bench peers(1);
  peers.add("sweep", items, [&] { run(few, one); });
  peers.add("sweep, vertical motion", items, [&] { bench::keep(sweep(sliders, shaken, one).peak); });
  peers.add("sweep, on a slope", items, [&] { bench::keep(sweep(sloping, few, one).peak); });
  peers.add("sweep, static above kinetic", items, [&] { bench::keep(sweep(stuck_faster, few, one).peak); });
  peers.add("plain loop in C++", items, [&] {
    double sum = 0;
    for (const GroundMotion& motion : few) {
      const std::vector<double> n(motion.acceleration().begin(), motion.acceleration().end());
      for (const auto& slider : sliders)
        for (const double sign : {1.0, -1.0}) sum += by_hand(n, sign, slider.law().forward());
    }
    bench::keep(sum);
  });
  peers.add("loop over integrate", items, [&] {
    Response response;
    for (const GroundMotion& motion : few)
      for (const double sign : {1.0, -1.0}) {
        const GroundMotion turned = motion.scaled(sign);
        for (const auto& slider : sliders) response = integrate(slider, turned, {.settle = true}, std::move(response));
      }
  });
  const auto ratios = peers.run(std::min(options.rounds, 5));
  bench::Bench processors(1);  // however busy the machine is; what a second thread adds is lost by it
  processors.add("426,600 analyses, one thread [ms]", in_ms, [&] { run(motions, one); });
  processors.add("the same, two threads [ms]", in_ms, [&] { run(motions, two); });
  const auto spent = processors.run(std::min(options.rounds, 7));
  if (options.json) {
    std::printf(
        "{\"analyses\": %.0f, \"one_thread_s\": %.4f, \"two_threads_s\": %.4f, \"processor_s\": %.4f, "
        "\"spectrum_us\": %.1f}\n",
        analyses, times[0].least() / 1e3, times[1].least() / 1e3, spent[0].least() / 1e3, times[2].least());
    return 0;
  }
  bench::print_machine();
  bench::print_table("by the clock on the wall", times, 0);
  bench::print_table("processor time, of all threads", spent, 0);
  bench::print_table("8 records x 200 [ns a sample and level]", ratios, 0);
}
