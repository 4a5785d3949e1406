// The default pipeline on real recordings, held against what each of them is known to say; skipped by name where one is
// not at hand.
#include <algorithm>
#include <filesystem>
#include <numbers>
#include <set>

#include <gtest/gtest.h>

#include "range_images.hpp"
#include "support/real_recording.hpp"
#include <tilth/evaluation/umeyama.hpp>
#include <tilth/io/trajectory_file.hpp>
#include <tilth/odometry/make_odometry.hpp>
#include <tilth/search/kdtree.hpp>
#include <tilth/sources/open_source.hpp>

namespace tilth {
namespace {

/// The poses of all scans of a recording by the default pipeline. All but `lost` must be registered.
std::vector<Pose> poses_of(const std::filesystem::path& folder, const std::set<std::size_t>& lost = {}) {
  const auto source = open_source(folder.string(), {});
  const auto odometry = make_odometry(pipelines().front().name, {});
  std::vector<Pose> poses;
  while (const auto scan = source->next()) {
    const OdometryResult result = odometry->register_scan(*scan);
    EXPECT_TRUE(result.alignment.converged || lost.contains(poses.size())) << "scan " << poses.size();
    EXPECT_EQ(result.alignment.degenerate_directions, 0) << "scan " << poses.size();
    EXPECT_TRUE(result.T_world_lidar.matrix().allFinite()) << "scan " << poses.size();
    poses.push_back(result.T_world_lidar);
  }
  return poses;
}

constexpr double kDegree = std::numbers::pi / 180;

double metres(const Pose& T) {
  return T.translation().norm();
}
double degrees(const Pose& T) {
  return angle_of(T) / kDegree;
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(values.size() / 2), values.end());
  return values[values.size() / 2];
}

TEST(OdometryOnRecordings, VehicleStandsThenDrivesALoop) {
  const auto folder = recording("vlp16-outdoor-loop");
  NEEDS(folder);
  const std::vector<Pose> poses = poses_of(folder);
  ASSERT_EQ(poses.size(), 406u);
  for (std::size_t i = 0; i < 18; ++i) EXPECT_LT(metres(poses[0].inverse() * poses[i]), 0.015) << i;
  double way = 0;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    const double step = metres(poses[i - 1].inverse() * poses[i]);
    EXPECT_LT(step, 0.65) << i;
    way += step;
  }
  EXPECT_NEAR(way, 151, 3);
  const struct {
    std::size_t later, earlier;
    Eigen::Vector3d place;  // [m] found by ICP of the two scans, to 0.1 m
  } meetings[] = {{405, 74, {0.16, -0.80, -0.09}}, {395, 77, {0.05, -0.79, -0.04}}, {385, 83, {0.02, -0.75, -0.02}}};
  for (const auto& meeting : meetings) {
    const Pose T_earlier_later = poses[meeting.earlier].inverse() * poses[meeting.later];
    EXPECT_LT((T_earlier_later.translation() - meeting.place).norm(), 0.8) << meeting.later;
  }
}

TEST(OdometryOnRecordings, SensorAtRestStaysAtRest) {
  const auto folder = recording("rs16-static-room");
  NEEDS(folder);
  const std::vector<Pose> poses = poses_of(folder);
  ASSERT_EQ(poses.size(), 20u);
  for (const Pose& pose : poses) {
    EXPECT_LT(metres(poses[0].inverse() * pose), 0.01);
    EXPECT_LT(degrees(poses[0].inverse() * pose), 0.1);
  }
}

TEST(OdometryOnRecordings, HandHeldMotionAgreesWithTheGivenPoses) {
  const auto folder = recording("xt32-hilti14");
  NEEDS(folder);
  const std::vector<Pose> poses = poses_of(folder, {25, 26});
  const Trajectory given = read_tum(folder / "poses_tum.txt");
  ASSERT_EQ(poses.size(), given.size());
  const auto error_between = [&](std::size_t a, std::size_t b) {
    const Pose T_given = given[a].T_world_lidar.inverse() * given[b].T_world_lidar;
    return Pose(T_given.inverse() * (poses[a].inverse() * poses[b]));
  };
  std::vector<double> off, turned_off;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    off.push_back(metres(error_between(i - 1, i)));
    turned_off.push_back(degrees(error_between(i - 1, i)));
  }
  EXPECT_LT(median(off), 0.03);
  EXPECT_LT(median(turned_off), 1.0);
  EXPECT_LT(metres(error_between(24, 28)), 0.2);  // found again after 0.97 m and 29 degrees without a scan
  EXPECT_LT(degrees(error_between(24, 28)), 4.0);
}

