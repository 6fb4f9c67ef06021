// Blocks under pulses side by side do what one block does under the motion that `sample` gives.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "lanes/instruction_sets.hpp"
#include "stickslip/ensemble/run.hpp"
#include "stickslip/sliding/integrate.hpp"
#include "support/catch.hpp"

using namespace stickslip;

namespace {

std::vector<PoissonPulses> excitations() {
  PoissonOptions stationary, triangle, many_edges;
  stationary.stationary_start = true;
  triangle.shape = PulseShape({0, 0.5, 1, 1.5}, {1, -2, 1});
  std::vector<double> times, values;
  for (int i = 0; i <= 20; ++i) times.push_back(0.1 * i);
  for (int i = 0; i < 20; ++i) values.push_back(std::sin(0.314159 * i + 0.1));
  many_edges.shape = PulseShape(times, values);
  return {PoissonPulses(3, 1.0 / 6, 2.5, 20),
          PoissonPulses(0.05, 0.5, 5, 20),  // some members without any pulse
          PoissonPulses(40, 0.25, 1, 20),   // ten at a time
          PoissonPulses(3, 1.0 / 6, 2.5, 20, stationary),
          PoissonPulses(3, 1.0 / 6, 2.5, 20, triangle),
          PoissonPulses(3, 1.0 / 6, 2.5, 20, many_edges),  // more than the lanes take
          PoissonPulses(3, 1.0 / 6, 2.5, 20.3)};           // ends between two times of the statistics
}

}  // namespace

// Round-off of the displacement grows with the pieces, some hundred, and with what cancels in the ground acceleration
// where pulses overlap: 1e-12 of the scale is 4500 roundings.
TEST_CASE("blocks under pulses in lanes end and peak as single ones, on every instruction set", "[pulse_lanes]") {
  const auto all = excitations();
  test::on_each_instruction_set([&all](const std::string& set) {
    for (const PoissonPulses& pulses : all)
      for (const Coulomb& law :
           {Coulomb(0.5), Coulomb(1.96, 0.4), Coulomb(1, std::numeric_limits<double>::infinity()), Coulomb(0)}) {
        const EnsembleTimes times{0.25, 81};
        const std::atomic<bool> stopped = false;
        detail::Block block(times, false, false, stopped);
        const auto lanes = detail::lanes_simulator(Slider(law), pulses, 5, false);
        if (pulses.options().shape.times().size() > 16) {
          CHECK(lanes == nullptr);
          continue;
        }
        INFO(set << ": " << pulses.configuration() << ", levels " << law.forward() << " and " << law.backward());
        block.begin(37);
        lanes->simulate(64, 37, block);
        const detail::Tally tally = block.finish();
        double scale = 1;
        for (std::uint64_t i = 0; i < 37; ++i) {
          const GroundMotion motion = pulses.sample(5, 64 + i);
          const Response response = integrate(law, motion);
          scale = std::max(scale, response.peak);
          CHECK(std::abs(block.peak()[i] - response.peak) < 1e-12 * scale);
          CHECK(std::abs(block.residual()[i] - response.residual) < 1e-12 * scale);
        }
        const Slider<Coulomb> slider(law);
        const PairedMembers members(slider, pulses);
        detail::MemberSimulator alone(members, 5, false);
        block.begin(37);
        alone.simulate(64, 37, block);
        const detail::Tally expected = block.finish();
        for (std::size_t k = 0; k < times.count; ++k) {
          CHECK(std::abs(tally.moment(detail::Tally::x)[k] - expected.moment(detail::Tally::x)[k]) < 1e-12 * scale);
          CHECK(std::abs(tally.moment(detail::Tally::xx)[k] - expected.moment(detail::Tally::xx)[k]) <
                1e-12 * 37 * scale * scale);
          CHECK(std::abs(tally.moment(detail::Tally::vv)[k] - expected.moment(detail::Tally::vv)[k]) <
                1e-12 * 37 * scale * scale);
        }
      }
  });
}
