// A friction law of your own is one function: the slip level at a place. Everything else stays as it is.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <stickslip/core.hpp>

using namespace stickslip;

// A rough patch on a smooth floor: the slip level decays as exp(-(x/reach)^2).
struct Patch {
  double slip_level;  // [m/s^2]
  double reach;       // [m]

  template <class T>  // a number, or a power series in time: return auto, and let exp be found for either
  auto level(const T& x, Direction) const {
    using std::exp;
    return slip_level * exp(-(x / reach) * (x / reach));
  }
};

int main() {
  const Patch patch{.slip_level = 2, .reach = 0.3};
  const Slider slider(patch, 2 * std::numbers::pi / 3);  // on a spring, of period 3 s
  const GroundMotion motion({0, 4, 0, -4, 0}, 0.25, Interpolation::linear, "one cycle");

  const Response response = integrate(slider, motion);

  std::printf("at the end of the motion, %.2f s:\n", motion.duration());
  std::printf("displacement %8.4f m\n", response.residual);
  std::printf("velocity     %8.4f m/s\n", response.state.velocity);
  std::printf("friction took %.4f of the %.4f m^2/s^2 that the ground put in\n", response.energy.dissipated,
              response.energy.input);

  // The energy adds up, though the law said nothing of energy.
  const bool sane = response.peak > 0 && std::abs(response.energy.imbalance()) < 1e-12 * response.energy.input;
  return sane ? EXIT_SUCCESS : EXIT_FAILURE;
}
