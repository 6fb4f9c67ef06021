// The figures, one function each, and the helpers that build them.
#pragma once

#include <cmath>
#include <functional>
#include <span>
#include <stickslip/excitation/gaussian.hpp>
#include <stickslip/excitation/poisson.hpp>
#include <string>
#include <utility>
#include <vector>

#include "reproduction/thesis.hpp"

namespace stickslip::detail {

using Kind = ThesisCurve::Kind;
using Bound = ThesisStatement::Bound;

ThesisFigure figure_2_1(Thesis&);
ThesisFigure figure_2_2(Thesis&);
ThesisFigure figure_2_3(Thesis&);
ThesisFigure figure_2_4(Thesis&);
ThesisFigure figure_2_5(Thesis&);
ThesisFigure figure_2_6(Thesis&);
ThesisFigure figure_3_1(Thesis&);
ThesisFigure figure_3_2(Thesis&);
ThesisFigure figure_3_3(Thesis&);
ThesisFigure figure_4_1(Thesis&);
ThesisFigure figure_4_2(Thesis&);
ThesisFigure figure_4_3(Thesis&);
ThesisFigure figure_4_4(Thesis&);
ThesisFigure figure_4_5(Thesis&);
ThesisFigure figure_4_6(Thesis&);
ThesisFigure figure_4_7(Thesis&);
ThesisFigure figure_4_8(Thesis&);
ThesisFigure figure_5_1(Thesis&);
ThesisFigure figure_5_2(Thesis&);
ThesisFigure figure_5_3(Thesis&);
ThesisFigure figure_5_4(Thesis&);
ThesisFigure figure_5_5(Thesis&);
ThesisFigure figure_5_6(Thesis&);
ThesisFigure table_5_1(Thesis&);
ThesisFigure figure_5_7(Thesis&);
ThesisFigure section_5_6(Thesis&);
ThesisFigure figure_a_2(Thesis&);

/// `count` numbers from `first` to `last`, evenly, or in even ratios.
inline std::vector<double> even(double first, double last, int count) {
  std::vector<double> x;
  for (int i = 0; i < count; ++i) x.push_back(first + (last - first) * i / (count - 1));
  return x;
}
inline std::vector<double> geometric(double first, double last, int count) {
  std::vector<double> x = even(std::log(first), std::log(last), count);
  for (double& value : x) value = std::exp(value);
  x.front() = first;
  x.back() = last;
  return x;
}

/// y = f(x).
template <class Function>
ThesisCurve curve(std::string label, Kind kind, std::vector<double> x, Function&& f) {
  ThesisCurve result{std::move(label), kind, std::move(x), {}};
  for (const double value : result.x) result.y.push_back(f(value));
  return result;
}

/// A horizontal line.
inline ThesisCurve line(std::string label, double first, double last, double y, Kind kind = Kind::limit) {
  return {std::move(label), kind, {first, last}, {y, y}};
}

/// Points of an ensemble, added one by one.
struct Points {
  ThesisCurve curve;
  Points(std::string label, std::uint64_t members) : curve{std::move(label), Kind::simulation, {}, {}} {
    curve.members = members;
  }
  void add(double x, Estimate y) {
    curve.x.push_back(x);
    curve.y.push_back(y.value);
    curve.error.push_back(y.error);
  }
};

/// The square root of an estimate.
inline Estimate root(Estimate e) {
  const double value = std::sqrt(std::max(e.value, 0.0));
  return {value, value > 0 ? e.error / (2 * value) : 0};
}

/// A formatted number: 1.3; 100,000.
std::string number(double value);
std::string number(std::uint64_t count);

/// The thesis states a number: it agrees if ours rounds to it, as `within` specifies, or differs by less than 3
/// standard errors.
ThesisStatement about(std::string where, std::string claim, double said, double within, Estimate found,
                      std::string why = {});
/// The thesis states a bound for the number found.
ThesisStatement at_most(std::string where, std::string claim, double said, Estimate found, std::string why = {});
ThesisStatement at_least(std::string where, std::string claim, double said, Estimate found, std::string why = {});

/// The number of members in the thesis's own ensembles.
inline constexpr std::uint64_t thesis_members = 1000;

}  // namespace stickslip::detail
