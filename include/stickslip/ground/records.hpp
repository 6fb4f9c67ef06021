// Earthquake records from files.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "stickslip/ground/ground_motion.hpp"

namespace stickslip {

/// What a record file may leave open.
struct RecordOptions {
  std::string units{};         ///< of the acceleration, as `acceleration_unit` knows them; empty: as the file states
  std::string component{};     ///< its name in the file (in either case) or its number from 1; empty: the only one
  std::optional<double> dt{};  ///< time between samples [s], of one column of numbers; none: as the file states
  bool gaps = false;           ///< whether a gap, a time step over ten times the median one, is kept
};

/// A format of record files.
struct RecordFormat {
  std::string_view name;
  std::string_view units;      ///< where they come from
  std::string_view time_step;  ///< where it comes from
  std::string_view reference;
  std::string_view extension;  ///< of usual file names; it is not looked at
};

/// All formats that are read, in the order in which they are tried.
std::vector<RecordFormat> record_formats();

/// The format that some content is in, or nothing where it is in none of them, or is no text. Of a file that is damaged
/// within, it is still that format.
std::optional<RecordFormat> record_format(std::string_view content);

/// Reads one component of a strong-motion record; its format is recognized by the content, never by the file's name.
/// See `record_formats` for the list.
///
/// Columns of numbers are acceleration alone, with `dt` from the options, or seconds and one or several accelerations,
/// parted by a comma, a semicolon, a tab or blanks. Commas are decimal points where columns are parted by something
/// else and each comma is between digits. Any number of lines may come before: comments (`#`) and text. Units are read
/// from column labels, as `Time (s), Acceleration (g)`, or from a line as `# units: cm/s^2`; the names of several
/// components from the labels. Times that are even to the places or digits they are printed with become a step dt, the
/// shortest decimal that fits them all, and the clock starts at 0 whatever the first time. Other times are kept as they
/// are, also in lists of less than 100 units of the last place, or with steps of less than two: the times 0, 1, 2, 4
/// are not rounded.
///
/// Numbers are as C or Fortran print them: 1.5D-03 and 1.5-103 have an exponent, and a sign may separate numbers that
/// run together. A field that overflowed (`*****`) and a hexadecimal number are errors.
///
/// The samples are those of the file, all of them: GeoNet counts its stated peak times from after the samples it put
/// before the record (5 s, say), the motion counts them too. K-NET and KiK-net files and V1 files are not corrected:
/// take their offset away with `detrended`.
///
/// UTF-8 (with or without byte-order mark) and Latin-1 are read, with LF or CRLF line ends. Names and messages are
/// valid UTF-8 whatever the file holds: U+FFFD stands for what is no character, a blank for a control character. Names
/// are cut to 256 bytes each.
///
/// @param file     an existing regular file
/// @param options  units and dt, where the file has none (others than the file's are refused); component, where the
///                 file has several (in a file with one, its number is 1); whether gaps are kept
/// @return  the acceleration in m/s^2, linear between samples, named by the event, station and component as the file
///          gives them, or else by the file's stem; with the orientation that the file states
/// @throws std::filesystem::filesystem_error  file missing, unreadable or not a regular file, with the system's code
/// @throws std::invalid_argument  naming the file and the line or value refused: no known format; velocity,
///                 displacement, spectra or raw counts; no units, unknown units, or not those of `options`, and so for
///                 the time step; other than one component meant; text, NaN or infinity among the numbers; fewer or
///                 more samples than the header states; fewer than two; a time step that is not positive; times that do
///                 not increase; a gap
///
/// Linear in the file's length: about 1 ms for 10,000 samples.
GroundMotion read_record(const std::filesystem::path& file, const RecordOptions& options = {});

/// `read_record` of what a file would hold.
/// @param file  its name, for messages and for the motion where the content gives none; `archive.zip::member` is a file
/// in
///              an archive
GroundMotion parse_record(std::string_view content, const std::string& file, const RecordOptions& options = {});

/// One of the components of a record.
struct RecordComponent {
  GroundMotion motion;
  std::string name{};   ///< as the file has it, empty where it has none
  std::string start{};  ///< when it begins, in the file's own words; empty where it does not say
  std::string units{};  ///< of the acceleration, as the file states it; empty where it states none
};

/// All components of a record in the order of the file, or the one that the options name.
/// @throws as `read_record`
std::vector<RecordComponent> read_components(const std::filesystem::path& file, const RecordOptions& options = {});

/// `read_components` of what a file would hold.
std::vector<RecordComponent> parse_components(std::string_view content, const std::string& file,
                                              const RecordOptions& options = {});

/// How many m/s^2 one unit of acceleration is: `acceleration_unit("gal")` is 0.01.
///
/// @param name  g, m/s^2, cm/s^2, gal, mm/s^2, ft/s^2 or in/s^2, in upper or lower case, with or without blanks; also
///              g's, and s^2 as s2, s**2, sec2, s/s, sec/sec
/// @return  [m/s^2]; g is the standard gravity, 9.80665 m/s^2
/// @throws std::invalid_argument  listing the units known
double acceleration_unit(std::string_view name);

}  // namespace stickslip
