// Structures on a sliding base against CVODE with its own root finding, in physical coordinates.
#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include "stickslip/core.hpp"
#include "stickslip/structure/isolated_structure.hpp"
#include "structure/eigen.hpp"
#include "support/catch.hpp"

using namespace stickslip;

namespace {

/// A building on a base with friction a, by CVODE. State: x, x', displacements relative to the base, their rates.
class BuildingByCvode {
 public:
  BuildingByCvode(const Structure& building, double base_mass, double level)
      : of_(building),
        base_(base_mass),
        total_(base_mass + detail::view(building.mass()).sum()),
        level_(level),
        n_(building.size()) {
    const Eigen::VectorXd ones = Eigen::VectorXd::Ones(n_);
    const auto mass = detail::view(of_.mass());
    solver_.compute(mass);
    // M (u'' + 1 x'') = -C u' - K u - M 1 n, and the sum of all inertia forces is that of friction.
    Eigen::MatrixXd whole(n_ + 1, n_ + 1);
    whole(0, 0) = total_;
    whole.block(0, 1, 1, n_) = (mass * ones).transpose();
    whole.block(1, 0, n_, 1) = mass * ones;
    whole.block(1, 1, n_, n_) = mass;
    whole_.compute(whole);
    SUNContext_Create(0, &context_);
    y_ = N_VNew_Serial(2 * n_ + 2, context_);
    N_VConst(0, y_);
    memory_ = CVodeCreate(CV_ADAMS, context_);
    CVodeInit(memory_, &right_side, 0, y_);
    CVodeSStolerances(memory_, 1e-13, 1e-15);
    CVodeSetUserData(memory_, this);
    fixed_point_ = SUNNonlinSol_FixedPoint(y_, 0, context_);
    CVodeSetNonlinearSolver(memory_, fixed_point_);
    CVodeRootInit(memory_, 1, &event);
    CVodeSetMaxNumSteps(memory_, 100000);
  }
  ~BuildingByCvode() {
    CVodeFree(&memory_);
    SUNNonlinSolFree(fixed_point_);
    N_VDestroy(y_);
    SUNContext_Free(&context_);
  }
  BuildingByCvode(const BuildingByCvode&) = delete;
  BuildingByCvode& operator=(const BuildingByCvode&) = delete;

  void over(double begin, double end, double n_begin, double n_end) {
    begin_ = begin, end_ = end, n_begin_ = n_begin, n_end_ = n_end;
    double time = begin;
    while (time < end) {
      CVodeReInit(memory_, time, y_);
      CVodeSetStopTime(memory_, end);
      const int flag = CVode(memory_, end, y_, &time, CV_NORMAL);
      REQUIRE(flag >= 0);
      if (flag != CV_ROOT_RETURN) break;
      double* y = N_VGetArrayPointer(y_);
      if (mode_ == 0) {
        mode_ = demand(time, y) > 0 ? 1 : -1;
        ++breakaways;
      } else {
        y[1] = 0;
        const double q = demand(time, y);
        mode_ = std::abs(q) <= level_ ? 0 : q > 0 ? 1 : -1;
        mode_ == 0 ? ++arrests : ++reversals;
      }
    }
  }
  double displacement() const { return N_VGetArrayPointer(y_)[0]; }
  double velocity() const { return N_VGetArrayPointer(y_)[1]; }
  double floor(Eigen::Index i) const { return N_VGetArrayPointer(y_)[2 + i]; }

  int breakaways = 0, arrests = 0, reversals = 0;

