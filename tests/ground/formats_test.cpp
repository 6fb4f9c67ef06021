// Formats of records beyond those of records_test.cpp, columns, gaps, and content in memory.
#include <cmath>
#include <filesystem>
#include <initializer_list>
#include <limits>
#include <string>
#include <vector>

#include "ground/real_records.hpp"
#include "ground/record_files.hpp"
#include "stickslip/base/units.hpp"
#include "stickslip/ground/intensity_measures.hpp"
#include "stickslip/ground/records.hpp"
#include "support/catch.hpp"

using namespace stickslip;
using namespace record_files;
using Catch::Matchers::ContainsSubstring;

namespace {

constexpr double g = standard_gravity;

GroundMotion read(const std::string& content, const RecordOptions& options = {}) {
  return parse_record(content, "invented.txt", options);
}

std::vector<double> samples(const GroundMotion& motion) {
  return {motion.acceleration().begin(), motion.acceleration().end()};
}

void refuses(const std::string& content, std::initializer_list<const char*> parts, const RecordOptions& options = {}) {
  std::string message = "accepted";
  try {
    read(content, options);
  } catch (const std::invalid_argument& error) {
    message = error.what();
  }
  for (const char* part : parts) CHECK_THAT(message, ContainsSubstring(part));
}

/// A COSMOS file with one of its integers, which are 8 columns each and 10 a line.
std::string with_integer(std::string cosmos, std::size_t number, double value) {
  const std::size_t place = number - 1;
  return cosmos.replace(cosmos.find("    -999") + 8 * place + place / 10, 8, print("%8.0f", value));
}

const RecordOptions in_g{.units = "g"};

}  // namespace

TEST_CASE("every format has its row in the table, and the error names them all", "[records]") {
  const std::vector<RecordFormat> formats = record_formats();
  CHECK(formats.size() == 16);
  for (const RecordFormat& format : formats) {
    refuses("nothing\n", {std::string(format.name).c_str()});
    for (const std::string_view column : {format.name, format.units, format.time_step, format.extension})
      CHECK(!column.empty());
  }
}

TEST_CASE("content in memory is read as a file is", "[records]") {
  CHECK(parse_record(peer("5 .01 NPTS, DT"), "folder/a.AT2") == read(peer("5 .01 NPTS, DT")));
  CHECK(parse_record("0 1\n.1 2\n", "folder/a.b.csv", in_g).name() == "a.b");
  CHECK(parse_record("0 1\n.1 2\n", "x.zip::folder/a.csv", in_g).name() == "a");
  CHECK_THROWS_WITH(parse_record("hello\n", "folder/a.AT2"), ContainsSubstring("read_record: folder/a.AT2: no known"));
}

TEST_CASE("all components of a file come with name, orientation and start", "[records]") {
  const std::vector<RecordComponent> three = parse_components(geonet(), "a");
  REQUIRE(three.size() == 3);
  for (const RecordComponent& one : three) {
    CHECK(one.motion == read(geonet(), {.component = one.name}));
    CHECK(one.motion.orientation() == one.name);
    CHECK(one.start == "2001 February 03 04:05:06 UT");
    CHECK(one.units == "mm/s^2");
  }
  CHECK(parse_components(geonet(), "a", {.component = "up"}).size() == 1);
  CHECK(read(smc()).orientation() == "270");
  CHECK(read(peer("5 .01 NPTS, DT")).orientation() == "230");
  CHECK(read(replaced(peer("5 .01 NPTS, DT"), ", 230", ", UP")).orientation() == "UP");
  CHECK(read(replaced(peer("5 .01 NPTS, DT"), ", 230", ", FN")).orientation().empty());
  CHECK(read(cosmos_channel("HNE", cosmos_data)).orientation() == "E");
  CHECK(read(cosmos_channel("HN1", cosmos_data)).orientation().empty());
  const std::string named = cosmos_channel("", cosmos_data), other = replaced(named, "90 deg", "Other");
  CHECK(read(named).orientation() == "90 deg");
  CHECK(read(other).orientation().empty());
  // Integer 54: an azimuth from 1, 400 up, 401 down; 0 and other values carry no information.
  for (const auto& [code, orientation] :
       {std::pair{45, "45"}, {360, "0"}, {400, "up"}, {401, "down"}, {0, ""}, {402, "vertical"}, {500, ""}, {-999, ""}})
    CHECK(read(with_integer(other, 54, code)).orientation() == orientation);
}

