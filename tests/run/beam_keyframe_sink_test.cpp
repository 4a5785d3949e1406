// What of a run goes into the calibration of beams: where keyframes stand, how they move, and which windows are kept.
#include <functional>

#include <gtest/gtest.h>

#include <tilth/odometry/odometry.hpp>
#include <tilth/run/beam_keyframe_sink.hpp>
#include <tilth/run/run_record.hpp>

namespace tilth {
namespace {

constexpr double kPeriod = 0.1, kMiddle = 0.05;  // [s]

class BeamKeyframes : public testing::Test {
 protected:
  BeamKeyframes() {
    options.step = 0.4, options.window = 6, options.most_windows = 100;
    cloud.points = {{0, 5, 0}, {3, 0, 1}};
    cloud.rings = {0, 3};
    cloud.intensities = {10, 100};
  }

  /// `count` scans more, the pose of each at its own instant.
  void drive(std::size_t count, const std::function<Pose(double time)>& pose, TrackState state = TrackState::tracking) {
    for (std::size_t i = 0; i < count; ++i, time += kPeriod) {
      OdometryResult result;
      result.stamp = time, result.T_world_lidar = pose(time), result.filtered = cloud;
      result.motion = MotionInScan::steady(Vector6d::Constant(9), kMiddle);
      result.motion.vibration.knots[1] = Vector6d::Constant(1);
      result.track.state = state;
      sink().take({time - kMiddle, cloud, T_cloud_sensor}, result, {});
    }
  }

  void forward(std::size_t count, double metres_a_scan, TrackState state = TrackState::tracking) {
    const double from = x - metres_a_scan * time / kPeriod;
    drive(
        count, [&](double t) { return Pose(Eigen::Translation3d(from + metres_a_scan * t / kPeriod, 0, 0)); }, state);
    x += metres_a_scan * double(count);
  }

  BeamKeyframeSink& sink() {
    if (!sink_) sink_.emplace(options, gathered);
    return *sink_;
  }

  const GatheredKeyframes& finished() {
    sink().finish({});
    return gathered;
  }

  BeamCalibrationOptions options;
  PointCloud cloud;
  std::optional<Pose> T_cloud_sensor;
  double time = 100, x = 0;
  GatheredKeyframes gathered;

