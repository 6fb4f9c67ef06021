// Formats of the agencies of Turkiye, Taiwan, Mexico and China, of SIGMA and of SCEC.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include "ground/agency_files.hpp"
#include "ground/real_records.hpp"
#include "stickslip/base/units.hpp"
#include "stickslip/ground/processing.hpp"
#include "stickslip/ground/records.hpp"
#include "support/catch.hpp"

using namespace stickslip;
using namespace record_files;
using Catch::Matchers::ContainsSubstring;

namespace {

constexpr double g = standard_gravity;

GroundMotion read(const std::string& content, const RecordOptions& options = {}) {
  return parse_record(content, "made_up.txt", options);
}

std::vector<RecordComponent> all(const std::string& content) { return parse_components(content, "made_up.txt"); }

void refuses(const std::string& content, std::initializer_list<const char*> parts) {
  std::string message = "accepted";
  try {
    all(content);
  } catch (const std::invalid_argument& error) {
    message = error.what();
  }
  for (const char* part : parts) CHECK_THAT(message, ContainsSubstring(part));
}

/// The names and orientations of all components.
std::vector<std::pair<std::string, std::string>> names(const std::string& content) {
  std::vector<std::pair<std::string, std::string>> found;
  for (const RecordComponent& one : all(content)) found.emplace_back(one.name, one.motion.orientation());
  return found;
}

using Names = std::vector<std::pair<std::string, std::string>>;

}  // namespace

TEST_CASE("the files of agencies are told apart, in every case and with every line end", "[records]") {
  const std::pair<std::string, std::string> files[] = {{afad(), "AFAD (Turkiye)"},  {cwb(), "CWB (Taiwan)"},
                                                       {asa(), "ASA 2.0 (Mexico)"}, {csmnc(), "CSMNC (China)"},
                                                       {sigma(), "SIGMA"},          {bbp(), "SCEC Broadband Platform"}};
  for (const auto& [text, name] : files) {
    CAPTURE(name);
    CHECK(record_format(text)->name == name);
    const std::vector<RecordComponent> plain = all(text);
    for (const std::string& other :
         {"\xEF\xBB\xBF" + text, replaced(text, "\n", "\r\n"), replaced(text, "\n", "  \n"), "\n" + text}) {
      const std::vector<RecordComponent> read = all(other);
      REQUIRE(read.size() == plain.size());
      for (std::size_t k = 0; k < read.size(); ++k) CHECK(read[k].motion == plain[k].motion);
    }
    std::string upper = text, lower = text;
    std::ranges::transform(upper, upper.begin(), [](char c) { return c >= 'a' && c <= 'z' ? char(c - 32) : c; });
    std::ranges::transform(lower, lower.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? char(c + 32) : c; });
    for (const std::string& other : {upper, lower}) {
      CHECK(record_format(other)->name == name);
      CHECK(all(other)[0].motion.peak_acceleration() == plain[0].motion.peak_acceleration());
    }
  }
  // Each key alone makes no format.
  for (const char* table : {"# Number of Data: 2\n# units: g\n0 1\n1 2\n", "# StationCode: X\n# units: g\n0 1\n1 2\n",
                            "# Column 1: Time (s)\n# units: g\n0 1\n1 2\n"})
    CHECK(record_format(table)->name == "columns of numbers");
}

