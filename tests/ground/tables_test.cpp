// What columns of numbers state, and what they do not: labels, units, times, counts, remarks.
#include <algorithm>
#include <cmath>
#include <functional>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include "ground/record_files.hpp"
#include "stickslip/base/units.hpp"
#include "stickslip/ground/orientation.hpp"
#include "stickslip/ground/records.hpp"
#include "support/catch.hpp"

using namespace stickslip;
using namespace record_files;
using Catch::Matchers::ContainsSubstring;

namespace {

constexpr double g = standard_gravity;
constexpr int count = 200;
constexpr double peak = 2.77348;  // of the made-up samples [m/s^2]

/// A smooth pulse of 200 samples.
double sample(int i) { return peak * std::sin(0.05 * i) * std::exp(-std::pow((i - 94.2) / 60, 2)) / 0.99999; }

double largest() {
  double value = 0;
  for (int i = 0; i < count; ++i) value = std::max(value, std::abs(sample(i)));
  return value;
}

/// Rows of a first column, then the samples times each factor.
std::string rows(const std::string& separator, const std::function<std::string(int)>& first,
                 std::initializer_list<double> factors = {1}, const std::string& end = "\n") {
  std::string text;
  for (int i = 0; i < count; ++i) {
    text += first(i);
    for (const double factor : factors) text += separator + print("%.7f", factor * sample(i));
    text += end;
  }
  return text;
}

std::string seconds(int i) { return print("%.2f", 0.01 * i); }
std::string number(int i) { return std::to_string(i); }

RecordComponent one(const std::string& content, const RecordOptions& options = {}, const std::string& file = "a.csv") {
  const std::vector<RecordComponent> all = parse_components(content, file, options);
  REQUIRE(all.size() == 1);
  return all[0];
}

GroundMotion read(const std::string& content, const RecordOptions& options = {}) {
  return parse_record(content, "made_up.csv", options);
}

std::string refusal(const std::string& content, const RecordOptions& options = {}) {
  try {
    const std::vector<RecordComponent> found = parse_components(content, "made_up.csv", options);
    return "accepted";
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
}

void is_the_record(const GroundMotion& motion, double unit = 1) {
  CHECK(motion.samples() == count);
  CHECK(motion.dt() == 0.01);
  CHECK(motion.peak_acceleration() == Approx(unit * largest()).epsilon(1e-6));
}

}  // namespace

TEST_CASE("a first column that counts rows is no time", "[records]") {
  const RecordOptions given{.units = "g", .dt = 0.01};
  for (const char* label : {"No.", "", "sample", "Index", "frame", "#", "n", "Row", "Unnamed: 0", "Point", "time step",
                            "Sample number", "ID"}) {
    CAPTURE(label);
    const std::string text = std::string(label) + ",Acc (g)\n" + rows(",", number);
    CHECK_THAT(refusal(text), ContainsSubstring("states no time step: pass dt"));
    is_the_record(read(text, given), g);
  }
  // Without labels, counting from 0 or 1; and beside a column of times.
  for (const int from : {0, 1}) {
    const std::string text = rows(" ", [&](int i) { return std::to_string(i + from); });
    CHECK_THAT(refusal(text, {.units = "g"}), ContainsSubstring("pass dt"));
    is_the_record(read(text, given), g);
  }
  const std::string pandas = ",time,acc_g\n" + rows(",", [](int i) { return number(i) + "," + seconds(i); });
  is_the_record(read(pandas), g);
  is_the_record(read(pandas, {.units = "g", .component = "acc_g"}), g);
}

TEST_CASE("times are in the unit of their label", "[records]") {
  const auto milliseconds = [](int i) { return std::to_string(10 * i); };
  for (const char* label : {"time_ms", "t/ms", "Time in ms", "Time (ms)", "t [msec]", "milliseconds", "ms", "TimeMs"}) {
    CAPTURE(label);
    is_the_record(read(std::string(label) + ",Acc (m/s2)\n" + rows(",", milliseconds)));
  }
  for (const char* label : {"Time (s)", "t", "T", "time", "Time [sec]", "seconds", "Zeit [s]", "tiempo",
                            "Time (UTC) (s)", "time_s", "t/s", "\"Time (s)\"", "Elapsed time"}) {
    CAPTURE(label);
    is_the_record(read(std::string(label) + ",Acc (m/s2)\n" + rows(",", seconds)));
  }
  // In any column.
  std::string last = "Acc (m/s2),t (s)\n";
  for (int i = 0; i < count; ++i) last += print("%.7f", sample(i)) + "," + seconds(i) + "\n";
  is_the_record(read(last));
}

TEST_CASE("without labels times are even, begin near zero and have the steps of records", "[records]") {
  is_the_record(read(rows(",", seconds), {.units = "m/s^2"}));
  is_the_record(read(rows("\t", [](int i) { return print("%.3f", 0.01 * (i + 1)); }), {.units = "m/s^2"}));
  const auto refused = [&](const std::function<std::string(int)>& first, double dt) {
    CHECK_THAT(refusal(rows(",", first), {.units = "m/s^2", .dt = dt}), ContainsSubstring("is not time"));
  };
  refused([](int i) { return print("%.1f", 10. * i); }, 0.01);        // steps of 10
  refused([](int i) { return print("%.2f", 30 + 0.01 * i); }, 0.01);  // far from zero
  refused([](int i) { return print("%.7f", 1e-5 * i); }, 0.01);       // steps of 10 microseconds
  refused([](int i) { return print("%.3f", 0.01 * i + 1e-4 * i * i); }, 0.01);
}

TEST_CASE("a remark states no unit, and a line that is nothing but one does", "[records]") {
  const std::string table = rows(",", seconds);
  for (const char* remark :
       {"# Peak ground acceleration (g): 0.283\n", "# Max. acc. (g) of the instrument\n", "# Instrument unit: 12\n",
        "# Scaled to 0.4 g\n", "# acceleration sensitivity (g)\n", "# Unit 3 of the plant\n"}) {
    CAPTURE(remark);
    CHECK_THAT(refusal(remark + ("Time,Acc\n" + table)), ContainsSubstring("states no units of acceleration"));
    is_the_record(read(remark + ("Time,Acc\n" + table), {.units = "m/s^2"}));
  }
  for (const char* line :
       {"# units: m/s^2\n", "# Units = m/s2\n", "# Acceleration (m/s/s)\n", "m/s^2\n", "[m/s**2]\n",
        "# Accelerations in units of m/s2\n", "# ground acceleration in m/s^2.\n", "# Units: s, m/s^2\n"})
    for (const bool above : {true, false}) {
      CAPTURE(line);
      const std::string labels = "Time,Acc\n";
      is_the_record(read((above ? line + labels : labels + line) + table));
    }
  is_the_record(read("time,acceleration\ns,m/s2\n" + table));
  is_the_record(read("time;acceleration\n[s];[m/s2]\n" + table));
  // What two places state must agree.
  CHECK_THAT(refusal("# units: g\nTime,Acc (m/s2)\n" + table), ContainsSubstring("line 1: states the unit 'g', but"));
  CHECK_THAT(refusal("# units: g\n# units: gal\nTime,Acc\n" + table), ContainsSubstring("line 1: states other units"));
  CHECK_THAT(refusal("# units: furlong/s^2\nTime,Acc\n" + table), ContainsSubstring("unknown unit"));
}

TEST_CASE("each column has the unit of its own label", "[records]") {
  const std::string text = "Time (s),EW (gal),NS (m/s2),quality\n" +
                           rows(",", [](int i) { return seconds(i) + "," + print("%.4f", 80 * sample(i)); }, {1, 0});
  is_the_record(read(text, {.component = "NS"}));
  CHECK(read(text, {.component = "EW"}).peak_acceleration() == Approx(0.8 * largest()).epsilon(1e-4));
  CHECK(parse_components(text, "a").size() == 2);
  for (const char* label :
       {"Acc (corrected) [m/s2]", "Acc cm/s2", "acc_cm_s2", "a [gal] (raw)", "Acceleration in cm/s^2", "acc_gal",
        "Acc m s-2", "Acc (m\xC2\xB7s\xE2\x81\xBB\xC2\xB2)", "Acc (mg)", "Acc (%g)"}) {
    CAPTURE(label);
    const RecordComponent found = one("Time (UTC) (s)," + std::string(label) + "\n" + rows(",", seconds));
    CHECK(!found.units.empty());
  }
  CHECK(acceleration_unit("mg") == Approx(g / 1000));
  CHECK(acceleration_unit("m s-2") == 1);
}

TEST_CASE("a label that names another quantity is no acceleration", "[records][errors]") {
  const RecordOptions given{.units = "m/s^2"};
  for (const auto& [label, what] : {std::pair{"velocity", "a velocity"},
                                    {"Vel", "a velocity"},
                                    {"disp", "a displacement"},
                                    {"EW (cm/s)", "a velocity"},
                                    {"Displacement (cm)", "a displacement"},
                                    {"Counts", "a number of counts"},
                                    {"Temp (C)", "a temperature"},
                                    {"PGA (g)", "a peak"},
                                    {"PSA", "a spectral value"},
                                    {"x (mm)", "a length"}})
    CHECK_THAT(refusal("time," + std::string(label) + "\n" + rows(",", seconds), given),
               ContainsSubstring(what) && ContainsSubstring("line 1: no column holds an acceleration"));
  for (const char* label : {"Period (s)", "period", "Frequency", "freq (Hz)", "T period"})
    CHECK_THAT(refusal(label + (",Sa (g)\n" + rows(",", seconds)), given), ContainsSubstring("this is a spectrum"));
  // Beside an acceleration they are left out.
  const std::string all = "time,acc (m/s2),vel (m/s),disp (m)\n" + rows(",", seconds, {1, 0.1, 0.01});
  is_the_record(read(all));
  CHECK_THAT(refusal(all, {.component = "vel (m/s)"}), ContainsSubstring("select one component"));
}

TEST_CASE("numbers in reading order are one record", "[records]") {
  const RecordOptions given{.units = "m/s^2", .dt = 0.01};
  for (const int columns : {1, 2, 3, 4, 5, 7, 8, 10, 200}) {
    CAPTURE(columns);
    std::string text;
    for (int i = 0; i < count; ++i)
      text += " " + print("%.7f", sample(i)) + ((i + 1) % columns == 0 || i + 1 == count ? "\n" : "");
    is_the_record(read(text, given));
    is_the_record(read("200\n" + text, given));
    is_the_record(read("# dt = 0.01 s\n" + text, {.units = "m/s^2"}));
    is_the_record(read("NPTS= 200, DT= .01 SEC\n" + text, {.units = "m/s^2"}));
    is_the_record(read("# Sampling rate (Hz): 100\n# units: m/s^2\n" + text));
    for (const char* size : {"NPTS=200 DT=0.01", "200 0.01 NPTS, DT", "dt,0.01", "Fs,100", "dt (s),0.01", "# DT 0.01",
                             "Sampling freq.: 100 Hz", "Number of data points: 200, dt = 10 ms", "NPTS=200; DT=0.01"}) {
      CAPTURE(size);
      is_the_record(read(size + ("\n" + text), {.units = "m/s^2"}));
    }
    if (columns != 2) is_the_record(read("200 0.01\n" + text, {.units = "m/s^2"}));
    for (const char* counts : {"1000\n", "199\n", "# NPTS = 201\n"})
      CHECK_THAT(refusal(counts + text, given),
                 ContainsSubstring("line 1: states") && ContainsSubstring("200 numbers follow"));
    CHECK_THAT(refusal(text, {.units = "g"}), ContainsSubstring("no time step"));
    CHECK_THAT(refusal("dt = 0.02 s\n" + text, given), ContainsSubstring("states a time step of 0.02 s"));
  }
  // Components side by side vary more from one number to the next.
  std::string three;
  for (int i = 0; i < count; ++i)
    three += print("%.7f ", sample(i)) + print("%.7f ", -0.8 * sample(i)) + print("%.7f\n", 0.3 * sample(i));
  CHECK_THAT(refusal(three, given),
             ContainsSubstring("line 1: the first of 3 columns is not time") && ContainsSubstring("label the columns"));
  CHECK(parse_components("N E Z\n" + three, "a", given).size() == 3);
}

TEST_CASE("spreadsheets export empty columns, empty rows, quotation marks and remarks", "[records]") {
  const std::string head = "Time (s),Acceleration (m/s2)";
  is_the_record(read(head + ",,\n" + rows(",", seconds, {1}, ",,\n") + ",,,\n,,,\n"));
  is_the_record(read(head + "\n" + rows(",", seconds) + "# end, of, the, record\n"));
  is_the_record(
      read("\"Time (s)\",\"Acceleration (m/s2)\"\n" + rows(",", [](int i) { return "\"" + seconds(i) + "\""; })));
  std::string german = "\"Zeit (s)\",\"Beschl. (m/s2)\"\n";
  for (int i = 0; i < count; ++i)
    german += replaced("\"" + seconds(i) + "\";\"" + print("%.7f", sample(i)) + "\"\n", ".", ",");
  is_the_record(read(replaced(german, "\",\"", "\";\"")));
  is_the_record(read(replaced(german, ";", ",")));  // decimal commas in quotation marks
  CHECK_THAT(refusal(head + "\n0.00,1\n,\n0.01,2\n0.02,,3\n"), ContainsSubstring("line 5: expected finite numbers"));
}

TEST_CASE("files end in the marks of DOS, lines in carriage returns, and texts in UTF-16", "[records]") {
  const std::string text = "Time (s),Acc (m/s2)\n" + rows(",", seconds);
  is_the_record(read(text + std::string(100, '\x1A')));
  is_the_record(read(text + std::string(82, '\0')));
  is_the_record(read(text + "\x1A\r\n"));
  is_the_record(read(replaced(text, "\n", "\r")));
  for (const bool little : {true, false}) {
    std::string wide = little ? "\xFF\xFE" : "\xFE\xFF";
    for (const char c : text) wide += little ? std::string{c, '\0'} : std::string{'\0', c};
    is_the_record(read(wide));
  }
  CHECK(one(std::string("\xFF\xFE#\0 \0\x3D\xD8\x0B\xDF\n\0", 12) +
            [] {
              std::string wide;
              for (const char c : std::string("t,a (g)\n0,1\n.1,2\n")) wide += {c, '\0'};
              return wide;
            }())
            .motion.name() == "\xF0\x9F\x9C\x8B");
}

TEST_CASE("a vertical component is never taken for a horizontal one", "[records]") {
  const std::string table = rows(",", seconds);
  for (const char* label : {"HNZ (m/s2)", "acc_z (m/s2)", "Acc_UD (m/s2)", "Up-Down (m/s2)",
                            "Vertical component (m/s2)", "BHZ (m/s2)", "U-D (m/s2)", "a_ver (m/s2)", "up [m/s2]"}) {
    CAPTURE(label);
    CHECK(upward(one("t (s)," + std::string(label) + "\n" + table).motion.orientation()) == 1);
  }
  for (const char* file :
       {"CPM-UP.txt", "folder/CPM_V.csv", "x.zip::a/CPM.UD", "CPM.Z.txt", "CPM-DWN.txt", "AICH04.UD2", "UP.txt"}) {
    CAPTURE(file);
    CHECK(upward(one(table, {.units = "m/s^2"}, file).motion.orientation()) != 0);
  }
  for (const char* file : {"CPM_N.csv", "CPM-090.txt", "velocity.txt", "backup.csv", "run_001.csv"}) {
    CAPTURE(file);
    CHECK(upward(one(table, {.units = "m/s^2"}, file).motion.orientation()) == 0);
  }
}

TEST_CASE("labels state directions in many ways, and words beside them none", "[records]") {
  const std::string table = rows(",", seconds);
  const auto direction = [&](const std::string& label) {
    return one("t (s)," + label + "\n" + table, {.units = "m/s^2"}).motion.orientation();
  };
  for (const char* label :
       {"accZ", "az", "Az", "ACCZ", "zacc", "ugz", "AccUD", "UDacc", "acc.Z", "dirZ", "AccUp", "Acc (UD) (m/s2)",
        "Acc (V) (m/s2)", "Component 3 (vertical)", "Vertikal", "Verticale", "XX.STA..HNZ", "accelerationVertical"}) {
    CAPTURE(label);
    CHECK(upward(direction(label)) == 1);
  }
  for (const char* label : {"S-wave acc (m/s2)", "acc_w_filter_m/s2", "Acc w/o filter (m/s2)", "Made-up acc",
                            "acc_d (m/s2)", "Site D acc (m/s2)", "Acc 2", "0", "Acc 1e3"}) {
    CAPTURE(label);
    CHECK(direction(label).empty());
  }
  CHECK(azimuth_of(direction("Nord (m/s2)")) == 0);
  CHECK(azimuth_of(direction("accE")) == 90);
  // A letter in brackets is no newton and no volt, a second T no second time.
  const std::string three = rows(",", seconds, {1, 0.8, 0.3});
  for (const char* labels :
       {"Time (s),Acc (N),Acc (E),Acc (Z)", "Time (s),L (m/s2),T (m/s2),V (m/s2)", "Time (s),W,S,D"}) {
    CAPTURE(labels);
    CHECK(parse_components(labels + ("\n" + three), "a", {.units = "m/s^2"}).size() == 3);
  }
  // The direction of the record may stand on a line of its own.
  for (const char* line : {"# Component: UP", "# Orientation = vertical", "# VERTICAL COMPONENT", "Channel: HNZ"})
    CHECK(upward(one(line + ("\nTime (s),Acc (m/s2)\n" + table)).motion.orientation()) == 1);
  for (const char* file :
       {"CPM-UP (1).txt", "CPM_UP_corrected.csv", "CPM_HNZ.csv", "BHZ.txt", "CPM-UP.txt.gz", "CPM_vertical.csv"})
    CHECK(upward(one(table, {.units = "m/s^2"}, file).motion.orientation()) == 1);
  CHECK(read("Time (s),Acc N (m/s2),Acc E (m/s2)\n" + rows(",", seconds, {1, 0.5}), {.component = "N"})
            .peak_acceleration() == Approx(largest()).epsilon(1e-6));
  CHECK(read("time,0,1\n" + rows(",", seconds, {1, 0.5}), {.units = "m/s^2", .component = "#1"}).peak_acceleration() ==
        Approx(largest()).epsilon(1e-6));
}

TEST_CASE("what may be understood in two ways is refused", "[records][errors]") {
  const std::string table = rows(",", seconds);
  const RecordOptions given{.units = "m/s^2"};
  // Thousands or decimals.
  std::string thousands = "Time (ms);Acc (mm/s2)\n";
  for (int i = 0; i < 200; ++i)
    thousands += std::to_string(10 * i) + ";" + (i == 100 ? "1,150" : std::to_string(5 * i)) + "\n";
  CHECK_THAT(refusal(thousands), ContainsSubstring("line 102: commas may separate thousands or decimals"));
  // Multiplied units, a letter that may be one, and units that are none.
  for (const char* label : {"Acc in milli g", "Acc 1e-3 g", "Acc x 1000 (g)", "Acc (g) *100", "acc_pct_g"})
    CHECK_THAT(refusal("Time (s)," + std::string(label) + "\n" + table),
               ContainsSubstring("unknown unit of acceleration") || ContainsSubstring("states no units"));
  for (const char* label : {"Range 2 g", "station_G", "Sensor G"})
    CHECK_THAT(refusal("Time (s)," + std::string(label) + "\n" + table), ContainsSubstring("states no units"));
  for (const char* remark : {"# motion g", "# data: g", "# the g"})
    CHECK_THAT(refusal(remark + ("\nTime,Acc\n" + table)), ContainsSubstring("states no units"));
  // Units in a row of their own, of other quantities and of time.
  CHECK_THAT(refusal("Time,A\ns,m/s\n" + table, given), ContainsSubstring("'m/s' is a velocity"));
  is_the_record(read("Time,Acc\nms,m/s2\n" + rows(",", [](int i) { return std::to_string(10 * i); })));
  CHECK_THAT(refusal("Time (weeks),Acc (g)\n" + table), ContainsSubstring("line 1: the time must be in seconds"));
  // Two clocks.
  std::string clocks = "Time (s),A1 (g),Time (s),A2 (g)\n";
  for (int i = 0; i < 200; ++i) clocks += seconds(i) + ",1," + print("%.2f", 0.02 * i) + ",2\n";
  CHECK_THAT(refusal(clocks), ContainsSubstring("columns 1 and 3 are times that differ"));
  // Cells that a spreadsheet could not compute, and empty ones.
  for (const char* cell : {"#N/A", "#DIV/0!", "#VALUE!"})
    CHECK_THAT(refusal("Acc (m/s2)\n1\n2\n" + std::string(cell) + "\n3\n", {.dt = 0.01}),
               ContainsSubstring("line 4: expected finite numbers"));
  CHECK_THAT(refusal("N (m/s2),E (m/s2)\n1,2\n,\n2,3\n", {.dt = 0.01}), ContainsSubstring("line 3: an empty line"));
  // Other quantities beside an acceleration, in whatever language.
  for (const char* label :
       {"Geschwindigkeit", "vitesse", "v", "dispX", "raw", "Temperatur", "friction", "gyro", "fft"}) {
    CAPTURE(label);
    CHECK_THAT(refusal("time," + std::string(label) + "\n" + table, given),
               ContainsSubstring("no column holds an acceleration"));
    is_the_record(read("time,Acc (m/s2)," + std::string(label) + "\n" + rows(",", seconds, {1, 0.5})));
  }
  is_the_record(read("time,Acc (m/s2),Channel 4\n" + rows(",", seconds, {1, 0.5})));
}

TEST_CASE("titles and counts stand above numbers", "[records]") {
  const std::string table = rows(",", seconds);
  for (const char* title : {"1995 Kobe earthquake", "17 Jan 1995", "6.9 Mw, 12 km"})
    is_the_record(read(title + ("\nTime (s),Acc (m/s2)\n" + table)));
  for (const char* title : {"Acceleration history", "Kobe N", "North component"})
    is_the_record(read(title + ("\n" + rows(" ", seconds)), {.units = "m/s^2"}));
  std::string column;
  for (int i = 0; i < count; ++i) column += print("%.7f\n", sample(i));
  for (const char* remark : {"# Peak acceleration (g): 0.28", "# Force balance accelerometer", "# up to 25 Hz"})
    is_the_record(read(remark + ("\n" + column), {.units = "m/s^2", .dt = 0.01}));
  is_the_record(read("200 0.01\n" + rows(" ", seconds), {.units = "m/s^2"}));
  CHECK_THAT(refusal("199 0.01\n" + rows(" ", seconds), {.units = "m/s^2"}),
             ContainsSubstring("line 1: states 199 samples"));
  std::string gal;
  for (int i = 0; i < count; ++i) gal += print("%.0f\n", 100 * sample(i));
  for (const char* number : {"200\n", "200.\n", "2.0E+02\n", "+200\n", "200\n0.01\n"})
    CHECK(read(number + gal, {.units = "gal", .dt = 0.01}).samples() == count);
}

TEST_CASE("long headings are read in time", "[records]") {
  for (const char* part : {"x1 ", "a=1 ", "dt = 1,", "g ", "N-", "(g) ", "up_", "\"a\","}) {
    std::string line;
    while (line.size() < 300'000) line += part;
    CHECK(refusal(line + "\n0,1\n.1,2\n").size() < 400);
    CHECK(refusal("Time (s),Acc (g)\n0,1\n.1,2\n# " + line + "\n") == "accepted");
  }
}

TEST_CASE("labels stand in several lines", "[records]") {
  const auto both = [](int i) { return seconds(i) + print(",%.7f", 0.5 * sample(i)); };
  const std::string above = ",acc,acc\n,NS,EW\n";
  for (const std::string& heading : {above + "time,m/s2,m/s2\n", above + "s,m/s2,m/s2\n",
                                     std::string(",KOBE,KOBE\n,NS (m/s2),EW (m/s2)\nTime (s),,\n")}) {
    CAPTURE(heading);
    const std::vector<RecordComponent> all = parse_components(heading + rows(",", both), "a.csv", {});
    REQUIRE(all.size() == 2);
    CHECK(all[0].motion.orientation() == "NS");
    CHECK(all[1].motion.orientation() == "EW");
    is_the_record(all[1].motion);
    is_the_record(read(heading + rows(",", both), {.component = "EW"}));
  }
  is_the_record(read("Time,Acc\ns,m/s^2\n,KOBE\n" + rows(",", seconds)));  // of Origin
}

TEST_CASE("columns of text, or with nothing in them, are passed over", "[records]") {
  for (const char* text : {"KBU", "", "2011-A"}) {
    CAPTURE(text);
    is_the_record(
        read("station,time (s),acc (m/s2)\n" + rows(",", [&](int i) { return std::string(text) + "," + seconds(i); })));
  }
  CHECK_THAT(refusal("acc (g),time (s)\n****,0\n0.1,0.01\n0.2,0.02\n"),
             ContainsSubstring("line 2: expected finite numbers, got '****"));
  const std::string dates = rows(",", [](int i) { return "2024-01-17T05:46:" + seconds(i); });
  CHECK_THAT(refusal("time,acc (g)\n" + dates), ContainsSubstring("line 2: times must be seconds, got the date"));
}

TEST_CASE("a spectrum is no record, however its axes are named", "[records]") {
  for (const char* label : {"S_a (g)", "RotD50 (g)", "SAv [g]", "GMRotI50 (g)", "SA_H (g)"}) {
    CAPTURE(label);
    CHECK_THAT(refusal("T (s)," + std::string(label) + "\n" + rows(",", seconds)), ContainsSubstring("spectral value"));
  }
  const std::string values =
      rows(",", [](int i) { return print("%.2f,", 0.01 * i) + print("%.7f", std::abs(sample(i))); }, {});
  CHECK_THAT(refusal("T,A\n" + values, {.units = "g"}), ContainsSubstring("T may be a period"));
  CHECK(read("t,A\n" + values, {.units = "m/s^2"}).dt() == 0.01);
}

TEST_CASE("numbers of a fixed width may run together", "[records]") {
  const auto packed = [](const char* format, double factor) {
    std::string text;
    for (int i = 0; i < count; ++i) text += print(format, factor * sample(i)) + (i % 8 == 7 ? "\n" : "");
    return text;
  };
  is_the_record(read(packed("%9.4f", -100), {.units = "cm/s^2", .dt = 0.01}));
  is_the_record(read(packed("%15.7E", -1), {.units = "m/s^2", .dt = 0.01}));
  is_the_record(read(packed("%14.7E", 1), {.units = "m/s^2", .dt = 0.01}));
  CHECK_THAT(refusal(packed("%8.4f", 100), {.units = "cm/s^2", .dt = 0.01}), ContainsSubstring("expected"));
}

TEST_CASE("a number above the others is a time step, or asked for", "[records]") {
  const auto nothing = [](int) { return std::string(); };
  std::string packed;
  for (int i = 0; i < count; ++i) packed += print(" %.7f", sample(i)) + (i % 8 == 7 ? "\n" : "");
  is_the_record(read("0.01\n" + packed, {.units = "m/s^2"}));
  const std::string column = rows("", nothing);
  CHECK_THAT(refusal("0.01\n" + column, {.units = "m/s^2", .dt = 0.01}),
             ContainsSubstring("line 1: '0.01' may be a time step or a sample: write 'dt = 0.01'"));
  is_the_record(read("dt = 0.01\n" + column, {.units = "m/s^2"}));
  CHECK(read("0.0100000\n" + column, {.units = "m/s^2", .dt = 0.01}).samples() == count + 1);
}

TEST_CASE("equal columns without labels are refused", "[records]") {
  CHECK_THAT(refusal(rows(",", [](int i) { return print("%.7f", sample(i)); }), {.units = "g", .dt = 0.01}),
             ContainsSubstring("columns 1 and 2 are equal"));
}

TEST_CASE("labels are found above other lines, and count where they do not fit", "[records]") {
  const auto both = [](int i) { return seconds(i) + print(",%.7f", 0.5 * sample(i)); };
  for (const char* other : {"# corrected\n", ",filtered\n", "file1,file1\n"}) {
    CAPTURE(other);
    CHECK_THAT(refusal("Time,Velocity\n" + std::string(other) + rows(",", seconds), {.units = "g"}),
               ContainsSubstring("a velocity"));
    CHECK(read("Time,UP\n" + std::string(other) + rows(",", seconds), {.units = "g"}).orientation() == "UP");
  }
  const auto origin = parse_components("Time,NS,UD\ns,gal,gal\n,KJM,KJM\n" + rows(",", both), "a.csv", {});
  REQUIRE(origin.size() == 2);
  CHECK(origin[1].motion.orientation() == "UD");
  CHECK_THAT(refusal("Time\tVelocity\ns\t\n" + rows("\t", seconds), {.units = "m/s^2"}), ContainsSubstring("velocity"));
  CHECK_THAT(refusal("Time (s),Vel (cm/s)\n" + rows(",", both), {.units = "g"}), ContainsSubstring("do not fit the 3"));
  CHECK_THAT(refusal("Time (sec) Ground Velocity (cm/sec)\n" + rows(" ", seconds), {.units = "g"}),
             ContainsSubstring("do not fit the 2"));
}

TEST_CASE("cells that are merged label what lies below them", "[records]") {
  const auto both = [](int i) { return seconds(i) + print(",%.7f", 0.5 * sample(i)); };
  CHECK_THAT(refusal(",Velocity,\nTime (s),N,E\n" + rows(",", both), {.units = "g"}), ContainsSubstring("a velocity"));
  CHECK(parse_components(",Acc (g),\nTime (s),N,E\n" + rows(",", both), "a.csv", {}).size() == 2);
}

TEST_CASE("what looks like a unit and is none is not passed over", "[records]") {
  for (const char* unit : {"0.1 g", "G/1000", "1/100 g", "ug", "milli g", "% g", "mGal", "m.s-2", "g/10"}) {
    CAPTURE(unit);
    CHECK_THAT(refusal("Time (s),Acc (" + std::string(unit) + ")\n" + rows(",", seconds), {.units = "gal"}),
               ContainsSubstring("unit"));
  }
  for (const char* label : {"Acc (g) x10", "Acc [g] (x10)", "Acc/10 (g)", "Acc (g)/10"})
    CHECK_THAT(refusal("Time (s)," + std::string(label) + "\n" + rows(",", seconds)),
               ContainsSubstring("unknown unit"));
  CHECK_THAT(refusal("Time (s),a_g\n" + rows(",", seconds)), ContainsSubstring("states no units"));
  for (const char* line : {"# unit: counts\n", "# Units = 0.1 g\n", "# UNITS ARE SEC AND G/10\n", "%g\n"}) {
    CAPTURE(line);
    CHECK_THAT(refusal(line + ("Time,NS\n" + rows(",", seconds)), {.units = "g"}), ContainsSubstring("g"));
  }
  CHECK_THAT(refusal("# Units: g (1 g = 9.81 m/s2)\nTime,NS\n" + rows(",", seconds), {.units = "m/s^2"}),
             ContainsSubstring("the file states 'g'"));
  CHECK(read("t,H1\nms,%g\n" + rows(",", [](int i) { return std::to_string(10 * i); })).dt() == 0.01);
  // In percent of g: read as such, or refused; never as g.
  CHECK(read("%g\n" + rows(",", seconds)).peak_acceleration() == Approx(0.01 * g * largest()).epsilon(1e-6));
}

TEST_CASE("one direction is that of the record", "[records]") {
  CHECK(read("Time (s),E (m/s2)\n" + rows(",", seconds)).orientation() == "E");
  for (const char* line : {"# Component: UP\n", "Component UP\n", "Vertical component\n", "# Channel: HNZ\n"}) {
    CAPTURE(line);
    CHECK(upward(read(line + rows(",", seconds), {.units = "g"}).orientation()));
  }
}

TEST_CASE("labels name the vertical in many ways, and not by a word that is part of another", "[records]") {
  for (const char* label : {"Z-axis", "Acc Z-axis", "Z direction", "z-Richtung", "Komponente Z", "RSN1_A-UP",
                            "KOBE_KJM-UP", "Linear Acceleration z", "ACCELEROMETER Z", "acc up", "Up", "KJM_UD"}) {
    CAPTURE(label);
    CHECK(upward(read("Time (s)," + std::string(label) + " (g)\n" + rows(",", seconds)).orientation()));
  }
  for (const char* label : {"Scaled up", "made up acc", "Acc"}) {
    CAPTURE(label);
    CHECK(one("Time (s)," + std::string(label) + " (g)\n" + rows(",", seconds)).motion.orientation().empty());
  }
  const auto both = [](int i) { return seconds(i) + print(",%.7f", 0.5 * sample(i)); };
  for (const RecordComponent& each : parse_components("time,0,1\n" + rows(",", both), "a.csv", {.units = "g"}))
    CHECK(each.motion.orientation().empty());  // of pandas
  CHECK_THAT(refusal("# Component: N\n# Component: UP\n" + rows(",", seconds), {.units = "g"}),
             ContainsSubstring("line 1: states another direction"));
}

TEST_CASE("components side by side are no record in reading order", "[records]") {
  for (const double factor : {0.95, 0.8, -1., 0.3}) {
    const std::string text = rows(",", [&](int i) { return print("%.7f", factor * sample(i)); });
    CHECK_THAT(refusal(text, {.units = "g", .dt = 0.01}), ContainsSubstring("label the columns"));
  }
  std::string records;
  for (const char* name : {"N", "E"})
    for (int i = 0; i < count; ++i) records += name + print(",%.7f\n", sample(i));
  CHECK_THAT(refusal("component,acc (g)\n" + records, {.dt = 0.01}), ContainsSubstring("changes from 'N' to 'E'"));
}

TEST_CASE("two time steps in a line must agree", "[records]") {
  CHECK_THAT(refusal("# dt = 0.01, fs = 50\n" + rows("", [](int) { return std::string(); }), {.units = "g"}),
             ContainsSubstring("states no time step"));
  CHECK(read("# dt = 0.01, fs = 100\n" + rows("", [](int) { return std::string(); }), {.units = "g"}).dt() == 0.01);
}
