// A friction law of your own is one function: the slip level as a function of position. Nothing else changes.
//
//     own_law [file]        writes the histories to the file, as comma-separated values
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <numbers>
#include <stickslip/core.hpp>
#include <vector>

using namespace stickslip;

// A rough patch on a smooth floor: the slip level decays as exp(-(x/reach)^2).
struct Patch {
  double slip_level;  // [m/s^2]
  double reach;       // [m]

  template <class T>  // a number, or a power series in time: `using std::exp` and `auto` serve both
  auto resist(const T& x, Direction) const {
    using std::exp;
    return slip_level * exp(-(x / reach) * (x / reach));
  }
};

int main(int argc, char** argv) {
  const double pi = std::numbers::pi, dt = 0.01;  // [s]
  std::vector<double> ground(601);                // 6 s; the ground moves during the first 4 s
  for (int i = 0; i <= 400; ++i) ground[i] = 4 * std::sin(pi * i / 400) * std::sin(2 * pi * i * dt);  // [m/s^2]
  const GroundMotion motion(ground, dt);

  const double spring = 2 * pi / 3;  // [rad/s]: period 3 s
  const Response patch = integrate(Slider(Patch{.slip_level = 1, .reach = 0.1}, spring), motion);
  const Response rough = integrate(Slider(Coulomb(1), spring), motion);  // as rough everywhere

  std::printf("on the patch: peak %.4f m, after %.0f s %.4f m\n", patch.peak, motion.duration(), patch.residual);
  std::printf("as rough everywhere: peak %.4f m, residual %.4f m\n", rough.peak, rough.residual);
  std::printf("friction of the patch dissipated %.4f of an energy input of %.4f m^2/s^2\n", patch.energy.dissipated,
              patch.energy.input);

  if (argc > 1) {
    std::ofstream file(argv[1]);
    file << "time [s],ground acceleration [m/s^2],on the patch [m],as rough everywhere [m]\n";
    for (std::size_t i = 0; i < motion.samples(); ++i)
      file << motion.time(i) << ',' << ground[i] << ',' << patch.displacement[i] << ',' << rough.displacement[i]
           << '\n';
    if (!file.flush()) return EXIT_FAILURE;
  }

  // The energy balance holds, although the law does not define its work. The slider slides farther on a smoother floor.
  const bool sane =
      std::abs(patch.energy.imbalance()) < 1e-12 * patch.energy.input && patch.peak > rough.peak && rough.peak > 0;
  return sane ? EXIT_SUCCESS : EXIT_FAILURE;
}