TEST_CASE("a file of AFAD has three columns in gal", "[records]") {
  const std::vector<RecordComponent> three = all(afad());
  REQUIRE(three.size() == 3);
  CHECK(names(afad()) == Names{{"N-S", "N-S"}, {"E-W", "E-W"}, {"U-D", "U-D"}});
  CHECK(three[0].motion.dt() == 0.01);
  CHECK(three[0].motion.samples() == 5);
  CHECK(three[0].motion.acceleration()[2] == Approx(-0.0980665).epsilon(1e-14));
  CHECK(three[1].motion.acceleration()[3] == Approx(-0.03).epsilon(1e-14));
  CHECK(three[2].motion.peak_acceleration() == Approx(0.12345678).epsilon(1e-14));
  CHECK(three[2].motion.name() == "2001/02/03 04:05:06 (GMT), 9999 MADE-UP DEVLET HASTANESI, U-D");
  CHECK(three[0].start == "03/02/2001 04:05:01.000000 (GMT)");
  CHECK(three[0].units == "gal");
  CHECK(names(afad("  V  L  T"))[0] == std::pair<std::string, std::string>("V", "V"));
  CHECK(read(replaced(afad(), "(gal)", "(mg)"), {.component = "N-S"}).acceleration()[1] == Approx(1.5e-3 * g));
}

TEST_CASE("a damaged file of AFAD is refused", "[records][errors]") {
  refuses(afad("       N-S          E-W          U-D", 6), {"ends after 5 of the 6 samples"});
  refuses(afad("       N-S          E-W          U-D", 4), {"line 23", "more than the 4 samples"});
  refuses(afad("  N-S  E-W"), {"line 19", "expected 2 numbers, got 3"});
  refuses(afad("  MORE: TEXT"), {"line 18", "names of the columns", "'N-S E-W U-D'", "MORE: TEXT"});
  refuses(replaced(afad(), "   -9.806650", "         nan"), {"line 21", "finite numbers", "nan"});
  refuses(replaced(afad(), "    0.000909", "         nan"), {"line 19", "finite numbers", "nan"});
  refuses(replaced(afad(), "12.345678", ""), {"line 21", "expected 3 numbers, got 2"});
  refuses(replaced(afad(), ": 0.01\n", ": ten\n"), {"line 14", "'SAMPLING INTERVAL (sec)'", "ten"});
  refuses(replaced(afad(), ": 0.01\n", ": 10\n"), {"line 14", "time step above 0 and up to 1 s", "10 s"});
  refuses(replaced(afad(), ": 0.01\n", ": -0.01\n"), {"line 14", "time step"});
  refuses(replaced(afad(), "RAW PGA VALUES (gal)", "RAW PGA VALUES"), {"no units of acceleration"});
  refuses(replaced(afad(), "(gal)", "(count)"), {"count"});
}

TEST_CASE("a file of Taiwan is read in its columns", "[records]") {
  const std::vector<RecordComponent> three = all(cwb());
  REQUIRE(three.size() == 3);
  CHECK(names(cwb()) == Names{{"U", "U"}, {"N", "N"}, {"E", "E"}});
  CHECK(three[0].motion.dt() == 0.02);
  CHECK(three[0].motion.samples() == 5);
  CHECK(three[0].motion.acceleration()[1] == Approx(0.0125).epsilon(1e-14));
  CHECK(three[1].motion.acceleration()[1] == Approx(-0.98067).epsilon(1e-14));
  CHECK(three[1].motion.acceleration()[4] == Approx(12.34567).epsilon(1e-14));
  CHECK(three[2].motion.acceleration()[4] == Approx(123.45679).epsilon(1e-14));
  CHECK(three[1].motion.name() == "2001/02/03-04:05:06, MAD Made-up, N");
  CHECK(three[1].start == "2001/02/03-04:05:01.000");
  CHECK(three[1].units == "gal");
  CHECK(all(replaced(cwb(), "#SampleRate(Hz): 50\n", ""))[0].motion == three[0].motion);
  CHECK(all(replaced(cwb(), "(sec): 0.1", "(sec): 0.08"))[0].motion == three[0].motion);
}

