// The records of a ROS 1 bag, version 2.0: a header of named binary fields, then data. Little-endian throughout.
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include <tilth/io/input_file.hpp>
#include <tilth/io/recording.hpp>

namespace tilth::rosbag1 {

static_assert(std::endian::native == std::endian::little, "numbers are copied as they stand in the bag");

inline constexpr std::string_view kMagic = "#ROSBAG V2.0\n";
inline constexpr std::size_t kBagHeaderSize = 4096;  ///< [bytes] of the first record, padded

enum class Op : std::uint8_t { message = 2, bag_header = 3, index = 4, chunk = 5, chunk_info = 6, connection = 7 };

using Fields = std::map<std::string, std::string, std::less<>>;

/// The bytes of a number, as a field's value.
template <class T>
std::string raw(T value) {
  return {reinterpret_cast<const char*>(&value), sizeof(value)};
}

/// The number at the begin of `text`, where it has that many bytes.
template <class T>
std::optional<T> number(std::string_view text) {
  T value{};
  if (text.size() < sizeof(value)) return std::nullopt;
  std::memcpy(&value, text.data(), sizeof(value));
  return value;
}

struct Record {
  Fields fields;
  std::uint64_t position = 0;       ///< of the record
  std::uint64_t data_position = 0;  ///< the data may reach beyond the end of a broken file
  std::uint32_t data_size = 0;

  std::uint64_t end() const { return data_position + data_size; }
  bool is(Op op) const { return text("op") == std::string_view(raw(op)); }
  std::string_view text(std::string_view name) const;  ///< empty where there is no such field

  template <class T>
  std::optional<T> field(std::string_view name) const {
    return number<T>(text(name));
  }
};

/// Nothing where the bytes are no header of fields with an op.
std::optional<Record> record_at(const InputFile& file, std::uint64_t position);
std::optional<Fields> parse_fields(std::string_view bytes);

/// The connection of a connection record, `data` being its data; nothing where a field is missing.
std::optional<Connection> connection_of(const Record& record, std::string_view data);

std::optional<std::uint64_t> nanoseconds(std::string_view time);  ///< of u32 seconds, u32 nanoseconds
std::string raw_time(std::uint64_t nanoseconds);

std::string fields_text(const Fields& fields);  ///< as a header's or a connection's bytes
std::string record_text(const Fields& header, std::string_view data);

}  // namespace tilth::rosbag1
