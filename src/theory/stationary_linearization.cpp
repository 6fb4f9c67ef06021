#include "stickslip/theory/stationary_linearization.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <utility>
#include <variant>
#include <vector>

#include "numerics/quadrature.hpp"
#include "stickslip/base/error.hpp"
#include "theory/ranges.hpp"

namespace stickslip::theory {
namespace {

using std::numbers::pi;

constexpr double infinity = std::numeric_limits<double>::infinity();

double squared(double x) { return x * x; }

/// (omega^2 - wn^2) / omega: without a spring omega.
double detuning(double omega, double wn) {
  return wn == 0 || std::isinf(omega) ? omega : (omega - wn) * ((omega + wn) / omega);
}

/// The zero of f, which increases through zero once: a bracket by doubling steps, then the false position (Anderson and
/// Bjorck, BIT 13 (1973)). `numerics::root` is not used because it halves the bracket first: far from the zero, the
/// integral behind f may not converge.
template <class F>
double rising_root(const F& f, double start) {
  double a = start, fa = f(a), b = a, fb = fa;
  for (double step = 1; (fa > 0) == (fb > 0); step *= 2) {
    a = b;
    fa = fb;
    b += fa > 0 ? -step : step;
    fb = f(b);
    if (!(step < 1e4)) throw ConvergenceError("StationaryLinearization: no damping below e^" + detail::shortest(b));
  }
  for (int i = 0; i < 200 && std::abs(b - a) > 2e-16 * std::max(1.0, std::abs(b)) && std::abs(fb) > 1e-16; ++i) {
    double c = b - fb * (b - a) / (fb - fa);
    if (!(c > std::min(a, b) && c < std::max(a, b))) c = a + (b - a) / 2;
    const double fc = f(c);
    if ((fc > 0) != (fb > 0)) {
      a = b;
      fa = fb;
    } else {
      const double shrink = 1 - fc / fb;
      fa *= shrink > 0 ? shrink : 0.5;
    }
    b = c;
    fb = fc;
  }
  return b;
}

/// The damping with zeta^2 sigma_v^2(zeta) = wanted, as a logarithm. `share` is the left side, which increases with
/// zeta to the whole variance; `lack` is the whole variance minus the left side, computed without cancellation: near
/// the threshold, it determines the solution.
template <class Share, class Lack>
double log_damping(double wanted, double excess, double start, const Share& share, const Lack& lack) {
  if (wanted < excess) return rising_root([&](double y) { return std::log(share(std::exp(y)) / wanted); }, start);
  return rising_root([&](double y) { return -std::log(lack(std::exp(y)) / excess); }, start);
}

// ---- the ideal band-pass without a spring, in units of its upper edge

/// (t - atan t) / t^3
double atan_lack(double t) {
  if (t > 0.5) return (t - std::atan(t)) / (t * t * t);
  double sum = 0, power = 1;
  for (int k = 3; std::abs(power) > 1e-17; k += 2, power *= -t * t) sum += power / k;
  return sum;
}

struct Band {
  double low, width;  // the upper edge is 1