TEST_CASE("a damaged file of Taiwan is refused", "[records][errors]") {
  refuses(cwb("Time U(-); N(+); E(+)"), {"line 21", "'Time U(+); N(+); E(+)'", "U(-)"});
  refuses(cwb("U(+); N(+); E(+)"), {"line 21", "Time U(+)"});
  refuses(cwb("Time U(+); N(+)"), {"line 23", "expected 3 numbers, got 4"});
  refuses(cwb("Time U(+); N(+); E(+)", "100"), {"line 24", "sampling rate", "'100' Hz", "0.020"});
  refuses(cwb("Time U(+); N(+); E(+)", "0"), {"line 16", "time step"});
  refuses(replaced(cwb(), "     0.040    -0.500     2.000     4.000\n", ""), {"line 25", "times disagree", "0.060"});
  refuses(replaced(cwb(), "(sec): 0.1", "(sec): 0.2"), {"ends after 5 of the 10 samples"});
  refuses(replaced(cwb(), "(sec): 0.1", "(sec): 0.06"), {"line 26", "more than the 3 samples"});
  refuses(replaced(cwb(), "1.250~", "2.350~"), {"line 18", "a peak of 2.35", "1.25"});
  refuses(replaced(cwb(), " 1234.567~", "  123.457~"), {"line 19", "a peak of 123.457"});
  CHECK(read(replaced(replaced(cwb(), "1.250~", "2.350~"), " DCoffset(corr)", ""), {.component = "U"}).samples() == 5);
  refuses(replaced(cwb(), "  gal. DC", "  count. DC"), {"count"});
  refuses(replaced(cwb(), "-0.500     2", "*****     2"), {"line 25", "finite numbers"});
}

TEST_CASE("a standard file of Mexico is read by its sections", "[records]") {
  CHECK(std::ranges::count(asa(), '\n') == 109 + 5);
  const std::vector<RecordComponent> three = all(asa());
  REQUIRE(three.size() == 3);
  CHECK(names(asa()) == Names{{"V", "V"}, {"N90E", "N90E"}, {"N00E", "N00E"}});
  CHECK(three[0].motion.dt() == 0.004);
  CHECK(three[0].motion.samples() == 4);  // without the last row, which is there twice
  CHECK(three[0].motion.acceleration()[1] == Approx(-0.0145).epsilon(1e-14));
  CHECK(three[1].motion.acceleration()[3] == Approx(-0.9807).epsilon(1e-14));
  CHECK(three[2].motion.acceleration()[0] == Approx(-0.0064).epsilon(1e-14));
  CHECK(three[1].motion.name() == "2001/02/03 04:05:06.0, MADE ACANTILADO, N90E");
  CHECK(three[1].start == "04:05:30.00");
  CHECK(three[1].units == "gal");
  // Another length of the header, and other names of the same things.
  const std::string shorter = replaced(replaced(asa(), std::string(14, '\n'), "\n"), "SISMO [GMT]", "SISMO (GMT)");
  CHECK(all(shorter)[1].motion == three[1].motion);
}

TEST_CASE("a damaged standard file of Mexico is refused", "[records][errors]") {
  refuses(replaced(asa(6), "0.016", "0.024"), {"ends after 5 of the 6 samples"});
  refuses(replaced(asa(3), "0.016", "0.012"), {"line 113", "more than the 3 samples"});
  refuses(replaced(asa(), "0.016", "0.16"), {"line 70", "duration"});
  refuses(replaced(asa(), "/250/250/250", "/100/100/100"), {"line 47", "samples per second"});
  refuses(replaced(asa(), "/0.004/0.004/0.004", "/0.004/0.004/0.005"),
          {"line 47", "same number for each channel", "0.005"});
  refuses(replaced(asa(), "/0.004/0.004/0.004", "/0.004/0.004"), {"line 47", "3 channels", "got 2"});
  refuses(replaced(asa(), "INTERVALO DE", "INTERVALO"), {"no 'INTERVALO DE MUESTREO, C1-C6'"});
  refuses(replaced(asa(), "/V;+/", "/V;-/"), {"line 37", "directions of positive samples", "V;-"});
  refuses(replaced(asa(), "/-1.45/98.07", "/-1.45/9.807"), {"line 74", "a peak of 9.807", "98.0"});
  refuses(replaced(asa(), "      N90E      N00E", "      N00E      N90E"), {"line 108", "directions"});
  refuses(replaced(asa(), "Gal (cm/s/s)", "cm/s"), {"cm/s"});
  refuses(replaced(asa(), ": Gal (cm/s/s)", ":"), {"no units of acceleration"});
  refuses(replaced(asa(), "ESTANDAR DE ACELERACION", "ESTANDAR DE VELOCIDAD"), {"line 7", "expected acceleration"});
  refuses(replaced(asa(), "2.33     -0.64", " nan     -0.64"), {"line 110", "finite numbers"});
  refuses(replaced(replaced(asa(), ": /0.016/0.016/0.016", ":"), "DECIMACION                   : 1", "DECIMACION : 2"),
          {"line 79", "decimation"});
}

