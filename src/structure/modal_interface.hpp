// A linear structure with one sliding interface, in modal coordinates.
#pragma once

#include <complex>
#include <utility>
#include <vector>

#include "stickslip/slider/spring.hpp"
#include "stickslip/slider/stops.hpp"
#include "stickslip/structure/response.hpp"
#include "structure/eigen.hpp"

namespace stickslip::detail {

/// Modes y, interface displacement x, and per reference mass
///     q   = demand.r - ground_demand n - spring x,          r = w^2 y + D y'            (force that the bond carries)
///     mass x'' = q - damper x' - s F while it slides in the direction s, else x'' = 0
///     y'' = -r + reaction (demand.r) - load n - jump x''.
/// A change of x' at an impact changes y' by -jump times that change. The same equations hold for a structure on a
/// sliding base, for a slider on a floor with and without feedback, and for a slider that is driven by a structure.
struct ModalInterface {
  Eigen::VectorXd stiffness;  // w^2 [1/s^2]
  Eigen::MatrixXd damping;    // D [1/s]
  bool classical = true;      // whether D is diagonal
  Eigen::VectorXd demand, load, reaction, jump;
  double ground_demand = 1;
  double mass = 1;
  Spring spring{};
  double damper = 0;  // [1/s]
  Stops stops{};
  bool one_way = false;

  // Energy per reference mass: v^2 / 2 + v coupling.y' + own (coupling.y')^2 / 2 + modal_mass |y'|^2 / 2, and the same
  // for the springs. The ground does the work -n (input_base v + input.y') in a unit of time.
  Eigen::VectorXd coupling, input;
  double modal_mass = 0, own = 0, input_base = 1;
  bool driven = false;  // the structure does not feel the slider; the energy is that of the slider alone

  // Floors: displacements shapes y; absolute accelerations shapes y'' + influence (n + rides x'').
  Eigen::MatrixXd shapes{};
  Eigen::VectorXd influence{};
  bool rides = true;
  // Forces of inertia, those of a slider on a floor among them: floor_mass times the absolute accelerations of the
  // floors (empty if unknown) plus slider_mass x''; in total base_shear.y'' + base_shear_of_base (n + rides x'') plus
  // the same.
  Eigen::MatrixXd floor_mass{};
  Eigen::Index slider_floor = 0;
  double slider_mass = 0;
  Eigen::VectorXd base_shear{};
  double base_shear_of_base = 0;

  double fastest = 0;  // largest magnitude of an eigenvalue of the stuck and of the sliding motion [1/s]

  Eigen::Index modes() const noexcept { return stiffness.size(); }
  double force_of_modes(const StructureState& state) const;  // demand.r [m/s^2]
  double demand_of(const StructureState& state, double ground, double weight) const {
    return force_of_modes(state) - ground_demand * ground - spring.under(weight) * state.displacement;
  }
  double size_of_force(const StructureState& state) const;  // the same with the magnitude of each term
};

/// Kinetic and elastic energy per reference mass [m^2/s^2].
std::pair<double, double> energy_of(const ModalInterface& of, const StructureState& state);

/// Matrix of the motion z' = A z without loads, z = (x, v, y, y') while it slides, (y, y') while it is stuck.
Eigen::MatrixXd flow_matrix(const ModalInterface& of, bool sliding);

/// Sets `fastest`; of more than 80 modes to some 1e-4.
void set_fastest(ModalInterface& of);

/// The largest part of the demand, beside the pull of the spring, that can still occur while the interface remains
/// stuck without ground motion: the amplitudes of all modes, which only shrink. Of more than 80 modes that feel each
/// other, in n^2 operations instead of n^3: by the energy of their rates, which only falls.
class StuckBound {
 public:
  explicit StuckBound(const ModalInterface& of);
  double operator()(const StructureState& state) const { return after(state, 0); }
  /// The same when it has been stuck for some time [s].
  double after(const StructureState& state, double time) const;

 private:
  double by_energy(const StructureState& state) const;

  // Of a mode that does not feel the others: the roots of its equation, their distance, and the demand of y and y'.
  struct Pair {
    std::complex<double> first, second, apart;
    double of_place, of_rate;
  };
  std::vector<Pair> pairs_{};
  Eigen::Index modes_;
  std::vector<Eigen::Index> kept_;   // components of (y, y') that act
  Eigen::MatrixXcd left_;            // amplitudes of the eigenvectors from (y, y')
  Eigen::VectorXd weights_, rates_;  // |demand| of each, and its growth [1/s]
  const ModalInterface* of_many_ = nullptr;
};

}  // namespace stickslip::detail