  /// Of the angle Theta between the edges, thesis (4.32) corrected: the denominator is Z^2 + Omega1 Omega2.
  double tangent(double z) const { return width / (z + low / z); }
  /// int z^2 / (z^2 + w^2) dw = z Theta
  double share(double z) const { return z * std::atan(tangent(z)); }
  /// int w^2 / (z^2 + w^2) dw = width - z Theta
  double lack(double z) const {
    const double t = tangent(z);
    return t * (z * t * t * atan_lack(t) + low / z);
  }
  /// int 1 / (z^2 + w^2) dw
  double velocity(double z) const {
    const double t = tangent(z);
    return z > 0 ? std::atan(t) / z : width / low;
  }
  /// int 1 / (w^2 (z^2 + w^2)) dw, thesis (4.45)
  double displacement(double z) const {
    const double slope = width / (z * z + low);  // tangent / z
    return slope / low + slope * slope * slope * atan_lack(slope * z);
  }
};

// ---- any spectrum

/// The integral of S(omega) kernel(omega, r) over the whole line, by the detuning r, in which the linear system's gain
/// is 1 / (r^2 + zeta^2) with a spring as without:
///     omega = (r + sqrt(r^2 + 4 wn^2)) / 2,   d omega / dr = omega^2 / (omega^2 + wn^2)
/// @param width  of the kernel in r
template <class Kernel>
double integral_over(const Spectrum& spectrum, double wn, double width, const Kernel& kernel) {
  const auto side = [&](double sign) {
    double near = sign * detuning(spectrum.low(), wn), far = sign * detuning(spectrum.high(), wn);
    if (sign < 0) std::swap(near, far);
    near = std::max(near, 0.0);
    if (!(near < far)) return 0.0;
    std::vector<double> cuts = spectrum.breakpoints();
    for (double& cut : cuts) cut = sign * detuning(cut, wn);
    const double last = std::isfinite(far) ? far : std::max({1e3 * wn, 1e3 * width, cuts.empty() ? 0 : cuts.back()});
    for (const double scale : {width, wn})  // splits the declining part into pieces
      for (double cut = scale; cut > 0 && cut < last; cut *= 100) cuts.push_back(cut);
    std::ranges::sort(cuts);
    return detail::integral(
        [&](double u) {
          const double root = std::hypot(u, 2 * wn), omega = sign > 0 ? (u + root) / 2 : 2 * wn * (wn / (u + root));
          return spectrum(omega) * kernel(omega, sign * u) / (1 + squared(wn / omega));
        },
        near, far, cuts);
  };
  return 2 * (side(1) + side(-1));
}

/// S = factor omega^power near zero.
struct NearZero {
  double power, factor;
};

NearZero near_zero(const Spectrum& spectrum, double scale) {
  if (spectrum.low() > 0) return {infinity, 0};
  if (const auto* s = std::get_if<Spectrum::CloughPenzien>(&spectrum.form()))
    return {4, s->s0 / squared(squared(s->filter_frequency))};
  if (const auto* s = std::get_if<Spectrum::Table>(&spectrum.form())) {
    if (s->density[0] > 0) return {0, s->density[0]};
    return s->density[1] > 0 ? NearZero{1, s->density[1] / s->omega[1]} : NearZero{infinity, 0};
  }
  if (std::holds_alternative<Spectrum::Function>(spectrum.form())) {
    // From the slope of its logarithm, far below all relevant frequencies.
    const double near = 1e-12 * scale, far = 1e-9 * scale, at_near = spectrum(near), at_far = spectrum(far);
    if (at_near == 0) return {infinity, 0};
    double power = std::log(at_far / at_near) / std::log(far / near);
    if (std::abs(power - std::round(power)) < 1e-3) power = std::round(power);
    return {power, at_near / std::pow(near, power)};
  }
  return {0, spectrum(0)};
}

constexpr double critical = 0.79788456080286536;  // sqrt(2/pi), thesis (4.22)

/// sigma_n / a, in readable form.
std::string shown(double ratio) { return "sigma_n / a = " + detail::shortest(std::round(1e4 * ratio) / 1e4); }

/// The fraction of the variance of a ground acceleration below a frequency.
double variance_below(const Spectrum& spectrum, double frequency) {
  const double high = std::min(frequency, spectrum.high());
  if (!(high > spectrum.low()) || !std::isfinite(spectrum.variance())) return 0;
  std::vector<double> cuts = spectrum.breakpoints();
  std::erase_if(cuts, [&](double cut) { return !(cut > spectrum.low() && cut < high); });
  return 2 * detail::integral([&](double omega) { return spectrum(omega); }, spectrum.low(), high, cuts) /
         spectrum.variance();
}

/// The damping ratio of the filter that stands for the soil; 0 without one.
double soil_damping(const Spectrum& spectrum) {
  const auto damping = []<class Form>(const Form& form) -> double {
    if constexpr (requires { form.damping; })
      return form.damping;
    else
      return 0;
  };
  return std::visit(damping, spectrum.form());
}

std::string remark_of(double ratio, const Spectrum& spectrum, double wn, double low_power) {
  std::string remark;
  const auto add = [&](const std::string& more) { remark += (remark.empty() ? "" : "; ") + more; };
  if (ratio < 1.5 * critical) add(shown(ratio) + " is near sqrt(2/pi), thesis (4.22): velocities may be far too low");
  std::string outside;
  const auto leave = [&](const std::string& why) { outside += (outside.empty() ? "" : " and ") + why; };
  if (const double below = wn > 0 && std::isfinite(ratio) ? variance_below(spectrum, wn) : 0;
      below > detail::quasi_static_fraction)
    leave("the natural frequency of the spring exceeds those of " + detail::shortest(std::round(100 * below)) +
          " % of the variance of the ground acceleration");
  if (const double soil = soil_damping(spectrum); soil > detail::most_damped_soil)
    leave("the damping ratio of the soil, " + detail::shortest(soil) + ", exceeds " +
          detail::shortest(detail::most_damped_soil) + ", the largest one measured");
  else if (soil > detail::damped_soil)
    leave("the damping ratio of the soil, " + detail::shortest(soil) + ", exceeds " +
          detail::shortest(detail::damped_soil));
  if (!outside.empty()) add(outside + ": " + detail::stationary_range);
  if (wn == 0 && low_power > 0 && std::isfinite(ratio))
    add("no acceleration at zero frequency: under friction the displacement drifts all the same");
  return remark;
}

}  // namespace

void StationaryLinearization::check(const Slider<Coulomb>& slider) {
  detail::require_plain(slider, "StationaryLinearization");
  if (slider.law().forward() != slider.law().backward())
    throw std::invalid_argument(
        "StationaryLinearization: the slip level must be the same both ways, for what slides one way more easily "
        "drifts; "
        "got " +
        detail::shortest(slider.law().forward()) + " m/s^2 forward and " + detail::shortest(slider.law().backward()) +
        " m/s^2 backward");
}

double StationaryLinearization::threshold(const Slider<Coulomb>& slider, const StationaryNoise& noise) const {
  check(slider);
  return critical * slider.law().forward() / std::sqrt(noise.spectrum().variance());  // thesis (4.22)
}

StationaryPrediction StationaryLinearization::predict(const Slider<Coulomb>& slider, const Spectrum& spectrum) const {
  check(slider);
  const double a = slider.law().forward(), wn = slider.natural_frequency(), variance = spectrum.variance();
  const double wanted = 2 / pi * a * a;  // of zeta^2 sigma_v^2, thesis (4.19), (4.20)
  const double excess = variance - wanted, ratio = std::sqrt(variance) / a;
  StationaryPrediction p{0, 0, 0, 0, {}, spectrum, wn};
  if (!(excess > 0)) {
    p.damping = infinity;
    p.remark = shown(ratio) +
               " is not above sqrt(2/pi), thesis (4.22): no motion is predicted, though now and then friction lets go";
    return p;
  }

  const auto* white = std::get_if<Spectrum::White>(&spectrum.form());
  const auto* band_pass = wn == 0 ? std::get_if<Spectrum::BandPass>(&spectrum.form()) : nullptr;
  const Band band =
      band_pass ? Band{band_pass->low / band_pass->high, (band_pass->high - band_pass->low) / band_pass->high} : Band{};
  if (a > 0) {
    if (white) {
      p.damping = wanted / (pi * white->s0);  // int S0 / (omega^2 + zeta^2) = pi S0 / zeta, with a spring too
    } else if (band_pass) {
      const double unit = 2 * band_pass->s0 * band_pass->high;
      p.damping = band_pass->high * std::exp(log_damping(
                                        wanted / unit, excess / unit, 0, [&](double z) { return band.share(z); },
                                        [&](double z) { return band.lack(z); }));  // thesis (4.35)
    } else {
      const std::vector<double> known = spectrum.breakpoints();
      const auto share = [&](double zeta) {
        return integral_over(spectrum, wn, zeta, [=](double, double r) { return 1 / (1 + squared(r / zeta)); });
      };
      const auto lack = [&](double zeta) {
        return integral_over(spectrum, wn, zeta, [=](double, double r) { return 1 / (1 + squared(zeta / r)); });
      };
      p.damping = std::exp(log_damping(wanted, excess, known.empty() ? 0 : std::log(known.back()), share, lack));
    }
  }

  // The low-frequency power of the velocity's spectrum, omega^power, determines the behavior of the displacement.
  const double zeta = p.damping;
  const NearZero begin = near_zero(spectrum, zeta > 0 ? zeta : std::isfinite(spectrum.high()) ? spectrum.high() : 1);
  const double power = begin.power + (wn > 0 ? 2 : zeta > 0 ? 0 : -2);
  const bool resonant = zeta == 0 && wn > 0 && spectrum(wn) > 0;
  const double h = zeta > 0 ? squared(1 / zeta) : 1;
  p.growth_rate = resonant || power < 0 ? infinity : power > 0 ? 0 : 2 * pi * begin.factor * h;  // thesis (4.13)
  if (zeta > 0)
    p.velocity_std = critical * a / zeta;  // thesis (4.19)
  else if (resonant || power <= -1)
    p.velocity_std = infinity;
  else if (band_pass)
    p.velocity_std = std::sqrt(2 * band_pass->s0 / band_pass->high * band.velocity(0));
  else
    p.velocity_std = std::sqrt(integral_over(spectrum, wn, 0, [](double, double r) { return 1 / (r * r); }));

  if (resonant || power <= 1)
    p.displacement_std = infinity;
  else if (white)
    p.displacement_std = p.velocity_std / wn;
  else if (band_pass)
    p.displacement_std =
        std::sqrt(2 * band_pass->s0 / band_pass->high * band.displacement(zeta / band_pass->high)) / band_pass->high;
  else
    p.displacement_std = std::sqrt(integral_over(spectrum, wn, zeta, [=](double w, double r) {
      return 1 / (squared(w) * (r * r + zeta * zeta));
    }));  // thesis (4.12)
  p.remark = remark_of(ratio, spectrum, wn, begin.power);
  return p;
}

double StationaryPrediction::velocity_spectrum(double omega) const {
  const double s = spectrum(omega);
  if (s == 0 || std::isinf(damping)) return 0;
  if (omega == 0 && natural_frequency > 0) return 0;
  return s / (squared(detuning(std::abs(omega), natural_frequency)) + squared(damping));
}

// ---- from rest

namespace {

using Complex = std::complex<double>;

/// x and x' after a time, of those at the beginning.
struct Transition {
  double xx = 1, xv = 0, vx = 0, vv = 1;

