// Pose graphs as g2o files (Kuemmerle et al. 2011): VERTEX_SE3:QUAT, FIX and EDGE_SE3:QUAT lines. g2o's error is
// [translation; vector part of the quaternion], so information goes from [rotation; translation] there and back.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include <tilth/core/pose_graph.hpp>

namespace tilth {

/// Writes `graph` with its first pose fixed. Throws Error where the file cannot be written in full.
void write_g2o(const std::filesystem::path& path, const PoseGraph& graph);

/// Edges between poses that do not follow one another are taken for closures; lines of other kinds are passed over.
/// Throws Error naming file and line on what is broken, on vertices out of order and on edges to no vertex.
PoseGraph read_g2o(const std::filesystem::path& path);

/// The same from text; `name` is what errors call it.
PoseGraph parse_g2o(std::string_view text, const std::string& name);

}  // namespace tilth
