// Earthquake records from files.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "stickslip/ground/ground_motion.hpp"

namespace stickslip {

/// What a record file may leave unspecified.
struct RecordOptions {
  std::string units{};  ///< of the acceleration, as accepted by `acceleration_unit`; empty: as the file states
  /// Name or label in the file, in any case; direction; or number from 1, also as #1, which is never a name. Empty: the only one.
  std::string component{};
  std::optional<double> dt{};  ///< time between samples [s], for a single column of numbers; none: as the file states
  bool gaps = false;           ///< keep gaps (time steps over ten times the median) instead of rejecting the file
};

/// A format of record files.
struct RecordFormat {
  std::string_view name;
  std::string_view units;      ///< where the units come from
  std::string_view time_step;  ///< where the time step comes from
  std::string_view reference;
  std::string_view extension;  ///< usual file extension; not used for detection
};

/// All supported formats, in the order in which they are tried.
std::vector<RecordFormat> record_formats();

/// The format of the content; nothing if no format matches or the content is not text. A file that is damaged later on
/// still has its format.
std::optional<RecordFormat> record_format(std::string_view content);

/// Read one component of a strong-motion record. The format is detected from the content, never from the file name. See
/// `record_formats` for the list.
///
/// Columns of numbers contain either acceleration alone, with `dt` from the options, or seconds and one or more
/// accelerations, separated by a comma, a semicolon, a tab or blanks. Commas are decimal points if columns have another
/// separator and each comma is between digits. Any number of header lines may precede: comments (`#`) and text. Units
/// are read from column labels, such as `Time (s), Acceleration (g)`, or from a line such as `# units: cm/s^2`; the
/// names of several components are read from the labels. Times that are even to their printed precision are replaced by
/// a step dt, the shortest decimal that fits them all, and the motion starts at 0 whatever the first time. Other times
/// are kept unchanged, and so are lists that span less than 100 units of the last printed place or have steps of less
/// than two: the times 0, 1, 2, 4 are not rounded.
///
/// Numbers may have the formats of C or Fortran: 1.5D-03 and 1.5-103 have an exponent, and a sign may separate numbers
/// that run together. A field that overflowed (`*****`) and a hexadecimal number are errors.
///
/// All samples of the file are kept. GeoNet pads its records at the front (by 5 s, for example) and states peak times
/// from the end of the padding; the time of the motion includes the padding. K-NET, KiK-net and V1 files are
/// uncorrected: remove their offset with `detrended`.
///
/// Files may be UTF-8 (with or without byte-order mark) or Latin-1, with LF or CRLF line ends. Names and messages are
/// always valid UTF-8: U+FFFD replaces invalid characters, and a blank replaces each control character. Names are cut
/// to 256 bytes each.
///
/// @param file     an existing regular file
/// @param options  units and dt, if the file has none (values that differ from the file's are rejected); component, if
///                 the file has several (the only component of a file has number 1); whether gaps are kept
/// @return  the acceleration in m/s^2, linear between samples, named by the event, station and component that the file
///          states, otherwise by the stem of the file name; with the orientation that the file states
/// @throws std::filesystem::filesystem_error  file missing, unreadable or not a regular file, with the system's code
/// @throws std::invalid_argument  names the file and the invalid line or value: no known format; velocity,
///                 displacement, spectra or raw counts; units or time step missing, unknown or different from those of
///                 `options`; not exactly one component selected; text, NaN or infinity among the numbers; fewer or
///                 more samples than the header states; fewer than two; a time step that is not positive; times that do
///                 not increase; a gap
///
/// Time is linear in the file size: about 1 ms for 10,000 samples.
GroundMotion read_record(const std::filesystem::path& file, const RecordOptions& options = {});

/// `read_record` for content in memory.
/// @param file  file name for messages, and for the motion if the content gives no name; `archive.zip::member` is a
///              file in an archive
GroundMotion parse_record(std::string_view content, const std::string& file, const RecordOptions& options = {});

/// What was understood of a file, and where it stands.
struct RecordSources {
  std::string format{};     ///< name of its format
  std::string units{};      ///< where the unit of acceleration stands, in words: "label of column 2 (line 1)", "given"
  std::string time_step{};  ///< where the time step stands
  std::string orientation{};  ///< where the orientation stands; empty where there is none
};

/// One of the components of a record.
struct RecordComponent {
  GroundMotion motion;
  std::string name{};    ///< as the file states it; empty if it states none
  std::string start{};   ///< start time as the file writes it; empty if it states none
  std::string units{};   ///< of the acceleration, as the file states it; empty if it states none
  std::string sensor{};  ///< where the sensor is, such as borehole, if the file says so
  RecordSources sources{};
};

/// All components of a record in the order of the file, or the one selected by the options.
/// @throws as `read_record`
std::vector<RecordComponent> read_components(const std::filesystem::path& file, const RecordOptions& options = {});

/// `read_components` for content in memory.
std::vector<RecordComponent> parse_components(std::string_view content, const std::string& file,
                                              const RecordOptions& options = {});

/// A unit of acceleration in m/s^2: `acceleration_unit("gal")` is 0.01.
///
/// @param name  g, mg, %g, m/s^2, cm/s^2, gal, mm/s^2, ft/s^2 or in/s^2, in upper or lower case, with or without blanks;
///              also g's, s^2 as s2, s**2, sec2, s/s, sec/sec, and m/s^2 as m s-2
/// @return  [m/s^2]; g is the standard gravity, 9.80665 m/s^2
/// @throws std::invalid_argument  unknown unit; lists the known ones
double acceleration_unit(std::string_view name);

}  // namespace stickslip
