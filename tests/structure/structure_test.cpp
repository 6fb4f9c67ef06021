// Structures with one sliding interface: modes, limits, balances and bad input.
#include "stickslip/structure/structure.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "stickslip/core.hpp"
#include "stickslip/friction/velocity_dependent.hpp"
#include "stickslip/structure/equipment_on_floor.hpp"
#include "stickslip/structure/flexible_slope.hpp"
#include "stickslip/structure/floor_motions.hpp"
#include "stickslip/structure/isolated_structure.hpp"
#include "stickslip/structure/sweep.hpp"
#include "structure/eigen.hpp"
#include "support/catch.hpp"

using namespace stickslip;
using Catch::Matchers::ContainsSubstring;
using detail::view;

namespace {

/// The ground motion of the reference values, with `parts` straight lines in place of one.
GroundMotion motion(int parts = 1) {
  std::vector<double> n;
  for (int m = 0; m < 400 * parts; ++m) {
    const auto at = [](int k) { return 2 * std::sin(0.7 * k) + 1.3 * std::cos(1.9 * k + 0.4); };
    const int k = m / parts;
    n.push_back(at(k) + (at(k + 1) - at(k)) * (m % parts) / parts);
  }
  n.push_back(2 * std::sin(280.0) + 1.3 * std::cos(760.4));
  return GroundMotion(n, 0.1 / parts);
}

Structure building() { return Structure::shear_building({1, 1, 0.8}, {600, 500, 400}, Rayleigh{0.1, 0.002}); }

Slider<Coulomb> slider(double level = 1, Mounting mounting = {}) { return Slider<Coulomb>(Coulomb(level), mounting); }

double furthest(const std::vector<double>& a, const std::vector<double>& b) {
  double most = std::abs(static_cast<double>(a.size()) - static_cast<double>(b.size()));
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) most = std::max(most, std::abs(a[i] - b[i]));
  return most;
}

}  // namespace

TEST_CASE("a building of two equal floors has the golden section in its modes", "[structure]") {
  const Structure two = Structure::shear_building({2, 2}, {18, 18}, 0.05);
  // w^2 = (k/m) (3 -+ sqrt 5) / 2
  const Modes& modes = two.modes();
  for (const std::size_t j : {0, 1}) {
    const double s = j == 0 ? -1 : 1;
    CHECK(modes.frequencies[j] == Approx(3 * std::sqrt((3 + s * std::sqrt(5)) / 2)).epsilon(1e-14));
    CHECK(modes.damping_ratios[j] == Approx(0.05).epsilon(1e-13));
    const auto shape = view(modes.shapes).col(static_cast<Eigen::Index>(j));
    const double ratio = shape[1] / shape[0];
    CHECK(ratio == Approx((1 - s * std::sqrt(5)) / 2).epsilon(1e-13));
  }
  CHECK(view(modes.effective_masses).sum() == Approx(4).epsilon(1e-14));
  CHECK(two.classical());
  CHECK((view(modes.shapes).transpose() * view(two.mass()) * view(modes.shapes) - Eigen::MatrixXd::Identity(2, 2))
            .norm() < 1e-14);
  // alpha / (2 w) + beta w / 2
  const Structure rayleigh = Structure::shear_building({2, 2}, {18, 18}, Rayleigh{0.3, 0.01});
  for (const std::size_t j : {0, 1}) {
    const double w = modes.frequencies[j];
    CHECK(rayleigh.modes().damping_ratios[j] == Approx(0.15 / w + 0.005 * w).epsilon(1e-13));
  }
}

