// What the library does with a law once it is in its list; see tests/CMakeLists.txt.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "stickslip/planar/any_planar_slider.hpp"
#include "stickslip/slider/identity.hpp"
#include "stickslip/sliding/any_slider.hpp"
#include "stickslip/sliding/trajectory.hpp"

using namespace stickslip;

namespace {

void check(bool holds, const char* what) {
  if (holds) return;
  std::printf("failed: %s\n", what);
  std::exit(EXIT_FAILURE);
}

bool near(double a, double b, double scale) { return std::abs(a - b) <= 1e-11 * scale; }

GroundMotion shaking() {
  std::vector<double> axis(801), transverse(801);
  for (int i = 0; i <= 800; ++i) {
    const double fade = std::pow(std::sin(std::numbers::pi * i / 800), 2);
    axis[static_cast<std::size_t>(i)] = 4 * fade * std::sin(0.13 * i);
    transverse[static_cast<std::size_t>(i)] = 3 * fade * std::cos(0.09 * i);
  }
  return GroundMotion(axis, 0.01).with_components(transverse);
}

}  // namespace

int main() {
  static_assert(LibraryLaws::has<Sand> && PlanarLaws::has<Sand>);
  const GroundMotion motion = shaking();

  // The drag is a damper: the same motion, in closed form.
  const AnySlider sand = Slider(Sand(0.7, 0.3), 2.0), damped = Slider(Coulomb(0.7), 2.0, 0.3);
  const Response found = integrate(sand, motion), expected = integrate(damped, motion);
  check(near(found.peak, expected.peak, expected.peak), "peak");
  check(near(found.residual, expected.residual, expected.peak), "residual");
  check(found.events.size() == expected.events.size(), "events");
  check(near(found.energy.dissipated, expected.energy.dissipated + expected.energy.damped, expected.energy.dissipated),
        "energy");
  State state, other;
  for (const Segment& segment : {Segment{0.3, 2, 3}, Segment{0.4, 3, -1}}) {
    advance(sand, segment, state);
    advance(damped, segment, other);
  }
  check(near(state.displacement, other.displacement, std::abs(other.displacement)), "advance");
  check(trajectory(sand, motion, found) != nullptr, "trajectory");

  const PlanarResponse in_plane = integrate(planar(sand), motion), by_damper = integrate(planar(damped), motion);
  check(near(in_plane.peak, by_damper.peak, by_damper.peak), "peak in the plane");

  check(identity(sand) == R"({"law": "Sand", "slip_level": 0.7, "drag": 0.3, "natural_frequency": 2})", "identity");
  try {
    Sand(0.7, -1);
    check(false, "range");
  } catch (const std::invalid_argument& error) {
    check(std::string(error.what()) == "Sand: drag must be finite and at least 0, got -1 1/s", "message");
  }
  return EXIT_SUCCESS;
}
