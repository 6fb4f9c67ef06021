// How the strength of a random acceleration is spread over frequency.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "stickslip/detail/equal.hpp"
#include "stickslip/detail/requirements.hpp"

namespace stickslip {

/// The two-sided spectral density S(omega) of a stationary ground acceleration [m^2/s^3], omega in rad/s:
///
///     variance = integral of S over the whole line,   S(-omega) = S(omega),   white noise has R(t) = 2 pi S0 delta(t)
///
/// (A one-sided density G(omega) is 2 S(omega); one over hertz, G(f), is 4 pi S(2 pi f).) Immutable, made by the
/// functions below, each of which refuses what is out of range with std::invalid_argument, naming the value.
class Spectrum {
 public:
  struct White {
    double s0;
    bool operator==(const White&) const = default;
  };
  struct BandPass {
    double s0, low, high;
    bool operator==(const BandPass&) const = default;
  };
  struct KanaiTajimi {
    double s0, frequency, damping;
    bool operator==(const KanaiTajimi&) const = default;
  };
  struct CloughPenzien {
    double s0, frequency, damping, filter_frequency, filter_damping;
    bool operator==(const CloughPenzien&) const = default;
  };
  struct Table {
    std::vector<double> omega, density;
    bool operator==(const Table&) const = default;
  };
  struct Function {
    std::shared_ptr<const std::function<double(double)>> density;
    double low, high;
    std::uint64_t fingerprint = 0;  ///< hash of 1024 values and of the variance, each as a float
    /// Functions are told apart by what they do.
    bool operator==(const Function& other) const {
      return detail::equal(low, other.low) && detail::equal(high, other.high) && fingerprint == other.fingerprint;
    }
  };
  using Form = std::variant<White, BandPass, KanaiTajimi, CloughPenzien, Table, Function>;

  /// White noise: S = s0 everywhere.
  /// @param s0  [m^2/s^3], positive and finite
  static Spectrum white(double s0);

  /// Ideal band-pass: S = s0 for low <= |omega| <= high, thesis (4.24).
  /// @param s0         [m^2/s^3], positive and finite
  /// @param low, high  [rad/s], 0 <= low < high, finite
  static Spectrum band_pass(double s0, double low, double high);

  /// White noise through a layer of soil of one mode, seen at the surface:
  ///     S = s0 (wg^4 + 4 z^2 wg^2 omega^2) / ((wg^2 - omega^2)^2 + 4 z^2 wg^2 omega^2)
  /// It keeps S(0) = s0, so that ground velocity and displacement grow without bound; see `clough_penzien`.
  /// @param s0         level in the rock [m^2/s^3], positive and finite
  /// @param frequency  wg [rad/s], positive and finite
  /// @param damping    z, share of critical, positive and finite
  /// Reference: K. Kanai, Bull. Earthq. Res. Inst. 35 (1957), 309-325; H. Tajimi, 2nd WCEE (1960), 781-797.
  static Spectrum kanai_tajimi(double s0, double frequency, double damping);

  /// Kanai-Tajimi through a second filter, which takes the low frequencies out:
  ///     S = S_KT omega^4 / ((wf^2 - omega^2)^2 + 4 zf^2 wf^2 omega^2)
  /// @param filter_frequency  wf [rad/s], positive and finite
  /// @param filter_damping    zf, positive and finite
  /// Reference: R. W. Clough, J. Penzien, Dynamics of Structures (1975), 26-2.
  static Spectrum clough_penzien(double s0, double frequency, double damping, double filter_frequency,
                                 double filter_damping);

  /// Straight lines between the points given, zero outside.
  /// @param omega    [rad/s], at least two, the first at least 0, increasing, finite
  /// @param density  as many [m^2/s^3], at least 0, finite, not all zero
  static Spectrum from_table(std::vector<double> omega, std::vector<double> density);

  /// Any function of omega >= 0, zero outside [low, high].
  /// @param density    S(omega) [m^2/s^3], finite and at least 0 wherever it is asked for. Called once and again, from
  ///                   one thread at a time unless the spectrum is itself used from several.
  /// @param low, high  [rad/s], 0 <= low < high; high may be infinite
  /// @throws std::invalid_argument too where the function is negative or NaN (at which omega), or not integrable
  static Spectrum from_function(std::function<double(double)> density, double low,
                                double high = std::numeric_limits<double>::infinity());

  /// S at `omega` [m^2/s^3]; NaN for NaN.
  double operator()(double omega) const;

  /// Edges of the band on the positive side [rad/s]: S is zero outside; high may be infinite.
  double low() const noexcept;
  double high() const noexcept;

  /// Integral over the whole line [m^2/s^4]; infinite for white noise. Closed forms, and quadrature to 1e-10 for
  /// Clough-Penzien and functions.
  double variance() const noexcept { return variance_; }

  /// Variance that the band from `low` to `high` [rad/s] carries, on both sides of the line [m^2/s^4].
  /// @param low, high  0 <= low <= high; high may be infinite
  /// @throws std::invalid_argument for other limits
  double variance(double low, double high) const;

  /// Positive frequencies where S jumps or bends, and where its peaks are, ascending [rad/s]: an integral over S should
  /// be split there.
  std::vector<double> breakpoints() const;

  /// Which spectrum it is, with its parameters.
  const Form& form() const noexcept { return form_; }

  /// All of it as one JSON object, numbers in the shortest form that reads back the same. A function can't be written:
  /// its edges and fingerprint stand for it.
  std::string configuration() const;

  friend bool operator==(const Spectrum& a, const Spectrum& b) { return a.form_ == b.form_; }

 private:
  explicit Spectrum(Form form);

  Form form_;
  double variance_ = 0;
};

}  // namespace stickslip
