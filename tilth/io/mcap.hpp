// MCAP recordings (mcap.dev, version 0), read in the order of their log times. One walk over the records finds the
// messages without the index at the end, so that a recording which crashed or was cut is read up to the break; it
// unpacks every chunk once, reading unpacks them again. A file packed as a whole (.mcap.zstd) is unpacked beside.
// Memory: 32 bytes a message and one unpacked chunk.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <tilth/io/input_file.hpp>
#include <tilth/io/recording.hpp>

namespace tilth {

class McapReader {
 public:
  /// Throws Error where the file cannot be read or is no MCAP file. A damaged one opens: see problem().
  explicit McapReader(const std::filesystem::path& path);
  explicit McapReader(InputFile file);

  const std::vector<Connection>& connections() const { return connections_; }

  /// Only these topics from now on, from the first message. Throws Error naming a topic that the file does not have.
  void select(const std::vector<std::string>& topics);

  /// The next message; nothing at the end.
  std::optional<Message> next();

  const std::string& problem() const { return problem_; }  ///< what is damaged; empty: nothing

 private:
  struct Entry {
    std::uint64_t stamp = 0;  // [ns]
    std::uint64_t chunk = 0;  // position of its body; 0: none
    std::uint64_t at = 0;     // of the data, in the chunk or the file
    std::uint32_t size = 0, connection = 0;
  };
  void index();
  void index_chunk(std::uint64_t position, std::uint64_t size);
  void take(std::uint8_t op, std::span<const std::byte> body, std::uint64_t chunk, std::uint64_t at);
  std::optional<std::vector<std::byte>> read(const Entry& entry);
  void hold(std::uint64_t chunk);
  void note(const std::string& problem);

  InputFile file_;
  std::vector<Connection> connections_;
  std::map<std::uint16_t, std::string> schemas_;
  std::map<std::uint16_t, std::uint32_t> channels_;  // -> connection
  std::vector<Entry> messages_, selected_;
  std::size_t next_ = 0;
  std::uint64_t held_ = 0;  // position of the chunk in held_bytes_; 0: none
  std::vector<std::byte> held_bytes_;
  std::string problem_;
};

}  // namespace tilth
