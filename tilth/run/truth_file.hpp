// A file of true poses, read and held against an estimate: KITTI's calibration applied where the truth is that of the
// camera, what was made of both files said. O(n log n) for n poses.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <tilth/evaluation/evaluate.hpp>
#include <tilth/io/pose_file.hpp>

namespace tilth {

struct TruthFile {
  std::string name;
  PoseFile poses;
  std::string calibration;             ///< the file of the calibration; empty: none
  bool asked = false;                  ///< for the calibration
  std::optional<Pose> T_camera_lidar;  ///< of it; nothing where it was found but could not be read
};

/// `calibration`: a file of KITTI's, "none", or empty: looked for beside the truth. Throws Error as read_pose_file, and
/// as read_kitti_calibration where a file was asked for.
TruthFile read_truth(const std::filesystem::path& path, const std::string& calibration = "");

/// What is in it, one sentence each: poses, times, path, gaps; how its columns and its frame are understood.
std::vector<std::string> truth_lines(const TruthFile& truth);

/// By stamps where both have them, else by index, without interpolation. A calibration that was asked for moves the
/// truth from the camera to the LiDAR; one that was found does where the truth moves along another axis of its body
/// than the estimate, and along the same one when moved. The notices of the evaluation say so; they warn where the two
/// axes differ and nothing mends it. Throws Error as evaluate.
Evaluation judge(const TruthFile& truth, const PoseFile& estimate, EvaluationOptions options);

}  // namespace tilth
