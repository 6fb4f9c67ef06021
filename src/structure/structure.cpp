#include "stickslip/structure/structure.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Eigenvalues>

#include "base/digits.hpp"
#include "stickslip/base/equal.hpp"
#include "stickslip/base/error.hpp"
#include "structure/eigen.hpp"

namespace stickslip {

using detail::values;
using detail::view;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

struct Structure::Data {
  RealMatrix mass{}, damping{}, stiffness{};
  std::vector<double> influence{};
  Modes modes{};
  RealMatrix modal_damping{}, unit_shapes{};
  bool classical = true, uniform = true;
};

namespace {

std::string element(const char* name, std::size_t i) { return std::string(name) + '[' + std::to_string(i) + ']'; }
std::string element(const char* name, Index i, Index j) {
  return std::string(name) + '[' + std::to_string(i) + ", " + std::to_string(j) + ']';
}

void check_matrix(const char* name, const MatrixXd& matrix, Index size) {
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

MatrixXd symmetric(const MatrixXd& matrix) { return (matrix + matrix.transpose()) / 2; }

void check_entries(const char* function, const char* name, const std::vector<double>& values, std::size_t size,
                   double least, bool included, const char* unit) {
  if (values.size() != size)
    throw std::invalid_argument(std::string(function) + ": " + name + " must have " + std::to_string(size) +
                                (size == 1 ? " entry, got " : " entries, got ") + std::to_string(values.size()));
  for (std::size_t i = 0; i < size; ++i) {
    const double value = values[i];
    if (!(std::isfinite(value) && (included ? value >= least : value > least)))
      detail::refuse(std::string(function) + ": " + element(name, i) + " must be finite and " +
                         (included ? "at least " : "more than ") + detail::shortest(least),
                     value, unit);
  }
}

// Mass and stiffness of a shear building.
std::pair<MatrixXd, MatrixXd> matrices_of(const std::vector<double>& masses, const std::vector<double>& stiffnesses) {
  if (masses.empty()) throw std::invalid_argument("Structure.shear_building: needs at least one floor, got none");
  check_entries("Structure.shear_building", "masses", masses, masses.size(), 0, false, "kg");
  check_entries("Structure.shear_building", "stiffnesses", stiffnesses, masses.size(), 0, false, "N/m");
  const auto each = view(stiffnesses);
  const Index n = each.size();
  MatrixXd stiffness = each.asDiagonal();
  for (Index i = 1; i < n; ++i) {
    stiffness(i - 1, i - 1) += each[i];
    stiffness(i, i - 1) = stiffness(i - 1, i) = -each[i];
  }
  return {view(masses).asDiagonal(), std::move(stiffness)};
}

}  // namespace

Structure::Structure(std::shared_ptr<const Data> data) : data_(std::move(data)) {}

Structure::Structure(const RealMatrix& mass, const RealMatrix& damping, const RealMatrix& stiffness)
    : Structure(mass, damping, stiffness, std::vector(static_cast<std::size_t>(mass.rows()), 1.0)) {}

Structure::Structure(const RealMatrix& mass, const RealMatrix& damping, const RealMatrix& stiffness,
                     const RealVector& influence) {
  const Index n = mass.rows();
  if (n == 0) throw std::invalid_argument("Structure: needs at least one degree of freedom, got an empty mass matrix");
  check_matrix("mass", view(mass), n);
  check_matrix("damping", view(damping), n);
  check_matrix("stiffness", view(stiffness), n);
  const MatrixXd m = symmetric(view(mass)), c = symmetric(view(damping)), k = symmetric(view(stiffness));
  if (static_cast<Index>(influence.size()) != n)
    throw std::invalid_argument("Structure: influence must have " + std::to_string(n) +
                                (n == 1 ? " entry, got " : " entries, got ") + std::to_string(influence.size()));
  for (std::size_t i = 0; i < influence.size(); ++i)
    if (!std::isfinite(influence[i]))
      detail::refuse("Structure: " + element("influence", i) + " must be finite", influence[i]);
  auto data = std::make_shared<Data>();
  data->mass = m;
  data->damping = c;
  data->stiffness = k;
  data->influence = influence;
  data->uniform = view(data->influence) == VectorXd::Ones(n);

  const auto smallest = [](const MatrixXd& matrix) {
    return Eigen::SelfAdjointEigenSolver<MatrixXd>(matrix, Eigen::EigenvaluesOnly).eigenvalues()[0];
  };
  // Round-off of the eigenvalues of a matrix with these entries.
  const auto round_off = [n](const MatrixXd& matrix) {
    return 1e-14 * static_cast<double>(n) * matrix.cwiseAbs().maxCoeff();
  };
  const auto check = [&](const char* name, const MatrixXd& matrix, bool definite) {
    const double least = smallest(matrix);
    if (definite ? !(least > 0) : !(least >= -round_off(matrix)))
      throw std::invalid_argument(std::string("Structure: ") + name + " must be positive " +
                                  (definite ? "definite" : "semidefinite") + ", got a smallest eigenvalue of " +
                                  detail::shortest(least));
  };
  check("mass", m, true);
  check("damping", c, false);
  check("stiffness", k, false);
  if (!(k.cwiseAbs().maxCoeff() > 0))
    throw std::invalid_argument("Structure: it must have a stiffness, got a stiffness matrix of zeros");

  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> solver(k, m);
  if (solver.info() != Eigen::Success)
    throw ConvergenceError("Structure: the modes do not converge; are mass and stiffness in consistent units?");
  if (!solver.eigenvalues().allFinite() || !solver.eigenvectors().allFinite())
    throw std::overflow_error("Structure: its modes leave the range of doubles");
  const MatrixXd& shapes = solver.eigenvectors();
  const double largest = solver.eigenvalues()[n - 1];
  const VectorXd frequencies = solver.eigenvalues().unaryExpr([&](double square) {
    return square > 1e-15 * static_cast<double>(n) * largest ? std::sqrt(square) : 0;  // a rigid-body mode
  });
  // A stiffness that is lost beside that of the fastest mode is not that of a rigid body.
  for (Index j = 0; j < n; ++j) {
    const VectorXd shape = shapes.col(j), size = shape.cwiseAbs();
    const double bends = shape.dot(k * shape), terms = size.dot(k.cwiseAbs() * size);
    if (frequencies[j] <= 0 && bends > 1e-9 * terms)
      throw std::invalid_argument(
          "Structure: the frequency of mode " + std::to_string(j + 1) +
          " is lost in the round-off of the fastest one, " + detail::digits(std::sqrt(largest)) +
          " rad/s; masses and stiffnesses must not differ by so much: make the light or stiff part rigid");
  }
  const VectorXd participation = shapes.transpose() * (m * view(data->influence));
  MatrixXd modal = symmetric(shapes.transpose() * c * shapes);
  const double most = modal.cwiseAbs().maxCoeff();
  // Coupling that is below the round-off of the shapes is none.
  MatrixXd coupling = modal;
  coupling.diagonal().setZero();
  data->classical = coupling.cwiseAbs().maxCoeff() <= 1e-13 * static_cast<double>(n) * most;
  if (data->classical) modal = MatrixXd(modal.diagonal().cwiseMax(0).asDiagonal());
  if (!frequencies.allFinite() || !modal.allFinite() || !participation.allFinite())
    throw std::overflow_error("Structure: its modes leave the range of doubles");
  data->modal_damping = modal;
  data->modes = {
      .frequencies = values(frequencies),
      .damping_ratios = values((modal.diagonal().array() / (2 * frequencies.array())).unaryExpr([](double ratio) {
        return std::isnan(ratio) ? std::numeric_limits<double>::infinity() : ratio;
      })),
      .participation = values(participation),
      .effective_masses = values(participation.cwiseAbs2()),
      .shapes = shapes};
  data_ = std::move(data);
}

Structure Structure::shear_building(const RealVector& masses, const RealVector& stiffnesses, const Rayleigh& damping) {
  detail::require(std::isfinite(damping.alpha) && damping.alpha >= 0, "Rayleigh: alpha must be finite and at least 0",
                  damping.alpha, "1/s");
  detail::require(std::isfinite(damping.beta) && damping.beta >= 0, "Rayleigh: beta must be finite and at least 0",
                  damping.beta, "s");
  auto [mass, stiffness] = matrices_of(masses, stiffnesses);
  return Structure(mass, damping.alpha * mass + damping.beta * stiffness, stiffness);
}

Structure Structure::shear_building(const RealVector& masses, const RealVector& stiffnesses, double damping_ratio) {
  detail::require(std::isfinite(damping_ratio) && damping_ratio >= 0,
                  "Structure.shear_building: damping_ratio must be finite and at least 0", damping_ratio);
  auto [mass, stiffness] = matrices_of(masses, stiffnesses);
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> solver(stiffness, mass);
  const MatrixXd weighted = mass * solver.eigenvectors();
  const VectorXd modal = 2 * damping_ratio * solver.eigenvalues().cwiseMax(0).cwiseSqrt();
  return Structure(mass, symmetric(weighted * modal.asDiagonal() * weighted.transpose()), stiffness);
}

std::shared_ptr<Structure::Data> Structure::data_of_modes(const std::vector<double>& mass_fractions,
                                                          const std::vector<double>& frequencies,
                                                          const std::vector<double>& damping_ratios) {
  constexpr const char* function = "Structure.from_modes";
  const std::size_t n = mass_fractions.size();
  if (n == 0) throw std::invalid_argument("Structure.from_modes: needs at least one mode, got none");
  check_entries(function, "mass_fractions", mass_fractions, n, 0, false, "");
  check_entries(function, "frequencies", frequencies, n, 0, false, "rad/s");
  check_entries(function, "damping_ratios", damping_ratios, n, 0, true, "");
  const auto fractions = view(mass_fractions);
  detail::require(fractions.sum() < 1,
                  "Structure.from_modes: the sum of mass_fractions must be less than 1, because the rest is the base",
                  fractions.sum());
  auto data = std::make_shared<Data>();
  data->modes = {.frequencies = frequencies,
                 .damping_ratios = damping_ratios,
                 .participation = values(fractions.cwiseSqrt()),
                 .effective_masses = mass_fractions,
                 .shapes = RealMatrix(0, fractions.size())};
  data->modal_damping = MatrixXd((2 * view(damping_ratios).cwiseProduct(view(frequencies))).asDiagonal());
  return data;
}

Structure Structure::from_modes(const RealVector& mass_fractions, const RealVector& frequencies,
                                const RealVector& damping_ratios) {
  return Structure(data_of_modes(mass_fractions, frequencies, damping_ratios));
}

Structure Structure::from_modes(const RealVector& mass_fractions, const RealVector& frequencies,
                                const RealVector& damping_ratios, const RealMatrix& shapes) {
  const auto data = data_of_modes(mass_fractions, frequencies, damping_ratios);
  const auto n = static_cast<Index>(mass_fractions.size());
  if (shapes.cols() != n || shapes.rows() == 0)
    throw std::invalid_argument("Structure.from_modes: shapes must have one row per floor and " + std::to_string(n) +
                                " columns, one per mode, got " + std::to_string(shapes.rows()) + " by " +
                                std::to_string(shapes.cols()));
  for (Index i = 0; i < shapes.rows(); ++i)
    for (Index j = 0; j < n; ++j)
      if (!std::isfinite(shapes(i, j)))
        detail::refuse("Structure.from_modes: " + element("shapes", i, j) + " must be finite", shapes(i, j));
  data->modes.shapes = view(shapes) * view(data->modes.participation).cwiseInverse().asDiagonal();
  data->influence.assign(static_cast<std::size_t>(shapes.rows()), 1);
  data->unit_shapes = shapes;
  return Structure(data);
}

std::ptrdiff_t Structure::size() const noexcept { return std::ssize(data_->modes.frequencies); }
std::ptrdiff_t Structure::floors() const noexcept { return data_->modes.shapes.rows(); }
bool Structure::has_matrices() const noexcept { return data_->mass.size() > 0; }
const RealMatrix& Structure::mass() const noexcept { return data_->mass; }
const RealMatrix& Structure::damping() const noexcept { return data_->damping; }
const RealMatrix& Structure::stiffness() const noexcept { return data_->stiffness; }
const std::vector<double>& Structure::influence() const noexcept { return data_->influence; }
bool Structure::uniform_influence() const noexcept { return data_->uniform; }
const Modes& Structure::modes() const noexcept { return data_->modes; }
const RealMatrix& Structure::modal_damping() const noexcept { return data_->modal_damping; }
const RealMatrix& Structure::unit_shapes() const noexcept { return data_->unit_shapes; }
bool Structure::classical() const noexcept { return data_->classical; }

bool Structure::operator==(const Structure& other) const {
  return data_ == other.data_ ||
         (mass() == other.mass() && damping() == other.damping() && stiffness() == other.stiffness() &&
          influence() == other.influence() && modes().frequencies == other.modes().frequencies &&
          modes().effective_masses == other.modes().effective_masses && modal_damping() == other.modal_damping() &&
          modes().shapes == other.modes().shapes);
}

}  // namespace stickslip