  Transition(double zeta, double wn, double time) {
    const double half = zeta / 2, beyond = (half - wn) * (half + wn), root = std::sqrt(std::abs(beyond));
    double mean = 0;
    if (beyond >= 0) {
      const double fast = half + root, slow = fast > 0 ? wn * (wn / fast) : 0, es = std::exp(-slow * time);
      xv = root > 0 ? es * -std::expm1(-2 * root * time) / (2 * root) : es * time;
      mean = (es + std::exp(-fast * time)) / 2;
    } else {
      const double decay = std::exp(-half * time);
      xv = decay * std::sin(root * time) / root;
      mean = decay * std::cos(root * time);
    }
    xx = mean + half * xv;
    vv = mean - half * xv;
    vx = -wn * wn * xv;
  }
};

/// The linear system from rest, under one frequency for a time t. With A_i the integral of h_i(u) exp(-i omega u) from
/// 0 to t it is about |weight_v A_v + weight_x A_x|^2, whose integrals give all moments without differences.
class FromRest {
 public:
  /// `straight` is for frequencies of at most wn + slow_phase / t.
  static constexpr double slow_phase = 4;

  FromRest(double zeta, double wn, double time) : zeta_(zeta), wn_(wn), whole_(zeta, wn, time) {
    const int halvings = static_cast<int>(std::ceil(std::log2((zeta + 2 * wn) * time + slow_phase)));
    part_ = std::ldexp(time, -halvings);
    for (int i = halvings; i > 0; --i) parts_.emplace_back(zeta, wn, std::ldexp(time, -i));
  }