TEST_CASE("structures take vectors and matrices of any kind", "[structure]") {
  const RealMatrix braces{{2, 0}, {0, 1}};
  Eigen::Matrix<double, 2, 2, Eigen::RowMajor> rows;
  rows << 2, 0, 0, 1;
  CHECK(braces.rows() == 2);
  CHECK(braces.data()[3] == 1);
  CHECK(RealMatrix(rows) == braces);
  CHECK(RealMatrix(rows * rows - rows)(0, 0) == 2);  // an expression
  CHECK(RealMatrix() == RealMatrix(0, 0));
  CHECK_THROWS_AS((RealMatrix{{1, 2}, {3}}), std::invalid_argument);
  const Structure one = Structure::shear_building({2, 1}, {18, 9}, 0.05);
  const Eigen::Vector2d masses(2, 1), stiffnesses(18, 9);
  CHECK(one == Structure::shear_building(masses, 2 * stiffnesses - stiffnesses, 0.05));
  const std::array<double, 2> array{2, 1};
  CHECK(one == Structure::shear_building(array, std::vector<double>{18, 9}, 0.05));
}

TEST_CASE("a structure is the same in modes and in matrices", "[structure]") {
  const double base = 1;
  const Structure matrices = building();
  const double total = base + view(matrices.mass()).sum();
  const Modes& modes = matrices.modes();
  const Structure from =
      Structure::from_modes(view(modes.effective_masses) / total, modes.frequencies, modes.damping_ratios,
                            view(modes.shapes) * view(modes.participation).asDiagonal());
  const Mounting spring{.natural_frequency = 2, .damping = 0.4};
  const auto a = integrate(IsolatedStructure(slider(1, spring), matrices, base), motion());
  const auto b = integrate(IsolatedStructure(slider(1, spring), from), motion());
  CHECK(furthest(a.displacement, b.displacement) < 1e-13);
  CHECK((view(a.floors.displacement) - view(b.floors.displacement)).cwiseAbs().maxCoeff() < 1e-13);
  CHECK((view(a.floors.acceleration) - view(b.floors.acceleration)).cwiseAbs().maxCoeff() < 1e-11);
  CHECK(furthest(a.floors.peak_acceleration, b.floors.peak_acceleration) < 1e-11);
  CHECK(a.peak_base_shear == Approx(total * b.peak_base_shear).epsilon(1e-12));
}

TEST_CASE("limits of a structure on a sliding base", "[structure][long]") {
  const auto one = [](double fraction, double frequency, double damping_ratio = 0.05) {
    return integrate(IsolatedStructure(slider(), Structure::from_modes({fraction}, {frequency}, {damping_ratio})),
                     motion());
  };
  const Response plain = integrate(slider(), motion());
  SECTION("a structure without mass") {
    // Reference: -2.3e-8 at a mass fraction of 1e-6, to two digits.
    CHECK(std::abs(one(1e-6, 8).residual - plain.residual + 2.3e-8) < 1e-9);
    CHECK(furthest(one(1e-12, 8).displacement, plain.displacement) < 1e-12);
  }
  SECTION("a rigid structure") {
    // Reference: 9.5e-4 m at 200 rad/s with a mass fraction of 0.8, 8.7e-5 at 2000.
    const double first = std::abs(one(0.8, 200).residual - plain.residual);
    const double second = std::abs(one(0.8, 2000).residual - plain.residual);
    CHECK(first == Approx(9.5e-4).epsilon(0.01));
    CHECK(second == Approx(8.7e-5).epsilon(0.01));
  }
  SECTION("a mass that is split over equal modes") {
    const auto split = integrate(
        IsolatedStructure(slider(), Structure::from_modes({0.3, 0.1, 0.3}, {8, 8, 8}, {0.05, 0.05, 0.05})), motion());
    CHECK(furthest(split.displacement, one(0.7, 8).displacement) < 1e-13);
  }
  SECTION("a heavy base") {
    const auto heavy = integrate(IsolatedStructure(slider(), building(), 1e13), motion());
    CHECK(furthest(heavy.displacement, plain.displacement) < 1e-11);
  }
  SECTION("a slider on a stiff floor, with and without mass") {
    const Structure stiff = Structure::shear_building({1}, {4e6}, 0.05);
    for (const double mass : {0.0, 0.5})
      CHECK(furthest(integrate(EquipmentOnFloor(slider(), stiff, 1, mass), motion()).displacement, plain.displacement) <
            1e-3);
  }
  SECTION("a slider of little mass on a floor") {
    const auto light = integrate(EquipmentOnFloor(slider(1.5), building(), 2), motion());
    const auto small = integrate(EquipmentOnFloor(slider(1.5), building(), 2, 1e-12), motion());
    CHECK(furthest(light.displacement, small.displacement) < 1e-9);
  }
}

