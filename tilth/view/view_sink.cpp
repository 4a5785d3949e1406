#include <algorithm>
#include <exception>

#include <tilth/core/error.hpp>
#include <tilth/odometry/odometry.hpp>
#include <tilth/run/run_messages.hpp>
#include <tilth/run/run_record.hpp>
#include <tilth/view/view_sink.hpp>

namespace tilth {
namespace {

constexpr std::uint64_t kScanPoints = 5000;
constexpr std::size_t kMapPoints = 100'000;
constexpr std::size_t kPathPoses = 5000;
constexpr double kBetweenWholes = 2.0;  // [s] from one path and map to the next

}  // namespace

void ViewSink::take(const Scan& scan, const OdometryResult& result, const RunRecord& record) {
  if (!problem_.empty()) return;
  try {
    send_scan(scan, result, record);
    if (sent_whole_ && since_whole_.seconds() < kBetweenWholes) return;
    send_whole(record, result.stamp);
  } catch (const std::exception& e) {
    problem_ = e.what();
  }
}

void ViewSink::send_scan(const Scan& scan, const OdometryResult& result, const RunRecord& record) {
  const auto send = [&](RunTopic topic, const auto& message) {
    if (server_->wanted(topic)) server_->send(topic, result.stamp, message());
  };
  if (record.localization) {
    const LocalizationRow& place = record.localization->rows.back();
    send(RunTopic::diagnostics, [&] { return diagnostics_message(place); });
    if (!place.T_map_lidar) return;
  }
  const StampedPose& pose = record.trajectory.back();
  const ScanRow& row = record.scans.rows.back();
  const RunFrames frames = frames_of(record);
  send(RunTopic::tf, [&] { return tf_message(pose, frames); });
  send(RunTopic::odometry, [&] { return odometry_message(pose, row.covariance, frames); });
  if (!record.localization) send(RunTopic::diagnostics, [&] { return diagnostics_message(row); });
  if (!result.filtered.empty()) send(RunTopic::scan, [&] { return scan_message(scan, result, kScanPoints); });
}

void ViewSink::send_whole(const RunRecord& record, double stamp) {
  const bool path = server_->wanted(RunTopic::path), map = server_->wanted(RunTopic::map);
  if (!path && !map) return;
  const RunFrames frames = frames_of(record);
  if (path) server_->send(RunTopic::path, stamp, path_message(thinned(record.trajectory, kPathPoses), frames));
  if (map)
    server_->send(RunTopic::map, stamp,
                  map_message(stamp, record.map.thinned_records(kMapPoints), names_in(frames).world));
  since_whole_ = Stopwatch();
  sent_whole_ = true;
}

void ViewSink::finish(const RunRecord& record) {
  if (!problem_.empty()) throw Error("view", problem_);
  if (!record.trajectory.empty()) send_whole(record, record.trajectory.back().stamp);
}

}  // namespace tilth
