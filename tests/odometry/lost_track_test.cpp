// Starts in motion, gaps, covered sensors: the pipelines find their way, or say that they are lost.
#include <functional>

#include <gtest/gtest.h>

#include <tilth/odometry/make_odometry.hpp>
#include <tilth/simulation/simulator.hpp>

namespace tilth {
namespace {

/// What becomes of scan `i` of a drive: the scan to give, or nothing.
using Accident = std::function<std::optional<Scan>(std::size_t i, Scan scan)>;

struct Drive {
  std::string scene;
  OptionValues options;
  std::size_t first, scans;
  Accident accident = [](std::size_t, Scan scan) { return std::optional(std::move(scan)); };
  double held = 0.0;  ///< [s] that the recording stands still, where the accident says so
};

struct Outcome {
  double last = 0;            ///< [m] from the truth at the end, the first poses made equal
  double worst = 0;           ///< [m] of the poses that are said to be right
  double worst_coasting = 0;  ///< [m] of those that are predicted
  std::size_t said = 0;
  std::vector<Track> tracks = {};
  std::vector<double> sigmas = {};  ///< [m]
};

Outcome drive(const std::string& pipeline, const Drive& drive) {
  const Simulator simulator(drive.scene, simulation_options(drive.scene, drive.options));
  const auto odometry = make_odometry(pipeline, {});
  Outcome outcome;
  Pose T_truth_world = Pose::Identity();
  for (std::size_t i = 0; i < drive.scans; ++i) {
    const Scan whole = simulator.scan(drive.first + i).scan;
    const std::optional<Scan> scan = drive.accident(i, whole);
    if (!scan) continue;
    const OdometryResult result = odometry->register_scan(*scan);
    const Pose T_truth = interpolate(simulator.truth(), result.stamp - (scan->stamp - whole.stamp));
    if (i == 0) T_truth_world = T_truth * result.T_world_lidar.inverse();
    outcome.last = (T_truth.inverse() * T_truth_world * result.T_world_lidar).translation().norm();
    const bool believed = result.track.state == TrackState::tracking;
    if (believed) outcome.worst = std::max(outcome.worst, outcome.last);
    if (result.track.state == TrackState::coasting)
      outcome.worst_coasting = std::max(outcome.worst_coasting, outcome.last);
    outcome.said += result.track.state == TrackState::lost;
    outcome.tracks.push_back(result.track);
    outcome.sigmas.push_back(std::sqrt(result.covariance.value_or(result.alignment.covariance)(3, 3)));
  }
  return outcome;
}

class LostTrack : public testing::TestWithParam<std::string> {};

TEST_P(LostTrack, StartsInMotionOnAStreet) {
  for (const char* speed : {"1.1", "1.7"}) {  // times 8 m/s
    const std::size_t first = std::size_t(57 / std::stod(speed));
    const Outcome outcome = drive(GetParam(), {"street", {{"seed", "7"}, {"speed", speed}}, first, 12});
    EXPECT_LT(outcome.worst, 0.12) << speed;  // lost: metres
    EXPECT_EQ(outcome.said, 0U) << speed;
  }
}

TEST_P(LostTrack, FindsItsWayWhereScansOfATurnAreMissing) {
  const auto missing = [](std::size_t i, Scan scan) {
    return i >= 15 && i < 21 ? std::nullopt : std::optional(std::move(scan));
  };
  const Outcome outcome = drive(GetParam(), {"plaza_fast", {{"seed", "207"}}, 32, 40, missing});
  EXPECT_EQ(outcome.said, 0U);
  EXPECT_LT(outcome.worst, 0.12);
}

TEST_P(LostTrack, ACoveredSensorIsSaidAndItsCovarianceHoldsTheError) {
  const auto covered = [](std::size_t i, Scan scan) {
    if (i >= 20 && i < 35) scan.cloud = {};
    return std::optional(std::move(scan));
  };
  const Outcome outcome = drive(GetParam(), {"corridor", {{"seed", "7"}}, 100, 45, covered});
  EXPECT_EQ(outcome.tracks[20].state, TrackState::coasting);
  EXPECT_EQ(outcome.tracks[34].state, TrackState::lost);
  EXPECT_EQ(outcome.tracks.back().state, TrackState::tracking);
  EXPECT_GT(outcome.sigmas[34], 1.0);
  EXPECT_LT(outcome.last, 0.05);
}

// A handful of returns, of the hand that covers the sensor, fits anywhere: the motion is carried on.
TEST_P(LostTrack, AScanOfAFewReturnsIsPredicted) {
  const auto few = [](std::size_t i, Scan scan) {
    if (i >= 17 && i < 21) {
      std::vector<std::uint8_t> keep(scan.cloud.size());
      std::fill_n(keep.begin(), 40, std::uint8_t(1));
      scan.cloud = select_kept(scan.cloud, keep);
    }
    return std::optional(std::move(scan));
  };
  const Outcome outcome = drive(GetParam(), {"plaza_fast", {{"seed", "207"}}, 32, 40, few});
  EXPECT_EQ(outcome.tracks[18].state, TrackState::coasting);
  EXPECT_LT(outcome.worst_coasting, 0.3);
  EXPECT_LT(outcome.last, 0.05);
}

// Other rooms of the same building fit by half: what was carried there must not be "found again".
TEST_P(LostTrack, ASensorThatWasCarriedAwayIsNeverBelievedElsewhere) {
  for (const char* seed : {"611", "612"}) {
    const OptionValues carried{{"seed", seed}, {"kidnap", "25"}, {"kidnap_jump", "20"}};
    const Outcome outcome = drive(GetParam(), {"hospital", carried, 235, 45});
    EXPECT_LT(outcome.worst, 0.1) << seed;
    EXPECT_GT(outcome.said, 20U) << seed;
  }
}

TEST_P(LostTrack, ADriveGoesOnAfterAPause) {
  const auto paused = [](std::size_t i, Scan scan) {
    scan.stamp += i >= 20 ? 30.0 : 0.0;
    return std::optional(std::move(scan));
  };
  const Outcome outcome = drive(GetParam(), {"plaza_fast", {{"seed", "207"}}, 32, 40, paused});
  EXPECT_EQ(outcome.tracks[20].state, TrackState::recovered);
  EXPECT_EQ(outcome.tracks[20].reason, TrackReason::long_gap);
  EXPECT_LT(outcome.last, 0.15);
}

TEST_P(LostTrack, ARecordingThatGoesOnElsewhereIsSaid) {
  const Simulator elsewhere("office", simulation_options("office", {{"seed", "7"}}));
  const auto joined = [&](std::size_t i, Scan scan) {
    if (i >= 20) scan.cloud = elsewhere.scan(100 + i).scan.cloud;
    return std::optional(std::move(scan));
  };
  const Outcome outcome = drive(GetParam(), {"corridor", {{"seed", "7"}}, 100, 40, joined});
  EXPECT_EQ(outcome.tracks[19].state, TrackState::tracking);
  EXPECT_EQ(outcome.tracks.back().state, TrackState::lost);
}

INSTANTIATE_TEST_SUITE_P(Pipelines, LostTrack, testing::Values("tilth", "improved_floam"),
                         [](const auto& pipeline) { return pipeline.param; });

}  // namespace
}  // namespace tilth