TEST_CASE("a K-NET file is counts times its scale factor", "[records]") {
  const GroundMotion motion = read(knet());
  REQUIRE(motion.samples() == 10);
  CHECK(motion.dt() == 0.01);
  CHECK(motion.orientation() == "N-S");
  CHECK(motion.name() == "2001/02/03 04:05:00, MAD001, N-S");
  // 2000 gal / 8000000: a count is 2.5e-6 m/s^2.
  CHECK(motion.acceleration()[3] == Approx(-0.25).epsilon(1e-14));
  CHECK(motion.acceleration()[9] == Approx(0.09).epsilon(1e-14));
  CHECK(parse_components(knet(), "a")[0].start == "2001/02/03 04:05:36");
  CHECK(samples(read(knet(), {.units = "cm/s^2"})) == samples(motion));
  for (const auto& [name, orientation] :
       {std::pair{"1", "N"}, {"2", "E"}, {"3", "Z"}, {"4", "N"}, {"5", "E"}, {"6", "Z"}})
    CHECK(read(knet(name)).orientation() == orientation);
}

TEST_CASE("a damaged K-NET file is refused", "[records][errors]") {
  refuses(knet("N-S", 9), {"ends after 9 of the 10 samples"});
  refuses(knet("N-S", 11), {"more than the 10 samples"});
  for (const char* scale : {"2000(gal)/0", "2000/8000000", "(gal)/8000000", "2000(gal)/", "2000(gal)", "2000(gal)/8x"})
    refuses(knet("N-S", 10, scale), {"line 14", "scale factor", scale});
  refuses(replaced(knet(), "100Hz", "0Hz"), {"invented.txt"});
  refuses(replaced(knet(), "100Hz", "many"), {"line 11", "'Sampling Freq(Hz)'", "many"});
  refuses(replaced(knet(), "Dir. ", "Way. "), {"no line 'Dir.'"});
}

TEST_CASE("an ESM file is read by the keys of its header", "[records]") {
  const GroundMotion motion = read(dyna());
  CHECK(motion.dt() == 0.005);
  CHECK(motion.samples() == 6);
  CHECK(motion.acceleration()[0] == Approx(-1.23e-6));
  CHECK(motion.peak_acceleration() == Approx(g / 10).epsilon(1e-14));
  CHECK(motion.orientation() == "E");
  CHECK(motion.name() == "Made-up, MU MAD, HNE");
  CHECK(read(dyna("HGZ")).orientation() == "Z");
  CHECK(read(dyna("HN2")).orientation().empty());
  CHECK(read(replaced(dyna(), "EVENT_NAME: Made-up", "EVENT_NAME: None")).name() == "MU-2001-0001, MU MAD, HNE");
  CHECK(parse_components(dyna(), "a")[0].start == "20010203_040512.000");
  // The peak says in which unit the samples are.
  refuses(replaced(dyna(), "UNITS: cm/s^2", "UNITS: mm/s^2"), {"line 17", "peak of -98.0665 cm/s^2"});
  const std::string elsewhere = replaced(dyna(), "EVENT_NAME: Made-up\n", "\n\nEVENT_NAME: Made-up\n");
  CHECK(read(elsewhere) == motion);
  refuses(replaced(elsewhere, "NDATA: 6", "NDATA: six"), {"line 15", "'NDATA'"});
}

TEST_CASE("a damaged ESM file, velocity and spectra are refused", "[records][errors]") {
  refuses(dyna("HNE", 7), {"ends after 6 of the 7 samples"});
  refuses(dyna("HNE", 5), {"more than the 5 samples"});
  refuses(replaced(dyna(), "DATA_TYPE: ACCELERATION", "DATA_TYPE: VELOCITY"), {"line 19", "VELOCITY"});
  refuses(replaced(dyna(), "DATA_TYPE: ACCELERATION", "DATA_TYPE: ACCELERATION RESPONSE SPECTRUM"),
          {"line 19", "history"});
  refuses(replaced(dyna(), "NDATA: 6", "NDATA: six"), {"line 13", "'NDATA'", "six"});
  refuses(replaced(dyna(), "NDATA", "NDATE"), {"no 'NDATA'"});
  refuses(replaced(dyna(), "0.005000", "0"), {"dt must be positive and finite, got 0 s"});
  refuses(replaced(dyna(), "98.066500", "nan"), {"line 24", "number 3 of the 6"});
}

TEST_CASE("a CSMIP file of corrected records has one component a channel", "[records]") {
  const GroundMotion motion = read(csmip_channel());
  CHECK(motion.dt() == 0.02);
  CHECK(motion.samples() == 10);
  CHECK(motion.acceleration()[2] == Approx(-0.10123456).epsilon(1e-14));
  CHECK(motion.acceleration()[3] == Approx(1.00123456).epsilon(1e-14));  // columns that run together
  CHECK(motion.acceleration()[9] == Approx(-g / 10).epsilon(1e-14));
  CHECK(motion.orientation() == "90");
  CHECK(motion.name() == "Made-up Earthquake, Made-up City - School, 90");
  CHECK(read(csmip_channel("90 Deg", "(UNITS: CM/SEC/SEC)")) == motion);
  const std::string two = csmip_channel() + "\n" + csmip_channel("Up");
  CHECK(read(two, {.component = "up"}).orientation() == "Up");
  CHECK(samples(read(two, {.component = "2"})) == samples(motion));
  refuses(two, {"1 90, 2 Up"});
}

