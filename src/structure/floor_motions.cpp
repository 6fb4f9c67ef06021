#include "stickslip/structure/floor_motions.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>

#include "stickslip/base/error.hpp"
#include "stickslip/friction/coulomb.hpp"
#include "stickslip/structure/equipment_on_floor.hpp"
#include "structure/expansion.hpp"
#include "structure/modal_interface.hpp"
#include "structure/stuck_flow.hpp"

namespace stickslip {
namespace {

using Eigen::Index;

// The modes of a structure that nothing slides on.
class Driven {
 public:
  Driven(const Structure& structure, const GroundMotion& motion)
      : of_(EquipmentOnFloor(Slider<Coulomb>(Coulomb(1)), structure, 1).modal()),
        expansion_(of_, detail::mean_step(motion)) {
    if (detail::StuckFlow::covers(of_, motion.dt())) flow_.emplace(of_, motion.dt());
    state_.setZero(2 * of_.modes());
  }

  const detail::ModalInterface& modal() const noexcept { return of_; }
  auto displacement() const { return state_.head(of_.modes()); }
  auto velocity() const { return state_.tail(of_.modes()); }

  void advance(const Segment& segment) {
    if (flow_) {
      flow_->each_part(segment.start, segment.end,
                       [&](double n, double change) { flow_->advance(state_.data(), n, change); });
      return;
    }
    if (!(segment.duration > 0)) return;
    const detail::GroundLoad load{segment.duration, segment.start, segment.end};
    const double steps = std::max(std::ceil(segment.duration / expansion_.longest()), 1.0);
    StructureState state{.modal_displacement = detail::values(displacement()),
                         .modal_velocity = detail::values(velocity())};
    for (double left = steps; left > 0; --left) {
      expansion_.expand(state, load, segment.duration * (left / steps), segment.duration / steps, 0, Coulomb(1));
      expansion_.end(state);
    }
    state_ << detail::view(state.modal_displacement), detail::view(state.modal_velocity);
  }

 private:
  detail::ModalInterface of_;
  detail::Expansion expansion_;
  std::optional<detail::StuckFlow> flow_{};
  Eigen::VectorXd state_{};
};

// The absolute accelerations of the floors at the samples, a column for each floor.
Eigen::MatrixXd accelerations_of(const Structure& structure, const GroundMotion& motion) {
  Driven driven(structure, motion);
  const detail::ModalInterface& of = driven.modal();
  // The part of the ground acceleration that the modes do not bring to a floor; with all modes, none.
  Eigen::VectorXd direct = detail::view(structure.influence()) - of.shapes * of.load;
  if (structure.has_matrices()) direct.setZero();
  const auto samples = static_cast<Index>(motion.samples());
  Eigen::MatrixXd accelerations(samples, structure.floors());
  Eigen::VectorXd force(of.modes());
  const auto keep = [&](Index sample, double n) {
    force = of.stiffness.cwiseProduct(driven.displacement());
    if (of.classical)
      force += of.damping.diagonal().cwiseProduct(driven.velocity());
    else
      force += of.damping * driven.velocity();
    accelerations.row(sample) = (direct * n - of.shapes * force).transpose();
  };
  for (Index i = 0; i + 1 < samples; ++i) {
    const Segment segment = motion.segment(static_cast<std::size_t>(i));
    keep(i, segment.start);
    driven.advance(segment);
    if (i + 2 == samples) keep(i + 1, segment.end);
  }
  if (!accelerations.allFinite() || accelerations.cwiseAbs().maxCoeff() > GroundMotion::max_acceleration)
    throw std::overflow_error("floor_motions: the accelerations of the floors exceed 1e100 m/s^2");
  return accelerations;
}

// The motion with each segment in equal parts.
std::vector<double> divided(std::span<const double> values, int parts, Interpolation interpolation) {
  std::vector<double> result;
  result.reserve((values.size() - 1) * static_cast<std::size_t>(parts) + 1);
  for (std::size_t i = 0; i + 1 < values.size(); ++i)
    for (int k = 0; k < parts; ++k) {
      const double part = interpolation == Interpolation::linear ? static_cast<double>(k) / parts : 0;
      result.push_back(values[i] + part * (values[i + 1] - values[i]));
    }
  result.push_back(values.back());
  return result;
}

GroundMotion divided(const GroundMotion& motion, int parts) {
  const auto of = [&](std::span<const double> values) {
    return values.empty() ? std::vector<double>() : divided(values, parts, motion.interpolation());
  };
  if (std::isfinite(motion.dt()))
    return GroundMotion(of(motion.acceleration()), motion.dt() / parts, motion.interpolation(), motion.name())
        .with_components(of(motion.transverse()), of(motion.vertical()));
  std::vector<double> times;
  for (std::size_t i = 0; i < motion.samples(); ++i) times.push_back(motion.time(i));
  return GroundMotion(of(motion.acceleration()), divided(times, parts, Interpolation::linear), motion.interpolation(),
                      motion.name())
      .with_components(of(motion.transverse()), of(motion.vertical()));
}

}  // namespace

std::vector<GroundMotion> floor_motions(const Structure& structure, const GroundMotion& motion, int parts,
                                        const std::optional<Structure>& transverse) {
  const Structure& other = transverse ? *transverse : structure;
  if (structure.floors() == 0 || other.floors() == 0)
    throw std::invalid_argument("floor_motions: needs a structure with floors; give from_modes the shapes");
  detail::require(parts >= 1, "floor_motions: parts must be at least 1", parts);
  if (transverse && !motion.has_transverse())
    throw std::invalid_argument("floor_motions: a transverse structure needs a motion with a transverse component");
  if (other.floors() != structure.floors())
    throw std::invalid_argument("floor_motions: the transverse structure must have " +
                                std::to_string(structure.floors()) + " floors, got " + std::to_string(other.floors()));
  const GroundMotion fine = divided(motion, parts);
  const Eigen::MatrixXd along = accelerations_of(structure, fine);
  Eigen::MatrixXd across;
  if (fine.has_transverse()) across = accelerations_of(other, fine.component(Component::transverse));

  std::vector<GroundMotion> result;
  const std::vector<double> up(fine.vertical().begin(), fine.vertical().end());
  std::vector<double> times;
  for (std::size_t i = 0; !std::isfinite(fine.dt()) && i < fine.samples(); ++i) times.push_back(fine.time(i));
  const auto column_of = [](const Eigen::MatrixXd& of, Index floor) {
    if (of.size() == 0) return std::vector<double>();
    const auto column = of.col(floor);
    return std::vector<double>(column.begin(), column.end());
  };
  for (Index floor = 0; floor < structure.floors(); ++floor) {
    std::vector<double> values = column_of(along, floor);
    std::string name = motion.name();
    if (!name.empty()) name += ' ';
    name += "floor " + std::to_string(floor + 1);
    GroundMotion one = times.empty()
                           ? GroundMotion(std::move(values), fine.dt(), Interpolation::linear, std::move(name))
                           : GroundMotion(std::move(values), times, Interpolation::linear, std::move(name));
    result.push_back(one.with_components(column_of(across, floor), up).with_orientation(motion.orientation()));
  }
  return result;
}

}  // namespace stickslip
