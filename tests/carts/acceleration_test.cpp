// What a cart's wheels do together: the minimum is a minimum, however parallel they are.
#include "carts/acceleration.hpp"

#include <cmath>
#include <random>
#include <vector>

#include "carts/zonotope.hpp"
#include "support/catch.hpp"

using namespace stickslip::detail;

TEST_CASE("Lines slide in the direction of their acceleration, and the others carry the rest", "[carts]") {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> unit(-1, 1), power(-8, 0), turn(-3.14, 3.14);
  std::size_t moved = 0, stuck = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    // Wheels of which some are almost parallel, as after a long roll, some on one axle, and each with rolling resistance.
    const double common = turn(random), apart = std::pow(10, power(random));
    struct Line {
      Vector3 row;
      double beta, level;
    };
    std::vector<Line> lines;
    const int wheels = 2 + trial % 3;
    const bool moves = trial % 4 == 0;
    for (int w = 0; w < wheels; ++w) {
      const double heading = trial % 5 == 0 ? turn(random) : common + apart * unit(random);
      const double x = w % 2 == 0 ? 1.2 : -1.2, y = w < 2 ? 0.8 : -0.8, c = std::cos(heading), s = std::sin(heading);
      lines.push_back({{-s, c, x * c + y * s}, moves ? 0.1 * unit(random) : 0, 1.1});
      lines.push_back({{c, s, x * s - y * c}, 0, 0.02});
    }
    const double load = std::pow(10, unit(random)), way = trial % 3 == 0 ? common : turn(random);
    const Vector3 p{load * std::cos(way), load * std::sin(way), 0};
    AccelerationProblem problem;
    for (const Line& line : lines) problem.add(line.row, line.beta, line.level);
    problem.solve(p);
    const Vector3 a = problem.acceleration();
    // p - a is what all carry: with signs where they slide, and the rest within what the others can.
    Vector3 rest = p;
    add_to(rest, -1, a);
    Zonotope others;
    bool right = true;
    for (std::size_t j = 0; j < lines.size(); ++j) {
      const double rate = dot(lines[j].row, a) + lines[j].beta;
      if (problem.slides(j) != 0) {
        add_to(rest, -problem.slides(j) * lines[j].level, lines[j].row);
        right = right && problem.slides(j) * rate >= -1e-14 * (norm(a) + std::abs(lines[j].beta));
        ++moved;
      } else {
        others.add(lines[j].row, lines[j].level);
        right = right && std::abs(rate) <= 1e-9;  // a tie, or what parallel rows leave
        ++stuck;
      }
    }
    others.close();
    const double size = load + 4;
    INFO("trial " << trial << ", apart by " << apart);
    CHECK(right);
    CHECK(norm(others.outside(rest)) <= 1e-9 * size);
    if (others.rank() > 0) CHECK(others.margin(rest) >= -1e-9 * size);
  }
  CHECK(moved > 1000);
  CHECK(stuck > 1000);
}
