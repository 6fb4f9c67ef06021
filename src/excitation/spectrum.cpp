#include "stickslip/excitation/spectrum.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <string_view>

#include "base/json.hpp"
#include "base/table.hpp"
#include "numerics/quadrature.hpp"
#include "stickslip/base/error.hpp"

namespace stickslip {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

template <class... Cases>
struct Overloaded : Cases... {
  using Cases::operator()...;
};
template <class... Cases>
Overloaded(Cases...) -> Overloaded<Cases...>;  // clang before 17 does not know

void require_positive(const char* name, double value, const char* unit) {
  detail::require(std::isfinite(value) && value > 0, "Spectrum: " + std::string(name) + " must be positive and finite",
                  value, unit);
}

void require_band(double low, double high) {
  detail::require(std::isfinite(low) && low >= 0, "Spectrum: low must be finite and at least 0", low, "rad/s");
  detail::require(high > low, "Spectrum: high must be above low = " + detail::shortest(low) + " rad/s", high, "rad/s");
}

/// |H|^2 of a filter of one mode, with its numerator given relative to w^4, x = omega / w.
double resonance(double numerator, double x, double damping) {
  const double detuning = (1 - x) * (1 + x);
  return numerator / (detuning * detuning + 4 * damping * damping * x * x);
}

double kanai_tajimi_factor(double omega, double frequency, double damping) {
  const double x = omega / frequency, soft = 2 * damping * x;
  if (x > 1e50) return (1 / (x * x) + 4 * damping * damping) / (x * x);  // x^4 would overflow
  return resonance(1 + soft * soft, x, damping);
}

double high_pass_factor(double omega, double frequency, double damping) {
  const double x = omega / frequency;
  return x > 1e9 ? 1 : resonance(x * x * x * x, x, damping);
}

/// The integral of the table from its first point to `omega`, on one side of the line.
double integral_to(const Spectrum::Table& table, double omega) {
  double sum = 0;
  for (std::size_t i = 1; i < table.omega.size() && table.omega[i - 1] < omega; ++i) {
    const double end = std::min(omega, table.omega[i]);
    sum +=
        (end - table.omega[i - 1]) / 2 * (table.density[i - 1] + detail::interpolated(table.omega, table.density, end));
  }
  return sum;
}

/// FNV-1a, of floats: the last bits of doubles are the mathematical library's.
std::uint64_t hash(std::span<const double> values) {
  std::uint64_t result = 0xcbf29ce484222325u;
  for (const double value : values) {
    const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(value));
    for (int byte = 0; byte < 4; ++byte) result = (result ^ (bits >> (8 * byte) & 0xFFu)) * 0x100000001b3u;
  }
  return result;
}

}  // namespace

Spectrum Spectrum::white(double s0) {
  require_positive("s0", s0, "m^2/s^3");
  return Spectrum(White{s0});
}

Spectrum Spectrum::band_pass(double s0, double low, double high) {
  require_positive("s0", s0, "m^2/s^3");
  require_band(low, high);
  detail::require(std::isfinite(high), "Spectrum: high must be finite", high, "rad/s");
  return Spectrum(BandPass{s0, low, high});
}

Spectrum Spectrum::kanai_tajimi(double s0, double frequency, double damping) {
  require_positive("s0", s0, "m^2/s^3");
  require_positive("frequency", frequency, "rad/s");
  require_positive("damping", damping, "");
  return Spectrum(KanaiTajimi{s0, frequency, damping});
}

Spectrum Spectrum::clough_penzien(double s0, double frequency, double damping, double filter_frequency,
                                  double filter_damping) {
  require_positive("s0", s0, "m^2/s^3");
  require_positive("frequency", frequency, "rad/s");
  require_positive("damping", damping, "");
  require_positive("filter_frequency", filter_frequency, "rad/s");
  require_positive("filter_damping", filter_damping, "");
  return Spectrum(CloughPenzien{s0, frequency, damping, filter_frequency, filter_damping});
}

Spectrum Spectrum::from_table(std::vector<double> omega, std::vector<double> density) {
  detail::require_table("Spectrum", omega, {"omega", "rad/s"}, density, {"density", "m^2/s^3"});
  detail::require(omega.front() >= 0, "Spectrum: omega[0] must be at least 0", omega.front(), "rad/s");
  if (std::ranges::all_of(density, [](double s) { return s == 0; }))
    throw std::invalid_argument("Spectrum: density must not be zero everywhere");
  return Spectrum(Table{std::move(omega), std::move(density)});
}

Spectrum Spectrum::from_function(std::function<double(double)> density, double low, double high) {
  if (!density) throw std::invalid_argument("Spectrum: density must be a function, got an empty one");
  require_band(low, high);
  return Spectrum(Function{std::make_shared<const std::function<double(double)>>(std::move(density)), low, high, 0});
}

