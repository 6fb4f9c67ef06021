#include "stickslip/structure/structure.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include <Eigen/Eigenvalues>

#include "base/digits.hpp"
#include "stickslip/base/equal.hpp"
#include "stickslip/error.hpp"

namespace stickslip {

using Eigen::Index;

struct Structure::Data {
  RealMatrix mass{}, damping{}, stiffness{};
  RealVector influence{};
  Modes modes{};
  RealMatrix modal_damping{}, unit_shapes{};
  bool classical = true, uniform = true;
};

namespace {

std::string element(const char* name, Index i) { return std::string(name) + '[' + std::to_string(i) + ']'; }
std::string element(const char* name, Index i, Index j) {
  return std::string(name) + '[' + std::to_string(i) + ", " + std::to_string(j) + ']';
}

void check_matrix(const char* name, const RealMatrix& matrix, Index size) {
  if (matrix.rows() != size || matrix.cols() != size)
    throw std::invalid_argument(std::string("Structure: ") + name + " must be " + std::to_string(size) + " by " +
                                std::to_string(size) + ", as the mass matrix, got " + std::to_string(matrix.rows()) +
                                " by " + std::to_string(matrix.cols()));
  for (Index i = 0; i < size; ++i)
    for (Index j = 0; j < size; ++j)
      if (!std::isfinite(matrix(i, j)))
        detail::refuse("Structure: " + element(name, i, j) + " must be finite", matrix(i, j));
  const double scale = matrix.cwiseAbs().maxCoeff();
  for (Index i = 0; i < size; ++i)
    for (Index j = 0; j < i; ++j)
      if (!(std::abs(matrix(i, j) - matrix(j, i)) <= 1e-12 * scale))
        throw std::invalid_argument(std::string("Structure: ") + name + " must be symmetric, got " +
                                    element(name, i, j) + " = " + detail::shortest(matrix(i, j)) + " and " +
                                    element(name, j, i) + " = " + detail::shortest(matrix(j, i)));
}

RealMatrix symmetric(const RealMatrix& matrix) { return (matrix + matrix.transpose()) / 2; }

void check_entries(const char* function, const char* name, const RealVector& values, Index size, double least,
                   bool included, const char* unit) {
  if (values.size() != size)
    throw std::invalid_argument(std::string(function) + ": " + name + " must have " + std::to_string(size) +
                                (size == 1 ? " entry, got " : " entries, got ") + std::to_string(values.size()));
  for (Index i = 0; i < size; ++i) {
    const double value = values[i];
    if (!(std::isfinite(value) && (included ? value >= least : value > least)))
      detail::refuse(std::string(function) + ": " + element(name, i) + " must be finite and " +
                         (included ? "at least " : "more than ") + detail::shortest(least),
                     value, unit);
  }
}

// Mass and stiffness of a shear building.
std::pair<RealMatrix, RealMatrix> matrices_of(const RealVector& masses, const RealVector& stiffnesses) {
  if (masses.size() == 0) throw std::invalid_argument("Structure.shear_building: needs at least one floor, got none");
  check_entries("Structure.shear_building", "masses", masses, masses.size(), 0, false, "kg");
  check_entries("Structure.shear_building", "stiffnesses", stiffnesses, masses.size(), 0, false, "N/m");
  const Index n = masses.size();
  RealMatrix stiffness = RealMatrix::Zero(n, n);
  for (Index i = 0; i < n; ++i) {
    stiffness(i, i) += stiffnesses[i];
    if (i > 0) {
      stiffness(i - 1, i - 1) += stiffnesses[i];
      stiffness(i, i - 1) = stiffness(i - 1, i) = -stiffnesses[i];
    }
  }
  return {masses.asDiagonal(), std::move(stiffness)};
}

}  // namespace

Structure::Structure(std::shared_ptr<const Data> data) : data_(std::move(data)) {}

Structure::Structure(RealMatrix mass, RealMatrix damping, RealMatrix stiffness)
    : Structure(mass, std::move(damping), std::move(stiffness), RealVector::Ones(mass.rows())) {}

Structure::Structure(RealMatrix mass, RealMatrix damping, RealMatrix stiffness, RealVector influence) {
  const Index n = mass.rows();
  if (n == 0) throw std::invalid_argument("Structure: needs at least one degree of freedom, got an empty mass matrix");
  check_matrix("mass", mass, n);
  check_matrix("damping", damping, n);
  check_matrix("stiffness", stiffness, n);
  auto data = std::make_shared<Data>();
  data->mass = symmetric(mass);
  data->damping = symmetric(damping);
  data->stiffness = symmetric(stiffness);
  data->influence = std::move(influence);
  if (data->influence.size() != n)
    throw std::invalid_argument("Structure: influence must have " + std::to_string(n) +
                                (n == 1 ? " entry, got " : " entries, got ") + std::to_string(data->influence.size()));
  for (Index i = 0; i < n; ++i)
    if (!std::isfinite(data->influence[i]))
      detail::refuse("Structure: " + element("influence", i) + " must be finite", data->influence[i]);
  data->uniform = data->influence == RealVector::Ones(n);

  const auto smallest = [](const RealMatrix& matrix) {
    return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix, Eigen::EigenvaluesOnly).eigenvalues()[0];
  };
  // Round-off of the eigenvalues of a matrix with these entries.
  const auto round_off = [n](const RealMatrix& matrix) {
    return 1e-14 * static_cast<double>(n) * matrix.cwiseAbs().maxCoeff();
  };
  const auto check = [&](const char* name, const RealMatrix& matrix, bool definite) {
    const double least = smallest(matrix);
    if (definite ? !(least > 0) : !(least >= -round_off(matrix)))
      throw std::invalid_argument(std::string("Structure: ") + name + " must be positive " +
                                  (definite ? "definite" : "semidefinite") + ", got a smallest eigenvalue of " +
                                  detail::shortest(least));
  };
  check("mass", data->mass, true);
  check("damping", data->damping, false);
  check("stiffness", data->stiffness, false);
  if (!(data->stiffness.cwiseAbs().maxCoeff() > 0))
    throw std::invalid_argument("Structure: it must have a stiffness, got a stiffness matrix of zeros");

  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(data->stiffness, data->mass);
  if (solver.info() != Eigen::Success)
    throw ConvergenceError("Structure: the modes do not converge; are mass and stiffness in consistent units?");
  Modes& modes = data->modes;
  if (!solver.eigenvalues().allFinite() || !solver.eigenvectors().allFinite())
    throw std::overflow_error("Structure: its modes leave the range of doubles");
  modes.shapes = solver.eigenvectors();
  const double largest = solver.eigenvalues()[n - 1];
  modes.frequencies = solver.eigenvalues().unaryExpr([&](double square) {
    return square > 1e-15 * static_cast<double>(n) * largest ? std::sqrt(square) : 0;  // a rigid-body mode
  });
  // A stiffness that is lost beside that of the fastest mode is not that of a rigid body.
  for (Index j = 0; j < n; ++j) {
    const RealVector shape = modes.shapes.col(j), size = shape.cwiseAbs();
    const double bends = shape.dot(data->stiffness * shape), terms = size.dot(data->stiffness.cwiseAbs() * size);
    if (modes.frequencies[j] <= 0 && bends > 1e-9 * terms)
      throw std::invalid_argument(
          "Structure: the frequency of mode " + std::to_string(j + 1) +
          " is lost in the round-off of the fastest one, " + detail::digits(std::sqrt(largest)) +
          " rad/s; masses and stiffnesses must not differ by so much: make the light or stiff part rigid");
  }
  modes.participation = modes.shapes.transpose() * (data->mass * data->influence);
  modes.effective_masses = modes.participation.cwiseAbs2();
  data->modal_damping = symmetric(modes.shapes.transpose() * data->damping * modes.shapes);
  const double most = data->modal_damping.cwiseAbs().maxCoeff();
  // Coupling that is below the round-off of the shapes is none.
  RealMatrix coupling = data->modal_damping;
  coupling.diagonal().setZero();
  data->classical = coupling.cwiseAbs().maxCoeff() <= 1e-13 * static_cast<double>(n) * most;
  if (data->classical) data->modal_damping = RealMatrix(data->modal_damping.diagonal().cwiseMax(0).asDiagonal());
  modes.damping_ratios =
      (data->modal_damping.diagonal().array() / (2 * modes.frequencies.array())).unaryExpr([](double ratio) {
        return std::isnan(ratio) ? std::numeric_limits<double>::infinity() : ratio;
      });
  if (!modes.frequencies.allFinite() || !data->modal_damping.allFinite() || !modes.participation.allFinite())
    throw std::overflow_error("Structure: its modes leave the range of doubles");
  data_ = std::move(data);
}

