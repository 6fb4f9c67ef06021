// Spectra: two-sided, even, and their variance is their integral.
#include "stickslip/excitation/spectrum.hpp"

#include <numbers>

#include "support/catch.hpp"
#include "support/motions.hpp"

using namespace stickslip;
using namespace test;
using Catch::Matchers::ContainsSubstring;
using std::numbers::pi;

namespace {

const Spectrum soil = Spectrum::kanai_tajimi(2, 15, 0.6);

std::vector<Spectrum> one_of_each() {
  return {Spectrum::white(1.5),
          Spectrum::band_pass(1.5, 2, 5),
          soil,
          Spectrum::clough_penzien(2, 15, 0.6, 1.5, 0.6),
          Spectrum::from_table({0, 1, 4}, {1, 3, 0}),
          Spectrum::from_function([](double w) { return std::exp(-w); }, 0.5, 8)};
}

/// Simpson's rule in the angle atan(omega), which brings the whole line into reach: another way than the library's.
double simpson(const Spectrum& s) {
  const int n = 2'000'000;
  const auto f = [&](int i) {
    const double angle = static_cast<double>(i) / n * pi / 2, c = std::cos(angle);
    return i == n ? 2e16 * s(1e8) : 2 * s(std::tan(angle)) / (c * c);  // the limit of S omega^2
  };
  double sum = 0;
  for (int i = 0; i < n; i += 2) sum += f(i) + 4 * f(i + 1) + f(i + 2);
  return sum * pi / 2 / n / 3;
}

}  // namespace

TEST_CASE("spectra are even, and zero outside their band", "[spectrum]") {
  for (const Spectrum& s : one_of_each()) {
    INFO(s.configuration());
    for (const double w : {0.0, 0.3, 2.0, 3.7, 15.0, 1e6}) {
      CHECK(s(w) == s(-w));
      CHECK(s(w) >= 0);
      if (w < s.low() || w > s.high()) CHECK(s(w) == 0);
    }
    CHECK(std::isnan(s(not_a_number)));
  }
}

TEST_CASE("variance is the integral over the whole line", "[spectrum]") {
  CHECK(Spectrum::band_pass(1.5, 2, 5).variance() == 9);  // 2 x 1.5 x 3
  CHECK(Spectrum::from_table({0, 1, 4}, {1, 3, 0}).variance() == 2 * (2 + 4.5));
  CHECK(std::isinf(Spectrum::white(1).variance()));
  CHECK(Spectrum::from_function([](double w) { return std::exp(-w); }, 0).variance() == Approx(2).epsilon(1e-10));
  CHECK(Spectrum::from_function([](double w) { return 1 / std::sqrt(w); }, 0, 4).variance() ==
        Approx(8).epsilon(1e-9));  // integrable, though it has no value at zero
}

TEST_CASE("Kanai-Tajimi has variance pi S0 wg (1 + 4 z^2) / (2 z), whatever its damping", "[spectrum]") {
  for (const double z : {0.001, 0.05, 0.6, 1.0, 3.0}) {
    const Spectrum s = Spectrum::kanai_tajimi(2, 15, z);
    INFO(z);
    CHECK(s.variance() == Approx(pi * 2 * 15 * (1 + 4 * z * z) / (2 * z)).epsilon(1e-15));
    CHECK(s.variance(0, infinity) == Approx(s.variance()).epsilon(1e-9));  // by quadrature
  }
  CHECK(soil(0) == 2);
  CHECK(soil(15) == Approx(2 * (1 + 4 * 0.36) / (4 * 0.36)).epsilon(1e-15));
  CHECK(soil(1e60) > 0);
  CHECK(soil(1e60) == Approx(2 * 4 * 0.36 * 225e-120).epsilon(1e-12));
}

