#include <cmath>
#include <map>
#include <system_error>

#include <tilth/core/error.hpp>
#include <tilth/io/output_file.hpp>
#include <tilth/io/pcd.hpp>
#include <tilth/run/run_record.hpp>
#include <tilth/run/tile_sink.hpp>

namespace tilth {
namespace {

namespace fs = std::filesystem;

using Tiles = std::map<std::pair<int, int>, std::vector<MapPoint>>;  // by the lower corner [m]

Tiles tiles_of(const std::vector<MapPoint>& points, int edge) {
  Tiles tiles;
  const auto corner = [edge](float at) { return edge * int(std::floor(at / float(edge))); };
  for (const MapPoint& p : points) tiles[{corner(p.x), corner(p.y)}].push_back(p);
  return tiles;
}

/// The folder, empty of tiles.
void clear(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw Error(folder.string(), "cannot be made: " + error.message());
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == ".pcd") fs::remove(entry.path());
  }
}

void write_tiles(const fs::path& path, const std::vector<MapPoint>& points, int edge) {
  const fs::path folder = path.parent_path() / "pointcloud_map";
  clear(folder);
  std::string metadata;
  for (const char* axis : {"x", "y"}) metadata += std::string(axis) + "_resolution: " + std::to_string(edge) + ".0\n";
  for (const auto& [corner, tile] : tiles_of(points, edge)) {
    const std::string x = std::to_string(corner.first), y = std::to_string(corner.second);
    const std::string name = x + "_" + y + ".pcd";
    write_pcd(folder / name, to_records(tile));
    metadata.append(name).append(": [").append(x).append(", ").append(y).append("]\n");
  }
  write_text(path, metadata);
}

}  // namespace

std::unique_ptr<Sink> tile_sink(const fs::path& path, int edge) {
  return file_sink(path, [edge](const fs::path& to, const RunRecord& run) { write_tiles(to, run.map.points(), edge); });
}

}  // namespace tilth
