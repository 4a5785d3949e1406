// The map of a run in square tiles, as Autoware's map_loader takes it: pointcloud_map/<x>_<y>.pcd, named by their lower
// corner, and pointcloud_map_metadata.yaml, which says where each lies.
#pragma once

#include <filesystem>
#include <memory>

#include <tilth/run/sink.hpp>

namespace tilth {

/// `path`: of the metadata; the tiles, `edge` [m] wide and in whole metres, go into the folder pointcloud_map beside
/// it, from which tiles of an earlier run are removed.
std::unique_ptr<Sink> tile_sink(const std::filesystem::path& path, int edge);

}  // namespace tilth