Spectrum::Spectrum(Form form) : form_(std::move(form)) {
  try {
    variance_ = std::visit(Overloaded{[](const White&) { return infinity; },
                                      [](const KanaiTajimi& s) {
                                        return std::numbers::pi * s.s0 * s.frequency * (1 + 4 * s.damping * s.damping) /
                                               (2 * s.damping);
                                      },
                                      [this](const auto&) { return variance(0, infinity); }},
                           form_);
  } catch (const ConvergenceError& error) {
    throw std::invalid_argument(std::string("Spectrum: must be integrable, but its ") + error.what());
  }
  if (std::holds_alternative<White>(form_)) return;
  detail::require(std::isfinite(variance_) && variance_ > 0, "Spectrum: its variance must be positive and finite",
                  variance_, "m^2/s^4");
  if (auto* s = std::get_if<Function>(&form_)) {
    constexpr int points = 1024;
    std::vector<double> values = {variance_};
    for (int i = 0; i < points; ++i) {
      const double share = (i + 0.5) / points;  // of the band, or of nine decades of an endless one
      values.push_back(
          (*this)(s->low + (std::isinf(s->high) ? std::pow(10, 9 * share - 3) : share * (s->high - s->low))));
    }
    s->fingerprint = hash(values);
  }
}

double Spectrum::operator()(double omega) const {
  const double w = std::abs(omega);
  if (!(w >= low() && w <= high())) return std::isnan(w) ? w : 0;
  return std::visit(
      Overloaded{[](const White& s) { return s.s0; }, [](const BandPass& s) { return s.s0; },
                 [w](const KanaiTajimi& s) { return s.s0 * kanai_tajimi_factor(w, s.frequency, s.damping); },
                 [w](const CloughPenzien& s) {
                   return s.s0 * kanai_tajimi_factor(w, s.frequency, s.damping) *
                          high_pass_factor(w, s.filter_frequency, s.filter_damping);
                 },
                 [w](const Table& s) { return detail::interpolated(s.omega, s.density, w); },
                 [w](const Function& s) {
                   const double value = (*s.density)(w);
                   detail::require(
                       std::isfinite(value) && value >= 0,
                       "Spectrum: density must be finite and at least 0 at omega = " + detail::shortest(w) + " rad/s",
                       value, "m^2/s^3");
                   return value;
                 }},
      form_);
}

double Spectrum::low() const noexcept {
  if (const auto* s = std::get_if<BandPass>(&form_)) return s->low;
  if (const auto* s = std::get_if<Table>(&form_)) return s->omega.front();
  if (const auto* s = std::get_if<Function>(&form_)) return s->low;
  return 0;
}

double Spectrum::high() const noexcept {
  if (const auto* s = std::get_if<BandPass>(&form_)) return s->high;
  if (const auto* s = std::get_if<Table>(&form_)) return s->omega.back();
  if (const auto* s = std::get_if<Function>(&form_)) return s->high;
  return infinity;
}

double Spectrum::variance(double low, double high) const {
  detail::require(low >= 0, "Spectrum: a band must begin at 0 or above", low, "rad/s");
  detail::require(high >= low, "Spectrum: a band must end above its beginning, " + detail::shortest(low) + " rad/s",
                  high, "rad/s");
  const double from = std::max(low, this->low()), to = std::min(high, this->high());
  if (!(from < to)) return 0;
  return 2 * std::visit(Overloaded{[&](const White& s) { return s.s0 * (to - from); },
                                   [&](const BandPass& s) { return s.s0 * (to - from); },
                                   [&](const Table& s) { return integral_to(s, to) - integral_to(s, from); },
                                   [&](const auto&) {
                                     return detail::integral([this](double w) { return (*this)(w); }, from, to,
                                                             breakpoints());
                                   }},
                        form_);
}

std::vector<double> Spectrum::breakpoints() const {
  std::vector<double> result =
      std::visit(Overloaded{[](const White&) { return std::vector<double>{}; },
                            [](const BandPass& s) {
                              return std::vector<double>{s.low, s.high};
                            },
                            [](const KanaiTajimi& s) { return std::vector<double>{s.frequency}; },
                            [](const CloughPenzien& s) {
                              return std::vector<double>{std::min(s.frequency, s.filter_frequency),
                                                         std::max(s.frequency, s.filter_frequency)};
                            },
                            [](const Table& s) { return s.omega; },
                            [](const Function& s) {
                              return std::vector<double>{s.low, s.high};
                            }},
                 form_);
  std::erase_if(result, [](double w) { return w == 0 || std::isinf(w); });
  return result;
}

std::string Spectrum::configuration() const {
  const auto object = [](std::string_view kind, auto... fields) {
    std::string text = R"({"kind": ")" + std::string(kind) + '"';
    ((text.append(", \"").append(fields.first).append("\": ").append(detail::json(fields.second))), ...);
    return text + "}";
  };
  using Number = std::pair<const char*, double>;
  using Numbers = std::pair<const char*, std::span<const double>>;
  return std::visit(
      Overloaded{
          [&](const White& s) { return object("white", Number("s0", s.s0)); },
          [&](const BandPass& s) {
            return object("band_pass", Number("s0", s.s0), Number("low", s.low), Number("high", s.high));
          },
          [&](const KanaiTajimi& s) {
            return object("kanai_tajimi", Number("s0", s.s0), Number("frequency", s.frequency),
                          Number("damping", s.damping));
          },
          [&](const CloughPenzien& s) {
            return object("clough_penzien", Number("s0", s.s0), Number("frequency", s.frequency),
                          Number("damping", s.damping), Number("filter_frequency", s.filter_frequency),
                          Number("filter_damping", s.filter_damping));
          },
          [&](const Table& s) { return object("table", Numbers("omega", s.omega), Numbers("density", s.density)); },
          [&](const Function& s) {
            return object("function", Number("low", s.low), Number("high", s.high),
                          std::pair("fingerprint", s.fingerprint));
          }},
      form_);
}

}  // namespace stickslip