TEST_CASE("while it is stuck, a structure is an oscillator on the ground, also from a first sample that is not zero",
          "[structure]") {
  const double w = 8, z = 0.1, n = 0.5, damped = w * std::sqrt(1 - z * z);
  const auto r = integrate(IsolatedStructure(slider(100), Structure::from_modes({0.5}, {w}, {z}, {{1}})),
                           GroundMotion(std::vector<double>(41, n), 0.05));
  CHECK(r.peak == 0);
  for (Eigen::Index i = 0; i <= 40; ++i) {
    const double t = 0.05 * static_cast<double>(i);
    const double y =
        -n / (w * w) * (1 - std::exp(-z * w * t) * (std::cos(damped * t) + z * w / damped * std::sin(damped * t)));
    CHECK(std::abs(r.floors.displacement(i, 0) - y) < 1e-16);
  }
  // The largest displacement comes after half a period, between samples.
  const double peak = n / (w * w) * (1 + std::exp(-z * w * std::numbers::pi / damped));
  CHECK(r.floors.peak_drift[0] == Approx(peak).epsilon(1e-13));
}

TEST_CASE("straight lines that are divided change nothing, and peaks lie between samples", "[structure][long]") {
  const IsolatedStructure isolated(slider(1, Mounting{.natural_frequency = 2, .damping = 0.2}), building(), 1);
  const EquipmentOnFloor equipment(slider(1.5), building(), 3, 0.2);
  for (const SlidingStructure& system : {SlidingStructure(isolated), SlidingStructure(equipment)}) {
    const auto coarse = integrate(system, motion()), fine = integrate(system, motion(64));
    CHECK(std::abs(coarse.residual - fine.residual) < 1e-12);
    CHECK(coarse.peak == Approx(fine.peak).epsilon(1e-12));
    CHECK(coarse.peak_base_shear == Approx(fine.peak_base_shear).epsilon(1e-11));
    for (std::size_t i = 0; i < 3; ++i) {
      const double drift = view(fine.floors.drift).col(static_cast<Eigen::Index>(i)).cwiseAbs().maxCoeff();
      const double acceleration =
          view(fine.floors.acceleration).col(static_cast<Eigen::Index>(i)).cwiseAbs().maxCoeff();
      CHECK(coarse.floors.peak_drift[i] == Approx(fine.floors.peak_drift[i]).epsilon(1e-12));
      CHECK(coarse.floors.peak_acceleration[i] == Approx(fine.floors.peak_acceleration[i]).epsilon(1e-11));
      CHECK(coarse.floors.peak_shear[i] == Approx(fine.floors.peak_shear[i]).epsilon(1e-11));
      // Samples every 1.6 ms miss at most w^2 dt^2 / 8 of the peak of an oscillation, w < 41 rad/s.
      CHECK(coarse.floors.peak_drift[i] >= drift * (1 - 1e-12));
      CHECK(coarse.floors.peak_drift[i] <= drift * (1 + 6e-4));
      CHECK(coarse.floors.peak_acceleration[i] >= acceleration * (1 - 1e-12));
    }
  }
}

