// The files that say how a run ended, each a sink. docs/outputs.md describes them.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include <tilth/io/utm_origin.hpp>
#include <tilth/run/sink.hpp>

namespace tilth {

std::unique_ptr<Sink> tum_sink(const std::filesystem::path& path);
std::unique_ptr<Sink> kitti_sink(const std::filesystem::path& path);
std::unique_ptr<Sink> scan_table_sink(const std::filesystem::path& path);
std::unique_ptr<Sink> summary_sink(const std::filesystem::path& path);

/// What the drive shows of the beams, for the next run's --beams; no file where it shows nothing.
std::unique_ptr<Sink> beams_sink(const std::filesystem::path& path);

/// The map in the format of its ending: .pcd, .ply or .las, the last one in UTM where an origin is given. Throws Error
/// naming a path that ends otherwise.
std::unique_ptr<Sink> map_sink(const std::filesystem::path& path, const std::optional<UtmOrigin>& origin = {});

/// The points that moved, as PCD.
std::unique_ptr<Sink> moving_sink(const std::filesystem::path& path);

/// Of a run with loop closure: the trajectory before it, the pairs that were looked at, the graph.
std::unique_ptr<Sink> odometry_trajectory_sink(const std::filesystem::path& path);
std::unique_ptr<Sink> closures_sink(const std::filesystem::path& path);
std::unique_ptr<Sink> pose_graph_sink(const std::filesystem::path& path);

/// Of a run in a saved map: what became of each scan, and the places that were thought of.
std::unique_ptr<Sink> hypotheses_sink(const std::filesystem::path& path);

}  // namespace tilth
