#include "stickslip/ground/orientation.hpp"

#include <optional>
#include <string>

#include "support/catch.hpp"

using namespace stickslip;

TEST_CASE("an azimuth is read as files write it", "[orientation]") {
  struct Known {
    const char* text;
    double azimuth;
  };
  for (const auto& [text, azimuth] :
       {Known{"N28W", 332}, Known{"n28w", 332},  Known{"S62W", 242},  Known{"S14E", 166},        Known{"N 05 E", 5},
        Known{"N0W", 0},    Known{"N90E", 90},   Known{"270", 270},   Known{"000", 0},           Known{"360", 0},
        Known{"-90", 270},  Known{"90 deg", 90}, Known{"45.5", 45.5}, Known{"230\xC2\xB0", 230}, Known{"N", 0},
        Known{"East", 90},  Known{"S", 180},     Known{"west", 270},  Known{"N-S", 0},           Known{"E-W", 90}}) {
    CAPTURE(text);
    CHECK(azimuth_of(text) == std::optional(azimuth));
    CHECK(upward(text) == 0);
  }
  for (const char* text :
       {"", "up", "H1", "N91E", "N-5E", "NE5", "N28", "nan", "inf", "1e999", "12x", "N28WE", "radial"}) {
    CAPTURE(text);
    CHECK(azimuth_of(text) == std::nullopt);
  }
}

TEST_CASE("up and down are told apart", "[orientation]") {
  for (const char* text : {"Up", "UP", "Z", "U-D", "Vertical", "VER"}) CHECK(upward(text) == 1);
  for (const char* text : {"Down", "DWN"}) CHECK(upward(text) == -1);
  for (const char* text : {"", "N28W", "90", "H1"}) CHECK(upward(text) == 0);
}

TEST_CASE("an azimuth is written from 0 to below 360", "[orientation]") {
  CHECK(orientation_at(332) == "332");
  CHECK(orientation_at(360) == "0");
  CHECK(orientation_at(-0.0) == "0");
  CHECK(orientation_at(-28) == "332");
  CHECK(orientation_at(332 + 28.1) == "0.1");
  CHECK(orientation_at(-1e-12) == "0");
}