TEST_CASE("a file of China has one component", "[records]") {
  const GroundMotion motion = read(csmnc());
  CHECK(motion.dt() == 0.005);
  CHECK(motion.samples() == 10);
  CHECK(motion.acceleration()[0] == Approx(-1.151609e-4).epsilon(1e-14));
  CHECK(motion.acceleration()[2] == Approx(-10.0535).epsilon(1e-14));
  CHECK(motion.acceleration()[9] == Approx(g / 100).epsilon(1e-14));
  CHECK(motion.orientation() == "EW");
  CHECK(motion.name() == "MADE-UP EARTHQUAKE, NOWHERE,CHN, 99MAD, EW");
  CHECK(all(csmnc())[0].start == "2001-02-03 04:05:00.000 BTM");
  CHECK(all(csmnc())[0].units == "cm/s^2");
  CHECK(read(csmnc_corrected()) == motion);
  CHECK(read(replaced(csmnc(), "COMP. EW", "COMP. UD")).orientation() == "UD");
}

TEST_CASE("a damaged file of China and velocity are refused", "[records][errors]") {
  refuses(csmnc("CORRECTED VELOCITY                UNIT: CM/SEC"), {"line 11", "expected acceleration", "VELOCITY"});
  refuses(csmnc("UNCORRECTED ACCELERATION          UNIT: COUNT"), {"COUNT"});
  refuses(csmnc("UNCORRECTED ACCELERATION"), {"no line", "UNIT: CM/SEC/SEC"});
  refuses(csmnc("UNCORRECTED ACCELERATION          UNIT: CM/SEC/SEC", "-10.0535"), {"line 13", "-10.0535", "1005.35"});
  refuses(replaced(csmnc(), "POINTS:  10", "POINTS:  11"), {"ends after 10 of the 11 samples"});
  refuses(replaced(csmnc(), "POINTS:  10", "POINTS:  9"), {"line 18", "more than the 9 samples"});
  refuses(csmnc() + " 1.0\n", {"line 19", "more than the 10 samples"});
  refuses(replaced(csmnc(), "0.005  SEC", "0.005  MS"), {"line 12", "0.005 SEC", "expected"});
  refuses(replaced(csmnc(), "0.005  SEC", "5  SEC"), {"line 12", "time step", "5 s"});
  refuses(replaced(csmnc(), "-1.151609E-2", "         NaN"), {"line 17", "number 1 of the 10"});
}

TEST_CASE("a file of SIGMA is packed", "[records]") {
  const GroundMotion motion = read(sigma());
  CHECK(motion.dt() == 0.005);
  CHECK(motion.samples() == 7);
  CHECK(motion.acceleration()[2] == -8.42162e-6);
  CHECK(motion.acceleration()[3] == -0.980665);
  CHECK(motion.acceleration()[6] == 0.25);
  CHECK(motion.orientation() == "NS");
  CHECK(motion.name() == "2001-02-03 04:05:06, 9999 / Made-up, Italy, NS");
  CHECK(all(sigma())[0].units == "m/s^2");
  CHECK(read(sigma("UP")).orientation() == "UP");
}

