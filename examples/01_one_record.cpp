// Slides a block on a floor through one earthquake record:
//
//     one_record [file [mu]]        a record in a format that read_record reads, and the coefficient of friction
//
// Without a file, the ground accelerates for half a second in one direction and then for half a second in the other.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <stickslip/stickslip.hpp>

using namespace stickslip;

int main(int argc, char** argv) try {
  const GroundMotion motion =
      argc > 1 ? read_record(argv[1]) : GroundMotion({4, -4, 0, 0}, 0.5, Interpolation::constant, "two pulses");
  const double mu = argc > 2 ? std::atof(argv[2]) : 0.2;
  const Coulomb law = Coulomb::from_friction(mu);

  const Response response = integrate(law, motion, {.settle = true});

  std::printf("%s: %.2f s, peak ground acceleration %.3f m/s^2\n", motion.name().c_str(), motion.duration(),
              motion.peak_acceleration());
  std::printf("friction %.3f: slip level %.3f m/s^2\n", mu, law.forward());
  std::printf("peak displacement     %8.4f m\n", response.peak);
  std::printf("residual displacement %8.4f m\n", response.residual);

  // The residual displacement cannot exceed the peak, and friction dissipates all the work of the ground.
  const Energy& energy = response.energy;
  const bool sane = std::abs(response.residual) <= response.peak &&
                    std::abs(energy.imbalance()) <= 1e-12 * (energy.dissipated + std::abs(energy.input));
  return sane ? EXIT_SUCCESS : EXIT_FAILURE;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return EXIT_FAILURE;
}
