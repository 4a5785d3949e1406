// A truth in the frame of KITTI's camera is moved to the LiDAR's, and whatever is not of one body is told.
#include <cmath>
#include <fstream>

#include <gtest/gtest.h>

#include "io/temporary_folder.hpp"
#include <tilth/evaluation/body_frame.hpp>
#include <tilth/io/trajectory_file.hpp>
#include <tilth/run/evaluation_report.hpp>
#include <tilth/run/truth_file.hpp>

namespace tilth {
namespace {

namespace fs = std::filesystem;

const char* const kCalib = "P0: 7 0 6 0 0 7 1 0 0 0 1 0\nTr: 0 -1 0 0.1 0 0 -1 -0.2 1 0 0 -0.3\n";

Pose camera_lidar() {
  Pose T = Pose::Identity();
  T.linear() << 0, -1, 0, 0, 0, -1, 1, 0, 0;
  T.translation() = Eigen::Vector3d(0.1, -0.2, -0.3);
  return T;
}

/// A LiDAR at 5 m/s in long bends, a pose each 0.1 s.
Trajectory drive(std::size_t poses) {
  Trajectory trajectory;
  Pose T = Pose::Identity();
  for (std::size_t i = 0; i < poses; ++i) {
    trajectory.push_back({0.1 * double(i), T});
    Vector6d motion;
    motion << 0, 0.001 * std::sin(0.1 * double(i)), 0.02 * std::sin(0.02 * double(i)), 0.5, 0, 0;
    T = retract(T, motion);
  }
  return trajectory;
}

/// The estimate drifts by one part in a hundred of each step.
Trajectory drifting(Trajectory trajectory) {
  for (StampedPose& pose : trajectory) pose.T_world_lidar.translation() *= 1.01;
  return trajectory;
}

class TruthInAFolder : public testing::Test {
 protected:
  fs::path camera_truth(std::size_t poses = 600) const {
    write_kitti_poses(folder_ / "poses.txt", in_frame_of(drive(poses), camera_lidar().inverse()));
    return folder_ / "poses.txt";
  }
  void put(const std::string& name, const std::string& text) const { std::ofstream(folder_ / name) << text; }
  Evaluation judged(const fs::path& truth, const Trajectory& estimate, const std::string& calibration = "") const {
    EvaluationOptions options;
    options.kitti = estimate.size() > 300;
    return judge(read_truth(truth, calibration), {estimate, true, {}}, options);
  }
  static bool says(const Evaluation& evaluation, const std::string& part) {
    for (const std::string& notice : notices_of(evaluation)) {
      if (notice.find(part) != std::string::npos) return true;
    }
    return false;
  }