TEST_CASE("a CSMIP file of uncorrected records has steps, or pairs of time and acceleration", "[records]") {
  const GroundMotion even = read(csmip_uncorrected(false)), pairs = read(csmip_uncorrected(true));
  CHECK(even.dt() == 0.02);
  CHECK(even.acceleration()[2] == Approx(-0.05 * g).epsilon(1e-14));
  CHECK(even.orientation() == "UP");
  for (std::size_t i = 0; i < 4; ++i) CHECK(pairs.acceleration()[i] == Approx(even.acceleration()[i]).epsilon(1e-14));
  CHECK(pairs.time(2) == 0.043);
  CHECK(pairs.name() == "MADE-UP EARTHQUAKE, MADE-UP CITY, UP");
}

TEST_CASE("spectra and counts are not taken for acceleration", "[records][errors]") {
  refuses("Response and Fourier Amplitude Spectra\nCorrected Accelerogram\nUncorrected Accelerogram Data\n",
          {"CSMIP V3", "spectra", "V1 or V2"});
  const std::string cosmos = cosmos_channel("HNE", cosmos_data);
  CHECK(read(with_integer(cosmos, 1, 2)).samples() == 10);
  refuses(with_integer(cosmos, 1, 0), {"line 15", "COSMOS V0", "raw counts"});
  refuses(with_integer(cosmos, 1, 3), {"line 15", "COSMOS V3", "spectra"});
  refuses(replaced(cosmos, "Corrected acceleration ", "Response spectra "), {"line 1", "COSMOS V3"});
  refuses(replaced(csmip_channel(), "points of accel", "points of power"), {"holds no acceleration"});
  refuses(csmip_channel().substr(0, csmip_channel().find("  9.000000")), {"ends after 8 of the 10 samples"});
}

TEST_CASE("formats that begin alike are told apart", "[records]") {
  CHECK(record_format(smc("1 UNCORRECTED ACCELEROGRAM"))->name == "USGS SMC");
  CHECK(read(smc("1 UNCORRECTED ACCELEROGRAM")) == read(smc()));
  CHECK(record_format(replaced(geonet(), "Corrected", "Uncorrected"))->name == "GeoNet V1A and V2A");
  CHECK(record_format(csmip_channel())->name == "CSMIP V1 and V2");
  CHECK(record_format(csmip_uncorrected(true))->name == "CSMIP V1 and V2");
  CHECK(record_format("0.1\n0.2\n")->name == "columns of numbers");
  CHECK(!record_format("nothing\n"));
  CHECK(!record_format(std::string(4, '\0')));
}

TEST_CASE("one column needs its time step, and units", "[records]") {
  const std::string column = "# Made-up, one column\n0.1\n-0.25\n1.5E-4\n0.5\n\n";
  const GroundMotion motion = read(column, {.units = "g", .dt = 0.02});
  CHECK(motion.dt() == 0.02);
  CHECK(samples(motion) == std::vector<double>{0.1 * g, -0.25 * g, 1.5e-4 * g, 0.5 * g});
  CHECK(motion.name() == "Made-up, one column");
  CHECK(read("Acceleration (gal)\n" + column.substr(22), {.dt = 0.02}).acceleration()[0] == 0.1 * 0.01);
  refuses(column, {"no units"}, {.dt = 0.02});
  refuses(column, {"no time step", "pass dt"}, in_g);
  refuses("0.1\n0.2 0.3\n", {"line 2", "1 column as in line 1", "got 2"}, {.units = "g", .dt = 0.1});
  refuses("0.1\n0.2\n\n0.3\n", {"line 3", "a sample may be missing"}, {.units = "g", .dt = 0.1});
  refuses("0.1\nx\n", {"line 2", "finite numbers", "'x'"}, {.units = "g", .dt = 0.1});
  for (const double bad : {-0.1, std::numeric_limits<double>::infinity(), std::nan("")})
    refuses(column, {"dt must be positive and finite"}, {.units = "g", .dt = bad});
}

TEST_CASE("a time step that is given may not differ from the file's", "[records][errors]") {
  CHECK(read(peer("5 .01 NPTS, DT"), {.dt = 0.01}).dt() == 0.01);
  refuses(peer("5 .01 NPTS, DT"), {"states a time step of 0.01 s, dt given is", "0.02 s"}, {.dt = 0.02});
  refuses("t a\n0 1\n1 2\n2 3\n4 4\n", {"states the times", "0.1 s"}, {.units = "g", .dt = 0.1});
}

