#include "stickslip/ground/records.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <optional>
#include <random>
#include <string>
#include <system_error>
#include <vector>

#include "ground/real_records.hpp"
#include "ground/record_files.hpp"
#include "stickslip/base/units.hpp"
#include "support/catch.hpp"

using namespace stickslip;
using namespace record_files;
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

  fs::path write(const std::string& content, const std::string& name = "invented.txt") const {
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

/// The error message for content that is rejected.
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

const std::vector<double> peer_samples = {-0.1 * g, 0.2 * g, 0.5 * g, -0.25 * g, 0.001 * g};

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

TEST_CASE("a PEER header is read by its labels", "[records]") {
  for (const char* line : {"File 3 NPTS= 5, DT= .01", "DT= .01, NPTS= 5", "NPTS : 5  DT : .01 s",
                           "npts 5 dt .01 seconds", "WIDTH= 7, NPTS= 5, DT= 1.0D-02 SEC, FILE 4", "5, .01, NPTS, DT"}) {
    INFO(line);
    CHECK(read(peer(line)).dt() == 0.01);
    CHECK(read(peer(line)).samples() == 5);
  }
  for (const char* line : {"NPTS= 5, DT=", "NPTS= 5, DT= x", "NPTS= , DT= .01", "5 .01 units of NPTS, DT", "NPTS, DT",
                           "NPTS= 5, DT= .01.5", "NPTS= 5, DT= .01-2.5", "NPTS= 5, DT= NaN", "NPTS= 5, DT= *****",
                           "5 NPTS, .01 DT", "NPTS= 5, WIDTH= .01"}) {
    INFO(line);
    says(refusal(peer(line)), {"line 4", "expected 'NPTS= 4096, DT= .0100 SEC'", line});
  }
  says(refusal(peer("NPTS= 5, DT= 10 MSEC")), {"line 4", "seconds", "'MSEC'"});
  says(refusal(peer("NPTS= 5, DT= 0x1p-7")), {"line 4", "seconds", "'x1p-7'"});
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

TEST_CASE("numbers are read as Fortran and C print them", "[records]") {
  const auto values = [](const std::string& line, int count) {
    return samples(read(replaced(peer(std::to_string(count) + " .01 NPTS, DT", line + "\n"), "OF G", "OF CM/S2")));
  };
  // Fortran leaves out the letter of an exponent of three digits; C does not, and neither prints a real without a
  // point.
  CHECK(values("1.234-100 -.5+003 1.234+02", 3) == std::vector<double>{1.234e-100 * .01, -.5e3 * .01, 123.4 * .01});
  CHECK(values("1.234D-05 1.234d+5 1.5E3 1.e0", 4) ==
        std::vector<double>{1.234e-5 * .01, 123400 * .01, 1500 * .01, 1 * .01});
  CHECK(values("-1.5-3.2+4.25 1.5-100.5", 5) ==
        std::vector<double>{-1.5 * .01, -3.2 * .01, 4.25 * .01, 1.5 * .01, -100.5 * .01});
  CHECK(values("0.123E-01-0.456E-02-0.5-100", 3) == std::vector<double>{.0123 * .01, -.00456 * .01, -.5e-100 * .01});
  CHECK(values("1-2", 2) == std::vector<double>{.01, -2 * .01});  // whole numbers have no exponent
  for (const char* word : {"1.5D", "1.5E+", ".", "+", "1.5.2", "1,5", "0x1p-3", "1.5D-", "1e-400", "*****", "1.5*****"})
    says(refusal(peer("3 .01 NPTS, DT", "1 2 3\n" + std::string(word) + "\n")), {"line 6"});
  for (const char* word : {"1.5D", ".", "1.5.2", "1,5", "0x1p-3", "1e-400", "*****", "1.5*****", "1.5-3x", "1.5-3.x"})
    says(refusal(peer("2 .01 NPTS, DT", "1\n" + std::string(word) + "\n")), {"line 6", "number "});
}

TEST_CASE("fields that overflow are refused with their line, in columns too", "[records]") {
  const std::string overflow = replaced(cosmos_data, "1000.12345", "**********");
  says(refusal(cosmos_channel("HNE", overflow)), {"line 50", "number 2 of the 10", "*****"});
  says(refusal("****,0.5\n0.1,2\n0.2,3\n", {.units = "g"}), {"line 1", "finite numbers", "****"});
  says(refusal(",0.5\n0.1,2\n0.2,3\n", {.units = "g"}), {"line 1", "finite numbers"});
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
  says(refusal(smc("2 CORRECTED ACCELEROGRAM", 10, 1.7e38)), {"no sampling rate", "uneven"});
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
  says(refusal(smc(), {.component = "90"}), {"1 270", "'90'"});
}

TEST_CASE("a GeoNet file holds three components", "[records]") {
  const GroundMotion first = read(geonet(), {.component = "N28W"});
  CHECK(first.samples() == 12);
  CHECK(first.dt() == 0.02);
  CHECK(first.acceleration()[0] == Approx(0.0002));
  CHECK(first.acceleration()[9] == Approx(-11.0247));
  CHECK(first.name() == "5 km east of Nowhere, 2001 February 03, MADE Made-up Farm, N28W");
  CHECK(read(geonet(), {.component = "2"}).acceleration()[0] == Approx(0.0012));
  CHECK(read(geonet(), {.component = "up"}).acceleration()[9] == Approx(100));
  for (const char* component : {"", "4", "0", "-1", "N28", "1x"})
    says(refusal(geonet(), {.component = component}), {"1 N28W, 2 S62W, 3 Up", component});
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
    CHECK(refusal(whole.substr(0, whole.size() / 5 * part), {.component = "1"}) != "accepted");
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
  CHECK(read(two, {.component = "HNE"}).acceleration()[0] == Approx(0.01));
  CHECK(read(two, {.component = "2"}).acceleration()[0] == Approx(0.11));
  CHECK(read(two, {.component = "90 deg"}).acceleration()[0] == Approx(0.11));
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
    CHECK(motion.name() == "invented");
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

TEST_CASE("all that a file leaves unspecified is told at once", "[records]") {
  says(refusal("1\n2\n3\n"), {"no units of acceleration and no time step: pass units", ", and pass dt"});
  says(refusal("1\n2\n3\n", {.units = "g"}), {"the file states no time step: pass dt"});
  says(refusal("1\n2\n3\n", {.dt = 0.1}), {"the file states no units of acceleration: pass units"});
}

TEST_CASE("a byte-order mark and DOS line ends are taken in every format", "[records]") {
  for (const std::string& text : {peer("5 .01 NPTS, DT"), smc(), geonet(), cosmos_channel("HNE", cosmos_data)}) {
    const RecordOptions first{.component = "1"};
    const GroundMotion dos = read("\xEF\xBB\xBF" + replaced(text, "\n", "\r\n") + "\x1A", first);
    CHECK(samples(dos) == samples(read(text, first)));
    CHECK(dos.name() == read(text, first).name());
  }
}

TEST_CASE("headers of many megabytes are read or refused", "[records]") {
  const auto many = [](const std::string& part, std::size_t bytes = 1'000'000) {
    std::string text;
    while (text.size() < bytes) text += part;
    return text;
  };
  says(refusal("a\nb\nACCELERATION G\nNPTS DT " + many("1", 8'000'000) + "\n1 2 3\n"), {"line 4", "expected 'NPTS="});
  says(refusal(peer(many("NPTS DT NPTSDT "))), {"line 4", "expected 'NPTS="});
  says(refusal("time (s) acc (" + many("sec", 8'000'000) + ")\n0,1\n.1,2\n"), {"states no units of acceleration"});
  for (const char* part : {"g's", "**", "s/s", "(", "[)", "unit", "unit ", "(s) ", "\xC2\xB2"})
    CHECK(refusal("# " + many(part) + "\n0,1\n.1,2\n").size() < 400);
  says(refusal(replaced(geonet(), "Instrument corrected data", "data in units of " + many("1")), {.component = "1"}),
       {"line 11", "units of 1.00 mm/s/s"});
  says(refusal("0,1\n0.1," + many("1")), {"line 2", "finite numbers"});
  says(refusal("0,1\n0.1," + many("1 ,")), {"line 2", "expected 2 columns as in line 1"});
  CHECK(read("# " + many("title ") + "\n0,1\n.1,2\n", {.units = "g"}).name().size() < 300);
  const std::string channel = cosmos_channel("HNE", many("0 accel pts\nEnd\n"));
  says(refusal(replaced(channel, "Made-up Earthquake", std::string(1'000'000, 'x'))), {"1 HNE, 2 HNE", "and so on to"});
}

TEST_CASE("names and messages are valid UTF-8", "[records]") {
  const RecordOptions in_g{.units = "g"};
  const std::string bad = "\xEF\xBF\xBD";  // U+FFFD
  struct Name {
    std::string bytes, read;
  };
  for (const auto& [bytes, name] : {Name{"\xED\xA0\x80", bad},                     // a surrogate
                                    Name{"\xED\xBF\xBF", bad},                     //
                                    Name{"\xC0\xAF", bad},                         // overlong forms of /
                                    Name{"\xE0\x80\xAF", bad},                     //
                                    Name{"\xF0\x80\x80\xAF", bad},                 //
                                    Name{"\xF4\x90\x80\x80", bad},                 // above U+10FFFF
                                    Name{"\xF7\xBF\xBF\xBF", bad},                 //
                                    Name{"\xED\x9F\xBF", "\xED\x9F\xBF"},          // the last before surrogates
                                    Name{"\xEE\x80\x80", "\xEE\x80\x80"},          // the first after
                                    Name{"\xF0\x9F\x8C\x8B", "\xF0\x9F\x8C\x8B"},  // a volcano
                                    Name{"\xF4\x8F\xBF\xBF", "\xF4\x8F\xBF\xBF"},  //
                                    Name{"a\x1B[31m\x7F"
                                         "b",
                                         "a [31m b"},  // control characters
                                    Name{"a\xC2\x9B"
                                         "31m",
                                         "a 31m"}}) {  // of eight bits
    CHECK(read("# x" + bytes + " y\n0,1\n.1,2\n", in_g).name() == "x" + name + " y");
    says(refusal("# x\n0,1\nx" + bytes + ",2\n", in_g), {"line 3", ("got 'x" + replaced(name, " [", " [")).c_str()});
  }
  const std::string cut = read("# " + std::string(255, 'x') + "\xC3\xBC" + "\n0,1\n.1,2\n", in_g).name();
  CHECK(cut == std::string(255, 'x') + "...");
}

TEST_CASE("a file name that is not UTF-8 names the motion and the error in UTF-8", "[records]") {
  const Folder folder;
  const fs::path file = folder.write("0,1\n.1,2\n",
                                     "\xFF"
                                     "a.csv");
  CHECK(read_record(file, {.units = "g"}).name() ==
        "\xEF\xBF\xBD"
        "a");
  try {
    read_record(file);
    FAIL("no units, and accepted");
  } catch (const std::invalid_argument& error) {
    says(error.what(), {"/\xEF\xBF\xBD"
                        "a.csv: the file states no units"});
  }
}

TEST_CASE("names come out in UTF-8", "[records]") {
  CHECK(read("# D\xFCzce\n# units: g\n0 1\n.1 2\n").name() == "D\xC3\xBCzce");
  CHECK(read("# D\xC3\xBCzce\n# units: g\n0 1\n.1 2\n").name() == "D\xC3\xBCzce");
}

TEST_CASE("units come from labels, from a line on units, or from the caller", "[records]") {
  const std::string rows = "0,1\n.1,2\n";
  const auto first = [&](const std::string& header, const RecordOptions& options = {}) {
    return read(header + rows, options).acceleration()[0];
  };
  CHECK(first("time [s], acc [cm/s^2]\n") == 0.01);
  CHECK(first("made up\nmore text\n# t (sec) a (ft/s2)\n") == 0.3048);
  CHECK(first("Time, Acceleration (g)\n") == g);
  CHECK(first("# Units: gal\nTime,Acceleration\n") == 0.01);
  CHECK(first("# United States\n# Time (s), Acceleration (m/s/s)\n") == 1);
  CHECK(first("", {.units = "g"}) == g);
  CHECK(first("t (s), a (cm/s/s)\n", {.units = "gal"}) == 0.01);

  says(refusal(rows), {"invented.txt", "no units", "pass units"});
  says(refusal("Time (s), Acceleration\n" + rows), {"pass units"});
  says(refusal("Time (s), Acceleration (furlong/s^2)\n" + rows), {"unknown unit", "furlong", "known are"});
  says(refusal("Time (s), Acceleration (g)\n" + rows, {.units = "m/s^2"}), {"'g'", "'m/s^2'"});
  says(refusal("Time (s), Acceleration (g)\n" + rows, {.units = "fathom"}), {"'fathom'", "known"});
}

TEST_CASE("another number of columns than in the first row is refused with its line", "[records]") {
  const RecordOptions in_g{.units = "g"};
  says(refusal("0,1\n0.1,2,3\n", in_g), {"line 2", "expected 2 columns as in line 1", "got 3"});
  says(refusal("# c\n0,1\n0.1\n", in_g), {"line 3", "expected 2 columns as in line 2", "got 1"});
  says(refusal("0,1\n0.1,2,3\n", in_g), {"line 2", "got 3"});
  says(refusal("SOME OTHER FORMAT\n4 9 3 8 5\n2 9 3 8 5\n3 9 3 8 5\n"), {"line 2", "not time", "record_formats"});
}

TEST_CASE("an invalid number in two columns is rejected with its line", "[records]") {
  const RecordOptions in_g{.units = "g"};
  for (const char* word : {"nan", "-inf", "x", "1e999", "1.2.3", "--1", "+-1", "1-2"}) {
    says(refusal("0,1\n0.1," + std::string(word) + "\n", in_g), {"line 2", "finite numbers", word});
    says(refusal("# made up\n0,1\n" + std::string(word) + ",2\n", in_g), {"line 3", word});
  }
  says(refusal("nan,1\n0.1,2\n", in_g), {"line 1", "nan"});
  says(refusal("0,1\nno comment\n", in_g), {"line 2"});
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

TEST_CASE("times printed with so many digits are even as far as each is printed", "[records]") {
  for (const char* format : {"%.3e", "%.4g"}) {
    CHECK(read(table(even_times(500, 0.02), format)).dt() == 0.02);
    CHECK(read(table(even_times(500, 1. / 16), format)).dt() == 1. / 16);
    CHECK(read(table(even_times(2000, 1e-7), format)).dt() == 1e-7);
    CHECK(read(table(even_times(3, 1e-7), format)).dt() == 1e-7);
    // One early time off by 2 units of its own last place, a fiftieth of the last time's.
    std::vector<double> times = even_times(500, 0.02);
    times[4] += 2e-4;
    const GroundMotion motion = read(table(times, format));
    CHECK(std::isnan(motion.dt()));
    CHECK(motion.time(4) == 0.0802);
    CHECK(motion.time(499) == 9.98);
  }
  // Steps that grow from 0.02 to 0.04 s: the same at %.3e, whose unit is 0.01 s in the end.
  std::vector<double> times = even_times(1000, 0.02);
  for (double& t : times) t *= 1 + t / 40;
  CHECK(std::isnan(read(table(times, "%.3e")).dt()));
  // Microseconds of an uneven clock that starts at 0, which %.3e prints with three places.
  times = even_times(1000, 1e-6);
  times[500] += 4e-7;
  CHECK(std::isnan(read(table(times, "%.3e")).dt()));
}

TEST_CASE("a time off by one unit of its last place is even, by two it is not", "[records]") {
  for (const char* format : {"%.2f", "%.4f", "%.5e"}) {
    const std::vector<double> even = even_times(400, 1.);
    for (const auto& [off, is_even] : {std::pair{0.5, true}, {2., false}}) {
      std::vector<double> times = even;
      times[150] += off * (format[2] == '2' ? 1e-2 : format[2] == '4' ? 1e-4 : 1e-3);
      CHECK(std::isnan(read(table(times, format)).dt()) != is_even);
    }
  }
}

TEST_CASE("times that do not increase are refused", "[records]") {
  says(refusal(table({0, 2, 1, 3, 4}, "%.1f")), {"line 4", "must increase", "'1.0' after 2"});
  says(refusal(table({0, 1, 1, 3}, "%.1f")), {"line 4", "'1.0' after 1"});
  says(refusal(table({3, 2, 1, 0}, "%.1f")), {"line 3", "'2.0' after 3"});
  says(refusal(table({1, 1, 1, 1}, "%.1f")), {"line 3", "'1.0' after 1"});
}

TEST_CASE("a file that is not a record is rejected, with the list of formats", "[records]") {
  for (const char* text : {"hello\n", "{\"a\": 1}\n", "# only\n# comments\n", "<html>\n</html>\n"})
    says(refusal(text),
         {"invented.txt", "no known format", "PEER AT2", "COSMOS", "GeoNet", "SMC", "columns of numbers"});
  for (const char* text : {"", "\n\n  \n", "\xEF\xBB\xBF"}) says(refusal(text), {"invented.txt", "empty"});
  says(refusal(std::string("PK\3\4\0\0x", 7)), {"NUL byte at offset 4"});
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
        const GroundMotion motion = read(text, {.component = "1"});
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
    const GroundMotion motion = read_record(*file, {.component = component});
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
  const GroundMotion motion = read_record(*file, {.component = "BNZ"});
  CHECK(motion.samples() == 42000);
  CHECK(motion.dt() == 0.005);
  CHECK(static_cast<double>(motion.samples()) * motion.dt() == Approx(210));
  CHECK(motion.acceleration()[peak(motion)] == Approx(-0.06851512).epsilon(1e-6));
  CHECK(motion.time(peak(motion)) == Approx(76.215));
}
