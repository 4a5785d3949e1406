// KITTI's three ways of saying where the LiDAR sits on camera 0.
#include <fstream>

#include <gtest/gtest.h>

#include "io/expect_error.hpp"
#include "io/temporary_folder.hpp"
#include <tilth/io/kitti_calibration.hpp>

namespace tilth {
namespace {

namespace fs = std::filesystem;

const std::string kTr = "P0: 7 0 6 0 0 7 1 0 0 0 1 0\n\nTr: 0 -1 0 0.1 0 0 -1 0.2 1 0 0 0.3\n";
const std::string kRaw = "calib_time: 15-Mar-2012 11:37:16\r\nR: 0 -1 0 0 0 -1 1 0 0\r\nT: 0.1 0.2 0.3\r\n";

void write(const fs::path& path, const std::string& text) {
  fs::create_directories(path.parent_path());
  std::ofstream(path) << text;
}

TEST(KittiCalibration, OdometryAndRawSayTheSame) {
  for (const std::string& text : {kTr, kRaw}) {
    const Pose T_camera_lidar = parse_kitti_calibration(text, "calib.txt");
    EXPECT_TRUE((T_camera_lidar * Eigen::Vector3d(5, 0, 0)).isApprox(Eigen::Vector3d(0.1, 0.2, 5.3))) << text;
  }
}

TEST(KittiCalibration, TheObjectBenchmarkRectifies) {
  const std::string text = "R0_rect: 0 -1 0 1 0 0 0 0 1\nTr_velo_to_cam: 0 -1 0 0.1 0 0 -1 0.2 1 0 0 0.3\n";
  const Pose T_camera_lidar = parse_kitti_calibration(text, "000000.txt");
  EXPECT_TRUE((T_camera_lidar * Eigen::Vector3d(5, 0, 0)).isApprox(Eigen::Vector3d(-0.2, 0.1, 5.3)));
}

TEST(KittiCalibration, TheRawCameraIsRectifiedByTheFileBeside) {
  const TemporaryFolder folder;
  write(folder / "calib_velo_to_cam.txt", kRaw);
  const Pose plain = read_kitti_calibration(folder / "calib_velo_to_cam.txt");
  write(folder / "calib_cam_to_cam.txt", "S_00: 1392 512\nR_rect_00: 0 -1 0 1 0 0 0 0 1\n");
  const Pose rectified = read_kitti_calibration(folder / "calib_velo_to_cam.txt");
  const Eigen::Vector3d p = plain * Eigen::Vector3d(1, 2, 3);
  EXPECT_TRUE((rectified * Eigen::Vector3d(1, 2, 3)).isApprox(Eigen::Vector3d(-p.y(), p.x(), p.z())));
}

TEST(KittiCalibration, SevenDigitsGiveARotation) {
  const std::string text =
      "Tr: 4.276802385584e-04 -9.999672484946e-01 -8.084491683471e-03 -1.198459927713e-02 -7.210626507497e-03 "
      "8.081198471645e-03 -9.999413164504e-01 -5.403984729748e-02 9.999738645903e-01 4.859485810390e-04 "
      "-7.206933692422e-03 -2.921968648686e-01";
  const Eigen::Matrix3d R = parse_kitti_calibration(text, "calib.txt").linear();
  EXPECT_TRUE((R * R.transpose()).isIdentity(1e-14));
}

TEST(KittiCalibration, ErrorsNameFileLineAndEntry) {
  const auto refuse = [](const std::string& text, const std::vector<std::string>& parts) {
    expect_error([&] { parse_kitti_calibration(text, "calib.txt"); }, parts);
  };
  refuse("", {"calib.txt", "no entry Tr"});
  refuse("P0: 1\n", {"calib.txt", "no entry Tr"});
  refuse("R: 1 0 0 0 1 0 0 0 1\n", {"calib.txt", "not both R: and T:"});
  refuse("P0: 1\nTr: 1 2\n", {"calib.txt, line 2", "Tr", "has 2 values"});
  refuse("Tr:\n", {"calib.txt, line 1", "Tr", "no numbers"});
  refuse("Tr: 0 -1 0 0 0 0 -1 x 1 0 0 0\n", {"calib.txt, line 1", "Tr", "'x'"});
  refuse("Tr: 0 -1 0 0 0 0 -1 0 2 0 0 0\n", {"calib.txt, line 1", "Tr", "no rotation"});
  refuse("R: 1 0 0 0 1 0 0 0 1\nT: 1 2\n", {"calib.txt, line 2", "entry T", "has 2 values"});
}

TEST(KittiCalibration, IsFoundWhereKittiPutsIt) {
  const TemporaryFolder folder;
  write(folder / "dataset/poses/00.txt", "");
  EXPECT_FALSE(find_kitti_calibration(folder / "dataset/poses/00.txt"));
  write(folder / "dataset/sequences/00/calib.txt", kTr);
  EXPECT_EQ(find_kitti_calibration(folder / "dataset/poses/00.txt"), folder / "dataset/sequences/00/calib.txt");
  EXPECT_FALSE(find_kitti_calibration(folder / "dataset/poses/01.txt")) << "of another sequence";
  EXPECT_EQ(find_kitti_calibration(folder / "dataset/sequences/00/poses.txt"),
            folder / "dataset/sequences/00/calib.txt");
  write(folder / "2011_09_26/calib_velo_to_cam.txt", kRaw);
  EXPECT_EQ(find_kitti_calibration(folder / "2011_09_26/2011_09_26_drive_0001_sync/poses.txt"),
            folder / "2011_09_26/calib_velo_to_cam.txt");
}

}  // namespace
}  // namespace tilth