TEST_CASE("the energy of a structure is balanced on every mounting", "[structure][long]") {
  const auto balanced = [](const SlidingStructure& system, const GroundMotion& ground,
                           const StructureIntegrateOptions& options = {}) {
    const auto r = integrate(system, ground, options);
    CHECK(r.time_sliding > 0);
    const double scale = r.energy.initial + std::abs(r.energy.input) + r.energy.dissipated;
    CHECK(std::abs(r.energy.imbalance()) <= 1e-12 * scale);
  };
  std::vector<double> up;
  for (int m = 0; m <= 400; ++m) up.push_back(12 * std::cos(0.5 * m + 0.2));  // lifts the weight, too
  const GroundMotion lifted = motion().with_components({}, up);
  RealMatrix dashpots = building().damping();
  dashpots(0, 0) += 6;
  const Structure complex(building().mass(), dashpots, building().stiffness());
  CHECK_FALSE(complex.classical());
  Mounting stops{.natural_frequency = 1.5, .damping = 0.1, .stops = Stops(0.02, 0.7)};
  Mounting pendulum{.natural_frequency = 2, .pendulum = true};
  for (const Structure& structure : {building(), complex}) {
    for (const GroundMotion& ground : {motion(), lifted}) {
      for (const Mounting& mounting : {Mounting{}, stops, pendulum}) {
        balanced(IsolatedStructure(slider(1, mounting), structure, 1), ground);
        balanced(IsolatedStructure(slider(1, mounting), structure, 1), ground, {.velocity = 0.3});
        balanced(EquipmentOnFloor(slider(1, mounting), structure, 2, 0.3), ground);
        balanced(EquipmentOnFloor(slider(1, mounting), structure, 2), ground);
        balanced(DecoupledStructure(slider(0.5, mounting), structure, 1), ground);
      }
      const StaticKinetic higher(Coulomb(1, 1.5), 1.4, 1.6);
      balanced(IsolatedStructure(Slider<StaticKinetic<Coulomb>>(higher), structure, 1), ground);
      const VelocityDependent fast(0.5, 1.2, 20);
      balanced(IsolatedStructure(Slider<VelocityDependent>(fast, Mounting{.natural_frequency = 2}), structure, 1),
               ground);
    }
  }
}

TEST_CASE("friction that depends on speed, on a structure without mass, is that of the slider", "[structure]") {
  const Slider<VelocityDependent> one(VelocityDependent(0.5, 1.2, 20), Mounting{.natural_frequency = 2});
  const auto r = integrate(IsolatedStructure(one, Structure::from_modes({1e-14}, {5}, {0.05})), motion());
  const Response plain = integrate(one, motion());
  CHECK(furthest(r.displacement, plain.displacement) < 1e-11);
  CHECK(r.energy.dissipated == Approx(plain.energy.dissipated).epsilon(1e-11));
  const Slider<Degrading> weaker(Degrading({0, 0.3, 2}, {1.5, 0.9, 0.8}));
  const auto s = integrate(IsolatedStructure(weaker, Structure::from_modes({1e-14}, {5}, {0.05})), motion());
  CHECK(furthest(s.displacement, integrate(weaker, motion()).displacement) < 1e-11);
}

TEST_CASE("friction that changes close to rest is followed, however fast the slip was before", "[structure]") {
  // At 1000 s/m, exp(-rate v) is lost in round-off until a few milliseconds before a stop.
  const Slider<VelocityDependent> one(VelocityDependent(1.4, 2.8, 1000), Mounting{.damping = 0.2});
  const auto at = [](int m) { return 9 * std::sin(0.9 * m) + 6 * std::cos(0.37 * m); };
  const auto in_parts = [&](int parts) {
    std::vector<double> n;
    for (int m = 0; m <= 400 * parts; ++m)
      n.push_back(at(m / parts) + (at(m / parts + 1) - at(m / parts)) * (m % parts) / parts);
    return GroundMotion(n, 0.02 / parts);
  };
  for (const SlidingStructure& system : {SlidingStructure(EquipmentOnFloor(one, building(), 1, 0.02)),
                                         SlidingStructure(IsolatedStructure(one, building(), 0.4))}) {
    const StructureResponse r = integrate(system, in_parts(1));
    for (const int parts : {2, 7}) {
      const StructureResponse fine = integrate(system, in_parts(parts));
      CHECK(std::abs(fine.residual - r.residual) <= 1e-12 * r.peak);
      CHECK(fine.events.size() == r.events.size());
    }
  }
}

