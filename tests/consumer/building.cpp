// A structure in a code that uses Eigen itself and is compiled with other instructions than the library: vectors and
// matrices go to and fro.
#include <Eigen/Dense>  // a user's own
#include <cmath>
#include <cstdio>
#include <stickslip/stickslip.hpp>
#include <stickslip/structure/isolated_structure.hpp>
#include <utility>
#include <vector>

using namespace stickslip;

int main() {
#if defined(__AVX2__)
  if (!__builtin_cpu_supports("avx2")) return std::puts("skipped: this processor has no AVX2"), 0;
#endif
  // While the interface sticks, two modes y'' + 2 z w y' + w^2 y = -sqrt(fraction) n(t), n from 1 to 2 m/s^2, from rest.
  Eigen::VectorXd fractions(2), frequencies(2), damping(2);
  fractions << 0.5, 0.2;
  frequencies << 6.0, 20.0;
  damping << 0.05, 0.02;
  const IsolatedStructure building(Slider<Coulomb>(Coulomb(100.0)),
                                   Structure::from_modes(fractions, frequencies, damping));
  const double duration = 0.01;
  StructureState state = building.rest();
  for (int k = 0; k < 3; ++k) {  // what the library has allocated is copied, moved and freed here
    StructureState other = building.rest();
    advance(building, Segment{duration, 1, 2}, other);
    state = std::exchange(other, state);
    other.modal_velocity.resize(7);
  }
  for (std::size_t i = 0; i < 2; ++i) {
    const auto j = static_cast<Eigen::Index>(i);
    const double w = frequencies[j];
    const auto rate = [&](double t, double y, double v) {
      return -std::sqrt(fractions[j]) * (1 + t / duration) - 2 * damping[j] * w * v - w * w * y;
    };
    double y = 0, v = 0;
    const int steps = 1000;  // of Runge and Kutta; (w h)^4 is below 1e-14
    const double h = duration / steps;
    for (int step = 0; step < steps; ++step) {
      const double t = h * step, k1 = rate(t, y, v), k2 = rate(t + h / 2, y + h / 2 * v, v + h / 2 * k1);
      const double k3 = rate(t + h / 2, y + h / 2 * v + h * h / 4 * k1, v + h / 2 * k2);
      const double k4 = rate(t + h, y + h * v + h * h / 2 * k2, v + h * k3);
      y += h * v + h * h / 6 * (k1 + k2 + k3);
      v += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    }
    if (!(std::abs(state.modal_displacement[i] - y) < 1e-12 * std::abs(y)))
      return std::printf("mode %d: %.15g, expected %.15g\n", static_cast<int>(i), state.modal_displacement[i], y), 1;
  }
  // A response, whose matrices grow here.
  std::vector<double> ground;
  for (int i = 0; i < 500; ++i) ground.push_back(3 * std::sin(0.07 * i));
  StructureResponse response = integrate(building, GroundMotion(ground, 0.01));
  const RealMatrix& y = response.modal_displacement;
  const Eigen::MatrixXd copy = Eigen::Map<const Eigen::MatrixXd>(y.data(), y.rows(), y.cols());
  response.modal_displacement = Eigen::MatrixXd::Random(2000, 5);
  response = StructureResponse{};
  // The library inverts and decomposes matrices of its own, and this code others, with the same functions of Eigen.
  const Eigen::MatrixXd mass = Eigen::Vector3d(2, 1, 1).asDiagonal(), random = Eigen::MatrixXd::Random(3, 3);
  const Eigen::MatrixXd stiffness = random * random.transpose();
  const Structure three(mass, 0.01 * stiffness, stiffness);
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(stiffness, mass);
  for (std::size_t j = 0; j < 3; ++j) {
    const double square = solver.eigenvalues()[static_cast<Eigen::Index>(j)], w = three.modes().frequencies[j];
    if (!(std::abs(w * w - square) < 1e-12 * solver.eigenvalues()[2]))
      return std::printf("w^2 %.15g, expected %.15g\n", w * w, square), 1;
  }
  return copy.allFinite() ? 0 : 1;
}
