// Spectral density of a random acceleration.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "stickslip/base/equal.hpp"
#include "stickslip/base/requirements.hpp"

namespace stickslip {

/// The two-sided spectral density S(omega) of a stationary ground acceleration [m^2/s^3], omega in rad/s:
///
///     variance = integral of S over the whole line,   S(-omega) = S(omega),   white noise has R(t) = 2 pi S0 delta(t)
///
/// (A one-sided density G(omega) is 2 S(omega); one over hertz, G(f), is 4 pi S(2 pi f).) Immutable. The
/// functions below create spectra; each rejects values out of range with std::invalid_argument, naming the value.
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
    /// Functions compare by their values.
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

  /// White noise in the rock, filtered by one mode of a soil layer, at the surface:
  ///     S = s0 (wg^4 + 4 z^2 wg^2 omega^2) / ((wg^2 - omega^2)^2 + 4 z^2 wg^2 omega^2)
  /// It keeps S(0) = s0, so that ground velocity and displacement grow without bound; see `clough_penzien`.
  /// @param s0         level in the rock [m^2/s^3], positive and finite
  /// @param frequency  wg [rad/s], positive and finite
  /// @param damping    z, fraction of critical damping, positive and finite
  /// Reference: K. Kanai, Bull. Earthq. Res. Inst. 35 (1957), 309-325; H. Tajimi, 2nd WCEE (1960), 781-797.
  static Spectrum kanai_tajimi(double s0, double frequency, double damping);

  /// Kanai-Tajimi spectrum with a second filter, which removes the low frequencies:
  ///     S = S_KT omega^4 / ((wf^2 - omega^2)^2 + 4 zf^2 wf^2 omega^2)
  /// @param filter_frequency  wf [rad/s], positive and finite
  /// @param filter_damping    zf, positive and finite
  /// Reference: R. W. Clough, J. Penzien, Dynamics of Structures (1975), 26-2.
  static Spectrum clough_penzien(double s0, double frequency, double damping, double filter_frequency,
                                 double filter_damping);

  /// Piecewise linear between the given points, zero outside.
  /// @param omega    [rad/s], at least two, the first at least 0, increasing, finite
  /// @param density  one value per frequency [m^2/s^3], at least 0, finite, not all zero
  static Spectrum from_table(std::vector<double> omega, std::vector<double> density);

  /// Any function of omega >= 0, zero outside [low, high].
  /// @param density    S(omega) [m^2/s^3], finite and at least 0. It is called many times, from one thread at a time
  ///                   unless the spectrum itself is used from several threads.
  /// @param low, high  [rad/s], 0 <= low < high; high may be infinite
  /// @throws std::invalid_argument  also if the function is negative or NaN (with the omega), or not integrable
  static Spectrum from_function(std::function<double(double)> density, double low,
                                double high = std::numeric_limits<double>::infinity());

  /// S at `omega` [m^2/s^3]; NaN for NaN.
  double operator()(double omega) const;

  /// Edges of the band on the positive side [rad/s]: S is zero outside; high may be infinite.
  double low() const noexcept;
  double high() const noexcept;

  /// Variance: the integral over all omega [m^2/s^4]; infinite for white noise. Closed forms; quadrature to 1e-10 for
  /// Clough-Penzien spectra and functions.
  double variance() const noexcept { return variance_; }

  /// Variance in the band from `low` to `high` [rad/s], at positive and negative omega [m^2/s^4].
  /// @param low, high  0 <= low <= high; high may be infinite
  /// @throws std::invalid_argument for other limits
  double variance(double low, double high) const;

  /// Positive frequencies of the jumps, kinks and peaks of S, ascending [rad/s]: split integrals over S there.
  std::vector<double> breakpoints() const;

  /// The kind of spectrum and its parameters.
  const Form& form() const noexcept { return form_; }

  /// The spectrum as one JSON object, with numbers in the shortest form that reads back exactly. A function is
  /// represented by its edges and a fingerprint.
  std::string configuration() const;

  friend bool operator==(const Spectrum& a, const Spectrum& b) { return a.form_ == b.form_; }

 private:
  explicit Spectrum(Form form);

  Form form_;
  double variance_ = 0;
};

}  // namespace stickslip