TEST_CASE("a damaged file of SIGMA and velocity are refused", "[records][errors]") {
  refuses(sigma("NS", 8), {"ends after 7 of the 8 samples"});
  refuses(sigma("NS", 5), {"line 12", "more than the 5 samples"});
  refuses(replaced(sigma(), "Accelaration time series in m/s/s", "Velocity time series in m/s"),
          {"line 10", "acceleration time series", "Velocity"});
  refuses(replaced(sigma(), "9.8066500E-01\nAcc", "9.8066500E-02\nAcc"), {"line 9", "0.0980665", "0.980665"});
  refuses(replaced(sigma(), ": 0.005", ": 0"), {"line 7", "time step"});
  refuses(replaced(sigma(), " in m/s/s", ""), {"no units of acceleration"});
  refuses(replaced(sigma(), "-6.4590450E-06", "           nan"), {"line 12", "number 6 of the 7"});
}

TEST_CASE("a file of SCEC's platform describes its columns", "[records]") {
  const std::vector<RecordComponent> three = all(bbp());
  REQUIRE(three.size() == 3);
  CHECK(names(bbp()) == Names{{"N/S", "000"}, {"E/W", "090"}, {"U/D", "up"}});
  CHECK(three[0].motion.dt() == 0.0125);
  CHECK(three[0].motion.samples() == 4);
  CHECK(three[0].motion.acceleration()[1] == Approx(-0.1 * g).epsilon(1e-14));
  CHECK(three[2].motion.acceleration()[0] == Approx(0.003).epsilon(1e-14));
  CHECK(three[1].motion.name() == "MU_MADE, E/W");
  CHECK(three[1].start == "02/03/01,04:05:06.00 UTC");
  CHECK(three[1].units == "cm/s^2");
  std::string older = replaced(bbp("acceleration (m/s/s)"), "N/S component ground", "North-south");
  older = replaced(replaced(older, "is 000", "is northward"), "is 090", "is 300");
  CHECK(names(older) == Names{{"North-south", "north"}, {"E/W", "300"}, {"U/D", "up"}});
  CHECK(all(older)[0].motion.acceleration()[0] == 1.5);
}

TEST_CASE("a damaged file of SCEC's platform, velocity and displacement are refused", "[records][errors]") {
  refuses(bbp("velocity (cm/s)"), {"line 9", "expected a column of acceleration", "velocity (cm/s)"});
  refuses(bbp("displacement (cm)"), {"line 9", "displacement (cm)"});
  refuses(bbp("acceleration"), {"no units of acceleration"});
  refuses(bbp("acceleration (cm/s)"), {"cm/s"});
  refuses(replaced(bbp(), "Time (s)", "Time (ms)"), {"line 8", "time in seconds", "Time (ms)"});
  refuses(replaced(bbp(), "Time (s)", "Time"), {"line 8", "time in seconds"});
  refuses(replaced(bbp(), "2.500000e-02", "3.500000e-02"), {"line 15", "evenly spaced times", "3.500000e-02"});
  refuses(replaced(bbp(), "2.500000e-02", "0.000000e-02"), {"line 15", "evenly spaced times"});
  refuses(replaced(bbp(), "\t6\n", "\n"), {"line 15", "expected 4 numbers, got 3"});
  refuses(replaced(bbp(), "\t6\n", "\tnan\n"), {"line 15", "finite numbers", "nan"});
}

