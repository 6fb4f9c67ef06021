// The formats of record files. A format is a function that recognizes it, one that reads it, and a row in formats.cpp.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "ground/records/text.hpp"

namespace stickslip::records {

/// One component as its file gives it.
struct Channel {
  std::string name{};  // empty where the format has none
  std::string title{};
  std::string units{};  // empty where the file states none
  double dt = 0;        // unless there are times
  std::vector<double> times{};
  std::vector<double> acceleration{};
};

bool is_cosmos(const Lines& lines);
std::vector<Channel> read_cosmos(const Lines& lines);

bool is_geonet(const Lines& lines);
std::vector<Channel> read_geonet(const Lines& lines);

bool is_peer(const Lines& lines);
std::vector<Channel> read_peer(const Lines& lines);

bool is_smc(const Lines& lines);
std::vector<Channel> read_smc(const Lines& lines);

bool is_table(const Lines& lines);
std::vector<Channel> read_table(const Lines& lines);

struct Format {
  std::string_view name;
  bool (*recognizes)(const Lines&);
  std::vector<Channel> (*read)(const Lines&);
};

/// The names of all, for a message.
std::string known_formats();

/// The format of a file.
/// @throws std::invalid_argument  none is known
const Format& recognize(const Lines& lines);

}  // namespace stickslip::records