/// Root mean square distance in the plane [m] of an estimate from positions, moved onto them as well as may be.
double distance_in_plane(std::vector<Eigen::Vector3d> estimate, std::vector<Eigen::Vector3d> truth) {
  for (std::vector<Eigen::Vector3d>* points : {&estimate, &truth}) {
    for (Eigen::Vector3d& p : *points) p.z() = 0;
  }
  const Similarity fit = umeyama(estimate, truth, false);
  double squares = 0;
  for (std::size_t i = 0; i < truth.size(); ++i)
    squares += (fit.rotation * estimate[i] + fit.translation - truth[i]).squaredNorm();
  return std::sqrt(squares / double(truth.size()));
}

// A street that is mostly road: of all there is to see little tells how far the car has come, and yet enough.
TEST(OdometryOnRecordings, CarPullsAwayFromRest) {
  const auto folder = recording("hdl64-durlachertor");
  NEEDS(folder);
  constexpr double kPeriod = 0.104;  // [s]
  const RangeImages images(folder);
  const std::vector<GpsPose> gps = gps_of(folder);
  ASSERT_EQ(gps.size(), 52u);
  const auto odometry = make_odometry(pipelines().front().name, {});
  std::vector<Eigen::Vector3d> estimate, truth;
  for (std::size_t i = 0; i < gps.size(); ++i) {
    const OdometryResult result = odometry->register_scan(images.scan(i, gps[i].stamp, kPeriod));
    EXPECT_EQ(result.alignment.degenerate_directions, 0) << "scan " << i;
    if (i + 1 == gps.size()) break;
    const double ratio = (result.stamp - gps[i].stamp) / (gps[i + 1].stamp - gps[i].stamp);
    estimate.push_back(result.T_world_lidar.translation());
    truth.push_back(gps[i].position + ratio * (gps[i + 1].position - gps[i].position));
  }
  EXPECT_NEAR((estimate.back() - estimate.front()).norm(), (truth.back() - truth.front()).head<2>().norm(), 0.2);
  EXPECT_LT(distance_in_plane(estimate, truth), 0.1);  // of which 5 cm are the jitter of the GPS poses
}

/// The share of the upright things of `later`, 4 to 40 m away, that lie within 0.1 m of a point of `earlier`.
double ratio_in_place(const PointCloud& later, const Pose& T_earlier_later, const KdTree& earlier) {
  std::size_t looked_at = 0, in_place = 0;
  for (const Eigen::Vector3d& p : later.points) {
    if (p.z() < -1 || p.z() > 1.5 || p.norm() < 4 || p.norm() > 40) continue;
    ++looked_at;
    const auto nearest = earlier.nearest(T_earlier_later * p);
    in_place += nearest && nearest->squared_distance < 0.1 * 0.1;
  }
  return double(in_place) / double(std::max<std::size_t>(1, looked_at));
}

// The given poses of this recording are rough in the first scans: the scans themselves are the judge.
TEST(OdometryOnRecordings, CarBringsItsLastScanOntoItsFirst) {
  const auto folder = recording("kitti00-first16");
  NEEDS(folder);
  const std::vector<Pose> poses = poses_of(folder);
  const Trajectory given = read_tum(folder / "poses_lidar_tum.txt");
  ASSERT_EQ(poses.size(), 16u);
  ASSERT_GE(given.size(), 16u);
  const auto source = open_source(folder.string(), {});
  std::vector<PointCloud> clouds;
  while (const auto scan = source->next()) clouds.push_back(scan->cloud);
  const KdTree first(clouds.front().points);
  const double ours = ratio_in_place(clouds.back(), poses.front().inverse() * poses.back(), first);
  const double theirs =
      ratio_in_place(clouds.back(), given.front().T_world_lidar.inverse() * given[15].T_world_lidar, first);
  EXPECT_GE(ours, 0.5);
  EXPECT_GE(ours, 4 * theirs);
}

}  // namespace
}  // namespace tilth
