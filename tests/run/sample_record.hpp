// A short run that no pipeline made.
#pragma once

#include <limits>

#include <tilth/run/run_record.hpp>

namespace tilth {

/// Four scans, 1 m and 0.5 s apart, back at the start with the last; 100, 200, 300 and 400 ms.
inline RunRecord sample_record() {
  RunRecord record;
  record.pipeline = "sample";
  record.options = {{"a.b", "3", "m", "meaning", "0 .. 9"}};
  record.skipped = {{7, "scan7.pcd", "is \"empty\""}};
  record.scans.stages = {"first", "second"};
  const double x[] = {0, 1, 1, 0}, y[] = {0, 0, 1, 0};
  for (std::size_t i = 0; i < 4; ++i) {
    record.trajectory.push_back({0.5 * double(i), Pose(Eigen::Translation3d(x[i], y[i], 0))});
    ScanRow row;
    row.stamp = 0.5 * double(i);
    row.register_ms = 100.0 * double(i + 1);
    row.converged = i != 2;
    row.stage_ms.assign(i == 0 ? 1 : 2, 7.0);
    record.scans.rows.push_back(row);
  }
  record.beams.emplace();
  record.beams->beams.model.range = {0.01, -0.02};
  record.beams->beams.model.elevation = {0.0, 0.001};
  record.beams->beams.covariance = 1e-6 * Eigen::MatrixXd::Identity(9, 9);
  record.beams->before = {{0.003, -0.008}, 0.012};
  record.beams->after = {{0.0, std::numeric_limits<double>::quiet_NaN()}, 0.009};
  record.beams->windows = 3, record.beams->directions = 9, record.beams->believed = 4;
  return record;
}

/// The same with loop closure.
inline RunRecord looped_record() {
  RunRecord record = sample_record();
  LoopRecord loops{.odometry = record.trajectory};
  loops.graph.poses.assign(3, Pose::Identity());
  for (const char* verdict : {"accepted", "ambiguous", "accepted"}) {
    ClosureRow row;
    row.verdict = verdict;
    loops.closures.push_back(row);
  }
  record.loops = loops;
  return record;
}

/// The same, lost in its last two scans.
inline RunRecord lost_record() {
  RunRecord record = sample_record();
  record.scans.rows[1].track = {TrackState::coasting, TrackReason::too_few_matches};
  record.scans.rows[2].track = {TrackState::lost, TrackReason::poor_fit};
  record.scans.rows[3].track = {TrackState::lost, TrackReason::poor_fit};
  return record;
}

}  // namespace tilth