  double weight_v = 0, weight_x = 0;

  /// Without cancellation, at frequencies so near to zero or to the spring's that little has turned in the time: by a
  /// power series for a part of the time, which is doubled.
  double straight(double omega) const {
    Complex x = 0, v = part_, term_x = 0, term_v = part_;
    for (int k = 2; k < 20; ++k) {
      const Complex next_x = term_v - Complex(0, omega) * term_x,
                    next_v = -(Complex(zeta_, omega) * term_v + wn_ * wn_ * term_x);
      term_x = next_x * (part_ / k);
      term_v = next_v * (part_ / k);
      x += term_x;
      v += term_v;
    }
    Complex turn = std::polar(1.0, -omega * part_);
    for (const Transition& part : parts_) {
      const Complex later_x = part.xx * x + part.xv * v, later_v = part.vx * x + part.vv * v;
      x += turn * later_x;
      v += turn * later_v;
      turn *= turn;
    }
    return std::norm(weight_v * v + weight_x * x);
  }

  /// The same as steady + cosine cos(omega t) + sine sin(omega t).
  double steady(double w) const {
    const Transition& p = whole_;
    return sum(w, 1 + squared(p.vv) + squared(p.vx / w), 1 + squared(p.xx) + squared(w * p.xv),
               w * p.xv * p.vv + p.xx * p.vx / w);
  }
  double cosine(double w) const { return sum(w, -2 * whole_.vv, -2 * whole_.xx, -(w * whole_.xv + whole_.vx / w)); }
  double sine(double w) const { return sum(w, 2 * whole_.vx / w, -2 * w * whole_.xv, whole_.xx - whole_.vv); }

 private:
  double sum(double w, double vv, double xx, double xv) const {
    const double to_x = weight_x / w;
    return (weight_v * weight_v * vv + to_x * to_x * xx + 2 * weight_v * to_x * xv) /
           (squared(detuning(w, wn_)) + squared(zeta_));
  }

