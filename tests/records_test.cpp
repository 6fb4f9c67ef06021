#include "stickslip/records.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <optional>
#include <random>
#include <string>
#include <system_error>
#include <vector>

#include "catch.hpp"
#include "real_records.hpp"
#include "stickslip/units.hpp"

using namespace stickslip;
namespace fs = std::filesystem;

namespace {

/// A folder of this test's own, gone when the test ends.
class Folder {
 public:
  Folder() : path_(fs::temp_directory_path() / ("stickslip_records_" + std::to_string(std::random_device()()))) {
    fs::create_directories(path_);
  }
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  const fs::path& path() const { return path_; }

  fs::path write(const std::string& content, const std::string& name = "made_up.txt") const {
    std::ofstream(path_ / name, std::ios::binary) << content;
    return path_ / name;
  }

 private:
  fs::path path_;
};

GroundMotion read(const std::string& content, const RecordOptions& options = {}) {
  const Folder folder;
  return read_record(folder.write(content), options);
}

/// What is said of content that is refused.
std::string refusal(const std::string& content, const RecordOptions& options = {}) {
  try {
    read(content, options);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

bool says(const std::string& message, std::initializer_list<const char*> parts) {
  INFO(message);
  const bool all = std::all_of(parts.begin(), parts.end(),
                               [&](const char* part) { return message.find(part) != std::string::npos; });
  CHECK(all);
  return all;
}

std::string print(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
  return text;
}

std::vector<double> samples(const GroundMotion& motion) {
  return {motion.acceleration().begin(), motion.acceleration().end()};
}

/// The sample of largest magnitude.
std::size_t peak(const GroundMotion& motion) {
  const auto n = motion.acceleration();
  const auto larger = [](double a, double b) { return std::abs(a) < std::abs(b); };
  return static_cast<std::size_t>(std::max_element(n.begin(), n.end(), larger) - n.begin());
}

constexpr double g = standard_gravity;

const std::string peer_values = "  -.1000E+00   .2000E+00\n   .5D0      -0.25\n  +1.0D-03\n";

std::string peer(const std::string& line4, const std::string& values = peer_values) {
  return "PEER NGA STRONG MOTION DATABASE RECORD\n"
         "Made-up Valley 1/2/2003, Station #6, 230\n"
         "ACCELERATION TIME SERIES IN UNITS OF G\n" +
         line4 + "\n" + values;
}

const std::vector<double> peer_samples = {-0.1 * g, 0.2 * g, 0.5 * g, -0.25 * g, 0.001 * g};

std::string smc(const std::string& type = "2 CORRECTED ACCELEROGRAM", int count = 10, double rate = 100) {
  std::string text = type + "\n*\nMADE1\n     1999   1   2    0304 Made-up Creek\n*\n" +
                     "station = Made-up School         component=    270\n*\n*\n*\n*\n*\n";
  for (int i = 1; i <= 48; ++i)
    text += print("%10.0f", i == 16 ? 2 : i == 17 ? count : -32768) + (i % 8 == 0 ? "\n" : "");
  for (int i = 1; i <= 50; ++i) text += print("%15.7E", i == 2 ? rate : 1.7e38) + (i % 5 == 0 ? "\n" : "");
  return text + "|\n|a comment\n" +
         " 1.5057E+0-2.2223E+0-1.9234E+0-3.1562E+0-3.2440E+0-3.5638E+0-5.1941E+0-5.7933E+0\n" +
         "-5.5295E+1 5.4933E+0\n";
}

std::string geonet_component(const std::string& name, const std::string& values, int velocities = 11) {
  std::string text =
      "Corrected accelerogram MADE_UP GNS Science\nSite MADE      42 37 10S  173 03 13E\nMade-up Farm\nInstrument\n"
      "Resolution\nAccelerogram\n5 km east of Nowhere\n2001 February 03         04:05:06 UT\nEpicentre\n"
      "Number of points  12    Duration 0.22 sec\nInstrument corrected data at 0.020 sec intervals\nBand-pass\n"
      "Component " +
      name + "  Longitudinal Accelerometer Axis\nAcceleration:\nVelocity:\nDisplacement:\n";
  for (int i = 1; i <= 40; ++i)
    text += print("%8.0f", i == 34 ? 12 : i == 35 || i == 36 ? velocities : 0) + (i % 10 == 0 ? "\n" : "");
  for (int i = 1; i <= 60; ++i)
    text += print("%8.4f", i == 25 ? 0.005 : i == 26 ? 0.02 : 0) + (i % 10 == 0 ? "\n" : "");
  text += values;
  for (int block = 0; block < 2 && velocities > 0; ++block)
    text += "   99.99   99.99   99.99   99.99   99.99   99.99   99.99   99.99   99.99   99.99\n   99.99\n";
  return text;
}

std::string geonet() {
  return geonet_component("N28W",
                          "     0.2    -0.1     0.2    -0.1     0.2    -0.1     0.2    -0.1     0.2-11024.7\n"
                          "     0.2    -0.1\n") +
         geonet_component("S62W",
                          "     1.2    -0.1     0.2    -0.1     0.2    -0.1     0.2    -0.1     0.2    -0.1\n"
                          "     0.2    -0.1\n") +
         geonet_component("Up",
                          "     2.2    -0.1     0.2    -0.1     0.2    -0.1     0.2    -0.1     0.2100000.0\n"
                          "     0.2    -0.1\n");
}

std::string cosmos_channel(const std::string& name, const std::string& data, const std::string& kind = "acceleration") {
  std::string text = "Corrected " + kind +
                     "    (Format v01.20 with 13 text lines)\n"
                     "Record of Made-up Earthquake of Fri Nov 30, 2018\nHypocenter:\nOrigin:\n"
                     "Statn No: 37-000011 Code:AK-MADE     UAF  Made-up River\nCoords:\nRecorder:\nRcrd start time:\n"
                     "Sta Chan   1: 90 deg (Rcrdr Chan  1) Location:\nRaw record length\nProcessed:\nRecord filtered\n"
                     "Values used when parameter or data value is unknown/unspecified:   -999, -999.00\n"
                     " 100 Integer-header values follow on  10 lines, Format= (10I8)\n";
  for (int i = 1; i <= 100; ++i) text += print("%8.0f", -999) + (i % 10 == 0 ? "\n" : "");
  text += " 100 Real-header values follow on  20 lines, Format= (5F15.6)\n";
  for (int i = 1; i <= 100; ++i)
    text += print("%15.6f", i == 34 ? 0.02 : i == 62 ? 5 : -999) + (i % 5 == 0 ? "\n" : "");
  text += "   2 Comment line(s) follow, each starting with a \"|\":\n| Sensor\n|";
  return text + (name.empty() ? "" : "<SCNL>MADE." + name + ".AK.--") + "\n" + data;
}

const std::string cosmos_data =
    "      10 acceleration pts, approx    0 secs, units=cm/sec2(04),Format=(8F10.5)\n"
    "   1.00000  -2.000001000.123451000.12345   5.00000   6.00000   7.00000   8.00000\n   9.00000-980.66500\n"
    "End-of-data for Chan  1 acceleration\n";

std::string cosmos_velocity() {
  return replaced(replaced(cosmos_data, "acceleration", "velocity"), "cm/sec2(04)", "cm/sec (05)");
}

/// A table of times printed with a format, accelerations made up.
std::string table(const std::vector<double>& times, const char* format) {
  std::string text = "Time (s),Acceleration (m/s^2)\n";
  for (const double t : times) text += print(format, t) + "," + print("%.5f", std::sin(t)) + "\n";
  return text;
}

std::vector<double> even_times(std::size_t count, double dt, double start = 0) {
  std::vector<double> times(count);
  for (std::size_t i = 0; i < count; ++i) times[i] = start + static_cast<double>(i) * dt;
  return times;
}

}  // namespace

TEST_CASE("units of acceleration are known in all their spellings", "[records]") {
  for (const char* name : {"g", "G", "g's", "G's", " g "}) CHECK(acceleration_unit(name) == 9.80665);
  for (const char* name : {"m/s^2", "m/s2", "m/s/s", "m/s**2", "M/S^2", "m / s^2", "m/sec2", "m/sec^2", "m/s\xC2\xB2"})
    CHECK(acceleration_unit(name) == 1);
  for (const char* name : {"cm/s^2", "cm/s/s", "cm/sec2", "cm/sec/sec", "CM/SEC**2", "gal", "Gal"})
    CHECK(acceleration_unit(name) == 0.01);
  for (const char* name : {"mm/s^2", "mm/s/s"}) CHECK(acceleration_unit(name) == 0.001);
  CHECK(acceleration_unit("ft/s^2") == 0.3048);
  CHECK(acceleration_unit("in/s^2") == 0.0254);
  for (const char* name : {"", "m/s", "s", "counts", "cm", "ms", "g^2"})
    CHECK_THROWS_AS(acceleration_unit(name), std::invalid_argument);
  try {
    acceleration_unit("furlong");
  } catch (const std::invalid_argument& error) {
    says(error.what(), {"'furlong'", "known are g, m/s^2, cm/s^2"});
  }
}

TEST_CASE("a PEER file is read in both forms of its fourth line", "[records]") {
  for (const char* line : {"NPTS=   5, DT=   .0100 SEC,", "NPTS= 5, DT= .01000 SEC", "NPTS=      5, DT=   0.0100 SEC, ",
                           "npts=5,dt=.01", "  5  0.0100  NPTS, DT", "    5    .0100    NPTS, DT"}) {
    const GroundMotion motion = read(peer(line));
    CHECK(motion.dt() == 0.01);
    CHECK(motion.interpolation() == Interpolation::linear);
    CHECK(motion.name() == "Made-up Valley 1/2/2003, Station #6, 230");
    REQUIRE(motion.samples() == peer_samples.size());
    for (std::size_t i = 0; i < peer_samples.size(); ++i)
      CHECK(motion.acceleration()[i] == Approx(peer_samples[i]).epsilon(1e-15));
  }
}

TEST_CASE("the old database states filters after the units", "[records]") {
  const std::string old = replaced(peer("  5  .0100 NPTS, DT"), "TIME SERIES IN UNITS OF G",
                                   "TIME HISTORY IN UNITS OF G. FILTER POINTS: HP=0.1 Hz LP=40.0 Hz");
  CHECK(read(old).acceleration()[2] == Approx(0.5 * g));
}

TEST_CASE("columns that run together are parted at the sign", "[records]") {
  const GroundMotion motion = read(peer("2 .01 NPTS, DT", "-0.123E-01-0.456E-02\n"));
  CHECK(motion.acceleration()[0] == Approx(-0.0123 * g));
  CHECK(motion.acceleration()[1] == Approx(-0.00456 * g));
  says(refusal(peer("2 .01 NPTS, DT", "0.123E-010.456E-02\n")), {"line 5", "0.123E-010.456E-02"});
}

TEST_CASE("velocity and displacement are not taken for acceleration", "[records]") {
  says(refusal(replaced(peer("5 .01 NPTS, DT"), "ACCELERATION TIME SERIES IN UNITS OF G",
                        "VELOCITY TIME SERIES IN UNITS OF CM/S")),
       {"line 3", "AT2", "VELOCITY"});
  says(refusal(smc("3 VELOCITY")), {"line 1", "accelerogram", "3 VELOCITY"});
  says(refusal(cosmos_channel("HNE", cosmos_velocity(), "velocity")), {"no channel", "acceleration"});
}

TEST_CASE("the header's number of samples is kept", "[records]") {
  says(refusal(peer("NPTS= 6, DT= .01 SEC")), {"ends after 5 of the 6 samples"});
  says(refusal(peer("NPTS= 4, DT= .01 SEC")), {"line 7", "more than the 4 samples"});
  says(refusal(peer("NPTS= 4, DT= .01 SEC", "1 2 3 4 5\n")), {"line 5", "more than the 4 samples"});
  says(refusal(peer("NPTS= 900000000000000, DT= .01 SEC")), {"ends after 5"});
  says(refusal(peer("NPTS= 4.5, DT= .01 SEC")), {"line 4", "whole number", "4.5"});
  says(refusal(peer("NPTS= many, DT= .01 SEC")), {"line 4", "NPTS= many"});
  says(refusal(peer("NPTS= 4096, DT= .01 SEC", "")), {"ends after 0 of the 4096"});
  says(refusal(smc("2 CORRECTED ACCELEROGRAM", 11)), {"ends after 10 of the 11"});
  says(refusal(smc("2 CORRECTED ACCELEROGRAM", 9)), {"line 31", "more than the 9"});
  says(refusal(cosmos_channel("HNE", replaced(cosmos_data, "      10 acc", "      11 acc"))),
       {"line 52", "number 11 of the 11", "End-of-data"});
  says(refusal(cosmos_channel("HNE", replaced(cosmos_data, "      10 acc", "       8 acc"))),
       {"line 51", "more than the 8"});
}

TEST_CASE("a bad time step or too few samples are refused", "[records]") {
  says(refusal(peer("NPTS= 5, DT= 0 SEC")), {"dt must be positive", "got 0 s"});
  says(refusal(peer("NPTS= 5, DT= -.01 SEC")), {"dt must be positive", "got -0.01 s"});
  says(refusal(peer("NPTS= 1, DT= .01 SEC", "0.5\n")), {"at least two samples, got 1"});
  says(refusal(smc("2 CORRECTED ACCELEROGRAM", 10, 0)), {"sampling rate", "got 0"});
  says(refusal(smc("2 CORRECTED ACCELEROGRAM", 10, 1.7e38)), {"sampling rate", "1.7e+38"});
  says(refusal(replaced(cosmos_channel("HNE", cosmos_data), "       5.000000", "    -999.000000")),
       {"dt must be positive", "-0.999"});
}

TEST_CASE("words among the samples are refused with their line", "[records]") {
  for (const char* word : {"nan", "NaN", "inf", "-Infinity", "text", "********", "1e999", "0x10", "1..5"})
    says(refusal(peer("5 .01 NPTS, DT", "1 2 3\n4 " + std::string(word) + "\n")),
         {"line 6", "number 5 of the 5", word[1] == 'x' || word[2] == '.' ? "'" : word});
}

TEST_CASE("an SMC file is read", "[records]") {
  const GroundMotion motion = read(smc());
  CHECK(motion.samples() == 10);
  CHECK(motion.dt() == 0.01);
  CHECK(motion.acceleration()[1] == Approx(-0.022223));
  CHECK(motion.peak_acceleration() == Approx(0.55295));
  CHECK(motion.name() == "1999 1 2 0304 Made-up Creek, Made-up School, 270");
  CHECK(samples(read(smc(), {.units = "gal", .component = "270"})) == samples(motion));
  says(refusal(smc(), {.units = "", .component = "90"}), {"1 270", "'90'"});
}

TEST_CASE("a GeoNet file holds three components", "[records]") {
  const GroundMotion first = read(geonet(), {.units = "", .component = "N28W"});
  CHECK(first.samples() == 12);
  CHECK(first.dt() == 0.02);
  CHECK(first.acceleration()[0] == Approx(0.0002));
  CHECK(first.acceleration()[9] == Approx(-11.0247));
  CHECK(first.name() == "5 km east of Nowhere, 2001 February 03, MADE Made-up Farm, N28W");
  CHECK(read(geonet(), {.units = "", .component = "2"}).acceleration()[0] == Approx(0.0012));
  CHECK(read(geonet(), {.units = "", .component = "up"}).acceleration()[9] == Approx(100));
  for (const char* component : {"", "4", "0", "-1", "N28", "1x"})
    says(refusal(geonet(), {.units = "", .component = component}), {"1 N28W, 2 S62W, 3 Up", component});
}

TEST_CASE("an uncorrected GeoNet file has no velocity", "[records]") {
  const std::string values =
      "     0.2    -0.1     0.2    -0.1     0.2    -0.1     0.2    -0.1     0.2    -0.1\n 0.2 0.3\n";
  const std::string raw = replaced(replaced(geonet_component("S14E", values, 0), "Corrected", "Uncorrected"),
                                   "Instrument corrected data at 0.020 sec intervals",
                                   "Raw readings in units of 1.00 mm/s/s  at intervals of 0.020 s");
  CHECK(read(raw).acceleration()[11] == Approx(0.0003));
  says(refusal(replaced(raw, "1.00 mm", "0.01 mm")), {"line 11", "units of 1.00 mm/s/s", "0.01"});
  says(refusal(raw + " 0.1\n"), {"heading"});
}

TEST_CASE("a truncated GeoNet file is refused whichever component is wanted", "[records]") {
  const std::string whole = geonet();
  for (const std::size_t part : {4u, 3u, 2u})
    CHECK(refusal(whole.substr(0, whole.size() / 5 * part), {.units = "", .component = "1"}) != "accepted");
}

TEST_CASE("a COSMOS file is read, also where its columns run together", "[records]") {
  const GroundMotion motion = read(cosmos_channel("HNE", cosmos_data));
  CHECK(motion.dt() == 0.005);
  CHECK(motion.samples() == 10);
  CHECK(motion.acceleration()[2] == Approx(10.0012345));
  CHECK(motion.acceleration()[3] == Approx(10.0012345));
  CHECK(motion.acceleration()[9] == Approx(-g));
  CHECK(motion.name() == "Made-up Earthquake of Fri Nov 30, 2018, AK-MADE UAF Made-up River, HNE");
}

TEST_CASE("the channels of a COSMOS file are counted without velocity", "[records]") {
  const std::string two = cosmos_channel("HNE", cosmos_data + cosmos_velocity()) +
                          cosmos_channel("HNE", cosmos_velocity(), "velocity") +
                          cosmos_channel("", replaced(cosmos_data, "   1.00000", "  11.00000"));
  CHECK(read(two, {.units = "", .component = "HNE"}).acceleration()[0] == Approx(0.01));
  CHECK(read(two, {.units = "", .component = "2"}).acceleration()[0] == Approx(0.11));
  CHECK(read(two, {.units = "", .component = "90 deg"}).acceleration()[0] == Approx(0.11));
  says(refusal(two), {"1 HNE, 2 90 deg"});
}

TEST_CASE("a COSMOS file in other units", "[records]") {
  const auto in = [](const std::string& units) {
    return cosmos_channel("HNE", replaced(cosmos_data, "cm/sec2(04)", units));
  };
  CHECK(read(in("g (02)")).acceleration()[0] == Approx(g));
  CHECK(read(in("cm/s^2")).acceleration()[0] == Approx(0.01));
  says(refusal(in("counts (50)")), {"unknown unit", "'counts'"});
}

TEST_CASE("two columns may be parted by a comma, a semicolon, a tab or blanks", "[records]") {
  for (const char* mark : {",", ";", "\t", " ", "   ", ", ", " ; ", " ,\t"}) {
    const GroundMotion motion =
        read(replaced("Time (s),Acceleration (cm/s^2)\n0.00,1\n0.01,-2.5\n\n0.02,3e1\n", ",", mark));
    CHECK(motion.dt() == 0.01);
    CHECK(samples(motion) == std::vector<double>{0.01, -2.5 * 0.01, 30 * 0.01});
    CHECK(motion.name() == "made_up");
  }
}

TEST_CASE("records as pyslammer writes them", "[records]") {
  const std::string text =
      "# Time Series: Made-up Valley, Nowhere 1999 - TCU-090\n# Time (s),Acceleration (g's)\n"
      "0.0,-6.0E-4\n0.005,6.86513E-4\n0.01,0.5\n0.015,-1.2";
  for (const bool dos : {false, true}) {
    const GroundMotion motion = read(dos ? "\xEF\xBB\xBF" + replaced(text, "\n", "\r\n") : text);
    CHECK(motion.name() == "Made-up Valley, Nowhere 1999 - TCU-090");
    CHECK(motion.dt() == 0.005);
    CHECK(samples(motion) == std::vector<double>{-6.0E-4 * g, 6.86513E-4 * g, 0.5 * g, -1.2 * g});
  }
}

TEST_CASE("a byte-order mark and DOS line ends are taken in every format", "[records]") {
  for (const std::string& text : {peer("5 .01 NPTS, DT"), smc(), geonet(), cosmos_channel("HNE", cosmos_data)}) {
    const RecordOptions first{.units = "", .component = "1"};
    const GroundMotion dos = read("\xEF\xBB\xBF" + replaced(text, "\n", "\r\n") + "\x1A", first);
    CHECK(samples(dos) == samples(read(text, first)));
    CHECK(dos.name() == read(text, first).name());
  }
}

TEST_CASE("names come out in UTF-8", "[records]") {
  CHECK(read("# D\xFCzce\n# units: g\n0 1\n1 2\n").name() == "D\xC3\xBCzce");
  CHECK(read("# D\xC3\xBCzce\n# units: g\n0 1\n1 2\n").name() == "D\xC3\xBCzce");
}

TEST_CASE("units come from labels, from a line on units, or from the caller", "[records]") {
  const std::string rows = "0,1\n1,2\n";
  const auto first = [&](const std::string& header, const RecordOptions& options = {}) {
    return read(header + rows, options).acceleration()[0];
  };
  CHECK(first("time [s], acc [cm/s^2]\n") == 0.01);
  CHECK(first("made up\nmore text\n# t (sec) a (ft/s2)\n") == 0.3048);
  CHECK(first("Time, Acceleration (g)\n") == g);
  CHECK(first("# Units: gal\nTime,Acceleration\n") == 0.01);
  CHECK(first("# United States\n# Time (s), Acceleration (m/s/s)\n") == 1);
  CHECK(first("", {.units = "g", .component = ""}) == g);
  CHECK(first("t (s), a (cm/s/s)\n", {.units = "gal", .component = ""}) == 0.01);

  says(refusal(rows), {"made_up.txt", "no units", "pass units"});
  says(refusal("Time (s), Acceleration\n" + rows), {"pass units"});
  says(refusal("Time (s), Acceleration (furlong/s^2)\n" + rows), {"unknown unit", "furlong", "known are"});
  says(refusal("Time (s), Acceleration (g)\n" + rows, {.units = "m/s^2", .component = ""}), {"'g'", "'m/s^2'"});
  says(refusal("Time (s), Acceleration (g)\n" + rows, {.units = "fathom", .component = ""}), {"'fathom'", "known"});
  says(refusal("Time (ms), Acceleration (g)\n" + rows), {"line 1", "seconds", "'ms'"});
  says(refusal("Acceleration (g), Time (s)\n" + rows), {"line 1", "first column must be time", "'g'"});
}

TEST_CASE("another number of columns than two is refused with its line", "[records]") {
  const RecordOptions in_g{.units = "g", .component = ""};
  says(refusal("0,1\n0.1,2,3\n", in_g), {"line 2", "two columns", "got 3"});
  says(refusal("# c\n0,1\n0.1\n", in_g), {"line 3", "two columns", "got 1"});
  says(refusal("0,1\n0.1,2,\n", in_g), {"line 2", "got 3"});
  says(refusal("0,005;0,1\n", in_g), {"line 1", "got 4"});
  says(refusal("0.1\n0.2\n0.3\n", in_g), {"line 1", "got 1"});
  says(refusal("SOME OTHER FORMAT\n1 2 3 4 5\n"), {"line 2", "got 5", "known formats", "PEER AT2"});
}

TEST_CASE("what is no number in two columns is refused with its line", "[records]") {
  const RecordOptions in_g{.units = "g", .component = ""};
  for (const char* word : {"nan", "-inf", "x", "1e999", "1.2.3", "--1", "+-1", "1-2"}) {
    says(refusal("0,1\n0.1," + std::string(word) + "\n", in_g), {"line 2", "two finite numbers", word});
    says(refusal("# made up\n0,1\n" + std::string(word) + ",2\n", in_g), {"line 3", word});
  }
  says(refusal("nan,1\n0.1,2\n", in_g), {"line 1", "nan"});
  says(refusal("0,1\n# not a comment any more\n", in_g), {"line 2"});
  says(refusal("Time (s), Acceleration (g)\n0,1\n"), {"line 2", "at least two"});
  says(refusal("Time (s), Acceleration (g)\n"), {"no known format"});
}

TEST_CASE("even times become a step, whatever their print", "[records]") {
  for (const double dt : {0.01, 0.005, 0.02, 0.0025, 1. / 128, 1. / 256})
    for (const char* format : {"%.3f", "%.4f", "%.6f", "%.17g", "%.6e"}) {
      INFO("dt " << dt << " as " << format);
      CHECK(read(table(even_times(4000, dt), format)).dt() == dt);
    }
  CHECK(read(table(even_times(4000, 1. / 300), "%.3f")).dt() == Approx(1. / 300).epsilon(1e-4));
  CHECK(read(table({0, 0.99}, "%.2f")).dt() == 0.99);
}

TEST_CASE("times added up step by step are even", "[records]") {
  std::vector<double> times;
  for (double t = 0; times.size() < 10000; t += 0.01) times.push_back(t);
  CHECK(read(table(times, "%.17g")).dt() == 0.01);
}

TEST_CASE("even times may start anywhere, the clock starts at 0", "[records]") {
  for (const double start : {-5., 0.01, 12.345}) {
    const GroundMotion motion = read(table(even_times(500, 0.01, start), "%.3f"));
    CHECK(motion.dt() == 0.01);
    CHECK(motion.time(0) == 0);
  }
}

TEST_CASE("uneven times are kept as they stand", "[records]") {
  for (const std::vector<double>& times : {std::vector<double>{0, 1, 2, 4}, {0, 1, 3, 4}, {0.5, 0.6, 0.8, 0.9}}) {
    const GroundMotion motion = read(table(times, "%.2f"));
    CHECK(std::isnan(motion.dt()));
    REQUIRE(motion.samples() == times.size());
    for (std::size_t i = 0; i < times.size(); ++i) CHECK(motion.time(i) == times[i]);
    CHECK(std::isnan(read(table(times, "%.1f")).dt()));
  }
}

TEST_CASE("a missing sample never hides in the rounding", "[records]") {
  for (const char* format : {"%.2f", "%.3f", "%.6f", "%.17g"}) {
    std::vector<double> times = even_times(1001, 0.01);
    times.erase(times.begin() + 500);
    CHECK(std::isnan(read(table(times, format)).dt()));
  }
}

TEST_CASE("times that do not increase are refused", "[records]") {
  says(refusal(table({0, 2, 1, 3, 4}, "%.1f")), {"times[2]", "got 1 s"});
  says(refusal(table({0, 1, 1, 3}, "%.1f")), {"times[2]"});
  says(refusal(table({3, 2, 1, 0}, "%.1f")), {"dt must be positive", "-1 s"});
  says(refusal(table({1, 1, 1, 1}, "%.1f")), {"dt must be positive", "0 s"});
}

TEST_CASE("what is no record is refused, with the formats known", "[records]") {
  for (const char* text : {"hello\n", "{\"a\": 1}\n", "# only\n# comments\n", "<html>\n</html>\n"})
    says(refusal(text), {"made_up.txt", "no known format", "PEER AT2", "COSMOS", "GeoNet", "SMC", "two columns"});
  for (const char* text : {"", "\n\n  \n", "\xEF\xBB\xBF"}) says(refusal(text), {"made_up.txt", "empty"});
  says(refusal(std::string("PK\3\4\0\0", 6)), {"NUL byte at offset 4"});
}

TEST_CASE("a file that cannot be opened is told apart from one that cannot be understood", "[records]") {
  const Folder folder;
  const auto code = [](const fs::path& file) -> std::error_code {
    try {
      read_record(file);
    } catch (const fs::filesystem_error& error) {
      CHECK(error.path1() == file);
      return error.code();
    }
    return {};
  };
  CHECK(code(folder.path() / "missing.AT2") == std::errc::no_such_file_or_directory);
  CHECK(code(folder.path()) == std::errc::is_a_directory);
  CHECK(code("") == std::errc::no_such_file_or_directory);
}

TEST_CASE("a damaged file is read or refused, and never more", "[records]") {
  std::mt19937 random(20240101);
  const std::string alphabet("0123456789.,-+eE \n\t#|()=xN\0\xFF", 29);
  for (const std::string& whole :
       {peer("5 .01 NPTS, DT"), smc(), geonet(), cosmos_channel("HNE", cosmos_data), table(even_times(9, 0.1), "%.1f")})
    for (int trial = 0; trial < 200; ++trial) {
      std::string text = whole.substr(0, trial % 4 == 0 ? random() % whole.size() : whole.size());
      for (int hit = trial % 4; hit > 0 && !text.empty(); --hit)
        text[random() % text.size()] = alphabet[random() % alphabet.size()];
      try {
        const GroundMotion motion = read(text, {.units = "", .component = "1"});
        CHECK(std::isfinite(motion.peak_acceleration()));
      } catch (const std::invalid_argument&) {
      }
    }
}

TEST_CASE("the peaks of a real GeoNet file are those its header states", "[records][real]") {
  const auto file = test::real_record("geonet/20161113_110259_WTMC_20.V2A");
  if (!file) return;
  struct Stated {
    const char* component;
    double peak, at;
  };
  // The header's times start after 250 samples put before the record.
  for (const auto& [component, stated, at] :
       {Stated{"N28W", -9.7331, 44.88}, Stated{"S62W", 7.9664, 45.96}, Stated{"Up", 18.0219, 44.14}}) {
    const GroundMotion motion = read_record(*file, {.units = "", .component = component});
    CHECK(motion.samples() == 8192);
    CHECK(motion.dt() == 0.02);
    CHECK(motion.duration() == Approx(163.82));
    CHECK(motion.acceleration()[peak(motion)] == Approx(stated).epsilon(1e-12));
    CHECK(motion.time(peak(motion)) == Approx(at + 250 * 0.02));
  }
}

TEST_CASE("the peak of a real SMC file is the one its header states", "[records][real]") {
  const auto file = test::real_record("smc/0111a.smc");
  if (!file) return;
  const GroundMotion motion = read_record(*file);
  CHECK(motion.samples() == 6001);
  CHECK(motion.dt() == 0.005);
  CHECK(motion.acceleration()[peak(motion)] == Approx(1.044078).epsilon(5e-5));  // printed with five digits
  CHECK(motion.time(peak(motion)) == Approx(10.17));
}

TEST_CASE("the peak of a real COSMOS file is the one its header states", "[records][real]") {
  const auto file = test::real_record("cosmos/akbmr_bnz.v2c");
  if (!file) return;
  const GroundMotion motion = read_record(*file, {.units = "", .component = "BNZ"});
  CHECK(motion.samples() == 42000);
  CHECK(motion.dt() == 0.005);
  CHECK(static_cast<double>(motion.samples()) * motion.dt() == Approx(210));
  CHECK(motion.acceleration()[peak(motion)] == Approx(-0.06851512).epsilon(1e-6));
  CHECK(motion.time(peak(motion)) == Approx(76.215));
}
