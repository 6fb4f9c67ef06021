// Reads a record file line by line.
#pragma once

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "ground/records/text.hpp"

namespace stickslip::records {

/// A cursor over the lines of a file.
class Reader {
 public:
  explicit Reader(const Lines& lines) : lines_(lines) {}

  /// The next line that is not blank; if there is none, the error says that `what` is missing.
  std::string_view line(const std::string& what) {
    if (done()) throw std::invalid_argument("the file ends before its " + what);
    return lines_[at_++];
  }

  /// The next `count` lines, unchanged.
  Lines block(std::size_t count, const std::string& what) {
    if (count > lines_.size() - at_) throw std::invalid_argument("the file ends within its " + what);
    const auto first = lines_.begin() + static_cast<std::ptrdiff_t>(at_);
    at_ += count;
    return {first, first + static_cast<std::ptrdiff_t>(count)};
  }

  /// The next `count` numbers, on lines of their own.
  std::vector<double> numbers(std::size_t count, const std::string& what, std::size_t width = 0) {
    std::vector<double> values;
    values.reserve(std::min(count, (lines_.size() - at_) * 16));  // the header may state any number
    const std::string stated = std::to_string(count) + " " + what + " its header states";
    for (; values.size() < count; ++at_) {
      if (at_ == lines_.size())
        throw std::invalid_argument("the file ends after " + std::to_string(values.size()) + " of the " + stated);
      const std::string_view failed = append_numbers(values, lines_[at_], width);
      if (!failed.empty())
        refuse_line(at_, "expected number " + std::to_string(values.size() + 1) + " of the " + stated + ", got " +
                             quote(failed));
      if (ends_cut_off(lines_[at_]))
        refuse_line(at_,
                    "the last number of the line is cut off: " + quote(lines_[at_].substr(lines_[at_].size() / 2)));
    }
    if (values.size() > count) refuse_line(at_ - 1, "more than the " + stated);
    return values;
  }

  bool done() {
    while (at_ < lines_.size() && trim(lines_[at_]).empty()) ++at_;
    return at_ == lines_.size();
  }

  /// Rejects the file if lines follow.
  void require_end(std::size_t samples) {
    if (!done()) refuse_line(at_, "more than the " + std::to_string(samples) + " samples the header states");
  }

  std::string_view peek() { return done() ? std::string_view() : lines_[at_]; }

  /// Index of the last line read.
  std::size_t last() const { return at_ - 1; }

 private:
  const Lines& lines_;
  std::size_t at_ = 0;
};

}  // namespace stickslip::records
