// What a response tells of the ends of arcs is what its motion, integrated again, shows there.
#include "stickslip/sliding/detail/recall.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "stickslip/core.hpp"
#include "stickslip/sliding/forces.hpp"
#include "stickslip/sliding/margins.hpp"
#include "support/catch.hpp"
#include "support/laws.hpp"
#include "support/motions.hpp"

using namespace stickslip;
using namespace test;

namespace {

std::vector<Mounting> mountings() {
  std::vector<Mounting> all(7);
  all[1].natural_frequency = 2;
  all[2].natural_frequency = 1.5;
  all[2].damping = 0.4;
  all[3].slope_degrees = 1;
  all[4].stops = Stops(0.03, 0.5);
  all[5].natural_frequency = 2;
  all[5].pendulum = true;
  all[6].stops = Stops(0.02, 0.05, 0);
  return all;
}

/// Strong and weak, horizontal and with vertical motion that does not lift a slider.
std::vector<GroundMotion> grounds() {
  std::vector<GroundMotion> all;
  for (const double deviation : {0.4, 1.0, 3.0}) {
    const GroundMotion level(gaussian(17, 150, deviation, deviation < 2), 0.02);
    std::vector<double> up = gaussian(18, 150, 2);
    for (double& a : up) a = std::clamp(a, -8.0, 8.0);
    all.push_back(level);
    all.push_back(level.with_components({}, up));
  }
  return all;
}

struct Read {
  Forces forces;
  Margins margins;
  LargestForce largest;
};

/// @tparam told  by the response where it can, or integrated again
template <bool told>
Read read(const Trajectory& trajectory) {
  const auto show = [&](auto& reader, double until) {
    if constexpr (told)
      detail::read_ends(trajectory, reader, until);
    else
      trajectory.read(reader, until);
  };
  detail::ForcesReader forces(trajectory);
  detail::MarginReader margins(trajectory);
  detail::LargestForceReader largest(trajectory);
  show(forces, std::max(trajectory.end(), trajectory.time(trajectory.response().displacement.size() - 1)));
  show(margins, trajectory.end() * (1 + 0x1p-46));
  if (largest.at_ends) show(largest, trajectory.end());
  return {std::move(forces.forces), margins.margins, largest.largest};
}

}  // namespace

TEST_CASE("forces and margins that a response tells are those of its motion", "[forces][margins]") {
  std::size_t covered = 0;
  for_each_law([&](const auto& example) {
    for (const Mounting& mounting : mountings())
      for (const GroundMotion& motion : grounds()) {
        const Slider slider(example.law, taken_by(example.law, mounting));
        const Response response = integrate(slider, motion, from(0.01, -0.1, mounting.natural_frequency > 0));
        const auto path = trajectory(slider, motion, response);
        covered += detail::Recall<detail::ForcesReader>::covers(*path);
        const Read is = read<true>(*path), expected = read<false>(*path);
        INFO(example.name << ", spring " << mounting.natural_frequency << ", slope " << mounting.slope_degrees
                          << ", stop " << mounting.stops.forward() << (motion.has_vertical() ? ", vertical" : ""));
        REQUIRE(is.forces.stuck == expected.forces.stuck);
        for (std::size_t i = 0; i < is.forces.stuck.size(); ++i) {
          REQUIRE(is.forces.total(i) == Approx(expected.forces.total(i)).margin(1e-11));
          REQUIRE(is.forces.normal[i] == Approx(expected.forces.normal[i]).margin(1e-11));
        }
        // A margin is a difference of loads: their round-off is that of a time of 3 s times their rate.
        CHECK(is.margins.load == Approx(expected.margins.load).margin(1e-10));
        CHECK(is.margins.impact == Approx(expected.margins.impact).margin(1e-10));
        CHECK(is.largest.force == Approx(expected.largest.force).epsilon(1e-12));
        CHECK(is.largest.time == Approx(expected.largest.time).margin(1e-12));
      }
  });
  CHECK(covered > 250);  // all but those of laws with memory
}