TEST_CASE("a weight that rises from zero under a motion of round-off ends its slips", "[structure]") {
  // The demand is the round-off of a motion that has not begun, and the level is less until the next double of time.
  const GroundMotion still(std::vector<double>(6, 0.0), 0.02);
  const GroundMotion falling = still.with_components({}, std::vector<double>{-8, -13, -24, -18, -17, 5});
  const StructureResponse r = integrate(IsolatedStructure(slider(0.3), building(), 1), falling);
  CHECK(r.peak < 1e-30);
  CHECK(r.events.size() < 10);
}

TEST_CASE("a structure in a user's own loop moves as integrated at once", "[structure]") {
  const GroundMotion ground = motion();
  const IsolatedStructure system(slider(1, Mounting{.stops = Stops(0.03, 0.5)}), building(), 1);
  const auto r = integrate(system, ground);
  StructureState state = system.rest();
  double most = 0;
  for (std::size_t i = 0; i < 100; ++i) {  // each impact multiplies round-off
    advance(system, ground.segment(i), state);
    most = std::max(most, std::abs(state.displacement - r.displacement[i + 1]));
  }
  CHECK(most < 1e-12);
  StructureState other{};
  CHECK_THROWS_WITH(advance(system, ground.segment(0), other), ContainsSubstring("3 modes, got 0 displacements"));
}

TEST_CASE("a structure settles when its modes can no longer move the interface", "[structure]") {
  std::vector<double> n;
  for (int m = 0; m <= 400; ++m) n.push_back(2 * std::sin(0.7 * m) + 1.3 * std::cos(1.9 * m + 0.4));
  n.push_back(0);
  const IsolatedStructure system(slider(0.3), Structure::from_modes({0.7}, {8}, {0.02}));
  const auto r = integrate(system, GroundMotion(n, 0.1), {.settle = true});
  // Computed at 40 digits.
  CHECK(r.settled);
  CHECK(std::abs(r.residual + 0.5624000916270817) < 1e-12);
  CHECK(std::abs(r.events[r.events.size() - 2].time - 40.922798028454106) < 1e-12);
  CHECK(std::abs(r.energy.dissipated - 2.0576569764342507) < 1e-12);
  CHECK(r.displacement.size() == 411);  // certified at sample 410
  // It stays there: two thousand further samples without ground motion.
  n.resize(2500, 0);
  CHECK(integrate(system, GroundMotion(n, 0.1)).residual == r.residual);
  // One that may not slide back holds the pull of its spring, however far it went.
  const IsolatedStructure ratchet(slider(0.3, Mounting{.natural_frequency = 3, .one_way = true}),
                                  Structure::from_modes({0.7}, {8}, {0.02}));
  const GroundMotion shaking(std::vector<double>(n.begin(), n.begin() + 402), 0.1);
  const auto held = integrate(ratchet, shaking, {.settle = true});
  CHECK(held.settled);
  CHECK(9 * held.residual > 3 * 0.3);  // the pull exceeds the friction
  CHECK(integrate(ratchet, GroundMotion(n, 0.1)).residual == held.residual);
  const SweepTable table = sweep(std::vector{ratchet}, {shaking}, {.settle = true});
  CHECK(table.residual[0] == Approx(held.residual).epsilon(1e-12));
  // An undamped structure may move it again at any time.
  const IsolatedStructure undamped(slider(0.01), Structure::from_modes({0.7}, {8}, {0.0}));
  const auto never_at_rest = [&] { return integrate(undamped, GroundMotion({2, -2, 0}, 0.1), {.settle = false}); };
  CHECK_FALSE(never_at_rest().settled);
}

