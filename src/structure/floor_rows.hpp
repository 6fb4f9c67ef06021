// The quantities of the floors of a structure, as rows.
#pragma once

#include <Eigen/Core>

#include "structure/modal_interface.hpp"

namespace stickslip::detail {

/// The quantities of the floors, each of which is a row times the modes.
struct FloorRows {
  explicit FloorRows(const ModalInterface& of);

  /// All of them, and the acceleration of the base last, as rows times (y, y', [x, x',] n, [s F]): see LinearStep.
  Eigen::MatrixXd of_state(const ModalInterface& of, bool sliding) const;

  // Of the modal accelerations, plus `with_base` times the acceleration of the base and `with_slider` times x'':
  // floors, stories (if the masses are known by floor), and the base shear last.
  Eigen::MatrixXd forces;
  Eigen::VectorXd with_base, with_slider;
  Eigen::MatrixXd drifts;  // of the modal displacements
  Eigen::Index floors, stories;
};

}  // namespace stickslip::detail