 private:
  std::optional<BeamKeyframeSink> sink_;
};

double place(const BeamKeyframe& keyframe) {
  return keyframe.T_map_lidar.translation().x();
}

TEST_F(BeamKeyframes, StandByTheWayAndNeverByTime) {
  forward(30, 0.15);
  forward(200, 0);
  forward(31, 0.15);
  std::vector<double> places;
  for (const auto& window : finished().windows) {
    EXPECT_EQ(window.size(), 6U);
    for (const BeamKeyframe& keyframe : window) places.push_back(place(keyframe));
  }
  EXPECT_EQ(places.size(), 18U);
  for (std::size_t i = 1; i < places.size(); ++i) {
    EXPECT_GE(places[i] - places[i - 1], 0.4 - 1e-9);
    EXPECT_LE(places[i] - places[i - 1], 0.55);
  }
}

TEST_F(BeamKeyframes, MoveAlongTheParabolaThroughThreePoses) {
  const MotionInScan truth{(Vector6d() << 0.1, 0, 0.4, 5, 0.2, 0).finished(),
                           (Vector6d() << 0, 0.3, -0.5, 1, 0, 0.4).finished()};
  options.window = 1;
  drive(3, [&](double t) { return truth.after(t - 100 - kPeriod); });
  const BeamKeyframe& keyframe = finished().windows.at(0).at(0);
  EXPECT_LT((keyframe.motion.velocity - truth.velocity).norm(), 1e-9);
  EXPECT_LT((keyframe.motion.acceleration - truth.acceleration).norm(), 1e-9);
  EXPECT_TRUE(keyframe.motion.vibration.none());
  EXPECT_EQ(keyframe.motion.begin, -kMiddle);
  EXPECT_EQ(keyframe.motion.duration, 2 * kMiddle);
  EXPECT_NEAR(keyframe.reference_time, kMiddle, 1e-12);
}

TEST_F(BeamKeyframes, WindowsAreThinnedEvenly) {
  options.most_windows = 3;
  forward(6 * 14 + 2, 0.5);
  std::vector<double> begins;
  for (const auto& window : finished().windows) begins.push_back(place(window.front()));
  ASSERT_EQ(begins.size(), 2U) << "windows 0 and 8 of 0 to 13";
  EXPECT_NEAR(begins[1] - begins[0], 8 * 6 * 0.5, 1e-9);
}

TEST_F(BeamKeyframes, NeverMoreWindowsThanAskedFor) {
  options.most_windows = 5;
  for (int i = 0; i < 60; ++i) {
    forward(6, 0.5);
    EXPECT_LE(gathered.windows.size(), 5U);
  }
  EXPECT_GE(gathered.windows.size(), 3U);
}

TEST_F(BeamKeyframes, AWindowNeedsMoreThanHalf) {
  forward(6 + 3 + 2, 0.5);
  EXPECT_EQ(finished().windows.size(), 1U);
  EXPECT_EQ(gathered.left_over, 3U);
}

TEST_F(BeamKeyframes, AWindowOfMoreThanHalfIsKept) {
  forward(6 + 4 + 2, 0.5);
  ASSERT_EQ(finished().windows.size(), 2U);
  EXPECT_EQ(gathered.windows[1].size(), 4U);
  EXPECT_EQ(gathered.left_over, 0U);
}

TEST_F(BeamKeyframes, AWindowEndsWhereTheTrackIsLost) {
  forward(6, 0.5);  // the first and the last one have no pose before or after
  forward(3, 0.5, TrackState::lost);
  forward(1, 0.5, TrackState::recovered);
  forward(8, 0.5);
  ASSERT_EQ(finished().windows.size(), 2U);
  EXPECT_EQ(gathered.windows[0].size(), 4U);
  EXPECT_EQ(gathered.windows[1].size(), 6U);
  EXPECT_LT(place(gathered.windows[0].back()), 6 * 0.5);
  EXPECT_GE(place(gathered.windows[1].front()), 10 * 0.5);
}

TEST_F(BeamKeyframes, NoneStandsBesideAPoseThatIsOnlyPredicted) {
  forward(4, 0.5);
  forward(1, 0.5, TrackState::coasting);
  forward(6, 0.5);
  ASSERT_EQ(finished().windows.size(), 1U) << "which goes on";
  for (const BeamKeyframe& keyframe : gathered.windows[0])
    EXPECT_GT(std::abs(place(keyframe) - 4 * 0.5), 0.5 + 1e-9) << "the pose that was predicted";
}

TEST_F(BeamKeyframes, AreSeenFromTheSensor) {
  T_cloud_sensor = Eigen::Translation3d(0.3, 0, 1) * Eigen::AngleAxisd(0.4, Eigen::Vector3d::UnitY());
  forward(8, 0.5);
  const BeamKeyframe& keyframe = finished().windows.at(0).at(0);
  const Eigen::Vector3d in_world(0.5, 5, 0);
  const auto found =
      std::find_if(keyframe.returns.begin(), keyframe.returns.end(), [](auto& r) { return r.ring == 0; });
  ASSERT_NE(found, keyframe.returns.end());
  EXPECT_LT((keyframe.T_map_lidar * found->point.cast<double>() - in_world).norm(), 1e-5);
  EXPECT_LT((keyframe.T_map_lidar.translation() - Eigen::Vector3d(0.8, 0, 1)).norm(), 1e-9);
  EXPECT_LT(
      (keyframe.motion.velocity.tail<3>() - T_cloud_sensor->linear().transpose() * Eigen::Vector3d(5, 0, 0)).norm(),
      1e-9);
}

TEST_F(BeamKeyframes, KnowRingsAndBrightness) {
  forward(8, 0.5);
  EXPECT_EQ(finished().rings, 4U);
  EXPECT_EQ(gathered.bright, 100);
  EXPECT_EQ(gathered.scans_without_rings, 0U);
}

TEST_F(BeamKeyframes, WithoutIntensitiesEveryReturnIsBright) {
  cloud.intensities.clear();
  forward(8, 0.5);
  EXPECT_EQ(finished().bright, 255);
}

TEST_F(BeamKeyframes, ThereAreNoneWithoutRings) {
  cloud.rings.clear();
  forward(20, 0.5);
  EXPECT_TRUE(finished().windows.empty());
  EXPECT_EQ(gathered.rings, 0U);
  EXPECT_EQ(gathered.scans_without_rings, 20U);
}

}  // namespace
}  // namespace tilth