TEST_CASE("a flexible slope", "[structure]") {
  const GroundMotion ground = motion();
  FlexibleSlope slope{.ky_g = 0.05, .height = 50, .shear_velocity = 600, .damping_ratio = 0.05};
  SECTION("is a column on a base") {
    const double w = std::numbers::pi * 600 / 100, fraction = 8 / (std::numbers::pi * std::numbers::pi);
    const Slider<Coulomb> one_way(Coulomb(0.05 * standard_gravity, std::numeric_limits<double>::infinity()));
    const Structure column = Structure::from_modes({fraction}, {w}, {0.05});
    CHECK(integrate(slope, ground, {}).displacement ==
          integrate(IsolatedStructure(one_way, column), ground).displacement);
    slope.method = SlopeMethod::decoupled;
    CHECK(integrate(slope, ground, {}).displacement ==
          integrate(DecoupledStructure(one_way, column), ground).displacement);
  }
  SECTION("of many modes slides with multiples of twice its frequency") {
    slope.modes = 10;
    const auto system = sliding_structure(slope, properties(slope, ground));
    // One mode gives 2.2976 w_1, ten 2.00014; the fastest is about 2.4 times the number of modes.
    CHECK(system.interface_mass() == Approx(2 / (std::numbers::pi * std::numbers::pi * 10)).epsilon(0.01));
    CHECK(system.fastest() / (std::numbers::pi * 6) == Approx(24).epsilon(0.05));
  }
  SECTION("that is stiff is a rigid block") {
    slope.shear_velocity = 1e5;
    const Slider<Coulomb> block(Coulomb(0.05 * standard_gravity, std::numeric_limits<double>::infinity()));
    const double rigid = integrate(block, ground, {.settle = true}).residual;
    CHECK(integrate(slope, ground).residual == Approx(rigid).epsilon(1e-2));
  }
  SECTION("on compliant rock") {
    CHECK(radiation_damping(2000, 500) == Approx(0.55016 * std::pow(4, -0.9904)).epsilon(1e-15));
    CHECK(radiation_damping(500, 500) == 0.2);
    slope.rock_velocity = 2000;
    CHECK(properties(slope, ground).damping_ratio ==
          Approx(0.05 + 0.55016 * std::pow(2000.0 / 600, -0.9904)).epsilon(1e-15));
  }
  SECTION("of soil is a fixed point of the equivalent-linear iteration") {
    slope.damping_ratio = 0;
    slope.soil = HyperbolicSoil(1e-3);
    const SlopeProperties found = properties(slope, ground);
    CHECK(found.iterations > 1);
    CHECK(found.shear_velocity == Approx(600 * std::sqrt(1 / (1 + found.strain / 1e-3))).epsilon(1e-12));
    FlexibleSlope linear{
        .ky_g = 1e90, .height = 50, .shear_velocity = found.shear_velocity, .damping_ratio = found.damping_ratio};
    const auto stuck = integrate(linear, ground, {});
    CHECK(0.65 * std::numbers::pi / 2 * stuck.floors.peak_drift[0] / 50 == Approx(found.strain).epsilon(1e-11));
    CHECK(HyperbolicSoil(1e-3).damping_ratio(0) == 0.01);
    // (4/pi) 2 (1 - ln 2) - 2/pi at the reference strain
    CHECK(HyperbolicSoil(1e-3).damping_ratio(1e-3) ==
          Approx(0.01 + 0.62 * std::pow(0.5, 0.1) * (8 / std::numbers::pi * (1 - std::log(2)) - 2 / std::numbers::pi))
              .epsilon(1e-14));
    // The series and the formula meet.
    CHECK(HyperbolicSoil(1).damping_ratio(0.01 * (1 - 1e-9)) ==
          Approx(HyperbolicSoil(1).damping_ratio(0.01 * (1 + 1e-9))).epsilon(1e-8));
  }
}

