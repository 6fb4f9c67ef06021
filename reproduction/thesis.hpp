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
    thesis,      ///< what the thesis drew, or its method as printed
    theory,      ///< a theory corrected, or one that the thesis did not have
    exact,       ///< an exact answer
    unstable,    ///< an exact answer that no disturbed motion comes back to
    points,      ///< single exact answers
    simulation,  ///< an ensemble, with standard errors
    limit,       ///< a line to compare with
    region       ///< an outline, whose inside is meant
  };
  std::string label;  ///< what is drawn, in TeX between dollar signs; curves of one label belong together
  Kind kind;
  std::vector<double> x, y;
  std::vector<double> error{};  ///< standard errors of y; empty where there are none
  std::uint64_t members = 0;    ///< of the ensemble; 0 where there is none
};

/// The kind as it is written in files: "thesis", "theory", ...
const char* name_of(ThesisCurve::Kind kind) noexcept;

/// One pair of axes.
struct ThesisPanel {
  std::string title;
  std::string x, y;  ///< what the axes show, with units or as non-dimensional groups
  bool log_x = false, log_y = false;
  std::vector<ThesisCurve> curves{};
  std::vector<double> x_limits{}, y_limits{};  ///< two, or none
};

/// Something that the thesis, or this library's documentation, says with a number, and what was found.
struct ThesisStatement {
  std::string where;          ///< section or equation of the thesis; empty where this library says it
  std::string claim;          ///< in the sense of who says it, with the unit
  double said;                ///< by the thesis, or by this library
  double found;               ///< by this library
  double error;               ///< standard error of `found`; 0 where it is no estimate
  bool agrees;                ///< within the digits or the bound that is given, and 3 standard errors
  std::string why;            ///< what is different, or how it was found
  std::uint64_t members = 0;  ///< of the ensembles behind `found`; 0 where it is no estimate
};

/// A figure or table of the thesis, as it comes out here.
struct ThesisFigure {
  std::string number;       ///< "2.1" to "5.7", "A.2", "Table 5.1"
  std::string caption;      ///< what is seen
  std::string thesis_cost;  ///< what the thesis says it took; empty where it doesn't
  std::vector<ThesisPanel> panels{};
  std::vector<ThesisStatement> statements{};
  double seconds = 0;  ///< that it took here
};

/// A number of a figure beside the one that is expected.
struct ThesisCheck {
  std::string what;  ///< the figure, and panel / curve / point or statement; says so where a number is missing
  double found;      ///< NaN where the figure lacks the number
  double expected;   ///< NaN where nothing is expected of it
  double allowed;    ///< by how much it may be off
  bool holds;        ///< whether it is off by no more
  bool loose;        ///< whether that is more than half of `expected`, the members being few
};

struct ThesisOptions {
  std::uint64_t members = 100'000;  ///< of each ensemble, at least 100
  std::uint64_t seed = 1;
  unsigned threads = 0;  ///< at most; 0: as many as the machine has
  /// Called some times a second with what is being done and how much of it is; may throw to end the work.
  std::function<void(std::string_view what, double share)> progress{};
};

/// Draws the figures of the thesis, number by number; what figures share is computed once.
///
/// Groups without dimension are had by a slip level, a level S0 of the spectrum and a half width of 1.
class Thesis {
 public:
  /// @throws std::invalid_argument  fewer than 100 members
  explicit Thesis(ThesisOptions options = {});

  /// What there is, in the thesis's order.
  static std::span<const std::string_view> numbers() noexcept;

  /// @param number  one of `numbers()`
  /// @throws std::invalid_argument  another number; lists those there are
  /// All figures together take some minutes on two threads with 100,000 members, and some seconds with 1000.
  ThesisFigure figure(std::string_view number);

  const ThesisOptions& options() const noexcept { return options_; }

  /// An ensemble, remembered under a name of its own.
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

/// What the thesis says in numbers and what was found, and the time each figure took beside the thesis's own.
std::string thesis_summary(std::span<const ThesisFigure> figures);

/// Holds a figure against what is expected of it: every number that is expected is looked for, and one that is missing,
/// or that nothing is expected of, does not hold.
///
/// Numbers are every simulated point, every statement and up to nine points of each other curve. They are expected as
/// 100,000 members and seed 1 have them, so that another seed is an independent trial. A simulated number may be off by
/// 5 standard errors of the difference, its own error being the expectation's times the root of the ratio of their
/// members: a false alarm in 2 million for each, if Gaussian. Where one member in a hundred moves it is not: with 2000
/// members 16 seeds of 8000 numbers had three alarms, all at such points. Any other number may be off by 1e-6 of the
/// largest that is expected of its curve.
std::vector<ThesisCheck> thesis_check(const ThesisFigure& figure);

/// What checks come to, in one line: how many were made, how many are loose, how many are off.
std::string thesis_verdict(std::span<const ThesisCheck> checks);

/// The lines by which `thesis_check` would expect this figure: what reproduction/expected.inc is made of.
std::string thesis_expectations(const ThesisFigure& figure);

}  // namespace stickslip
