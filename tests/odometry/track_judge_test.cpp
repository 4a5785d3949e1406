// Whether a track is believed: made registrations, good and bad ones.
#include <gtest/gtest.h>

#include <tilth/odometry/judged_odometry.hpp>

namespace tilth {
namespace {

constexpr double kPeriod = 0.1;  // [s]

/// Results as of a drive at 1 m/s of which 80 % of each scan fits.
class Drive {
 public:
  OdometryResult good() {
    OdometryResult result;
    result.stamp = stamp_ += kPeriod;
    result.T_world_lidar.translation().x() = stamp_;
    result.alignment.converged = true;
    result.alignment.candidates = 1000;
    result.alignment.matches = 900;
    result.alignment.weight = 800;
    return result;
  }
  OdometryResult fitting(double ratio) {
    OdometryResult result = good();
    result.alignment.weight = ratio * double(result.alignment.candidates);
    return result;
  }
  OdometryResult covered() {
    OdometryResult result = good();
    result.alignment = {};
    return result;
  }
  void pause(double seconds) { stamp_ += seconds; }

 private:
  double stamp_ = 10.0;
};

struct Judged {
  Drive drive;
  TrackJudge judge = {};
  Track last = {};

  Judged() { tell_good(10); }
  Track tell(const OdometryResult& result) { return last = judge.judge(result); }
  void tell_good(int scans) {
    for (int i = 0; i < scans; ++i) tell(drive.good());
  }
};

TEST(TrackJudge, BelievesWhatFits) {
  Judged run;
  EXPECT_EQ(run.last.state, TrackState::tracking);
  EXPECT_EQ(run.judge.unknown_for(), 0.0);
}

TEST(TrackJudge, ARunThatNeverFittedIsSaid) {
  Drive drive;
  TrackJudge judge;
  Track last;
  for (int i = 0; i < 10; ++i) last = judge.judge(drive.fitting(0.3));
  EXPECT_EQ(last.state, TrackState::lost);
  EXPECT_EQ(last.reason, TrackReason::poor_fit);
}

TEST(TrackJudge, ACoveredSensorCoastsIsLostAndFoundAgain) {
  Judged run;
  EXPECT_EQ(run.tell(run.drive.covered()).state, TrackState::coasting);
  EXPECT_EQ(run.last.reason, TrackReason::too_few_matches);
  for (int i = 0; i < 10; ++i) run.tell(run.drive.covered());
  EXPECT_EQ(run.last.state, TrackState::lost);
  EXPECT_NEAR(run.judge.unknown_for(), 11 * kPeriod, 1e-9);
  EXPECT_EQ(run.tell(run.drive.good()).state, TrackState::recovered);
  EXPECT_EQ(run.judge.unknown_for(), 0.0);
  EXPECT_EQ(run.tell(run.drive.good()).state, TrackState::tracking);
}

TEST(TrackJudge, AScanThatDoesNotFitSpoilsTheMapItGoesInto) {
  Judged run;
  EXPECT_EQ(run.tell(run.drive.fitting(0.2)).state, TrackState::lost);
  EXPECT_EQ(run.last.reason, TrackReason::poor_fit);
  run.tell_good(20);
  EXPECT_EQ(run.last.state, TrackState::lost) << "what fits a spoilt map is not found again";
  EXPECT_GT(run.judge.unknown_for(), 0.0);
}

TEST(TrackJudge, AScanThatDoesNotFitAndStaysOutsideSpoilsNothing) {
  Judged run;
  OdometryResult outside = run.drive.fitting(0.2);
  outside.in_map = false;
  EXPECT_EQ(run.tell(outside).state, TrackState::coasting);
  EXPECT_EQ(run.tell(run.drive.good()).state, TrackState::tracking);
}

TEST(TrackJudge, WhatFollowsADoubtMustFitAsUsual) {
  Judged run;
  for (const double ratio : {0.2, 0.6}) {  // the second as another room like this one fits
    OdometryResult elsewhere = run.drive.fitting(ratio);
    elsewhere.in_map = false;
    EXPECT_EQ(run.tell(elsewhere).reason, TrackReason::poor_fit) << ratio;
  }
  EXPECT_EQ(run.tell(run.drive.fitting(0.75)).state, TrackState::tracking);
  EXPECT_EQ(run.tell(run.drive.fitting(0.6)).state, TrackState::tracking) << "nothing was in doubt";
}

TEST(TrackJudge, TheLongerNothingWasSeenTheMoreMustFit) {
  for (const auto& [pause, state] : {std::pair(0.3, TrackState::tracking), std::pair(2.0, TrackState::lost)}) {
    Judged run;
    run.drive.pause(pause);
    EXPECT_EQ(run.tell(run.drive.fitting(0.6)).state, state) << pause;
  }
}

TEST(TrackJudge, AMapThatWasBegunAfterALossHasAUsualFitOfItsOwn) {
  Judged run;
  OdometryResult begins = run.drive.good();
  begins.relative = true;
  begins.alignment.matches = 0, begins.alignment.weight = 0;
  EXPECT_EQ(run.tell(begins).reason, TrackReason::new_map);
  for (int i = 0; i < 5; ++i) {
    OdometryResult goes_on = run.drive.fitting(0.5);
    goes_on.relative = true;
    EXPECT_EQ(run.tell(goes_on).reason, TrackReason::new_map) << i;
  }
  OdometryResult poor = run.drive.fitting(0.2);
  poor.relative = true;
  EXPECT_EQ(run.tell(poor).reason, TrackReason::poor_fit);
}

TEST(TrackJudge, SaysThatAnotherMotionFitsAsWell) {
  Judged run;
  OdometryResult either = run.drive.good();
  either.ambiguous = true;
  EXPECT_EQ(run.tell(either).reason, TrackReason::ambiguous);
  EXPECT_EQ(run.last.state, TrackState::lost);
}

TEST(TrackJudge, APoseThatLeapsIsNotBelieved) {
  Judged run;
  OdometryResult away = run.drive.good();
  away.T_world_lidar.translation().y() = 2.0;
  EXPECT_EQ(run.tell(away).reason, TrackReason::jump);
  EXPECT_EQ(run.last.state, TrackState::lost);
}

TEST(TrackJudge, SaysWhenNothingWasSeenForLong) {
  Judged run;
  run.drive.pause(10.0);
  EXPECT_EQ(run.tell(run.drive.good()).reason, TrackReason::long_gap);
  EXPECT_EQ(run.last.state, TrackState::recovered);
}

/// Tells what a drive says, whatever the scan.
class ToldOdometry : public Odometry {
 public:
  explicit ToldOdometry(std::vector<OdometryResult> results) : results_(std::move(results)) {}
  OdometryResult register_scan(const Scan&) override { return results_[next_++]; }
  PointCloud local_map() const override { return {}; }

 private:
  std::vector<OdometryResult> results_;
  std::size_t next_ = 0;
};

TEST(JudgedOdometry, TheCovarianceOfAPoseThatIsNotBelievedGrowsWithTime) {
  Drive drive;
  std::vector<OdometryResult> results;
  for (int i = 0; i < 5; ++i) results.push_back(drive.good());
  for (int i = 0; i < 20; ++i) results.push_back(drive.covered());
  JudgedOdometry odometry(std::make_unique<ToldOdometry>(results));
  for (int i = 0; i < 5; ++i) EXPECT_FALSE(odometry.register_scan({}).covariance) << "as the pipeline has it";
  double last = 0;
  for (int i = 1; i <= 20; ++i) {
    const double variance = odometry.register_scan({}).covariance.value()(3, 3);
    EXPECT_GT(variance, last);
    last = variance;
    const double braked = 0.5 * 2.0 * std::pow(kPeriod * i, 2);  // [m] astray at 2 m/s^2
    EXPECT_GT(std::sqrt(variance), braked) << i;
  }
}

}  // namespace
}  // namespace tilth
