// The text at the head of a PCD file (versions 0.5 to 0.7): fields, number of points, encoding. O(header).
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include <tilth/core/point_records.hpp>

namespace tilth {

enum class PcdEncoding { ascii, binary, binary_compressed };

/// A column of the file. Of COUNT > 1 elements the first is read; "_" is padding. COUNT 0 is what it says, or what old
/// converters wrote of single values: the data tells.
struct PcdColumn {
  std::string name;
  FieldType type = FieldType::f32;
  std::size_t elements = 1;

  bool is_padding() const { return name == "_"; }
  bool is_read() const { return !is_padding() && elements > 0; }
  std::size_t bytes() const { return elements * size_of(type); }
};

struct PcdHeader {
  std::vector<PcdColumn> columns;
  std::size_t points = 0;
  PcdEncoding encoding = PcdEncoding::ascii;
  std::size_t data_position = 0;  ///< [bytes] of the first byte after the header
  std::size_t lines = 0;          ///< of the header
};

/// Throws Error naming the file and the entry that is missing, no number, or at odds with another.
PcdHeader parse_pcd_header(std::string_view text, const std::string& name);

}  // namespace tilth
