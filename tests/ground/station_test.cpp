// Components of a station as one motion: geometry by hand, and rejected arguments.
#include "stickslip/ground/station.hpp"

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "ground/real_records.hpp"
#include "ground/record_files.hpp"
#include "stickslip/ground/processing.hpp"
#include "support/catch.hpp"
#include "support/motions.hpp"

using namespace stickslip;
using namespace test;
using Catch::Matchers::ContainsSubstring;

namespace {

RecordComponent component(std::vector<double> n, const std::string& orientation, double dt = 0.01) {
  return {
      GroundMotion(std::move(n), dt, Interpolation::linear, "Made-up, " + orientation).with_orientation(orientation),
      orientation,
      {}};
}

/// The record of a sensor at an azimuth, for given motions north and east.
RecordComponent seen_from(const GroundMotion& north, const GroundMotion& east, double azimuth) {
  const double a = azimuth * std::numbers::pi / 180;
  std::vector<double> n;
  for (std::size_t i = 0; i < north.samples(); ++i)
    n.push_back(north.acceleration()[i] * std::cos(a) + east.acceleration()[i] * std::sin(a));
  return component(std::move(n), detail::shortest(azimuth), north.dt());
}

std::vector<double> values(std::span<const double> n) { return {n.begin(), n.end()}; }

const std::vector<double> one{1, -3, 2}, two{4, 5, -6}, three{7, 8, 9};

}  // namespace

TEST_CASE("along a recorded component a station has its very samples", "[station]") {
  for (const bool clockwise : {true, false}) {
    const std::vector<RecordComponent> all{component(one, "N28W"), component(two, clockwise ? "N62E" : "S62W"),
                                           component(three, "Up")};
    const GroundMotion motion = station_motion(all);
    CHECK(values(motion.acceleration()) == one);
    // 90 degrees clockwise from the axis, which is N62E.
    CHECK(values(motion.transverse()) == (clockwise ? two : values(GroundMotion(two, 1).scaled(-1).acceleration())));
    CHECK(values(motion.vertical()) == three);
    CHECK(motion.orientation() == "N28W");
    CHECK(motion.name() == "Made-up, N28W");
    CHECK(station_motion(all, "n28w") == motion);
    CHECK(station_motion(all, "332") == motion);
    CHECK(station_motion(all, "-28") == motion);
    const GroundMotion other = station_motion(all, all[1].name);
    CHECK(values(other.acceleration()) == two);
    CHECK(values(other.transverse()) == (clockwise ? values(GroundMotion(one, 1).scaled(-1).acceleration()) : one));
  }
}

TEST_CASE("along any azimuth a station has what a sensor there had recorded", "[station]") {
  const GroundMotion north = broadband(3, 200), east = broadband(5, 200);
  const double scale = north.peak_acceleration() + east.peak_acceleration();
  for (const double first : {0.0, 17.0, 135.0, 300.0})
    for (const double apart : {90.0, -90.0, 85.0, 97.0})
      for (const double along : {0.0, 33.3, 180.0, 271.0}) {
        CAPTURE(first, apart, along);
        const std::vector<RecordComponent> pair{seen_from(north, east, first), seen_from(north, east, first + apart)};
        const GroundMotion motion = station_motion(pair, detail::shortest(along));
        // Round-off of some sums, over the sine of the angle between the components, 0.99 at least.
        CHECK(difference(motion.acceleration(), seen_from(north, east, along).motion.acceleration()) <= 2e-15 * scale);
        CHECK(difference(motion.transverse(), seen_from(north, east, along + 90).motion.acceleration()) <=
              2e-15 * scale);
        CHECK(difference(rotated(station_motion(pair), along - first).acceleration(), motion.acceleration()) <=
              4e-15 * scale);
        CHECK(std::stod(motion.orientation()) == along);
      }
}

TEST_CASE("a station may have one horizontal component, and a vertical one downward", "[station]") {
  const GroundMotion motion = station_motion(std::vector{component(three, "DWN"), component(one, "90")});
  CHECK(values(motion.acceleration()) == one);
  CHECK(!motion.has_transverse());
  CHECK(values(motion.vertical()) == std::vector<double>{-7, -8, -9});
  CHECK_THROWS_WITH(station_motion(std::vector{component(one, "90")}, "45"),
                    ContainsSubstring("two horizontal components for the azimuth 45, got 90 alone"));
}

