// Made-up record files in every format, for the tests and the fuzz target of the readers.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdio>
#include <string>
#include <vector>

namespace record_files {

inline std::string print(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
  return text;
}

inline const std::string peer_values = "  -.1000E+00   .2000E+00\n   .5D0      -0.25\n  +1.0D-03\n";

inline std::string peer(const std::string& line4, const std::string& values = peer_values) {
  return "PEER NGA STRONG MOTION DATABASE RECORD\n"
         "Made-up Valley 1/2/2003, Station #6, 230\n"
         "ACCELERATION TIME SERIES IN UNITS OF G\n" +
         line4 + "\n" + values;
}

inline std::string smc(const std::string& type = "2 CORRECTED ACCELEROGRAM", int count = 10, double rate = 100) {
  std::string text = type + "\n*\nMADE1\n     1999   1   2    0304 Made-up Creek\n*\n" +
                     "station = Made-up School         component=    270\n*\n*\n*\n*\n*\n";
  for (int i = 1; i <= 48; ++i)
    text += print("%10.0f", i == 16 ? 2 : i == 17 ? count : -32768) + (i % 8 == 0 ? "\n" : "");
  for (int i = 1; i <= 50; ++i) text += print("%15.7E", i == 2 ? rate : 1.7e38) + (i % 5 == 0 ? "\n" : "");
  return text + "|\n|a comment\n" +
         " 1.5057E+0-2.2223E+0-1.9234E+0-3.1562E+0-3.2440E+0-3.5638E+0-5.1941E+0-5.7933E+0\n" +
         "-5.5295E+1 5.4933E+0\n";
}

inline std::string geonet_component(const std::string& name, const std::string& values, int velocities = 11) {
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

inline std::string geonet() {
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

inline std::string cosmos_channel(const std::string& name, const std::string& data,
                                  const std::string& kind = "acceleration") {
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

inline const std::string cosmos_data =
    "      10 acceleration pts, approx    0 secs, units=cm/sec2(04),Format=(8F10.5)\n"
    "   1.00000  -2.000001000.123451000.12345   5.00000   6.00000   7.00000   8.00000\n   9.00000-980.66500\n"
    "End-of-data for Chan  1 acceleration\n";

inline std::string cosmos_velocity() {
  return replaced(replaced(cosmos_data, "acceleration", "velocity"), "cm/sec2(04)", "cm/sec (05)");
}

/// As NIED describes it: 17 lines of header, counts in eight columns.
inline std::string knet(const std::string& direction = "N-S", int count = 10,
                        const std::string& scale = "2000(gal)/8000000") {
  std::string text =
      "Origin Time       2001/02/03 04:05:00\nLat.              38.103\nLong.             142.860\n"
      "Depth. (km)       24\nMag.              7.0\nStation Code      MAD001\nStation Lat.      38.7292\n"
      "Station Long.     141.0217\nStation Height(m) 40\nRecord Time       2001/02/03 04:05:36\n"
      "Sampling Freq(Hz) 100Hz\nDuration Time(s)  0.1\nDir.              " +
      direction + "\nScale Factor      " + scale +
      "\nMax. Acc. (gal)   25.000\nLast Correction   2001/02/03 04:05:21\nMemo.\n";
  for (int i = 0; i < count; ++i)
    text += print("%8.0f", i == 3 ? -100000 : 4000 * i) + (i % 8 == 7 || i + 1 == count ? "\n" : " ");
  return text;
}

/// As the Engineering Strong Motion database writes it: a DYNA 1.2 header, one column.
inline std::string dyna(const std::string& stream = "HNE", int count = 6) {
  return "EVENT_NAME: Made-up\nEVENT_ID: MU-2001-0001\nEVENT_DATE_YYYYMMDD: 20010203\nEVENT_TIME_HHMMSS: 040500\n"
         "EVENT_DEPTH_KM: 10.5\nMAGNITUDE_W: 6.1\nNETWORK: MU\nSTATION_CODE: MAD\nSTATION_NAME: Made-up: north\n"
         "VS30_M/S:\nDATE_TIME_FIRST_SAMPLE_YYYYMMDD_HHMMSS: 20010203_040512.000\nSAMPLING_INTERVAL_S: 0.005000\n"
         "NDATA: " +
         std::to_string(count) + "\nDURATION_S: 0.025\nSTREAM: " + stream +
         "\nUNITS: cm/s^2\nPGA_CM/S^2: -98.0665\nHEADER_FORMAT: DYNA 1.2\nDATA_TYPE: ACCELERATION\n"
         "PROCESSING: manual (nobody et al., 2011)\nUSER5:\n"
         "-0.000123\n1.5\n-98.066500\n0.25e1\n0\n0.1\n";
}

inline std::string csmip_numbers(int count, int columns, int width, int places) {
  std::string text;
  for (int i = 1; i <= count; ++i)
    text += print(("%" + std::to_string(width) + "." + std::to_string(places) + "f").c_str(), 0) +
            (i % columns == 0 || i == count ? "\n" : "");
  return text;
}

/// A channel of a V2 file as CSMIP describes it: 25 lines of text, 100 integers, 100 reals, three series.
inline std::string csmip_channel(const std::string& orientation = "90 Deg", const std::string& units = "in cm/sec2.") {
  std::string text =
      "Corrected Accelerogram 12345-S0001-01001.01\nUncorrected Accelerogram Data processed: 02/03/01, CGS\n\n\n"
      "Made-up Earthquake              February 3, 2001 04:05 UTC\nStation No. 12345  34.000N, 118.000W\n"
      "Made-up City - School           CGS\nChan  1: " +
      orientation + "   Sta Chn:  1  Location: Ground floor\n";
  for (int i = 9; i <= 25; ++i) text += "Text " + std::to_string(i) + "\n";
  text += csmip_numbers(100, 16, 5, 0) + csmip_numbers(100, 8, 10, 3);
  text += "   10 points of accel data equally spaced at  .020 sec, " + units + " (8f10.6)\n" +
          "  1.500000 -2.250000-10.123456100.123456  5.000000  6.000000  7.000000  8.000000\n  9.000000-98.066500\n";
  for (const char* kind : {"veloc", "displ"})
    text += std::string("   10 points of ") + kind + " data equally spaced at  .020 sec, in cm/sec. (8f10.6)\n" +
            csmip_numbers(10, 8, 10, 6);
  return text + "/&  ---------- End of data for channel  1 ----------\n";
}

/// A channel of a V1 file: 13 lines of text, 100 integers, 50 reals, and equal steps or pairs of seconds and g/10.
inline std::string csmip_uncorrected(bool pairs) {
  std::string text =
      "UNCORRECTED ACCELEROGRAM DATA   PROCESSED: 02/03/01, CDMG\nLine 2\nLine 3\nMADE-UP EARTHQUAKE\n"
      "STATION NO. 12345\nMADE-UP CITY  - SCHOOL\nCHAN  1: UP\nLine 8\nLine 9\nLine 10\n"
      "NO. OF POINTS =   4\nUNITS OF UNCOR ACCEL ARE SEC-G/10.     MAX = .1 G\nLine 13\n";
  for (int i = 1; i <= 100; ++i) text += print("%5.0f", i == 28 ? 4 : 0) + (i % 16 == 0 || i == 100 ? "\n" : "");
  text += csmip_numbers(50, 8, 10, 3);
  text += pairs ? "   .000  -.100   .021   .250   .043  -.500   .060   .125\n"
                : "   4 points of accel data equally spaced at  .020 sec, in g. (8f9.6)\n -.010000  .025000 -.050000  "
                  ".012500\n";
  return text + "/&  ----------  END OF DATA FOR CHANNEL  1 ----------\n";
}

/// A table of times printed with a format, accelerations made up.
inline std::string table(const std::vector<double>& times, const char* format) {
  std::string text = "Time (s),Acceleration (m/s^2)\n";
  for (const double t : times) text += print(format, t) + "," + print("%.5f", std::sin(t)) + "\n";
  return text;
}

inline std::vector<double> even_times(std::size_t count, double dt, double start = 0) {
  std::vector<double> times(count);
  for (std::size_t i = 0; i < count; ++i) times[i] = start + static_cast<double>(i) * dt;
  return times;
}

}  // namespace record_files
