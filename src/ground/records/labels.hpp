// What the labels of columns and the lines above them state.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ground/records/text.hpp"

namespace stickslip::records {

enum class Quantity { unknown, time, index, acceleration, other };

/// The label of a column, such as `Acc (cm/s2)`, `acc_g`, `HNZ`, `Time in ms`.
struct Label {
  std::string text{};  // without quotation marks
  std::string name{};  // without its unit
  Quantity quantity = Quantity::unknown;
  std::string unit{};   // of acceleration, as written; empty where none is
  double seconds = 1;   // in the unit of time
  std::string other{};  // what another quantity is: "a velocity"
  std::string direction{};

  /// Whether any of it says something about a record.
  bool is_recognized() const;

  /// Whether it may also be a word of a title.
  bool is_unclear() const {
    return unit.empty() && (quantity == Quantity::unknown || quantity == Quantity::acceleration);
  }
};

Label label_of(std::string_view text);

/// The fields of a row or of a line of labels, which commas, semicolons, tabs or blanks separate, without quotation
/// marks. Blanks around a single comma or semicolon belong to it; within quotation marks nothing separates.
void split_row(std::string_view row, std::vector<std::string_view>& fields);

/// The labels in a line, one for each column, or none: some of them must be recognized.
std::vector<Label> labels_in(std::string_view line, std::size_t columns);

/// The parts of a line that marks separate, with the blanks around them; within quotation marks nothing separates.
std::vector<std::string_view> split_at(std::string_view line, std::string_view marks);

/// Whether a line is a level of labels above others, which has none for the first column: `,KOBE,KOBE` of pandas.
bool is_level(std::string_view line, std::size_t columns);

/// The labels that levels make together: `acc`, `EW` and `m/s2` below each other are `acc EW m/s2`.
std::vector<Label> labels_of_levels(const Lines& levels, std::size_t columns);

/// The text of a line of comment or of the heading, without the mark of comments before it.
std::string_view without_mark(std::string_view line);

/// Whether a line is a comment: it begins with #, % or !, or with //.
bool is_comment(std::string_view line);

/// The units that a line states which states nothing else: `units: cm/s^2`, `Accelerations in units of g`, `s,m/s2`;
/// one of acceleration for all, or one of any quantity for each column; otherwise none.
std::vector<std::string> units_in(std::string_view line, std::size_t columns);

/// What a line states which states nothing else but a time step, a sampling rate or a number of samples:
/// `dt = 0.01 s`, `Sampling rate (Hz): 100`, `NPTS= 4000, DT= .01 SEC`.
struct Size {
  std::optional<double> dt{};  // [s]
  std::optional<double> samples{};
};
std::optional<Size> size_in(std::string_view line);

}  // namespace stickslip::records
