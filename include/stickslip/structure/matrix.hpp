// Vectors and matrices of structures, whose layout does not depend on how a file is compiled.
#pragma once

#include "stickslip/base/requirements.hpp"  // before Eigen, whose errors would be told first

#include <concepts>
#include <cstddef>
#include <initializer_list>
#include <stdexcept>
#include <utility>
#include <vector>

#if __has_include(<Eigen/Core>)
#include <Eigen/Core>  // for codes that give its vectors: nothing here needs it
#endif

namespace stickslip {

/// A vector as an argument: a std::vector, numbers in braces, or whatever else has a size and entries [i], as vectors and
/// expressions of Eigen.
class RealVector {
 public:
  RealVector(std::vector<double> values) : values_(std::move(values)) {}
  RealVector(std::initializer_list<double> values) : values_(values) {}
  template <class Vector>
  requires(!std::same_as<Vector, RealVector> && requires(const Vector& v) {
    { v[0] } -> std::convertible_to<double>;
    { v.size() } -> std::convertible_to<std::ptrdiff_t>;
  }) RealVector(const Vector& vector) {
    if constexpr (requires { vector.eval(); })
      take(vector.eval());
    else
      take(vector);
  }

  operator const std::vector<double>&() const noexcept { return values_; }
  std::size_t size() const noexcept { return values_.size(); }
  double operator[](std::size_t i) const noexcept { return values_[i]; }

 private:
  void take(const auto& vector) {
    values_.reserve(static_cast<std::size_t>(vector.size()));
    for (decltype(vector.size()) i = 0; i < vector.size(); ++i) values_.push_back(vector[i]);
  }
  std::vector<double> values_{};
};

/// A matrix, column by column. It is made of rows in braces, or of whatever has `rows()`, `cols()` and entries (i, j), as
/// matrices and expressions of Eigen, which sees one as
/// `Eigen::Map<const Eigen::MatrixXd>(m.data(), m.rows(), m.cols())`.
class RealMatrix {
 public:
  using Index = std::ptrdiff_t;

  RealMatrix() = default;
  /// Zeros; rows and columns at least 0.
  RealMatrix(Index rows, Index cols) : rows_(rows), cols_(cols), values_(static_cast<std::size_t>(rows * cols)) {}
  /// @throws std::invalid_argument  the rows have different lengths
  RealMatrix(std::initializer_list<std::initializer_list<double>> rows)
      : RealMatrix(static_cast<Index>(rows.size()),
                   static_cast<Index>(rows.size() > 0 ? rows.begin()->size() : std::size_t{0})) {
    Index i = 0;
    for (const auto& row : rows) {
      if (static_cast<Index>(row.size()) != cols_)
        throw std::invalid_argument("RealMatrix: the rows must have equal lengths");
      for (Index j = 0; j < cols_; ++j) (*this)(i, j) = row.begin()[j];
      ++i;
    }
  }
  template <class Matrix>
  requires(!std::same_as<Matrix, RealMatrix> &&
           requires(const Matrix& m) {
             { m.rows() } -> std::convertible_to<Index>;
             { m.cols() } -> std::convertible_to<Index>;
           }) RealMatrix(const Matrix& matrix)
      : RealMatrix(matrix.rows(), matrix.cols()) {
    if constexpr (requires { matrix.eval(); })
      take(matrix.eval());
    else
      take(matrix);
  }

  Index rows() const noexcept { return rows_; }
  Index cols() const noexcept { return cols_; }
  std::size_t size() const noexcept { return values_.size(); }
  double& operator()(Index i, Index j) noexcept { return values_[at(i, j)]; }
  double operator()(Index i, Index j) const noexcept { return values_[at(i, j)]; }
  double* data() noexcept { return values_.data(); }
  const double* data() const noexcept { return values_.data(); }

  bool operator==(const RealMatrix&) const = default;

 private:
  std::size_t at(Index i, Index j) const noexcept { return static_cast<std::size_t>(i + j * rows_); }
  void take(const auto& matrix) {
    for (Index j = 0; j < cols_; ++j)
      for (Index i = 0; i < rows_; ++i) (*this)(i, j) = matrix(i, j);
  }
  Index rows_ = 0, cols_ = 0;
  std::vector<double> values_{};
};

}  // namespace stickslip
