// What lines of friction that stick can carry together.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace stickslip::detail {

using Vector3 = std::array<double, 3>;

inline double dot(const Vector3& a, const Vector3& b) noexcept { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline double norm(const Vector3& a) noexcept { return std::sqrt(dot(a, a)); }
inline Vector3 cross(const Vector3& a, const Vector3& b) noexcept {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline Vector3 scaled(double factor, const Vector3& a) noexcept {
  return {factor * a[0], factor * a[1], factor * a[2]};
}
inline void add_to(Vector3& a, double factor, const Vector3& b) noexcept {
  for (std::size_t i = 0; i < 3; ++i) a[i] += factor * b[i];
}

/// The sine of an angle between rows below which they are taken as parallel.
constexpr double parallel = 1e-9;

/// The sum of the segments [-level, level] row, in at most three dimensions:
///     f lies within  iff  u.f <= sum level |u.row|  for the normals u of all faces.
/// The faces are within the span of the rows.
class Zonotope {
 public:
  struct Face {
    Vector3 normal;  // of length 1
    double reach;    // sum of level |normal.row|
  };

  void clear() noexcept {
    rows_.clear();
    levels_.clear();
    lengths_.clear();
  }
  void add(const Vector3& row, double level) {
    rows_.push_back(row);
    levels_.push_back(level);
    lengths_.push_back(norm(row));
  }

  /// Finds rank, basis and faces.
  void close() {
    rank_ = 0;
    faces_.clear();
    // By Gram-Schmidt, each time the row that is farthest from the span so far.
    for (; rank_ < 3; ++rank_) {
      double farthest = parallel;
      Vector3 next{};
      std::size_t which = 0;
      for (std::size_t j = 0; j < rows_.size(); ++j) {
        if (!(lengths_[j] > 0)) continue;
        Vector3 rest = scaled(1 / lengths_[j], rows_[j]);
        for (int twice = 0; twice < 2; ++twice)
          for (std::size_t i = 0; i < rank_; ++i) add_to(rest, -dot(axes_[i], rest), axes_[i]);
        const double far = norm(rest);
        if (!(far > farthest)) continue;
        farthest = far;
        next = scaled(1 / far, rest);
        which = j;
      }
      if (!(farthest > parallel)) break;
      axes_[rank_] = next;
      basis_[rank_] = which;
    }
    if (rank_ == 1) {
      look(axes_[0]);
    } else if (rank_ == 2) {
      across_ = unit(cross(axes_[0], axes_[1]));
      for (std::size_t j = 0; j < rows_.size(); ++j)
        if (lengths_[j] > 0) look(unit(cross(across_, rows_[j])));
    } else if (rank_ == 3) {
      for (std::size_t i = 0; i < rows_.size(); ++i)
        for (std::size_t j = i + 1; j < rows_.size(); ++j) {
          if (!(lengths_[i] > 0) || !(lengths_[j] > 0)) continue;
          // Across both rows to round-off, even where they are almost parallel.
          const Vector3 one = unit(rows_[i]);
          Vector3 other = unit(rows_[j]);
          for (int twice = 0; twice < 2; ++twice) add_to(other, -dot(one, other), one);
          if (norm(other) > parallel) look(unit(cross(one, unit(other))));
        }
    }
  }

  std::size_t size() const noexcept { return rows_.size(); }
  std::size_t rank() const noexcept { return rank_; }
  /// The rows from which the others follow, `rank()` of them.
  std::size_t basis(std::size_t i) const noexcept { return basis_[i]; }
  /// Both faces of each pair.
  const std::vector<Face>& faces() const noexcept { return faces_; }
  const Vector3& row(std::size_t j) const noexcept { return rows_[j]; }
  double level(std::size_t j) const noexcept { return levels_[j]; }

  /// The part of a vector outside the span of the rows. Where that is one direction, its components have no round-off but of
  /// the direction, however small it is beside the vector.
  Vector3 outside(Vector3 f) const noexcept {
    if (rank_ == 3) return {};
    if (rank_ == 2) return scaled(dot(across_, f), across_);
    if (rank_ == 1) add_to(f, -dot(axes_[0], f), axes_[0]);
    return f;
  }
  /// The direction in which a row slides out of a face; 0 if it stays.
  int leaves(const Vector3& normal, std::size_t j) const noexcept {
    const double along = dot(normal, rows_[j]);
    return std::abs(along) <= parallel * lengths_[j] ? 0 : along > 0 ? 1 : -1;
  }
  /// The least distance of a vector from a face; negative outside.
  double margin(const Vector3& f, double weight = 1) const noexcept {
    double least = HUGE_VAL;
    for (const Face& face : faces_) least = std::min(least, weight * face.reach - dot(face.normal, f));
    return least;
  }

 private:
  static Vector3 unit(const Vector3& a) noexcept { return scaled(1 / norm(a), a); }
  void look(const Vector3& u) {
    for (const Face& face : faces_)
      if (norm(cross(face.normal, u)) < 1e-14) return;  // met before
    double reach = 0;
    for (std::size_t j = 0; j < rows_.size(); ++j) reach += levels_[j] * std::abs(dot(u, rows_[j]));
    faces_.push_back({u, reach});
    faces_.push_back({scaled(-1, u), reach});
  }

  std::vector<Vector3> rows_;
  std::vector<double> levels_, lengths_;
  std::vector<Face> faces_;
  std::array<Vector3, 3> axes_{};
  Vector3 across_{};  // both axes of rank 2
  std::array<std::size_t, 3> basis_{};
  std::size_t rank_ = 0;
};

}  // namespace stickslip::detail