TEST_CASE("more columns are several components on the same times", "[records]") {
  for (const char* header : {"Time (s), NS (g), EW (g), UD (g)", "# Time (s);NS (g);EW (g);UD (g)",
                             "# units: g\n# Time, NS, EW, UD", "# units: g\nt NS EW UD", "# units: g\nt\tNS\tEW\tUD"}) {
    const std::string text = std::string(header) + "\n0.00,1,2,3\n0.01,4,5,6\n0.02,7,8,9\n";
    const std::vector<RecordComponent> all = parse_components(text, "invented.txt");
    REQUIRE(all.size() == 3);
    CHECK(all[0].name == "NS");
    CHECK(all[1].motion.orientation() == "EW");
    CHECK(samples(all[2].motion) == std::vector<double>{3 * g, 6 * g, 9 * g});
    CHECK(all[2].motion.dt() == 0.01);
    CHECK(read(text, {.component = "ew"}) == all[1].motion);
    CHECK(read(text, {.component = "3"}) == all[2].motion);
    refuses(text, {"1 NS, 2 EW, 3 UD"});
  }
  // Each column has its own units.
  const std::string mixed = "t (s), a (g), b (gal)\n0,1,1\n1,2,2\n";
  CHECK(parse_components(mixed, "invented.txt")[1].units == "gal");
  CHECK(parse_components("t (s), a (CM/SEC2)\n0,1\n1,2\n", "invented.txt")[0].units == "cm/s^2");
  CHECK(parse_components("0,1\n.1,2\n", "invented.txt", in_g)[0].units.empty());  // given, not stated
  CHECK(read(mixed, {.component = "a"}).acceleration()[0] == g);
  CHECK(read(mixed, {.component = "b"}).acceleration()[0] == 0.01);
  refuses("0 1 2 3\n1 2 3\n2 3 4 5\n", {"line 2", "expected 4 columns as in line 1, got 3", "record_formats lists"},
          in_g);
  refuses("1 20 3\n0.5 19 3\n1 18 3\n", {"line 1", "first of 3 columns is not time", "label the columns"}, in_g);
}

TEST_CASE("a comma is a decimal point where something else parts the columns", "[records]") {
  for (const char* text :
       {"0,00;0,1\n0,01;-2,5\n0,02;3\n", "0,00\t0,1\n0,01\t-2,5\n0,02\t3\n", "0,00  0,1\n0,01 -2,5\n0,02 3\n",
        "0 0,1\n0,01 -2,5\n0,02 3\n", "0,00 ; 0,1\n0,01 ; -2,5\n0,02 ; 3\n"}) {
    CAPTURE(text);
    const GroundMotion motion = read(text, in_g);
    CHECK(motion.dt() == 0.01);
    CHECK(samples(motion) == std::vector<double>{0.1 * g, -2.5 * g, 3 * g});
  }
  // A comma alone separates columns, and so does one next to a blank; with a point in any row it is not a decimal sign.
  CHECK(read("0,1\n.1,5\n", in_g).acceleration()[1] == 5 * g);
  CHECK(read("0, 1\n.1, 5\n", in_g).acceleration()[1] == 5 * g);
  refuses("0,00;0,1\n0.01;0.5\n", {"line 2", "expected 4 columns as in line 1, got 2"}, in_g);
}

TEST_CASE("a gap is refused unless it is asked for", "[records]") {
  std::string text = "# units: g\nt a\n";
  for (int i = 0; i < 200; ++i) text += print("%.2f", 0.01 * i + (i < 120 ? 0 : 0.11)) + " 0.1\n";
  refuses(text, {"a gap of 0.12 s after 1.19 s", "median time step, 0.01 s", "pass gaps"});
  const GroundMotion kept = read(text, {.gaps = true});
  CHECK(kept.samples() == 200);
  CHECK(kept.time(120) == 1.31);
  // Up to ten steps are not a gap.
  CHECK(read(replaced(text, "1.19 0.1\n", "1.19 0.1\n1.25 0.2\n")).samples() == 201);
  CHECK(std::isnan(read("t a\n0 1\n1 2\n2 3\n12 4\n", in_g).dt()));
  refuses("t a\n0 1\n1 2\n2 3\n12.5 4\n", {"a gap of 10.5 s after 2 s"}, in_g);
}

TEST_CASE("one column of a real record has the peaks its list states", "[records][real]") {
  // PGA [g] and PGV [cm/s] of pairs.csv, to the digits printed there.
  const auto file = test::real_record("usgs_pairs/Northridge_1994_RRS-228.txt");
  if (!file) return;
  const GroundMotion motion = read_record(*file, {.units = "g", .dt = 0.01});
  CHECK(motion.samples() == 1991);
  CHECK(motion.peak_acceleration() / g == Approx(0.825).margin(5e-4));
  CHECK(peak_velocity(motion) * 100 == Approx(160.3).epsilon(0.05));
}