Structure Structure::shear_building(const RealVector& masses, const RealVector& stiffnesses, const Rayleigh& damping) {
  detail::require(std::isfinite(damping.alpha) && damping.alpha >= 0, "Rayleigh: alpha must be finite and at least 0",
                  damping.alpha, "1/s");
  detail::require(std::isfinite(damping.beta) && damping.beta >= 0, "Rayleigh: beta must be finite and at least 0",
                  damping.beta, "s");
  auto [mass, stiffness] = matrices_of(masses, stiffnesses);
  RealMatrix matrix = damping.alpha * mass + damping.beta * stiffness;
  return Structure(std::move(mass), std::move(matrix), std::move(stiffness));
}

Structure Structure::shear_building(const RealVector& masses, const RealVector& stiffnesses, double damping_ratio) {
  detail::require(std::isfinite(damping_ratio) && damping_ratio >= 0,
                  "Structure.shear_building: damping_ratio must be finite and at least 0", damping_ratio);
  auto [mass, stiffness] = matrices_of(masses, stiffnesses);
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(stiffness, mass);
  const RealMatrix weighted = mass * solver.eigenvectors();
  const RealVector modal = 2 * damping_ratio * solver.eigenvalues().cwiseMax(0).cwiseSqrt();
  RealMatrix matrix = symmetric(weighted * modal.asDiagonal() * weighted.transpose());
  return Structure(std::move(mass), std::move(matrix), std::move(stiffness));
}

