// Rows of columns of numbers below a header, and what a header states of them.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "ground/records/reader.hpp"
#include "ground/records/text.hpp"

namespace stickslip::records {

/// Numbers in columns.
struct Rows {
  std::vector<std::vector<double>> columns{};
  std::vector<std::size_t> lines{};  // index of the line of each row

  std::size_t size() const { return lines.size(); }

  /// Rejects another number of rows than the header states.
  void require_size(std::size_t stated) const;
};

/// The rest of a file as rows with that many numbers each.
/// @param width  of a column in characters, or 0: see `append_numbers`
Rows read_rows(Reader& reader, std::size_t columns, std::size_t width = 0);

/// Whether a line is text: it is blank or starts with a letter that does not belong to a number.
bool is_text(std::string_view line);

/// The step of the times in the first column, which must be even to their printed precision: see `set_times`.
double printed_step(const Rows& rows, const Lines& lines);

}  // namespace stickslip::records