TEST_CASE("structures refuse bad input by name", "[structure]") {
  const auto square = [](double a, double b, double c, double d) { return RealMatrix{{a, b}, {c, d}}; };
  const RealMatrix one = square(1, 0, 0, 1), skew = square(1, 0, 0.5, 1), negative = square(1, 0, 0, -2),
                   singular = square(1, 0, 0, 0);
  const auto made = [](const RealMatrix& m, const RealMatrix& c, const RealMatrix& k) { return Structure(m, c, k); };
  CHECK_THROWS_WITH(made(skew, one, one), ContainsSubstring("mass must be symmetric, got mass[1, 0] = 0.5"));
  CHECK_THROWS_WITH(made(singular, one, one),
                    ContainsSubstring("mass must be positive definite, got a smallest eigenvalue of 0"));
  CHECK_THROWS_WITH(made(one, negative, one),
                    ContainsSubstring("damping must be positive semidefinite, got a smallest eigenvalue of -2"));
  CHECK_THROWS_WITH(made(one, one, negative), ContainsSubstring("stiffness must be positive semidefinite"));
  CHECK_THROWS_WITH(made(one, one, RealMatrix(2, 2)), ContainsSubstring("must have a stiffness"));
  CHECK_THROWS_WITH(made(square(1, 0, 0, 1e-20), one, one),
                    ContainsSubstring("the frequency of mode 1 is lost in the round-off of the fastest one, 1e+10"));
  CHECK_THROWS_AS(made(square(1, 0, 0, 1e-320), one, one), std::overflow_error);
  CHECK_THROWS_WITH(integrate(FlexibleSlope{.ky_g = 0.1, .height = 9, .shear_velocity = 99, .modes = 1001}, motion()),
                    ContainsSubstring("modes must be from 1 to 1000, got 1001"));
  CHECK_THROWS_WITH(made(one, Eigen::MatrixXd::Identity(3, 3), one),
                    ContainsSubstring("damping must be 2 by 2, as the mass matrix, got 3 by 3"));
  CHECK_THROWS_WITH(Structure::shear_building({1, -1}, {1, 1}, 0.05),
                    ContainsSubstring("masses[1] must be finite and more than 0, got -1 kg"));
  CHECK_THROWS_WITH(Structure::shear_building({1, 1}, {1}, 0.05),
                    ContainsSubstring("stiffnesses must have 2 entries, got 1"));
  CHECK_THROWS_WITH(Structure::from_modes({0.6, 0.4}, {1, 2}, {0, 0}),
                    ContainsSubstring("must be less than 1, because the rest is the base, got 1"));
  CHECK_THROWS_WITH(EquipmentOnFloor(slider(), building(), 4), ContainsSubstring("floor must be from 1 to 3, got 4"));
  CHECK_THROWS_WITH(EquipmentOnFloor(slider(), building(), 1, -1),
                    ContainsSubstring("mass must be finite and at least 0, got -1 kg"));
  CHECK_THROWS_WITH(IsolatedStructure(slider(), building(), 0),
                    ContainsSubstring("IsolatedStructure: base_mass must be positive and finite, got 0 kg"));
  CHECK_THROWS_WITH(IsolatedStructure(slider(), building()),
                    ContainsSubstring("IsolatedStructure: a structure with matrices needs a base_mass [kg], got none"));
  CHECK_THROWS_WITH(
      IsolatedStructure(slider(3, Mounting{.slope_degrees = 10}), building(), 1),
      ContainsSubstring("IsolatedStructure: must slide on level ground, got a slider on a slope of 10 degrees"));
  const IsolatedStructure system(slider(1, Mounting{.stops = Stops(0.1, 0)}), building(), 1);
  CHECK_THROWS_WITH(integrate(system, motion(), {.displacement = 0.2}), ContainsSubstring("between the stops"));
  CHECK_THROWS_WITH(integrate(FlexibleSlope{.ky_g = 0.1, .height = 0, .shear_velocity = 1}, motion()),
                    ContainsSubstring("height must be positive and finite, got 0 m"));
}

