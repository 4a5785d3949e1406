#include <charconv>

#include <tilth/atlas/map_files.hpp>
#include <tilth/atlas/map_folder.hpp>
#include <tilth/core/error.hpp>
#include <tilth/io/config_file.hpp>

namespace tilth {
namespace {

constexpr const char* kAllFiles[] = {kMapPlaces, kMapUprights, kMapPatches, kMapGraph, kMapBeams};

/// A text in single quotes, as YAML takes it: one line.
std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) {
    if (c == '\'') result += '\'';
    result += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
  }
  return result + "'";
}

/// "places" of "places.bin", since points part keys.
std::string key_of(const std::string& file) {
  return "files." + file.substr(0, file.find('.'));
}

/// Takes entries out of what was read.
class ListEntries {
 public:
  ListEntries(OptionValues values, std::string name) : values_(std::move(values)), name_(std::move(name)) {}

  bool has(const std::string& key) const { return values_.contains(key); }

  std::string text(const std::string& key) {
    const auto entry = values_.find(key);
    if (entry == values_.end()) throw Error(name_, "has no key " + key);
    const std::string value = entry->second;
    values_.erase(entry);
    return value;
  }

  std::uint64_t number(const std::string& key, std::uint64_t most) {
    const std::string value = text(key);
    std::uint64_t number = 0;
    const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), number);
    if (error != std::errc{} || end != value.data() + value.size() || number > most) {
      throw Error(name_ + ", key " + key,
                  "is '" + value.substr(0, 40) + "', expected a whole number up to " + std::to_string(most));
    }
    return number;
  }

  void require_empty() const {
    if (!values_.empty()) throw Error(name_, "has an unknown key " + values_.begin()->first);
  }

 private:
  OptionValues values_;
  std::string name_;
};

}  // namespace

std::string text_of(const MapList& list) {
  std::string text = "# A map of Tilth, for tilth localize. Written whole; not to be edited.\n";
  text += "format: " + std::to_string(list.format) + "\nprogram: " + quoted(list.program) +
          "\nsource: " + quoted(list.source) + "\nplaces: " + std::to_string(list.places) + "\nfiles:\n";
  for (const auto& [file, listed] : list.files) {
    text += "  " + key_of(file).substr(6) + ":\n    bytes: " + std::to_string(listed.bytes) +
            "\n    crc32: " + std::to_string(listed.checksum) + "\n";
  }
  return text;
}

MapList parse_map_list(const std::string& text, const std::string& name) {
  ListEntries entries(parse_config(text, name), name);
  MapList list;
  list.format = int(entries.number("format", 1'000'000));
  if (list.format < 1 || list.format > kMapFormat) {
    throw Error(name + ", key format", "is " + std::to_string(list.format) + ", expected 1 to " +
                                           std::to_string(kMapFormat) + ": a later version of the program wrote it");
  }
  list.program = entries.text("program");
  list.source = entries.text("source");
  list.places = entries.number("places", 1'000'000'000);
  for (const std::string file : kAllFiles) {
    const std::string key = key_of(file);
    if (file == kMapBeams && !entries.has(key + ".bytes")) continue;
    const std::uint64_t bytes = entries.number(key + ".bytes", std::uint64_t{1} << 48);
    list.files[file] = {bytes, std::uint32_t(entries.number(key + ".crc32", 0xFFFFFFFF))};
  }
  entries.require_empty();
  return list;
}

}  // namespace tilth
