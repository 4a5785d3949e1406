// Text of numbers: lines with their numbers in the file, words, and numbers read strictly. O(bytes).
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <tilth/core/point_records.hpp>

namespace tilth {

/// Walks the lines of a text; "\n" and "\r\n" both end a line.
class TextLines {
 public:
  explicit TextLines(std::string_view text) : text_(text) {}

  std::optional<std::string_view> next();             ///< the next line without its end
  std::size_t number() const { return number_; }      ///< of the line last returned, from 1
  std::size_t position() const { return position_; }  ///< [bytes] of the first byte not yet returned
  std::string where(const std::string& file) const;   ///< "file, line 12"

 private:
  std::string_view text_;
  std::size_t position_ = 0, number_ = 0;
};

/// Words between spaces, tabs and any of the characters in `also`.
std::vector<std::string_view> words(std::string_view line, std::string_view also = "");

/// Cells of a row of a table: between semicolons where it has any, else commas, else white space. Cells without text
/// count; white space and quotes around them do not.
std::vector<std::string_view> cells(std::string_view line);

std::optional<double> to_double(std::string_view word);        ///< also "nan", "inf"
std::optional<std::uint64_t> to_count(std::string_view word);  ///< decimal, no sign
bool store_number(std::string_view word, FieldType type,
                  std::byte* target);  ///< in native order; false: not of the type

/// The numbers of the next line that is neither blank nor a '#' comment; nothing at the end. Throws Error naming the
/// line where a word is no finite number or their count is not `expected`.
std::optional<std::vector<double>> next_numbers(TextLines& lines, const std::string& file, std::size_t expected);

/// `value` with so many digits that it reads back as the same double.
std::string exact_text(double value);

}  // namespace tilth
