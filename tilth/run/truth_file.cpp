#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <utility>

#include <tilth/core/error.hpp>
#include <tilth/evaluation/body_frame.hpp>
#include <tilth/io/kitti_calibration.hpp>
#include <tilth/run/truth_file.hpp>

namespace tilth {
namespace {

const double kSameAxis = std::cos(std::numbers::pi / 4);  // two directions of motion that are of one body

using Direction = std::optional<Eigen::Vector3d>;

/// Whether two bodies may be one; also where either moves in no one direction.
bool may_be_one(const Direction& a, const Direction& b) {
  return !a || !b || a->dot(*b) > kSameAxis;
}

std::string axis_text(const Eigen::Vector3d& direction) {
  Eigen::Index axis = 0;
  const double largest = direction.cwiseAbs().maxCoeff(&axis);
  if (largest > 0.9) return {direction[axis] < 0 ? '-' : '+', "xyz"[axis]};
  char text[64];
  std::snprintf(text, sizeof text, "(%.2f, %.2f, %.2f)", direction.x(), direction.y(), direction.z());
  return text;
}

std::string moved_text(const TruthFile& truth) {
  return truth.name + ": given in the camera's frame, moved to the LiDAR's by " + truth.calibration +
         (truth.asked ? "" : ", found beside it");
}

std::string unused_text(const TruthFile& truth) {
  return truth.calibration + ", found beside the truth, is not used: the estimate moves in no one direction, which " +
         "would tell whether the truth is that of a camera; --calib uses it";
}

std::string mismatch_text(const Eigen::Vector3d& truth, const Eigen::Vector3d& estimate, bool calibrated) {
  const std::string of_truth = axis_text(truth), of_estimate = axis_text(estimate);
  std::string text = "warning: the truth moves along " + of_truth + " of its own body, the estimate along " +
                     of_estimate + ": they are not poses of the same body";
  if (of_truth == "+z" && !calibrated) {
    text += "; the truth looks like that of a camera, which KITTI's calibration moves to the LiDAR (--calib calib.txt)";
  }
  if (of_estimate == "+z" && calibrated) text += "; the estimate looks like that of a camera (--calib none)";
  return text;
}

/// The truth as the estimate, which moves along `forward` of its body, is to be held against it.
Trajectory in_lidar_frame(const TruthFile& truth, const Direction& forward, EvaluationOptions& options,
                          std::vector<std::string>& notices) {
  const Trajectory& given = truth.poses.trajectory;
  const Direction own = forward_direction(given);
  if (!truth.T_camera_lidar) {
    if (!may_be_one(own, forward)) notices.push_back(mismatch_text(*own, *forward, false));
    return given;
  }
  const Direction moved = own ? Direction(truth.T_camera_lidar->linear().transpose() * *own) : Direction();
  const bool fits = !may_be_one(own, forward) && may_be_one(moved, forward);
  const bool used = truth.asked || fits;
  const Direction& judged = used ? moved : own;
  if (used) notices.push_back(moved_text(truth));
  if (!used && !forward) notices.push_back(unused_text(truth));
  if (!may_be_one(judged, forward)) notices.push_back(mismatch_text(*judged, *forward, used));
  if (!used) return given;
  options.T_kitti_lidar = *truth.T_camera_lidar;
  return in_frame_of(given, *truth.T_camera_lidar);
}

std::string poses_text(const TruthFile& truth) {
  const Trajectory& poses = truth.poses.trajectory;
  char text[160];
  std::snprintf(text, sizeof text,
                truth.poses.has_stamps ? "%zu poses, %.3f s to %.3f s, a path of %.2f m"
                                       : "%zu poses without stamps, number %g to %g, a path of %.2f m",
                poses.size(), poses.front().stamp, poses.back().stamp, path_length(poses));
  return text;
}

/// The gaps that an estimate is not judged in; empty where there are none.
std::string gaps_text(const Trajectory& poses) {
  const double limit = gap_limit(poses, {});
  std::size_t gaps = 0;
  double longest = 0;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    const double gap = poses[i].stamp - poses[i - 1].stamp;
    longest = std::max(longest, gap);
    if (gap > limit) ++gaps;
  }
  if (gaps == 0) return "";
  char text[160];
  std::snprintf(text, sizeof text, "%zu times no pose for more than %.3g s, %.3g s at most: not interpolated over",
                gaps, limit, longest);
  return text;
}

}  // namespace

std::vector<std::string> truth_lines(const TruthFile& truth) {
  std::vector<std::string> lines{poses_text(truth)};
  const std::string gaps = truth.poses.has_stamps ? gaps_text(truth.poses.trajectory) : "";
  if (!gaps.empty()) lines.push_back(gaps);
  lines.insert(lines.end(), truth.poses.notices.begin(), truth.poses.notices.end());
  if (const Direction forward = forward_direction(truth.poses.trajectory)) {
    const std::string axis = axis_text(*forward);
    lines.push_back("moves along " + axis + " of its own body" + (axis == "+z" ? ", as a camera does" : ""));
  }
  if (truth.T_camera_lidar) {
    lines.push_back("KITTI's calibration: " + truth.calibration +
                    (truth.asked ? "" : ", used where the motion asks for it"));
  }
  return lines;
}

TruthFile read_truth(const std::filesystem::path& path, const std::string& calibration) {
  TruthFile truth{path.string(), read_pose_file(path), "", !calibration.empty(), std::nullopt};
  if (calibration == "none") return truth;
  if (truth.asked) {
    truth.calibration = calibration;
    truth.T_camera_lidar = read_kitti_calibration(calibration);
  } else if (const auto found = find_kitti_calibration(path)) {
    truth.calibration = found->string();
    try {
      truth.T_camera_lidar = read_kitti_calibration(*found);
    } catch (const Error&) {  // it need not be KITTI's: nobody asked for it
    }
  }
  return truth;
}

Evaluation judge(const TruthFile& truth, const PoseFile& estimate, EvaluationOptions options) {
  std::vector<std::string> notices = truth.poses.notices;
  notices.insert(notices.end(), estimate.notices.begin(), estimate.notices.end());
  const Direction forward = forward_direction(estimate.trajectory);
  const Trajectory trajectory = in_lidar_frame(truth, forward, options, notices);
  const bool stamps = truth.poses.has_stamps && estimate.has_stamps;
  Evaluation evaluation = (stamps ? evaluate : evaluate_by_index)(trajectory, estimate.trajectory, options);
  evaluation.notices = std::move(notices);
  return evaluation;
}

}  // namespace tilth
