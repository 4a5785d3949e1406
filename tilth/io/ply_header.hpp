// The text at the head of a PLY file: elements with their properties. O(header).
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <tilth/core/point_records.hpp>

namespace tilth {

enum class PlyFormat { ascii, binary_little_endian, binary_big_endian };

struct PlyProperty {
  std::string name;
  FieldType type = FieldType::f32;
  std::optional<FieldType> list_size;  ///< of a list: the type of its count
};

struct PlyElement {
  std::string name;
  std::size_t count = 0;
  std::vector<PlyProperty> properties;

  bool has_lists() const;
  std::size_t stride() const;  ///< [bytes] of one, lists left out
};

struct PlyHeader {
  PlyFormat format = PlyFormat::ascii;
  std::vector<PlyElement> elements;
  std::size_t data_position = 0;  ///< [bytes] of the first byte after the header
  std::size_t lines = 0;          ///< of the header
};

/// Of the words of one element, those of the properties that are no lists; nothing where there are more or fewer words
/// than the properties ask for.
std::optional<std::vector<std::string_view>> scalar_words(const std::vector<std::string_view>& all,
                                                          const PlyElement& element);

/// Throws Error naming the file and the line of the header that is wrong.
PlyHeader parse_ply_header(std::string_view text, const std::string& name);

}  // namespace tilth