 private:
  using Vector = Eigen::Map<const Eigen::VectorXd>;
  double ground(double t) const { return n_begin_ + (n_end_ - n_begin_) * (t - begin_) / (end_ - begin_); }
  Eigen::VectorXd forces(const double* y) const {
    return -detail::view(of_.damping()) * Vector(y + 2 + n_, n_) - detail::view(of_.stiffness()) * Vector(y + 2, n_);
  }
  // Force of inertia of all masses, which friction carries while it sticks, per total mass.
  double demand(double t, const double* y) const {
    const Eigen::VectorXd absolute = solver_.solve(forces(y));
    return -(base_ * ground(t) + (detail::view(of_.mass()) * absolute).sum()) / total_;
  }
  static int right_side(double t, N_Vector y_vector, N_Vector slope_vector, void* user) {
    const auto& self = *static_cast<BuildingByCvode*>(user);
    const double* y = N_VGetArrayPointer(y_vector);
    double* slope = N_VGetArrayPointer(slope_vector);
    const Eigen::Index n = self.n_;
    const Eigen::VectorXd force = self.forces(y), mass_ones = detail::view(self.of_.mass()) * Eigen::VectorXd::Ones(n);
    Eigen::VectorXd u;
    double x = 0;
    if (self.mode_ == 0) {
      u = self.solver_.solve(force - mass_ones * self.ground(t));
    } else {
      Eigen::VectorXd load(n + 1);
      load[0] = -self.total_ * (self.ground(t) + self.mode_ * self.level_);
      load.tail(n) = force - mass_ones * self.ground(t);
      const Eigen::VectorXd both = self.whole_.solve(load);
      x = both[0];
      u = both.tail(n);
    }
    slope[0] = self.mode_ == 0 ? 0 : y[1];
    slope[1] = x;
    for (Eigen::Index i = 0; i < n; ++i) {
      slope[2 + i] = y[2 + n + i];
      slope[2 + n + i] = u[i];
    }
    return 0;
  }
  static int event(double t, N_Vector y_vector, double* out, void* user) {
    const auto& self = *static_cast<BuildingByCvode*>(user);
    const double* y = N_VGetArrayPointer(y_vector);
    out[0] = self.mode_ == 0 ? self.level_ - std::abs(self.demand(t, y)) : self.mode_ * y[1];
    return 0;
  }

  const Structure& of_;
  double base_, total_, level_;
  Eigen::Index n_;
  Eigen::LDLT<Eigen::MatrixXd> solver_{}, whole_{};
  SUNContext context_ = nullptr;
  N_Vector y_ = nullptr;
  void* memory_ = nullptr;
  SUNNonlinearSolver fixed_point_ = nullptr;
  int mode_ = 0;
  double begin_ = 0, end_ = 0, n_begin_ = 0, n_end_ = 0;
};

}  // namespace

TEST_CASE("CVODE with events finds the same motion of a building on a sliding base", "[structure][long]") {
  std::vector<double> n;
  for (int m = 0; m <= 200; ++m) n.push_back(2 * std::sin(0.7 * m) + 1.3 * std::cos(1.9 * m + 0.4));
  const GroundMotion motion(n, 0.1);
  const Eigen::Vector3d masses(1, 1, 0.8), stiffnesses(600, 500, 400);
  const Structure plain = Structure::shear_building(masses, stiffnesses, Rayleigh{0.1, 0.002});
  RealMatrix dashpots = plain.damping();
  dashpots(0, 0) += 6;  // below the first floor: the modes are complex
  const Structure complex(plain.mass(), dashpots, plain.stiffness());
  for (const Structure& building : {plain, complex}) {
    const StructureResponse r = integrate(IsolatedStructure(Slider<Coulomb>(Coulomb(1)), building, 1), motion);
    BuildingByCvode other(building, 1, 1);
    double worst = 0;
    for (std::size_t i = 0; i + 1 < n.size(); ++i) {
      other.over(motion.time(i), motion.time(i + 1), n[i], n[i + 1]);
      const auto sample = static_cast<Eigen::Index>(i + 1);
      worst = std::max(worst, std::abs(other.displacement() - r.displacement[i + 1]));
      worst = std::max(worst, std::abs(other.velocity() - r.velocity[i + 1]));
      for (Eigen::Index k = 0; k < 3; ++k)
        worst = std::max(worst, std::abs(other.floor(k) - r.floors.displacement(sample, k)));
    }
    // Local errors of 1e-13 of the velocities, of order 0.5 m/s, over some 200 events.
    CHECK(worst < 1e-9);
    int breakaways = 0, arrests = 0, reversals = 0;
    for (const Event& event : r.events) {
      breakaways += event.kind == EventKind::breakaway;
      arrests += event.kind == EventKind::arrest;
      reversals += event.kind == EventKind::reversal;
    }
    CHECK(breakaways == other.breakaways);
    CHECK(arrests == other.arrests);
    CHECK(reversals == other.reversals);
    UNSCOPED_INFO(worst);
  }
}