TEST_CASE("what a header states of its samples must be true of them", "[records][errors]") {
  const std::string two = csmip_since_1990();
  refuses(replaced(two, "in units of g", "in units of cm/s2"), {"line 12", "peak of 0.079 g"});
  refuses(replaced(two, "200 pts/sec", "50 pts/sec"), {"line 11", "duration of 60 s", "240 s"});
  refuses(replaced(usc_volume_2(), "  IN UNITS CM/SEC/SEC", "  IN UNITS G"), {"line 18", "242.3945 CMS/SEC/SEC"});
  refuses(replaced(geonet(), "Acceleration:", "Acceleration:  peak  -110.2 mm/s/s at  0.18 sec"),
          {"line 14", "peak of -110.2 mm/s/s"});
  refuses(replaced(geonet(), "at 0.020 sec", "at 0.010 sec"), {"line 11", "0.01 s", "0.02 s"});
  refuses(knet("N-S", 10, "20000(gal)/8000000"), {"line 15", "peak of 25 gal", "250 gal"});
  const std::string cosmos = replaced(cosmos_channel("HNE", cosmos_data), "Processed:\n",
                                      "Processed: today, Max =  1000.123 cm/sec2 at 0.02 sec\n");
  CHECK(all(cosmos).size() == 1);
  refuses(replaced(cosmos, "=cm/sec2(04)", "=mm/sec2(04)"), {"line 11", "peak of 1000.123 cm/sec2"});
  refuses(replaced(cosmos, "approx    0 secs", "approx   70 secs"), {"duration of 70 s"});
  // A last number that was cut off has no exponent, or a shorter one.
  for (const char* end : {"E-0", ""})
    refuses(peer("5 .01 NPTS, DT", std::string("  -.1E+00   .2E+00  .3E+00\n   .5E+00  .4E+00 .9459335") + end + "\n"),
            {"line 6", "cut off"});
}

TEST_CASE("CSMIP states rates and full integers since 1990", "[records]") {
  const std::string two = csmip_since_1990() + csmip_since_1990("Up");
  const std::vector<RecordComponent> found = all(two);
  REQUIRE(found.size() == 2);
  CHECK(names(two) == Names{{"360", "360"}, {"Up", "Up"}});
  CHECK(found[0].motion.samples() == 12000);
  CHECK(found[0].motion.dt() == 0.005);
  CHECK(found[0].motion.peak_acceleration() == Approx(0.079181 * g).epsilon(1e-14));
  refuses(replaced(two, "200 pts/sec", "zero pts/sec"), {"line 28", "equally spaced"});
  refuses(replaced(two, "200 pts/sec", "200 pts/min"), {"line 28", "equally spaced"});
}

TEST_CASE("volume I of USC and Caltech holds pairs of seconds and tenths of g", "[records]") {
  const RecordComponent one = all(usc_volume_1())[0];
  CHECK(one.motion.samples() == 200);
  CHECK(one.motion.dt() == 0.004);
  CHECK(one.motion.peak_acceleration() == Approx(0.4064 * g).epsilon(1e-14));
  CHECK(one.units == "g");
  CHECK(one.motion.orientation() == "N08W");
  CHECK(one.motion.name() == "IBB123, 1 MADE-UP RD., MADE-UP CITY, CA, N08W");
  refuses(replaced(usc_volume_1(), "POINTS =    200", "POINTS =    201"),
          {"line 11", "201 points", "integer 28 is 200"});
  refuses(replaced(usc_volume_1(), "UNITS ARE SEC AND G/10", "UNITS"), {"no units"});
  refuses(replaced(usc_volume_1(), "G/10", "STONES/10"), {"unknown unit", "STONES/10"});
}

TEST_CASE("volume II of USC and Caltech has its unit above the samples or at the peak", "[records]") {
  for (const char* units : {"  IN UNITS CM/SEC/SEC", ""}) {
    const std::vector<RecordComponent> found = all(usc_volume_2(units));
    REQUIRE(found.size() == 1);
    CHECK(found[0].motion.samples() == 16);
    CHECK(found[0].motion.dt() == 0.02);
    CHECK(found[0].motion.peak_acceleration() == Approx(2.42395).epsilon(1e-14));
    CHECK(found[0].motion.orientation() == "N08W");
  }
  // What the text states of the samples must be true of them.
  refuses(usc_volume_2("  IN UNITS G"), {"line 18", "peak of -242.3945 CMS/SEC/SEC", "242.395 G"});
  refuses(replaced(usc_volume_2(), "OF    .020  SEC", "OF    .010  SEC"), {"line 17", "0.01 s", "0.02 s"});
}