TEST_CASE("components that do not fit together are refused", "[station][errors]") {
  const auto refuses = [](const std::vector<RecordComponent>& all, const std::string& message,
                          const std::string& along = {}) {
    CHECK_THROWS_WITH(station_motion(all, along), ContainsSubstring(message));
  };
  refuses({}, "at least one component, got none");
  refuses({component(one, "up")}, "one or two horizontal components, got 0");
  refuses({component(one, "0"), component(one, "90"), component(two, "180")}, "got 3");
  refuses({component(one, "0"), component(one, "up"), component(two, "up")}, "one vertical component at most");
  refuses({component(one, "0"), component(two, "H2")}, "Made-up, H2 says 'H2'; give its orientation");
  refuses({component(one, "0"), component(two, "")}, "does not say; give its orientation");
  refuses({component(one, "0"), component(two, "79")}, "perpendicular to within 10 degrees, got 0 and 79");
  refuses({component(one, "0"), component(two, "180")}, "perpendicular");
  refuses({component(one, "0"), component(two, "90", 0.02)}, "same time step, got 0.01 s (0) and 0.02 s (90)");
  refuses({component(one, "0"), component({1, 2}, "90")},
          "number of samples (or ask for the common length), got 3 (0) and 2 (90)");
  refuses({component(one, "0"), component(two, "90")},
          "along must be an azimuth in degrees or one of the horizontal components (0, 90), got 'fault normal'",
          "fault normal");
  std::vector<RecordComponent> late{component(one, "0"), component(two, "90")};
  late[0].start = "04:05:06";
  CHECK(station_motion(late).samples() == 3);
  late[1].start = "04:05:07";
  refuses(late, "same start, got 04:05:06 (0) and 04:05:07 (90)");
  const auto uneven = [](double last, const std::string& orientation) {
    return RecordComponent{GroundMotion(one, {0, 1, last}).with_orientation(orientation)};
  };
  refuses({uneven(3, "0"), component(one, "90")}, "same time step, got uneven times (0) and 0.01 s (90)");
  refuses({uneven(3, "0"), uneven(4, "90")}, "same times, got 3 s (0) and 4 s (90)");
  CHECK(station_motion(std::vector{uneven(3, "0"), uneven(3, "90")}).time(2) == 3);
}

TEST_CASE("the common length is cut when it is asked for", "[station]") {
  const GroundMotion motion = station_motion(
      std::vector{component(one, "0"), component({1, 2, 3, 4}, "90"), component({5, 6}, "up")}, {}, true);
  CHECK(values(motion.acceleration()) == std::vector<double>{1, -3});
  CHECK(values(motion.transverse()) == std::vector<double>{1, 2});
  CHECK(values(motion.vertical()) == std::vector<double>{5, 6});
}

TEST_CASE("a real station is one motion of three components", "[station][real]") {
  const auto file = test::real_record("geonet/20161113_110259_WTMC_20.V2A");
  if (!file) return;
  const std::vector<RecordComponent> all = read_components(*file);
  REQUIRE(all.size() == 3);
  const GroundMotion motion = station_motion(all);
  CHECK(motion.orientation() == "N28W");
  CHECK(motion.peak_acceleration() == Approx(9.7331).epsilon(1e-12));
  CHECK(motion.component(Component::transverse).peak_acceleration() == Approx(7.9664).epsilon(1e-12));
  CHECK(motion.component(Component::vertical).peak_acceleration() == Approx(18.0219).epsilon(1e-12));
  // S62W is 90 degrees counterclockwise from N28W.
  CHECK(motion.transverse()[100] == -all[1].motion.acceleration()[100]);
  // The larger of two perpendicular peaks is at most that of the vector, and rotating does not change the vector.
  const GroundMotion north = station_motion(all, "N");
  for (std::size_t i = 0; i < motion.samples(); i += 97)
    CHECK(std::hypot(north.acceleration()[i], north.transverse()[i]) ==
          Approx(std::hypot(motion.acceleration()[i], motion.transverse()[i])).epsilon(1e-12));
}
