#include <cerrno>
#include <cstdio>
#include <fcntl.h>
#include <system_error>
#include <unistd.h>

#include <tilth/atlas/map_files.hpp>
#include <tilth/atlas/map_writer.hpp>
#include <tilth/atlas/patch_bytes.hpp>
#include <tilth/core/error.hpp>
#include <tilth/io/beam_file.hpp>
#include <tilth/io/g2o.hpp>
#include <tilth/io/unpack.hpp>

namespace tilth {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& path, int error) {
  throw Error(path.string(), "cannot be written: " + std::generic_category().message(error));
}

/// "maps/office" of "maps/office/".
std::filesystem::path without_slash(const std::filesystem::path& path) {
  return path.has_filename() ? path : path.parent_path();
}

/// Waits until a file or folder is on the disk.
void flush(const std::filesystem::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) refuse(path, errno);
  const int failed = ::fsync(descriptor) == 0 ? 0 : errno;
  ::close(descriptor);
  if (failed != 0 && failed != EINVAL) refuse(path, failed);  // EINVAL: a file system that knows no such thing
}

/// Puts `from` under the name of `to`, which is exchanged with it at once where it is there.
void replace_folder(const std::filesystem::path& from, const std::filesystem::path& to) {
  if (::rename(from.c_str(), to.c_str()) == 0) return;
  if (errno != ENOTEMPTY && errno != EEXIST) refuse(to, errno);
  if (::renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_EXCHANGE) != 0) refuse(to, errno);
  std::filesystem::remove_all(from);
}

void write_bytes(const std::filesystem::path& path, std::span<const std::byte> bytes) {
  OutputFile file(path);
  file.write(bytes);
  file.close();
}

}  // namespace

MapWriter::MapWriter(const std::filesystem::path& folder)
    : folder_(without_slash(folder)), partial_(folder_.string() + ".partial") {
  std::error_code error;
  const bool there = std::filesystem::exists(folder_, error);
  const bool is_free = !there || (std::filesystem::is_directory(folder_, error) &&
                                  (holds_map(folder_) || std::filesystem::is_empty(folder_, error)));
  if (!is_free) throw Error(folder_.string(), "is there already, and is no map: it is not replaced");
  std::filesystem::remove_all(partial_, error);
  std::filesystem::create_directories(partial_, error);
  if (error) throw Error(partial_.string(), "cannot be made: " + error.message());
  patches_.emplace(partial_ / kMapPatches);
}

MapWriter::~MapWriter() {
  if (finished_) return;
  patches_.reset();
  std::error_code ignored;
  std::filesystem::remove_all(partial_, ignored);
}

void MapWriter::add(const MapPlace& place, const SurfacePatches& patches) {
  const std::vector<std::byte> packed = pack_zstd(bytes_of(patches));
  records_.push_back({place, patches_->size(), std::uint32_t(packed.size()), checksum(packed)});
  records_.back().place.patches = std::uint32_t(patches.size());
  patches_->write(packed);
  uprights_.add(patches, place.T_map_lidar);
}

void MapWriter::finish(const MapOrigin& origin, const PoseGraph& graph, const std::optional<BeamEstimate>& beams) {
  if (records_.empty()) throw Error(folder_.string(), "is not written: there is no place");
  if (graph.poses.size() != records_.size()) {
    throw Error(folder_.string(), "is not written: its graph has " + std::to_string(graph.poses.size()) +
                                      " poses, expected " + std::to_string(records_.size()));
  }
  MapList list{kMapFormat, origin.program, origin.source, records_.size()};
  list.files[kMapPatches].bytes = patches_->size();
  patches_->close();
  write_bytes(partial_ / kMapPlaces, bytes_of(records_));
  write_bytes(partial_ / kMapUprights, bytes_of(uprights_.cells()));
  write_g2o(partial_ / kMapGraph, graph);
  if (beams) write_beams(partial_ / kMapBeams, *beams);
  for (const char* file : {kMapPlaces, kMapUprights, kMapGraph, kMapBeams}) {
    if (file == kMapBeams && !beams) continue;
    const std::vector<std::byte> bytes = read_file(partial_ / file);
    list.files[file] = {bytes.size(), checksum(bytes)};
  }
  write_text(partial_ / kMapList, text_of(list));
  for (const auto& [file, listed] : list.files) flush(partial_ / file);
  flush(partial_ / kMapList);
  flush(partial_);
  replace_folder(partial_, folder_);
  finished_ = true;
}

}  // namespace tilth