TEST_CASE("Clough-Penzien has nothing at zero, Kanai-Tajimi above its filter, and a finite variance", "[spectrum]") {
  const Spectrum s = Spectrum::clough_penzien(2, 15, 0.6, 1.5, 0.6);
  CHECK(s(0) == 0);
  CHECK(s(1e-3) == Approx(2 * std::pow(1e-3 / 1.5, 4)).epsilon(1e-5));
  CHECK(s(1.5) == Approx(soil(1.5) / (4 * 0.36)).epsilon(1e-14));
  CHECK(s(1e5) == Approx(soil(1e5)).epsilon(1e-9));
  CHECK(s(1e30) == soil(1e30));
  CHECK(s.variance() == Approx(simpson(s)).epsilon(1e-9));
  CHECK(soil.variance() == Approx(simpson(soil)).epsilon(1e-9));
}

TEST_CASE("the parts of a band add up, and are counted on both sides of the line", "[spectrum]") {
  for (const Spectrum& s : one_of_each()) {
    INFO(s.configuration());
    CHECK(s.variance(1, 1) == 0);
    CHECK(s.variance(0, 0.7) + s.variance(0.7, 3.3) + s.variance(3.3, 20) == Approx(s.variance(0, 20)).epsilon(1e-9));
    CHECK(s.variance(0, infinity) == Approx(s.variance()).epsilon(1e-9));
    CHECK(s.variance(2.5, 2.501) == Approx(2 * 0.001 * s(2.5005)).epsilon(1e-6));
  }
  CHECK(Spectrum::band_pass(1, 2, 5).variance(4, 9) == 2);
  CHECK(Spectrum::white(3).variance(1, 2) == 6);
}

TEST_CASE("a table is straight between its points and includes its ends", "[spectrum]") {
  const Spectrum s = Spectrum::from_table({1, 2, 4}, {1, 3, 2});
  CHECK((s(0.999) == 0 && s(1) == 1 && s(1.5) == 2 && s(2) == 3 && s(3) == 2.5 && s(4) == 2 && s(4.001) == 0));
  CHECK((s.low() == 1 && s.high() == 4));
}

TEST_CASE("an integral over a spectrum is told where to split", "[spectrum]") {
  CHECK(Spectrum::white(1).breakpoints().empty());
  CHECK(Spectrum::band_pass(1, 0, 5).breakpoints() == std::vector<double>{5});
  CHECK(Spectrum::band_pass(1, 2, 5).breakpoints() == std::vector<double>{2, 5});
  CHECK(soil.breakpoints() == std::vector<double>{15});
  CHECK(Spectrum::clough_penzien(2, 15, 0.6, 1.5, 0.6).breakpoints() == std::vector<double>{1.5, 15});
  CHECK(Spectrum::from_table({0, 1, 4}, {1, 3, 0}).breakpoints() == std::vector<double>{1, 4});
  CHECK(Spectrum::from_function([](double) { return 1.0; }, 1, 2).breakpoints() == std::vector<double>{1, 2});
}

TEST_CASE("spectra are equal where they are the same, and can be written down", "[spectrum]") {
  const auto all = one_of_each();
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t j = 0; j < all.size(); ++j) CHECK((all[i] == one_of_each()[j]) == (i == j));
  CHECK(Spectrum::white(1) == Spectrum::white(1));
  CHECK_FALSE(Spectrum::white(1) == Spectrum::white(2));
  CHECK_FALSE(all[5] == Spectrum::from_function([](double w) { return 1.001 * std::exp(-w); }, 0.5, 8));
  CHECK(all[1].configuration() == R"({"kind": "band_pass", "s0": 1.5, "low": 2, "high": 5})");
  CHECK(all[4].configuration() == R"({"kind": "table", "omega": [0, 1, 4], "density": [1, 3, 0]})");
  CHECK_THAT(Spectrum::from_function([](double w) { return std::exp(-w); }, 0).configuration(),
             ContainsSubstring(R"({"kind": "function", "low": 0, "high": null, "fingerprint": ")"));
}

