#include "ground/records/formats.hpp"

#include <algorithm>
#include <iterator>
#include <stdexcept>

namespace stickslip {
namespace records {
namespace {

constexpr Format formats[] = {
    {{"COSMOS V1 and V2", "stated with the data", "real header 62", "COSMOS (2001), Strong Motion Data Format 1.20",
      ".v1c, .v2c"},
     is_cosmos,
     read_cosmos},
    {{"GeoNet V1A and V2A", "mm/s^2", "real header 26", "Cousins (2008), GNS Science", ".V1A, .V2A"},
     is_geonet,
     read_geonet},
    {{"USGS SMC", "cm/s^2", "1 / real header 2", "USGS NSMP, SMC-format data files", ".smc"}, is_smc, read_smc},
    {{"CSMIP V1 and V2", "stated with the data", "stated with the data, or times",
      "Shakal and Huang (1985), CSMIP report OSMS 85-03", ".v1, .v2, .raw"},
     is_csmip,
     read_csmip},
    {{"K-NET and KiK-net", "gal times the scale factor", "1 / sampling frequency", "NIED, K-NET ASCII format",
      ".NS, .EW, .UD, .NS1, .NS2, ..."},
     is_knet,
     read_knet},
    {{"ESM and ITACA", "UNITS", "SAMPLING_INTERVAL_S", "ORFEUS and INGV, DYNA 1.2 header", ".ASC"}, is_dyna, read_dyna},
    {{"AFAD (Turkiye)", "RAW PGA VALUES", "SAMPLING INTERVAL", "AFAD, strong ground motion records of Turkiye", ".txt"},
     is_afad,
     read_afad},
    {{"CWB (Taiwan)", "AmplitudeUnit", "1 / SampleRate", "Central Weather Bureau, free format", ".dat, .txt"},
     is_cwb,
     read_cwb},
    {{"ASA 2.0 (Mexico)", "UNIDADES DE LOS DATOS", "INTERVALO DE MUESTREO", "UNAM, archivo estandar de aceleracion 2.0",
      ".101, .012, ..."},
     is_asa,
     read_asa},
    {{"CSMNC (China)", "UNIT", "EQUALLY SPACED INTERVALS OF",
      "Institute of Engineering Mechanics, China Strong Motion Network", ".dat"},
     is_csmnc,
     read_csmnc},
    {{"SIGMA", "stated with the data", "Time Increment", "GEM gmpe-smtk, sigma parser", ".cor.acc"},
     is_sigma,
     read_sigma},
    {{"SCEC Broadband Platform", "lines of the columns", "from the times", "SCEC, files of the platform", ".bbp"},
     is_bbp,
     read_bbp},
    {{"BHRC volume 1", "UNITS ARE SECONDS AND G/10", "1 / real 9", "BHRC, Iran Strong Motion Network", ".V1"},
     is_bhrc,
     read_bhrc},
    {{"USGS, three series", "line 7", "1 / SAMPLES/SEC", "USGS Open-File Report 89-12", ".040, .044, ..."},
     is_usgs,
     read_usgs},
    {{"PEER AT2", "line 3", "line 4, either form", "PEER NGA-West2 database", ".AT2"}, is_peer, read_peer},
    {{"columns of numbers", "label, own line, or given", "times, own line, or given", "", ".csv, .txt, ..."},
     is_table,
     read_table},  // last: it accepts any file with a number
};

}  // namespace

std::string known_formats() {
  std::string known;
  for (const Format& format : formats) known.append(known.empty() ? "" : "; ").append(format.about.name);
  return known;
}

const Format& recognize(const Lines& lines) {
  const auto* const format = std::ranges::find_if(formats, [&](const Format& f) { return f.recognizes(lines); });
  if (format == std::end(formats))
    throw std::invalid_argument("no known format of records; known are: " + known_formats());
  return *format;
}

}  // namespace records

std::vector<RecordFormat> record_formats() {
  std::vector<RecordFormat> all;
  for (const records::Format& format : records::formats) all.push_back(format.about);
  return all;
}

}  // namespace stickslip