TEST_CASE("a file of Iran holds components at even steps in tenths of g", "[records]") {
  const std::string three = bhrc() + bhrc("V2") + bhrc("T3");
  CHECK(names(three) == Names{{"L1", "50"}, {"V2", "V"}, {"T3", "140"}});
  const GroundMotion motion = all(three)[0].motion;
  CHECK(motion.dt() == 0.005);
  CHECK(motion.samples() == 20);
  CHECK(motion.acceleration()[7] == Approx(-0.0244355 * g).epsilon(1e-14));
  CHECK(motion.name() == "2012/08/11 12:23:16, Made-up, L1");
  refuses(replaced(three, "POINTS =   20", "POINTS =   19"), {"line 11", "19 points", "integer 28 is 20"});
  refuses(replaced(three, "  .200000E+03", "  .100000E+03"), {"line 11", "sampling rate of 100 1/s"});
  refuses(replaced(three, "G/10", "G"), {"line 1", "UNITS ARE SECONDS AND G/10"});
}

TEST_CASE("of three series of the USGS the acceleration is read", "[records]") {
  const std::vector<RecordComponent> found = all(usgs());
  REQUIRE(found.size() == 1);
  CHECK(found[0].motion.samples() == 13);
  CHECK(found[0].motion.dt() == 0.005);
  CHECK(found[0].motion.peak_acceleration() == Approx(5.1403).epsilon(1e-14));
  CHECK(found[0].motion.orientation() == "090");
  refuses(replaced(usgs(), "TYPE=AC", "TYPE=VL"), {"no series", "DATA TYPE=AC"});
  refuses(replaced(usgs(), "POINTS=    13", "POINTS=    14"), {"line 10", "14 of the 14"});
  refuses(replaced(usgs(), "SAMPLES/SEC=200", "SAMPLES/SEC=x"), {"line 6", "expected a number"});
}

TEST_CASE("velocities of a real V2 file are the integral of what is read", "[records][real]") {
  struct Stated {
    const char* file;
    double peak, initial;  // [cm/s]
  };
  for (const auto& [name, stated, initial] :
       {Stated{"csmip/CE58667.V2", 2.890, -0.001}, Stated{"csmip/ce36456p_CE36456.V2", 28.253, -0.052},
        Stated{"csmip/chan001.v2", 0.205, 0}}) {
    const auto file = test::real_record(std::string("agency/") + name);
    if (!file) return;
    CAPTURE(name);
    const GroundMotion motion = read_record(*file, {.component = "1"});
    double largest = 0;
    for (const double v : ground_history(motion).velocity) largest = std::max(largest, std::abs(100 * v + initial));
    CHECK(largest == Approx(stated).epsilon(0.01));  // the agency corrected the velocity, too
  }
}

