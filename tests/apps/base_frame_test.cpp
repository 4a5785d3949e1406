// Extrinsics and levelling, by the program.
#include <array>
#include <numbers>
#include <set>

#include <gtest/gtest.h>

#include "program.hpp"
#include <tilth/io/pcd.hpp>
#include <tilth/io/trajectory_file.hpp>

namespace tilth::app {
namespace {

constexpr const char* kDrive = "sim://plaza?seed=61&columns=400&duration=4";

class BaseFrame : public testing::Test {
 protected:
  Outcome run(const std::string& out, std::vector<std::string> more = {}, const char* command = "run") const {
    std::vector<std::string> arguments{command, kDrive, "--out", (folder_ / out).string(), "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return tilth(arguments);
  }
  Trajectory poses(const std::string& out) const { return read_tum(folder_ / out / "trajectory.tum"); }

  TemporaryFolder folder_;
};

/// What --base-from-lidar says in metres and degrees.
Pose mounted(const Eigen::Vector3d& at, double roll, double pitch, double yaw) {
  constexpr double kDegree = std::numbers::pi / 180;
  return Eigen::Translation3d(at) * Eigen::AngleAxisd(yaw * kDegree, Eigen::Vector3d::UnitZ()) *
         Eigen::AngleAxisd(pitch * kDegree, Eigen::Vector3d::UnitY()) *
         Eigen::AngleAxisd(roll * kDegree, Eigen::Vector3d::UnitX());
}

double gap(const Pose& a, const Pose& b) {
  return (a.matrix() - b.matrix()).cwiseAbs().maxCoeff();
}

/// The points of a map, moved.
std::vector<Eigen::Vector3d> points_of(const std::filesystem::path& path, const Pose& T) {
  const PointRecords records = read_pcd(path);
  const std::vector<double> x = column(records, *records.find("x")), y = column(records, *records.find("y")),
                            z = column(records, *records.find("z"));
  std::vector<Eigen::Vector3d> points;
  for (std::size_t i = 0; i < records.count; ++i) points.push_back(T * Eigen::Vector3d(x[i], y[i], z[i]));
  return points;
}

/// Share of `points` that have one of `others` in their cell of 0.2 m or one beside it.
double share_within(const std::vector<Eigen::Vector3d>& points, const std::vector<Eigen::Vector3d>& others) {
  const auto cell_of = [](const Eigen::Vector3d& p) {
    const Eigen::Vector3d cell = (p / 0.2).array().floor();
    return std::array{int(cell.x()), int(cell.y()), int(cell.z())};
  };
  std::set<std::array<int, 3>> cells;
  for (const Eigen::Vector3d& p : others) {
    const auto [x, y, z] = cell_of(p);
    for (int i = 0; i < 27; ++i) cells.insert({x + i % 3 - 1, y + i / 3 % 3 - 1, z + i / 9 - 1});
  }
  return double(
             std::count_if(points.begin(), points.end(), [&](const auto& p) { return cells.contains(cell_of(p)); })) /
         double(points.size());
}

TEST_F(BaseFrame, PosesAndMapAreThoseOfTheLidarSeenFromTheBase) {
  const std::string mount = "0.4,-0.1,0.6,3,-8,170";
  const Pose T_base_lidar = mounted({0.4, -0.1, 0.6}, 3, -8, 170);
  ASSERT_EQ(run("lidar").exit_code, 0);
  const Outcome outcome = run("base", {"--base-from-lidar", mount});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const Trajectory lidar = poses("lidar"), base = poses("base");
  ASSERT_EQ(lidar.size(), base.size());
  EXPECT_LT(gap(base.front().T_world_lidar, Pose::Identity()), 1e-9) << "the world begins at base_link";
  for (std::size_t i = 0; i < base.size(); ++i) {
    EXPECT_EQ(base[i].stamp, lidar[i].stamp);
    EXPECT_LT(gap(T_base_lidar.inverse() * base[i].T_world_lidar * T_base_lidar, lidar[i].T_world_lidar), 1e-9) << i;
  }
  EXPECT_GT(share_within(points_of(folder_ / "base/map.pcd", T_base_lidar.inverse()),
                         points_of(folder_ / "lidar/map.pcd", Pose::Identity())),
            0.99);
  const std::string summary = text_of(folder_ / "base/summary.json");
  EXPECT_NE(summary.find("\"poses_of\": \"base_link\""), std::string::npos);
  EXPECT_NE(summary.find("\"base_from_lidar\": \"" + mount), std::string::npos);
  EXPECT_NE(text_of(folder_ / "base/report.html").find("base_link"), std::string::npos);
}

TEST_F(BaseFrame, LevellingMakesATiltedBaseUpright) {
  const std::string tilted = "0,0,0.5,4,-9,0";  // the simulated LiDAR stands level, so it is the base that is tilted
  const Outcome level = run("level", {"--level", "--base-from-lidar", tilted});
  ASSERT_EQ(level.exit_code, 0) << level.err;
  const Trajectory levelled = poses("level");
  const Pose T_world_lidar = levelled.front().T_world_lidar * mounted({0, 0, 0.5}, 4, -9, 0);
  const double tilt = std::acos(std::min(1.0, T_world_lidar.linear()(2, 2))) * 180 / std::numbers::pi;
  EXPECT_LT(tilt, 0.5) << "the LiDAR stands upright in a level world";
  EXPECT_LT(levelled.front().T_world_lidar.translation().norm(), 1e-9);
  EXPECT_NE(text_of(folder_ / "level/summary.json").find("\"levelled_by\""), std::string::npos);
  const Outcome plain = run("plain", {"--base-from-lidar", tilted});
  ASSERT_EQ(plain.exit_code, 0);
  const Pose T_level = levelled.front().T_world_lidar * poses("plain").front().T_world_lidar.inverse();
  for (std::size_t i = 0; i < levelled.size(); ++i)
    EXPECT_LT(gap(T_level * poses("plain")[i].T_world_lidar, levelled[i].T_world_lidar), 1e-9)
        << "nothing else changes";
}

TEST_F(BaseFrame, RefusesListsThatAreNoneAndFloorsThatAreNone) {
  const Outcome shorter = run("bad", {"--base-from-lidar", "1,2,3,0,0"});
  EXPECT_EQ(shorter.exit_code, 1);
  EXPECT_NE(shorter.err.find("yaw is missing"), std::string::npos) << shorter.err;
  const Outcome steep = run("steep", {"--level", "--base-from-lidar", "0,0,0,80,0,0"});
  EXPECT_EQ(steep.exit_code, 1);
  EXPECT_NE(steep.err.find("show no floor"), std::string::npos) << steep.err;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "steep/trajectory.tum"));
}

}  // namespace
}  // namespace tilth::app
