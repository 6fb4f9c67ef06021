// A seismic code with its own time loop: a block stands on the floor of a building, which the code integrates. One call
// per step advances the block, and its state is the only data kept between steps.
//
//     time_loop [file]        writes the histories to the file, as comma-separated values
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <numbers>
#include <stickslip/core.hpp>
#include <vector>

using namespace stickslip;

// One storey, damping 5 %, period 0.5 s, integrated by the semi-implicit Euler method.
class Building {
 public:
  // Advances by one step; returns the absolute acceleration of the floor [m/s^2].
  double step(double ground_acceleration, double dt) {
    const double wn = 2 * std::numbers::pi / 0.5;
    const double pull = wn * wn * displacement_ + 2 * 0.05 * wn * velocity_;
    velocity_ -= (ground_acceleration + pull) * dt;
    displacement_ += velocity_ * dt;
    return -pull;
  }

 private:
  double displacement_ = 0, velocity_ = 0;  // of the floor, relative to the ground [m], [m/s]
};

int main(int argc, char** argv) {
  const double dt = 0.005;  // [s]
  const Slider slider(Coulomb::from_friction(0.3));
  Building building;
  State block;  // at rest
  double floor = 0;
  std::vector<double> floor_history{floor}, block_history{block.displacement};

  for (int i = 1; i <= 2000; ++i) {
    const double t = i * dt;
    const double ground = 2 * std::exp(-t / 4) * std::sin(2 * std::numbers::pi * t / 0.5);  // [m/s^2]
    const double next = building.step(ground, dt);
    advance(slider, Segment{.duration = dt, .start = floor, .end = next}, block);
    floor = next;
    floor_history.push_back(floor);
    block_history.push_back(block.displacement);
  }
  std::printf("after the earthquake the block is %.4f m from where it stood, %s\n", block.displacement,
              block.mode == Mode::stuck ? "at rest" : "still sliding");

  // The same floor motion, integrated in one call.
  const Response response = integrate(slider, GroundMotion(floor_history, dt));
  std::printf("its largest displacement was %.4f m\n", response.peak);

  if (argc > 1) {
    std::ofstream file(argv[1]);
    file << "time [s],floor acceleration [m/s^2],block [m]\n";
    for (std::size_t i = 0; i < floor_history.size(); ++i)
      file << static_cast<double>(i) * dt << ',' << floor_history[i] << ',' << block_history[i] << '\n';
    if (!file.flush()) return EXIT_FAILURE;
  }

  const bool sane = response.peak > 0 && std::abs(response.residual - block.displacement) < 1e-12 * response.peak;
  return sane ? EXIT_SUCCESS : EXIT_FAILURE;
}