std::shared_ptr<Structure::Data> Structure::data_of_modes(const RealVector& mass_fractions,
                                                          const RealVector& frequencies,
                                                          const RealVector& damping_ratios) {
  constexpr const char* function = "Structure.from_modes";
  const Index n = mass_fractions.size();
  if (n == 0) throw std::invalid_argument("Structure.from_modes: needs at least one mode, got none");
  check_entries(function, "mass_fractions", mass_fractions, n, 0, false, "");
  check_entries(function, "frequencies", frequencies, n, 0, false, "rad/s");
  check_entries(function, "damping_ratios", damping_ratios, n, 0, true, "");
  detail::require(mass_fractions.sum() < 1,
                  "Structure.from_modes: the sum of mass_fractions must be less than 1, because the rest is the base",
                  mass_fractions.sum());
  auto data = std::make_shared<Data>();
  Modes& modes = data->modes;
  modes.frequencies = frequencies;
  modes.damping_ratios = damping_ratios;
  modes.participation = mass_fractions.cwiseSqrt();
  modes.effective_masses = mass_fractions;
  modes.shapes.resize(0, n);
  data->modal_damping = RealMatrix((2 * damping_ratios.array() * frequencies.array()).matrix().asDiagonal());
  return data;
}

Structure Structure::from_modes(const RealVector& mass_fractions, const RealVector& frequencies,
                                const RealVector& damping_ratios) {
  return Structure(data_of_modes(mass_fractions, frequencies, damping_ratios));
}

Structure Structure::from_modes(const RealVector& mass_fractions, const RealVector& frequencies,
                                const RealVector& damping_ratios, const RealMatrix& shapes) {
  const auto data = data_of_modes(mass_fractions, frequencies, damping_ratios);
  const Index n = mass_fractions.size();
  if (shapes.cols() != n || shapes.rows() == 0)
    throw std::invalid_argument("Structure.from_modes: shapes must have one row per floor and " + std::to_string(n) +
                                " columns, one per mode, got " + std::to_string(shapes.rows()) + " by " +
                                std::to_string(shapes.cols()));
  for (Index i = 0; i < shapes.rows(); ++i)
    for (Index j = 0; j < n; ++j)
      if (!std::isfinite(shapes(i, j)))
        detail::refuse("Structure.from_modes: " + element("shapes", i, j) + " must be finite", shapes(i, j));
  data->modes.shapes = shapes * data->modes.participation.cwiseInverse().asDiagonal();
  data->influence = RealVector::Ones(shapes.rows());
  data->unit_shapes = shapes;
  return Structure(data);
}

Index Structure::size() const noexcept { return data_->modes.frequencies.size(); }
Index Structure::floors() const noexcept { return data_->modes.shapes.rows(); }
bool Structure::has_matrices() const noexcept { return data_->mass.size() > 0; }
const RealMatrix& Structure::mass() const noexcept { return data_->mass; }
const RealMatrix& Structure::damping() const noexcept { return data_->damping; }
const RealMatrix& Structure::stiffness() const noexcept { return data_->stiffness; }
const RealVector& Structure::influence() const noexcept { return data_->influence; }
bool Structure::uniform_influence() const noexcept { return data_->uniform; }
const Modes& Structure::modes() const noexcept { return data_->modes; }
const RealMatrix& Structure::modal_damping() const noexcept { return data_->modal_damping; }
const RealMatrix& Structure::unit_shapes() const noexcept { return data_->unit_shapes; }
bool Structure::classical() const noexcept { return data_->classical; }

bool Structure::operator==(const Structure& other) const {
  const auto same = [](const auto& a, const auto& b) { return a.rows() == b.rows() && a.cols() == b.cols() && a == b; };
  return data_ == other.data_ ||
         (same(mass(), other.mass()) && same(damping(), other.damping()) && same(stiffness(), other.stiffness()) &&
          same(influence(), other.influence()) && same(modes().frequencies, other.modes().frequencies) &&
          same(modes().effective_masses, other.modes().effective_masses) &&
          same(modal_damping(), other.modal_damping()) && same(modes().shapes, other.modes().shapes));
}

}  // namespace stickslip