  double zeta_, wn_, part_;
  Transition whole_;
  std::vector<Transition> parts_;  // of the part's length, twice that, ... half of the time
};

/// From `low` to `high`, and whether it is to be taken straight.
struct Section {
  double low, high;
  bool straight;
};

std::vector<Section> sections_of(const Spectrum& spectrum, double zeta, double wn, double time) {
  const double near = FromRest::slow_phase / time;
  const double begin = wn > 2 * near ? wn - near : 0;  // of what is straight about the spring's frequency
  std::vector<double> cuts = spectrum.breakpoints();
  cuts.insert(cuts.end(), {spectrum.low(), spectrum.high(), wn, zeta, begin, wn + near, near});
  double last = std::max({wn, zeta, spectrum.breakpoints().empty() ? 0 : spectrum.breakpoints().back()});
  if (last == 0) last = 1e-15 * near;  // nothing shows where the spectrum is strong
  for (double cut = 10 * last; cut > 0 && cut < near; cut *= 10)
    cuts.push_back(cut);  // splits the declining part into pieces
  std::ranges::sort(cuts);
  std::vector<Section> sections;
  for (std::size_t i = 1; i < cuts.size(); ++i) {
    const double low = cuts[i - 1], high = cuts[i];
    if (!(low < high) || low < spectrum.low() || high > spectrum.high()) continue;
    sections.push_back({low, high, high <= near || (low >= begin && high <= wn + near)});
  }
  return sections;
}

/// White noise of level 1, from the impulse response of the system.
std::array<double, 3> from_rest_in_white_noise(double zeta, double wn, double time) {
  const double scale = 1 / (zeta + wn);
  const std::vector<double> cuts{scale, 10 * scale, 40 * scale};
  const auto after = [&](auto member) { return [=](double u) { return squared(Transition(zeta, wn, u).*member); }; };
  return {2 * pi * detail::integral(after(&Transition::vv), 0, time, cuts),
          2 * pi * detail::integral(after(&Transition::xv), 0, time, cuts),
          pi * squared(Transition(zeta, wn, time).xv)};
}

/// Variances of velocity and displacement, and their covariance.
std::array<double, 3> from_rest(const Spectrum& spectrum, double zeta, double wn, double time) {
  if (const auto* white = std::get_if<Spectrum::White>(&spectrum.form())) {
    auto moments = from_rest_in_white_noise(zeta, wn, time);
    for (double& moment : moments) moment *= white->s0;
    return moments;
  }
  FromRest system(zeta, wn, time);
  const std::vector<Section> sections = sections_of(spectrum, zeta, wn, time);
  const auto mean_square = [&](double weight_v, double weight_x) {
    system.weight_v = weight_v;
    system.weight_x = weight_x;
    double sum = 0;
    for (const auto& [low, high, straight] : sections)
      sum += detail::integral(
          [&, is_straight = straight](double w) {
            return spectrum(w) * (is_straight ? system.straight(w) : system.steady(w));
          },
          low, high);
    const double tolerance = 1e-11 * sum;
    if (!(tolerance > 0)) return 0.0;
    for (const auto& [low, high, straight] : sections) {
      if (straight) continue;
      sum +=
          detail::cosine_integral([&](double w) { return spectrum(w) * system.cosine(w); }, time, low, high, tolerance);
      sum += detail::sine_integral([&](double w) { return spectrum(w) * system.sine(w); }, time, low, high, tolerance);
    }
    return 2 * sum;
  };
  const double v = mean_square(1, 0), x = mean_square(0, 1);
  if (!(v > 0 && x > 0)) return {v, x, 0};
  const double rate = std::sqrt(v / x);
  return {v, x, (mean_square(1, rate) - v - rate * rate * x) / (2 * rate)};
}

}  // namespace

Moments StationaryPrediction::transient(std::span<const double> times, const std::function<void()>& progress) const {
  for (const double time : times)
    detail::require(std::isfinite(time) && time >= 0, "StationaryPrediction: times must be finite and at least 0", time,
                    "s");
  Moments moments;
  moments.time.assign(times.begin(), times.end());
  for (const double time : times) {
    if (progress) progress();
    const auto [v, x, xv] = time == 0 || std::isinf(damping) ? std::array<double, 3>{}
                                                             : from_rest(spectrum, damping, natural_frequency, time);
    moments.velocity_variance.value.push_back(v);
    moments.displacement_variance.value.push_back(x);
    moments.covariance.value.push_back(xv);
  }
  const std::vector<double> zeros(times.size());
  moments.displacement_mean = moments.velocity_mean = {zeros, zeros};
  for (Estimates* figures : {&moments.displacement_variance, &moments.covariance, &moments.velocity_variance})
    figures->error = zeros;
  moments.growth_rate = {growth_rate, 0};
  moments.remark = remark;
  return moments;
}

}  // namespace stickslip::theory
