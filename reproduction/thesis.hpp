// The figures and tables of the thesis, "The Response of Stick-Slip Systems to Random Seismic Excitation", computed
// anew: its own theory, the exact answer and simulation side by side. Numbers of equations in this library are the
// thesis's.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "stickslip/ensemble/ensemble.hpp"
#include "stickslip/ensemble/options.hpp"

namespace stickslip {

/// One curve or set of points of a figure.
struct ThesisCurve {
  enum class Kind {
    thesis,      ///< drawn in the thesis, or by its method as printed
    theory,      ///< a corrected theory, or one that is not in the thesis
    exact,       ///< an exact solution
    unstable,    ///< an exact solution to which no disturbed motion returns
    points,      ///< single exact solutions
    simulation,  ///< an ensemble, with standard errors
    limit,       ///< a line for comparison
    region       ///< an outline of a region
  };
  std::string label;  ///< name of the curve, in TeX between dollar signs; curves with the same label belong together
  Kind kind;
  std::vector<double> x, y;
  std::vector<double> error{};  ///< standard errors of y; empty where there are none
  std::uint64_t members = 0;    ///< of the ensemble; 0 where there is none
};

/// The kind as written in files: "thesis", "theory", ...
const char* name_of(ThesisCurve::Kind kind) noexcept;

/// One pair of axes.
struct ThesisPanel {
  std::string title;
  std::string x, y;  ///< quantities on the axes, with units or as non-dimensional groups
  bool log_x = false, log_y = false;
  std::vector<ThesisCurve> curves{};
  std::vector<double> x_limits{}, y_limits{};  ///< two, or none
};

/// A numerical statement of the thesis or of this library's documentation, and the number found.
struct ThesisStatement {
  enum class Bound { about, at_most, at_least };

  std::string where;          ///< section or equation of the thesis; empty for statements of this library
  std::string claim;          ///< the statement, with the unit
  Bound bound;                ///< whether `said` is a value or a bound
  double said;                ///< in the thesis, or in this library
  double within;              ///< largest deviation from a value that its digits or its words allow; 0 for a bound
  double found;               ///< by this library
  double error;               ///< standard error of `found`; 0 if it is not an estimate
  std::string why;            ///< reason for a difference, or method
  std::uint64_t members = 0;  ///< of the ensembles behind `found`; 0 if it is not an estimate

  /// Whether `found` is within the stated digits or bound, and 3 standard errors.
  bool agrees() const { return agrees_with({found, error}); }

  /// The same for another number.
  bool agrees_with(Estimate number) const;
};

/// The bound in words: "about", "at most", "at least".
const char* name_of(ThesisStatement::Bound bound) noexcept;

/// A figure or table of the thesis, as computed here.
struct ThesisFigure {
  std::string number;       ///< "2.1" to "5.7", "A.2", "Table 5.1"
  std::string caption;      ///< description
  std::string thesis_cost;  ///< computing time according to the thesis; empty if not stated
  std::vector<ThesisPanel> panels{};
  std::vector<ThesisStatement> statements{};
  double seconds = 0;  ///< computing time here
};

/// A number or a text of a figure and what is expected of it.
struct ThesisCheck {
  std::string what;  ///< the figure, and panel / curve / point or statement; says so where a number is missing
  double found;      ///< NaN where the figure lacks the number, and for texts
  double expected;   ///< NaN where no value is expected, and for texts
  double allowed;    ///< largest allowed deviation
  bool holds;        ///< whether the deviation is within `allowed`, or the text is the expected one
  bool loose;        ///< whether half of a nonzero expected value would hold too, because there are few members
};

struct ThesisOptions {
  std::uint64_t members = 100'000;  ///< of each ensemble, at least 100
  std::uint64_t seed = 1;
  unsigned threads = 0;  ///< at most; 0: as many as the machine has
  /// Called a few times a second with the name of the current work and its progress; may throw to end the work.
  std::function<void(std::string_view what, double share)> progress{};
};

/// Draws the figures of the thesis, number by number; what figures share is computed once.
///
/// Slip level, spectral level S0 and half width are 1, which makes the results non-dimensional groups.
class Thesis {
 public:
  /// @throws std::invalid_argument  fewer than 100 members
  explicit Thesis(ThesisOptions options = {});

  /// The available numbers, in the order of the thesis.
  static std::span<const std::string_view> numbers() noexcept;

  /// @param number  one of `numbers()`
  /// @throws std::invalid_argument  an unknown number; the message lists the available ones
  /// All figures together take some minutes on two threads with 100,000 members, and some seconds with 1000.
  ThesisFigure figure(std::string_view number);

  const ThesisOptions& options() const noexcept { return options_; }

  /// An ensemble, stored under its own name.
  /// @param what  as passed to the progress callback
  /// @param run   simulates it with the options given
  const Ensemble& ensemble(const std::string& what, std::uint64_t members, bool velocity_spectrum,
                           const std::function<Ensemble(const EnsembleOptions&)>& run);

 private:
  ThesisOptions options_;
  std::string number_;
  std::map<std::string, Ensemble> ensembles_;
};

/// Every curve and point of a figure: panel, label, kind, members, x, y, error; a line each, 17 digits.
std::string thesis_csv(const ThesisFigure& figure);

/// The numerical statements of the thesis and the numbers found, and the computing time of each figure here and in the
/// thesis.
std::string thesis_summary(std::span<const ThesisFigure> figures);

/// Compares a figure with its expected values: a number that is missing, or for which no value is expected, fails.
///
/// Numbers are every simulated point, up to nine points of each other curve, and of every statement the number found,
/// the number claimed and the deviation that the claim allows. They are expected as 100,000 members and seed 1 have
/// them, so that another seed is an independent trial. Any number may be off by 1e-6 of itself and, for round-off, by
/// 1e-12 of the largest that is expected of its curve. A simulated number may also be off by 5 standard errors of the
/// difference, its own error being the expectation's times the root of the ratio of their members: a false alarm in 2
/// million for each, if Gaussian. Where one member in a hundred moves it is not: with 2000 members 16 seeds of 8000
/// numbers had three alarms, all at such points.
///
/// Texts are the titles and axes of panels, the labels and kinds of curves, and of every statement the claim and
/// whether the expected number agrees with it.
/// @param expectations  the content of python/stickslip/thesis_expected.txt
std::vector<ThesisCheck> thesis_check(const ThesisFigure& figure, const std::string& expectations);

/// A summary of checks in one line: how many were made, how many are loose, how many fail.
std::string thesis_verdict(std::span<const ThesisCheck> checks);

/// The lines with which `thesis_check` would expect this figure, a part of python/stickslip/thesis_expected.txt.
std::string thesis_expectations(const ThesisFigure& figure);

}  // namespace stickslip
