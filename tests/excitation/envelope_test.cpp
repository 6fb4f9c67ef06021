// Envelopes: their three phases, tables, and what is refused.
#include "stickslip/excitation/envelope.hpp"

#include "support/catch.hpp"
#include "support/motions.hpp"

using namespace stickslip;
using namespace test;
using Catch::Matchers::ContainsSubstring;

TEST_CASE("a motion builds up, stays strong, decays", "[envelope]") {
  const Envelope envelope(4, 10, 0.5);
  CHECK(envelope(-1e-9) == 0);
  CHECK(envelope(0) == 0);
  CHECK(envelope(1) == 1.0 / 16);
  CHECK(envelope(2) == 0.25);
  CHECK(envelope(4) == 1);
  CHECK(envelope(14) == 1);
  CHECK(envelope(16) == std::exp(-1.0));
  CHECK(envelope(infinity) == 0);
  CHECK(envelope(std::nextafter(4.0, 0.0)) == Approx(1).epsilon(1e-15));
  CHECK((envelope.build_up() == 4 && envelope.strong_duration() == 10 && envelope.decay_rate() == 0.5));
}

TEST_CASE("phases may be missing", "[envelope]") {
  CHECK(Envelope(0, 1, 1)(0) == 1);
  CHECK(Envelope(0, infinity, 1)(1e300) == 1);
  CHECK(Envelope(0, 0, 0)(1e300) == 1);
  CHECK(Envelope(0, 0, 2)(1) == std::exp(-2.0));
}

TEST_CASE("at no time an envelope has no factor", "[envelope][errors]") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Envelope& e : {Envelope(2, 2, 1), Envelope(0, 0, 0), Envelope(0, infinity, 1)}) CHECK(std::isnan(e(nan)));
  CHECK(std::isnan(Envelope::from_table({0, 1}, {1, 1})(nan)));
}

TEST_CASE("a table is straight between its points and zero outside", "[envelope]") {
  const Envelope envelope = Envelope::from_table({1, 2, 4}, {0.5, 2, 0});
  CHECK(envelope(0.999) == 0);
  CHECK(envelope(1) == 0.5);
  CHECK(envelope(1.5) == 1.25);
  CHECK(envelope(2) == 2);
  CHECK(envelope(3) == 1);
  CHECK(envelope(4) == 0);
  CHECK(envelope(5) == 0);
}

TEST_CASE("envelopes are equal where they are the same, and can be written down", "[envelope]") {
  CHECK(Envelope(4, 10, 0.5) == Envelope(4, 10, 0.5));
  CHECK_FALSE(Envelope(4, 10, 0.5) == Envelope(4, 10, 0.25));
  CHECK_FALSE(Envelope(0, 0, 0) == Envelope::from_table({0, 1}, {1, 1}));
  CHECK(Envelope(4, 10, 0.1).configuration() ==
        R"({"kind": "jennings", "build_up": 4, "strong_duration": 10, "decay_rate": 0.1})");
  CHECK(Envelope::from_table({0, 0.1}, {1, 1e-5}).configuration() ==
        R"({"kind": "table", "time": [0, 0.1], "factor": [1, 1e-05]})");
}

TEST_CASE("what is no envelope is refused by name", "[envelope][errors]") {
  CHECK_THROWS_WITH(Envelope(-1, 1, 1), "Envelope: build_up must be finite and at least 0, got -1 s");
  CHECK_THROWS_WITH(Envelope(infinity, 1, 1), "Envelope: build_up must be finite and at least 0, got inf s");
  CHECK_THROWS_WITH(Envelope(1, not_a_number, 1), "Envelope: strong_duration must be at least 0, got nan s");
  CHECK_THROWS_WITH(Envelope(1, 1, -0.5), "Envelope: decay_rate must be finite and at least 0, got -0.5 1/s");
  CHECK_THROWS_WITH(Envelope::from_table({0, 1}, {1}), "Envelope: needs as many factor as time values, got 1 for 2");
  CHECK_THROWS_WITH(Envelope::from_table({0}, {1}), "Envelope: a table needs at least two points, got 1");
  CHECK_THROWS_WITH(Envelope::from_table({0, 2, 2}, {1, 1, 1}), "Envelope: time[2] must come after 2 s, got 2 s");
  CHECK_THROWS_WITH(Envelope::from_table({0, infinity}, {1, 1}), "Envelope: time[1] must be finite, got inf s");
  CHECK_THROWS_WITH(Envelope::from_table({0, 1}, {1, -1}), "Envelope: factor[1] must be finite and at least 0, got -1");
}
