// Earthquake records from files.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "stickslip/ground/ground_motion.hpp"

namespace stickslip {

/// What a record file may leave open.
struct RecordOptions {
  std::string units{};      ///< of the acceleration, as `acceleration_unit` knows them; empty: as the file states
  std::string component{};  ///< its name in the file (in either case) or its number from 1; empty: the only one
};

/// Reads one component of a strong-motion record; its format is told by the content, never by the file's name.
///
/// | format              | units                 | time step                   | reference                          |
/// |---------------------|-----------------------|-----------------------------|------------------------------------|
/// | PEER AT2            | line 3                | line 4, either form         | PEER NGA-West2 database            |
/// | COSMOS V1, V2       | stated with the data  | real header 62              | COSMOS (2001), format version 1.20 |
/// | GeoNet V1A, V2A     | mm/s^2                | real header 26              | Cousins (2008), GNS Science        |
/// | USGS SMC            | cm/s^2                | 1 / real header 2           | USGS NSMP, SMC-format data files   |
/// | two-column text     | header, or `options`  | from the times              | below                              |
///
/// Two-column text is seconds and acceleration, parted by a comma, a semicolon, a tab or blanks. Any number of lines
/// may come before: comments (`#`) and text. Units are read from column labels, as `Time (s), Acceleration (g)`, or
/// from a line as `# units: cm/s^2`. Times that are even to the places or digits they are printed with become a step
/// dt, the shortest decimal that fits them all, and the clock starts at 0 whatever the first time. Other times are kept
/// as they are, also in lists of less than 100 units of the last place, or with steps of less than two: the times 0, 1,
/// 2, 4 are not rounded.
///
/// Numbers are as C or Fortran print them: 1.5D-03 and 1.5-103 have an exponent, and a sign may separate numbers that
/// run together. A field that overflowed (`*****`), a decimal comma and a hexadecimal number are errors.
///
/// The samples are those of the file, all of them: GeoNet counts its stated peak times from after the samples it put
/// before the record (5 s, say), the motion counts them too.
///
/// UTF-8 (with or without byte-order mark) and Latin-1 are read, with LF or CRLF line ends. Names and messages are
/// valid UTF-8 whatever the file holds: U+FFFD stands for what is no character, a blank for a control character. Names
/// are cut to 256 bytes each.
///
/// @param file     an existing regular file
/// @param options  units, where the file has none (another unit than the file's is refused); component, where the
///                 file has several (in a file with one, its number is 1)
/// @return  the acceleration in m/s^2, linear between samples, named by the event, station and component as the file
///          gives them, or else by the file's stem
/// @throws std::filesystem::filesystem_error  file missing, unreadable or not a regular file, with the system's code
/// @throws std::invalid_argument  naming the file and the line or value refused: no known format; velocity or
///                 displacement; no units, unknown units, or not those of `options`; other than one component meant;
///                 text, NaN or infinity among the numbers; fewer or more samples than the header states; fewer than
///                 two; a time step that is not positive; times that do not increase
///
/// Linear in the file's length: about 1 ms for 10,000 samples.
GroundMotion read_record(const std::filesystem::path& file, const RecordOptions& options = {});

/// How many m/s^2 one unit of acceleration is: `acceleration_unit("gal")` is 0.01.
///
/// @param name  g, m/s^2, cm/s^2, gal, mm/s^2, ft/s^2 or in/s^2, in upper or lower case, with or without blanks; also
///              g's, and s^2 as s2, s**2, sec2, s/s, sec/sec
/// @return  [m/s^2]; g is the standard gravity, 9.80665 m/s^2
/// @throws std::invalid_argument  listing the units known
double acceleration_unit(std::string_view name);

}  // namespace stickslip
