// The map of a run as an OctoMap (A. Hornung et al., Autonomous Robots 34, 2013): which cells are occupied, free and
// unknown in three dimensions; map.bt, as octomap_server and the planners of MoveIt read it. About 10 us a point.
#pragma once

#include <filesystem>
#include <memory>

#include <tilth/run/sink.hpp>

namespace tilth {

/// `resolution` [m]: edge of the smallest cells.
std::unique_ptr<Sink> octomap_sink(const std::filesystem::path& path, double resolution);

}  // namespace tilth
