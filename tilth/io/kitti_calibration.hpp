// Where KITTI's LiDAR sits on the camera whose poses the benchmark gives: calib.txt of the odometry benchmark,
// calib_velo_to_cam.txt of the raw recordings, files of the object benchmark. O(characters).
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include <tilth/core/se3.hpp>

namespace tilth {

/// T_camera_lidar of the entry "Tr:" ("Tr_velo_to_cam:", turned by "R0_rect:" where the file has one), else of "R:" and
/// "T:". The rotation is made orthonormal. Throws Error naming file, line and entry where there is neither, a number is
/// missing, or the 3x3 is no rotation.
Pose parse_kitti_calibration(std::string_view text, const std::string& name);

/// Of calib_velo_to_cam.txt also with "R_rect_00:" of the calib_cam_to_cam.txt beside it, where there is one: poses of
/// the benchmark are those of the rectified camera.
Pose read_kitti_calibration(const std::filesystem::path& path);

/// The calibration that belongs to a file of poses: calib.txt or calib_velo_to_cam.txt beside it or in one of the two
/// folders above, or for poses/NN.txt sequences/NN/calib.txt. Nothing where there is none.
std::optional<std::filesystem::path> find_kitti_calibration(const std::filesystem::path& poses);

}  // namespace tilth
