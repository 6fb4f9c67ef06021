// Numbers as text, also without the parts of <charconv> that older standard libraries lack.
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <random>
#include <string>
#include <system_error>

#include "base/read_number.hpp"
#include "stickslip/base/error.hpp"
#include "support/catch.hpp"

namespace {

using namespace stickslip::detail;

/// Doubles of all magnitudes, and with few digits.
template <class Use>
void for_many(Use&& use) {
  std::mt19937_64 random(7);
  for (int i = 0; i < 20'000; ++i) {
    const std::uint64_t bits = random();
    double value = 0;
    std::memcpy(&value, &bits, sizeof value);
    if (std::isfinite(value)) use(value);
    use(static_cast<double>(static_cast<std::int64_t>(bits) % 1'000'000) *
        std::pow(10., static_cast<int>(bits % 40) - 20));
  }
  for (const double value : {0.0, -0.0, 1.0, 0.1, 0.05, 1e5, 120000.0, 123456.0, 1e22, 9007199254740993.0, 1e-4, 1e-5,
                             5e-324, std::numeric_limits<double>::max(), std::numeric_limits<double>::min()})
    use(value);
}

}  // namespace

TEST_CASE("Without std::to_chars, the shortest decimal string is the same") {
  for_many([](double value) {
    char text[32];
    const std::string expected(text, std::to_chars(text, text + sizeof text, value).ptr);
    if (shortest_printed(value) != expected) CHECK(shortest_printed(value) == expected);
  });
  CHECK(shortest(std::numeric_limits<double>::infinity()) == "inf");
}

TEST_CASE("Without std::from_chars, numbers read the same") {
  for_many([](double value) {
    for (const std::string& text : {shortest(value), std::to_string(value)})
      if (read_number_by_strtod(text) != read_number(text)) CHECK(read_number_by_strtod(text) == read_number(text));
  });
  for (const char* text : {"",
                           "-",
                           "+1",
                           " 1",
                           "1 ",
                           "1e",
                           "1e+",
                           "e5",
                           ".",
                           "-.5",
                           "5.",
                           "0x10",
                           "nan",
                           "inf",
                           "-inf",
                           "infinity",
                           "1.5.2",
                           "1e999",
                           "-1e999",
                           "1e-999",
                           "0e-999",
                           "-0",
                           "1,5",
                           "1e5e5",
                           "--1",
                           "1e+-5",
                           "1e++5",
                           "9007199254740993",
                           "123456789012345678901",
                           "1e22",
                           "1e23",
                           "-.5e-3"}) {
    CAPTURE(text);
    CHECK(read_number_by_strtod(text) == read_number(text));
  }
  CHECK(read_number("5e-324") == 5e-324);
  CHECK_FALSE(read_number("1e999"));
}
