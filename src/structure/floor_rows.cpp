#include "structure/floor_rows.hpp"

namespace stickslip::detail {

FloorRows::FloorRows(const ModalInterface& of) : floors(of.shapes.rows()), stories(of.floor_mass.rows()) {
  const Eigen::Index n = of.modes();
  forces = Eigen::MatrixXd::Zero(floors + stories + 1, n);
  with_base = with_slider = Eigen::VectorXd::Zero(floors + stories + 1);
  forces.topRows(floors) = of.shapes;
  with_base.head(floors) = of.influence;
  if (stories > 0) {
    Eigen::MatrixXd inertia = of.floor_mass * of.shapes;
    Eigen::VectorXd with = of.floor_mass * of.influence;
    for (Eigen::Index i = stories - 2; i >= 0; --i) {
      inertia.row(i) += inertia.row(i + 1);
      with[i] += with[i + 1];
    }
    forces.middleRows(floors, stories) = inertia;
    with_base.segment(floors, stories) = with;
    with_slider.segment(floors, of.slider_floor + 1).setConstant(of.slider_mass);
  }
  forces.row(floors + stories) = of.base_shear.transpose();
  with_base[floors + stories] = of.base_shear_of_base;
  with_slider[floors + stories] = of.slider_mass;
  // Only where floors move with the base is one above another.
  drifts = (of.influence.array() == 1).all() ? of.shapes : Eigen::MatrixXd(0, n);
  for (Eigen::Index i = drifts.rows() - 1; i > 0; --i) drifts.row(i) -= of.shapes.row(i - 1);
}

Eigen::MatrixXd FloorRows::of_state(const ModalInterface& of, bool sliding) const {
  using Eigen::Index;
  const Index n = of.modes(), m = 2 * n + (sliding ? 2 : 0);
  Eigen::MatrixXd springs = Eigen::MatrixXd::Zero(n, m + (sliding ? 2 : 1));  // r = w^2 y + D y'
  springs.leftCols(n) = of.stiffness.asDiagonal();
  springs.middleCols(n, n) = of.damping;
  const Eigen::RowVectorXd demand = of.demand.transpose() * springs;
  Eigen::RowVectorXd slider = Eigen::RowVectorXd::Zero(springs.cols());  // x''
  if (sliding) {
    slider = demand / of.mass;
    slider[2 * n] = -of.spring.stiffness / of.mass;
    slider[2 * n + 1] = -of.damper / of.mass;
    slider[m] = -of.ground_demand / of.mass;
    slider[m + 1] = -1 / of.mass;
  }
  Eigen::RowVectorXd base = Eigen::RowVectorXd::Unit(springs.cols(), m);
  if (of.rides) base += slider;
  Eigen::MatrixXd accelerations = of.reaction * demand - springs - of.jump * slider;
  accelerations.col(m) -= of.load;
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(forces.rows() + drifts.rows() + 1, springs.cols());
  all.topRows(forces.rows()) = forces * accelerations + with_base * base + with_slider * slider;
  all.block(forces.rows(), 0, drifts.rows(), n) = drifts;
  all.bottomRows(1) = base;
  return all;
}

}  // namespace stickslip::detail
