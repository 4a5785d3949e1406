#include <system_error>

#include <tilth/atlas/map_files.hpp>
#include <tilth/atlas/map_folder.hpp>
#include <tilth/atlas/patch_bytes.hpp>
#include <tilth/core/error.hpp>
#include <tilth/io/beam_file.hpp>
#include <tilth/io/g2o.hpp>
#include <tilth/io/unpack.hpp>

namespace tilth {
namespace {

std::uint64_t require_size(const std::filesystem::path& path, const ListedFile& listed) {
  std::error_code error;
  const std::uint64_t size = std::filesystem::file_size(path, error);
  if (error) throw Error(path.string(), "cannot be read: " + error.message());
  if (size != listed.bytes) {
    throw Error(path.string(), "has " + std::to_string(size) + " bytes, expected " + std::to_string(listed.bytes) +
                                   " as " + kMapList + " says");
  }
  return size;
}

/// A file that is read as a whole, as its checksum says.
std::vector<std::byte> checked(const std::filesystem::path& folder, const MapList& list, const char* file) {
  const std::filesystem::path path = folder / file;
  std::vector<std::byte> bytes = read_file(path);
  const ListedFile& listed = list.files.at(file);
  if (bytes.size() == listed.bytes && checksum(bytes) == listed.checksum) return bytes;
  throw Error(path.string(), "is damaged: its checksum is not that of " + std::string(kMapList));
}

}  // namespace

bool holds_map(const std::filesystem::path& folder) {
  std::error_code ignored;
  return std::filesystem::exists(folder / kMapList, ignored);
}

MapFolder::MapFolder(const std::filesystem::path& folder) : folder_(folder) {
  std::error_code ignored;
  if (!std::filesystem::is_directory(folder, ignored)) throw Error(folder.string(), "is no folder of a map");
  if (!holds_map(folder)) throw Error(folder.string(), "is no map: it has no " + std::string(kMapList));
  const std::filesystem::path list_path = folder / kMapList;
  const std::vector<std::byte> text = read_file(list_path);
  const MapList list = parse_map_list(std::string(as_text(text)), list_path.string());
  origin_ = {list.program, list.source};
  bytes_ = text.size();
  for (const auto& [file, listed] : list.files) bytes_ += require_size(folder / file, listed);
  records_ =
      records_of(checked(folder, list, kMapPlaces), list.files.at(kMapPatches).bytes, (folder / kMapPlaces).string());
  if (records_.size() != list.places || records_.empty()) {
    throw Error((folder / kMapPlaces).string(), "has " + std::to_string(records_.size()) + " places, expected " +
                                                    std::to_string(list.places) + " and at least one");
  }
  for (const PlaceRecord& record : records_) places_.push_back(record.place);
  uprights_ = cells_of(checked(folder, list, kMapUprights), (folder / kMapUprights).string());
  checked(folder, list, kMapGraph);
  if (list.files.contains(kMapBeams)) checked(folder, list, kMapBeams);
  patches_ = std::make_unique<InputFile>(folder / kMapPatches);
}

SurfacePatches MapFolder::patches(std::size_t place) const {
  const PlaceRecord& record = records_.at(place);
  const std::string where = patches_->name() + ", place " + std::to_string(place);
  const std::vector<std::byte> packed = patches_->read(record.begin, record.size);
  if (packed.size() != record.size || checksum(packed) != record.checksum)
    throw Error(where, "is damaged: its checksum is not that of " + std::string(kMapPlaces));
  const std::optional<std::vector<std::byte>> bytes = unpack("zstd", packed);
  if (!bytes) throw Error(where, "is damaged: it cannot be unpacked");
  SurfacePatches patches = patches_of(*bytes, where);
  if (patches.size() == record.place.patches) return patches;
  throw Error(where, "has " + std::to_string(patches.size()) + " patches, expected " +
                         std::to_string(record.place.patches) + " as " + kMapPlaces + " says");
}

PoseGraph MapFolder::graph() const {
  return read_g2o(folder_ / kMapGraph);
}

std::optional<BeamEstimate> MapFolder::beams() const {
  std::error_code ignored;
  if (!std::filesystem::exists(folder_ / kMapBeams, ignored)) return std::nullopt;
  return read_beams(folder_ / kMapBeams);
}

}  // namespace tilth
