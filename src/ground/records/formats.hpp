// The formats of record files. A format is a function that recognizes it, one that reads it, and a row in formats.cpp.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ground/records/text.hpp"
#include "stickslip/ground/records.hpp"

namespace stickslip::records {

/// One component as its file gives it.
struct Channel {
  std::string name{};   // empty where the format has none
  std::string label{};  // of its column, by which it can be selected, too
  std::string title{};
  std::string orientation{};   // the text that states it, where it is not the name
  std::string sensor{};        // where the sensor is, for stations with several
  std::string start{};         // date and time of the first sample, in the format's own words
  std::string units{};         // empty where the file states none
  std::optional<double> dt{};  // none where there are times, and where the file states none
  std::string units_from{};    // where they stand, if not where the table of formats says
  std::string step_from{};
  std::vector<double> times{};
  std::vector<double> acceleration{};
};

bool is_afad(const Lines& lines);
std::vector<Channel> read_afad(const Lines& lines);

bool is_asa(const Lines& lines);
std::vector<Channel> read_asa(const Lines& lines);

bool is_bbp(const Lines& lines);
std::vector<Channel> read_bbp(const Lines& lines);

bool is_bhrc(const Lines& lines);
std::vector<Channel> read_bhrc(const Lines& lines);

bool is_cosmos(const Lines& lines);
std::vector<Channel> read_cosmos(const Lines& lines);

bool is_csmip(const Lines& lines);
std::vector<Channel> read_csmip(const Lines& lines);

bool is_csmnc(const Lines& lines);
std::vector<Channel> read_csmnc(const Lines& lines);

bool is_cwb(const Lines& lines);
std::vector<Channel> read_cwb(const Lines& lines);

bool is_dyna(const Lines& lines);
std::vector<Channel> read_dyna(const Lines& lines);

bool is_geonet(const Lines& lines);
std::vector<Channel> read_geonet(const Lines& lines);

bool is_knet(const Lines& lines);
std::vector<Channel> read_knet(const Lines& lines);

bool is_peer(const Lines& lines);
std::vector<Channel> read_peer(const Lines& lines);

bool is_sigma(const Lines& lines);
std::vector<Channel> read_sigma(const Lines& lines);

bool is_smc(const Lines& lines);
std::vector<Channel> read_smc(const Lines& lines);

bool is_usgs(const Lines& lines);
std::vector<Channel> read_usgs(const Lines& lines);

bool is_table(const Lines& lines);
std::vector<Channel> read_table(const Lines& lines);

struct Format {
  RecordFormat about;
  bool (*recognizes)(const Lines&);
  std::vector<Channel> (*read)(const Lines&);
};

/// The names of all formats, for a message.
std::string known_formats();

/// The format of a file.
/// @throws std::invalid_argument  if no format is recognized
const Format& recognize(const Lines& lines);

}  // namespace stickslip::records