  TemporaryFolder folder_;
};

TEST_F(TruthInAFolder, ACameraWithoutCalibrationIsWarnedOf) {
  const Evaluation evaluation = judged(camera_truth(), drive(600));
  EXPECT_TRUE(says(evaluation, "warning: the truth moves along +z of its own body, the estimate along +x"));
  EXPECT_TRUE(says(evaluation, "--calib"));
  EXPECT_GT(evaluation.kitti->translation, 1.0) << "nothing is right then";
}

TEST_F(TruthInAFolder, TheCalibrationBesideItIsFoundAndUsed) {
  put("calib.txt", kCalib);
  const Evaluation evaluation = judged(camera_truth(), drive(600));
  EXPECT_TRUE(says(evaluation, "moved to the LiDAR's by"));
  EXPECT_TRUE(says(evaluation, "found beside it"));
  EXPECT_FALSE(says(evaluation, "warning"));
  EXPECT_LT(evaluation.kitti->translation, 1e-12);
  EXPECT_LT(evaluation.ape.full.max, 1e-9);
}

TEST_F(TruthInAFolder, TheCalibrationAskedForIsUsed) {
  put("other.txt", kCalib);
  const Evaluation evaluation = judged(camera_truth(), drive(600), (folder_ / "other.txt").string());
  EXPECT_TRUE(says(evaluation, "other.txt"));
  EXPECT_LT(evaluation.ape.full.max, 1e-9);
}

TEST_F(TruthInAFolder, KittiMeasuresWhereTheCameraIs) {
  put("calib.txt", kCalib);
  const Trajectory truth = drive(600), estimate = drifting(truth);
  EvaluationOptions options;
  options.kitti = true;
  const Evaluation camera =
      evaluate(in_frame_of(truth, camera_lidar().inverse()), in_frame_of(estimate, camera_lidar().inverse()), options);
  const Evaluation moved = judged(camera_truth(), estimate);
  EXPECT_NEAR(moved.kitti->translation, camera.kitti->translation, 1e-12);
  EXPECT_NEAR(moved.kitti->rotation, camera.kitti->rotation, 1e-12);
}

TEST_F(TruthInAFolder, OfTheLidarItselfIsLeftAlone) {
  put("calib.txt", kCalib);
  write_tum(folder_ / "poses_lidar.tum", drive(600));
  const Evaluation evaluation = judged(folder_ / "poses_lidar.tum", drive(600));
  EXPECT_TRUE(notices_of(evaluation).empty());
  EXPECT_LT(evaluation.ape.full.max, 1e-12);
  const Evaluation asked = judged(folder_ / "poses_lidar.tum", drive(600), (folder_ / "calib.txt").string());
  EXPECT_TRUE(says(asked, "warning")) << "a calibration that does not belong to it";
}

TEST_F(TruthInAFolder, AnEstimateInTheCamerasFrameIsLeftThere) {
  put("calib.txt", kCalib);
  const Trajectory estimate = in_frame_of(drive(600), camera_lidar().inverse());
  const Evaluation evaluation = judged(camera_truth(), estimate);
  EXPECT_TRUE(notices_of(evaluation).empty());
  EXPECT_LT(evaluation.ape.full.max, 1e-12);
  EXPECT_TRUE(says(judged(camera_truth(), estimate, (folder_ / "calib.txt").string()), "--calib none"));
}

TEST_F(TruthInAFolder, NoneLeavesItWhereItIs) {
  put("calib.txt", kCalib);
  EXPECT_TRUE(says(judged(camera_truth(), drive(600), "none"), "warning: the truth moves along +z"));
}

TEST_F(TruthInAFolder, WhereTheMotionTellsNothingThatIsSaid) {
  put("calib.txt", kCalib);
  const Evaluation evaluation = judged(camera_truth(5), drive(5));
  EXPECT_TRUE(says(evaluation, "is not used")) << "two metres are too few";
}

TEST_F(TruthInAFolder, AFileThatIsNotKittisIsNoHindranceUnlessAskedFor) {
  put("calib.txt", "fx: 500\nfy: 500\n");
  EXPECT_TRUE(says(judged(camera_truth(), drive(600)), "warning: the truth moves along +z"));
  EXPECT_THROW(judged(camera_truth(), drive(600), (folder_ / "calib.txt").string()), Error);
}

TEST_F(TruthInAFolder, ASidewaysMountedBodyIsWarnedOfToo) {
  Pose T = Pose::Identity();
  T.linear() = Eigen::AngleAxisd(1.5, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  write_tum(folder_ / "imu.tum", in_frame_of(drive(600), T));
  EXPECT_TRUE(says(judged(folder_ / "imu.tum", drive(600)), "not poses of the same body"));
}

TEST_F(TruthInAFolder, GapsAreTold) {
  Trajectory truth = drive(600);
  truth.erase(truth.begin() + 100, truth.begin() + 129);
  write_tum(folder_ / "gaps.tum", truth);
  EvaluationOptions options;
  options.association.interpolate = true;
  const Evaluation evaluation = judge(read_truth(folder_ / "gaps.tum"), {drive(600), true, {}}, options);
  EXPECT_TRUE(says(evaluation, "29 poses of the estimate are left out"));
  EXPECT_TRUE(says(evaluation, "9.900 s to 12.900 s"));
  EXPECT_NE(evaluation_json(evaluation).find("\"truth_gaps\""), std::string::npos);
  EXPECT_NE(evaluation_table(evaluation).find("29 poses"), std::string::npos);
}

TEST_F(TruthInAFolder, LinesTellWhatIsInIt) {
  put("calib.txt", kCalib);
  std::string all;
  for (const std::string& line : truth_lines(read_truth(camera_truth()))) all += line + "\n";
  for (const char* part : {"600 poses without stamps", "a path of 299", "+z of its own body, as a camera", "calib.txt"})
    EXPECT_NE(all.find(part), std::string::npos) << all;
}

}  // namespace
}  // namespace tilth