TEST_CASE("real files of agencies have the peaks that they state", "[records][real]") {
  struct Stated {
    const char *file, *component;
    std::size_t samples;
    double dt, unit, peak, printed;  // peak in units as printed, and half a unit of its last digit
  };
  for (const auto& [name, component, samples, dt, unit, peak, printed] : {
           Stated{"turkiye/20170720223109_0921.txt", "N-S", 28683, 0.01, 0.01, 13.200332, 5e-7},
           Stated{"turkiye/20170720223109_0921.txt", "E-W", 28683, 0.01, 0.01, 12.163827, 5e-7},
           Stated{"turkiye/20170720223109_0921.txt", "U-D", 28683, 0.01, 0.01, 9.840572, 5e-7},
           Stated{"taiwan/1-EAS.dat", "U", 6000, 0.02, 0.01, 0.837, 5e-4},
           Stated{"taiwan/1-EAS.dat", "N", 6000, 0.02, 0.01, 2.273, 5e-4},
           Stated{"taiwan/1-EAS.dat", "E", 6000, 0.02, 0.01, 1.017, 5e-4},
           Stated{"mexico/ACAC8903.101", "V", 2455, 0.01, 0.01, 5.28, 5e-3},
           Stated{"mexico/ACAC8903.101", "N90E", 2455, 0.01, 0.01, 11.90, 5e-3},
           Stated{"mexico/ACAC8903.101", "N00E", 2455, 0.01, 0.01, 7.98, 5e-3},
           Stated{"mexico/CUP50401.012", "V", 17500, 0.004, 0.01, 0.47, 5e-3},
           Stated{"mexico/CUP50401.012", "N90E", 17500, 0.004, 0.01, 1.19, 5e-3},
           Stated{"mexico/CUP50401.012", "N00E", 17500, 0.004, 0.01, 1.22, 5e-3},
           Stated{"china/ua0004.dat", "EW", 8800, 0.005, 0.01, 3.262, 5e-4},
           Stated{"smtk/16882_H1.cor.acc", "NS", 9400, 0.005, 1, 7.7132247e-3, 5e-11},
           Stated{"smtk/16882_H2.cor.acc", "WE", 9400, 0.005, 1, 9.4270337e-3, 5e-11},
           Stated{"smtk/16882_V.cor.acc", "UP", 9400, 0.005, 1, 6.1634634e-3, 5e-11},
           Stated{"csmip/CE58667.V2", "H1", 7500, 0.01, 0.01, 27.114, 5e-4},
           Stated{"csmip/ce36456p_CE36456.V2", "90", 3251, 0.02, 0.01, 267.957, 5e-4},
           Stated{"csmip/chan001.v2", "Up", 13000, 0.005, 0.01, 17.433, 5e-4},
           Stated{"csmip/CE89146.V1", "360", 13200, 0.005, g, 0.079, 5e-4},
           Stated{"usc/017m30bt.s0a", "N08W", 1887, 0.02, 0.01, 242.3945, 6e-4},
           Stated{"usc/274o42pv.s0a", "S58W", 573, 0.02, 0.01, 6.869, 5e-4},
           Stated{"chile/altohospicio0911131.v1", "EW", 3500, 0.01, g, 0.051, 5e-4},
           Stated{"chile/vinacentro1002271parte2.v1", "EW", 3500, 0.01, g, 0.036, 1e-3},
           Stated{"smc/0165b_a.smc", "up", 6014, 0.005, 0.01, 274.4508, 1e-3},
           Stated{"kiknet/AICH040010061330.EW2", "5", 28600, 0.005, 0.01, 5.020857, 5e-4},
           Stated{"cosmos/Cosmos12TimeSeriesTest.v1", "1", 7000, 0.01, 0.01, 161.962, 5e-3},
           Stated{"peer/RSN10590_ComalTX11-10-20_IU.CCM.BHZ.00.AT2", "BHZ00", 15306, 0.05, g, 1.85234e-6, 5e-12},
           Stated{"iran/5526-1.V1", "L1", 9472, 0.005, g, 0.0059154, 5e-8},
           Stated{"smc/usaca40.044", "090", 5983, 0.005, 0.01, 514.03, 5e-3},
       }) {
    const auto file = test::real_record(std::string("agency/") + name);
    if (!file) return;
    CAPTURE(name, component);
    const GroundMotion motion = read_record(*file, {.component = component});
    CHECK(motion.samples() == samples);
    CHECK(motion.dt() == dt);
    CHECK(motion.peak_acceleration() / unit == Approx(peak).margin(printed).epsilon(1e-12));
  }
}