TEST_CASE("the level of a flexible slope may change with the distance", "[structure]") {
  FlexibleSlope constant{.ky_g = 0.05, .height = 50, .shear_velocity = 600, .damping_ratio = 0.1, .modes = 2};
  FlexibleSlope degrading = constant;
  degrading.ky_g = 0;
  const double level = constant.ky_g * standard_gravity;
  degrading.degrading = Degrading({0, 0.1}, {level, level});
  for (const SlopeMethod method : {SlopeMethod::coupled, SlopeMethod::decoupled}) {
    constant.method = degrading.method = method;
    const StructureResponse one = integrate(constant, motion()), other = integrate(degrading, motion());
    CHECK(furthest(one.displacement, other.displacement) < 1e-12 * one.residual);
    CHECK(other.sliding_distance == Approx(other.residual).epsilon(1e-12));
  }
  // A stiff column is a rigid block with the same law; softening makes it slide further.
  FlexibleSlope stiff = degrading;
  stiff.shear_velocity = 3e4;
  stiff.method = SlopeMethod::decoupled;
  stiff.degrading = Degrading({0, 0.3}, {level, level / 2});
  const auto rigid = [](const auto& law) {
    return integrate(Slider(law, Mounting{.one_way = true}), motion(), {.settle = true}).residual;
  };
  CHECK(integrate(stiff, motion()).residual == Approx(rigid(*stiff.degrading)).epsilon(0.01));
  CHECK(rigid(*stiff.degrading) > 1.1 * rigid(Coulomb(level)));
  stiff.ky_g = 0.1;
  CHECK_THROWS_WITH(integrate(stiff, motion()), ContainsSubstring("with a Degrading law, ky_g must be left out"));
}

TEST_CASE("a structure that is too fast for the time step is refused before it is integrated", "[structure]") {
  const IsolatedStructure system(slider(), building(), 1);
  const auto at = [&](double times) {
    const double step = times * SlidingStructure::most_rate_per_step / system.fastest();
    return GroundMotion({0, 2, -2}, step);
  };
  CHECK(std::isfinite(integrate(system, at(0.999)).peak));
  CHECK_THROWS_AS(integrate(system, at(1.001)), std::invalid_argument);
  CHECK_THROWS_WITH(integrate(IsolatedStructure(slider(), building(), 1e-12), motion()),
                    ContainsSubstring("its fastest rate, ") && ContainsSubstring(" rad/s, times 0.1 s is ") &&
                        ContainsSubstring("more than 10000; give the base more mass") &&
                        ContainsSubstring("or take a smaller time step"));
  // What counts is the mean step: a long one among short ones is affordable.
  const double fastest = system.fastest(), most = SlidingStructure::most_rate_per_step;
  std::vector<double> n, times;
  for (int i = 0; i < 100; ++i) n.push_back(i % 2), times.push_back(0.01 * i + (i == 99 ? 2 * most / fastest : 0));
  CHECK(std::isfinite(integrate(system, GroundMotion(n, times)).peak));

  const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(2, 2);
  const Structure damped(one, 1e12 * one, one);
  const std::vector<IsolatedStructure> extreme{
      IsolatedStructure(slider(), building(), 1e-12),
      IsolatedStructure(slider(1, Mounting{.natural_frequency = 1e9}), building(), 1),
      IsolatedStructure(slider(1, Mounting{.damping = 1e9}), building(), 1),
      IsolatedStructure(slider(), damped, 1),
  };
  for (const IsolatedStructure& each : extreme) {
    CHECK_THROWS_WITH(integrate(each, motion()), ContainsSubstring("too fast for the time step"));
    StructureState state = each.rest();
    CHECK_THROWS_WITH(advance(each, motion().segment(0), state), ContainsSubstring("too fast for the time step"));
  }
  CHECK_THROWS_WITH(floor_motions(damped, motion()), ContainsSubstring("too fast for the time step"));
  const FlexibleSlope slope{.ky_g = 0.1, .height = 1e-6, .shear_velocity = 600, .damping_ratio = 0.05};
  CHECK_THROWS_WITH(integrate(slope, motion()), ContainsSubstring("too fast for the time step"));
}

TEST_CASE("degrees of freedom that are not floors have no drifts", "[structure]") {
  const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(2, 2);
  const Structure turned(one, 0.5 * one, 100 * one, {1, 0.5});
  for (const SlidingStructure& system : {SlidingStructure(IsolatedStructure(slider(), turned, 1)),
                                         SlidingStructure(EquipmentOnFloor(slider(), turned, 2))}) {
    const Floors floors = integrate(system, motion()).floors;
    CHECK(floors.displacement.cols() == 2);
    CHECK(floors.peak_acceleration.size() == 2);
    CHECK(floors.drift.cols() == 0);
    CHECK(floors.peak_drift.size() == 0);
    CHECK(floors.shear.cols() == 0);
  }
}