TEST_CASE("what is no spectrum is refused by name", "[spectrum][errors]") {
  CHECK_THROWS_WITH(Spectrum::white(0), "Spectrum: s0 must be positive and finite, got 0 m^2/s^3");
  CHECK_THROWS_WITH(Spectrum::white(not_a_number), "Spectrum: s0 must be positive and finite, got nan m^2/s^3");
  CHECK_THROWS_WITH(Spectrum::band_pass(-1, 1, 2), "Spectrum: s0 must be positive and finite, got -1 m^2/s^3");
  CHECK_THROWS_WITH(Spectrum::band_pass(1, 2, 1), "Spectrum: high must be above low = 2 rad/s, got 1 rad/s");
  CHECK_THROWS_WITH(Spectrum::band_pass(1, 2, 2), "Spectrum: high must be above low = 2 rad/s, got 2 rad/s");
  CHECK_THROWS_WITH(Spectrum::band_pass(1, -2, 2), "Spectrum: low must be finite and at least 0, got -2 rad/s");
  CHECK_THROWS_WITH(Spectrum::band_pass(1, 2, infinity), "Spectrum: high must be finite, got inf rad/s");
  CHECK_THROWS_WITH(Spectrum::kanai_tajimi(1, 0, 1), "Spectrum: frequency must be positive and finite, got 0 rad/s");
  CHECK_THROWS_WITH(Spectrum::kanai_tajimi(1, 1, -1), "Spectrum: damping must be positive and finite, got -1");
  CHECK_THROWS_WITH(Spectrum::clough_penzien(1, 1, 1, 1, 0),
                    "Spectrum: filter_damping must be positive and finite, got 0");
  CHECK_THROWS_WITH(Spectrum::from_table({0, 1}, {1, -2}),
                    "Spectrum: density[1] must be finite and at least 0, got -2 m^2/s^3");
  CHECK_THROWS_WITH(Spectrum::from_table({0, 2, 1}, {1, 1, 1}),
                    "Spectrum: omega[2] must come after 2 rad/s, got 1 rad/s");
  CHECK_THROWS_WITH(Spectrum::from_table({-1, 1}, {1, 1}), "Spectrum: omega[0] must be at least 0, got -1 rad/s");
  CHECK_THROWS_WITH(Spectrum::from_table({0, 1}, {0, 0}), "Spectrum: density must not be zero everywhere");
  CHECK_THROWS_WITH(soil.variance(-1, 1), "Spectrum: a band must begin at 0 or above, got -1 rad/s");
  CHECK_THROWS_WITH(soil.variance(2, 1), "Spectrum: a band must end above its beginning, 2 rad/s, got 1 rad/s");
}

TEST_CASE("functions that are negative, NaN or not integrable are refused", "[spectrum][errors]") {
  CHECK_THROWS_WITH(Spectrum::from_function([](double w) { return 1 - w; }, 0, 3),
                    ContainsSubstring("Spectrum: density must be finite and at least 0 at omega = ") &&
                        ContainsSubstring(" rad/s, got -"));
  CHECK_THROWS_WITH(Spectrum::from_function([](double) { return not_a_number; }, 0, 3),
                    ContainsSubstring("got nan m^2/s^3"));
  CHECK_THROWS_WITH(Spectrum::from_function([](double) { return 1.0; }, 0),
                    ContainsSubstring("Spectrum: must be integrable, but its integral from 0 to inf: reached "));
  CHECK_THROWS_WITH(Spectrum::from_function([](double w) { return 1 / w; }, 0, 1),
                    ContainsSubstring("Spectrum: must be integrable"));
  CHECK_THROWS_WITH(Spectrum::from_function([](double) { return 0.0; }, 0, 1),
                    "Spectrum: its variance must be positive and finite, got 0 m^2/s^4");
  CHECK_THROWS_WITH(Spectrum::from_function({}, 0, 1), "Spectrum: density must be a function, got an empty one");
  CHECK_THROWS_AS(Spectrum::from_function([](double) -> double { throw std::out_of_range("mine"); }, 0, 1),
                  std::out_of_range);
}
