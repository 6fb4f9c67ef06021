// A linear structure, and its modes on a fixed base.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "stickslip/structure/matrix.hpp"

namespace stickslip {

/// Rayleigh damping, C = alpha M + beta K.
struct Rayleigh {
  double alpha = 0;  ///< [1/s], finite and at least 0
  double beta = 0;   ///< [s], finite and at least 0
};

/// The modes of a structure on a fixed base, in order of frequency.
struct Modes {
  std::vector<double> frequencies;     ///< w_j [rad/s]; 0 for a rigid-body mode
  std::vector<double> damping_ratios;  ///< diagonal of the modal damping, divided by 2 w_j; infinite where w_j = 0
  std::vector<double> participation;   ///< shape' M influence; with `from_modes`, the square root of the mass fraction
  std::vector<double> effective_masses;  ///< participation squared [kg]; with `from_modes`, the mass fractions
  /// One column per mode and one row per degree of freedom, shape' M shape = 1; empty if `from_modes` was given none.
  RealMatrix shapes;
};

/// A linear structure on a base that moves with acceleration n,
///     M u'' + C u' + K u = -M influence n,
/// u the displacements relative to the base [m]. It holds its modes on a fixed base, in which its motion is computed.
/// Immutable; copies share their data.
class Structure {
 public:
  /// @param mass       M [kg], symmetric and positive definite
  /// @param damping    C [N s/m], symmetric and positive semidefinite; it need not be diagonal in the modes
  /// @param stiffness  K [N/m], symmetric and positive semidefinite, not zero
  /// @throws std::invalid_argument  naming the matrix and the entry or the eigenvalue
  Structure(const RealMatrix& mass, const RealMatrix& damping, const RealMatrix& stiffness);

  /// The same with another influence than ones.
  /// @param influence  displacements under a unit displacement of the base
  Structure(const RealMatrix& mass, const RealMatrix& damping, const RealMatrix& stiffness,
            const RealVector& influence);

  /// A building of rigid floors, counted from the bottom; stiffness i is that of the story below floor i.
  /// @param masses       of the floors [kg], positive and finite
  /// @param stiffnesses  of the stories [N/m], as many, positive and finite
  /// @throws std::invalid_argument  naming the entry
  static Structure shear_building(const RealVector& masses, const RealVector& stiffnesses, const Rayleigh& damping);

  /// The same with one damping ratio for all modes.
  /// @param damping_ratio  finite and at least 0
  static Structure shear_building(const RealVector& masses, const RealVector& stiffnesses, double damping_ratio);

  /// A structure that is known by some of its modes. Each mode y_j is that of a single oscillator,
  ///     y_j'' + 2 z_j w_j y_j' + w_j^2 y_j = -n,
  /// with a fraction of the mass of base and structure; what the fractions leave is the mass that moves with the base.
  /// @param mass_fractions  positive; their sum is less than 1
  /// @param frequencies     w_j [rad/s], positive and finite
  /// @param damping_ratios  z_j, finite and at least 0
  /// @throws std::invalid_argument  naming the entry
  static Structure from_modes(const RealVector& mass_fractions, const RealVector& frequencies,
                              const RealVector& damping_ratios);

  /// The same with the shapes of the modes.
  /// @param shapes  one row per floor and one column per mode: the displacements of the floors are shapes y. With all
  ///                modes, each row has the sum 1
  static Structure from_modes(const RealVector& mass_fractions, const RealVector& frequencies,
                              const RealVector& damping_ratios, const RealMatrix& shapes);

  std::ptrdiff_t size() const noexcept;    ///< number of modes
  std::ptrdiff_t floors() const noexcept;  ///< number of degrees of freedom; 0 if `from_modes` was given no shapes
  bool has_matrices() const noexcept;      ///< whether it is not made by `from_modes`

  const RealMatrix& mass() const noexcept;                ///< M [kg]; empty without matrices
  const RealMatrix& damping() const noexcept;             ///< C [N s/m]
  const RealMatrix& stiffness() const noexcept;           ///< K [N/m]
  const std::vector<double>& influence() const noexcept;  ///< ones with `from_modes`
  bool uniform_influence() const noexcept;                ///< whether `influence` is ones

  const Modes& modes() const noexcept;
  /// shapes' C shapes, per unit modal mass [1/s].
  const RealMatrix& modal_damping() const noexcept;
  /// The shapes that `from_modes` was given; empty otherwise.
  const RealMatrix& unit_shapes() const noexcept;
  /// Whether `modal_damping` is diagonal, up to round-off.
  bool classical() const noexcept;

  bool operator==(const Structure& other) const;

 private:
  struct Data;
  explicit Structure(std::shared_ptr<const Data> data);
  static std::shared_ptr<Data> data_of_modes(const std::vector<double>& mass_fractions,
                                             const std::vector<double>& frequencies,
                                             const std::vector<double>& damping_ratios);
  std::shared_ptr<const Data> data_;
};

}  // namespace stickslip
