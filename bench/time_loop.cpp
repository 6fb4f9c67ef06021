// One segment at a time, as in a seismic code with its own time loop: `advance` in C++, and the C interface with a
// model made once (stickslip_step) and without (stickslip_advance).
//
// time_loop [--check] [--json] [--rounds N]
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include "bench.hpp"
#include "stickslip/core.hpp"
#include "stickslip/stickslip.h"

using namespace stickslip;

namespace {

constexpr std::size_t segments = 50'000;
constexpr double dt = 0.005;

// The acceleration of a floor: two sines under a slow modulation, sliding about a third of the time.
std::vector<double> floor_motion() {
  std::vector<double> values(segments + 1);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double t = static_cast<double>(i) * dt;
    values[i] = 4 * std::sin(0.3 * t) * (std::sin(9 * t) + 0.4 * std::sin(23.7 * t));
  }
  return values;
}
const std::vector<double> ground = floor_motion();

template <class Law>
State by_cpp(const Slider<Law>& slider) {
  State state;
  for (std::size_t i = 0; i < segments; ++i) advance(slider, Segment{dt, ground[i], ground[i + 1]}, state);
  return state;
}

template <class Step>
stickslip_state by_c(Step&& step) {
  stickslip_state state = {};
  for (std::size_t i = 0; i < segments; ++i) {
    const stickslip_segment segment = {dt, ground[i], ground[i + 1], 0, 0};
    if (step(&segment, &state) != STICKSLIP_OK) std::exit(EXIT_FAILURE);
  }
  return state;
}

stickslip_state by_model(const stickslip_model* model) {
  return by_c([&](auto* segment, auto* state) { return stickslip_step(model, segment, state); });
}
stickslip_state by_numbers(const stickslip_slider& slider) {
  return by_c([&](auto* segment, auto* state) { return stickslip_advance(&slider, segment, state); });
}

void require_same_bits(const std::string& name, const State& expected, const stickslip_state& found) {
  bench::require_below(name + ": x", std::abs(found.displacement - expected.displacement), 0);
  bench::require_below(name + ": x'", std::abs(found.velocity - expected.velocity), 0);
  bench::require(expected.displacement != 0, name + ": has slid", expected.displacement, 0);
}

}  // namespace

int main(int argc, char** argv) {
  const bench::Options asked = bench::options(argc, argv, "time_loop");
  bench::Bench bench(segments);
  std::vector<stickslip_model*> models;
  const auto add = [&](const std::string& name, const auto& slider, const stickslip_slider& numbers) {
    stickslip_model* model = nullptr;
    if (stickslip_create(&numbers, &model) != STICKSLIP_OK) std::exit(EXIT_FAILURE);
    models.push_back(model);
    require_same_bits(name + ", stickslip_step", by_cpp(slider), by_model(model));
    require_same_bits(name + ", stickslip_advance", by_cpp(slider), by_numbers(numbers));
    bench.add(name + ": C++, advance", [slider] { bench::keep(by_cpp(slider)); });
    bench.add(name + ": C, stickslip_step", [model] { bench::keep(by_model(model)); });
    bench.add(name + ": C, stickslip_advance", [numbers] { bench::keep(by_numbers(numbers)); });
  };
  add("Coulomb", Slider(Coulomb(1)), {.slip_level = 1});
  add("Coulomb, spring", Slider(Coulomb(1), 2), {.slip_level = 1, .natural_frequency = 2});
  add("static above kinetic", Slider(StaticKinetic(Coulomb(1), 1.3)), {.slip_level = 1, .static_level = 1.3});

  if (!asked.check) {
    const auto timings = bench.run(asked.rounds);
    if (!asked.json) {
      bench::print_machine();
      std::printf("%zu segments of 0.005 s; answers checked; ns of processor time, %d rounds\n", segments,
                  asked.rounds);
    } else {
      std::printf("{\"commit\": %s, \"rows\": {", bench::json_string(build_info().commit).c_str());
    }
    for (std::size_t first = 0; first < timings.size(); first += 3) {
      const std::vector<bench::Timing> group(timings.begin() + static_cast<std::ptrdiff_t>(first),
                                             timings.begin() + static_cast<std::ptrdiff_t>(first + 3));
      if (!asked.json) {
        bench::print_table("each segment", group, 0);
        continue;
      }
      for (const bench::Timing& timing : group)
        std::printf("%s\n  %s: {\"median\": %.3f, \"least\": %.3f, \"spread\": %.3f, \"ratio\": %.3f}",
                    first == 0 && &timing == group.data() ? "" : ",", bench::json_string(timing.name).c_str(),
                    timing.median(), timing.least(), timing.spread(), timing.ratio(group[0]));
    }
    if (asked.json) std::printf("}}\n");
  }
  for (stickslip_model* model : models) stickslip_destroy(model);
  return EXIT_SUCCESS;
}
