#include "registrar.hpp"

#include <tilth/core/error.hpp>
#include <tilth/run/saved_map_sink.hpp>
#include <tilth/run/scan_row.hpp>

namespace tilth::python {

ScanResult Registrar::register_scan(const Scan& scan) {
  const auto alone = lock();
  if (last_stamp_ && scan.stamp <= *last_stamp_)
    throw Error("stamp", "is " + std::to_string(scan.stamp) + " s, expected one after the last scan's, " +
                             std::to_string(*last_stamp_) + " s");
  last_stamp_ = scan.stamp;
  OdometryResult result = odometry_->register_scan(scan);
  keep(scan, result);
  return {std::move(result), scan.stamp};
}

PointCloud Registrar::local_map() const {
  const auto alone = lock();
  return odometry_->local_map();
}

std::unique_lock<std::mutex> Registrar::lock() const {
  std::unique_lock<std::mutex> lock(busy_, std::try_to_lock);
  if (!lock) throw Error("this odometry", "is at work in another thread: each thread needs one of its own");
  return lock;
}

SlamRegistrar::SlamRegistrar(Pipeline pipeline, const MapOptions& map)
    : Registrar(std::move(pipeline.odometry)), slam_(pipeline.slam) {
  record_.version = TILTH_VERSION;
  record_.source = "Python";
  record_.map = MapBuilder(map);
}

void SlamRegistrar::keep(const Scan& scan, const OdometryResult& result) {
  closed_.reset();
  record_.map.add(result, scan.stamp);
  record_.trajectory.push_back({result.stamp, result.T_world_lidar});
  record_.scans.rows.push_back(row_of(scan, result));
}

void SlamRegistrar::save_places(const std::string& folder) {
  const std::shared_ptr<const RunRecord> record = closed();
  const auto alone = lock();
  saved_map_sink({folder, {}, {}, {}}, *slam_)->finish(*record);
}

std::shared_ptr<const RunRecord> SlamRegistrar::closed() {
  const auto alone = lock();
  if (!closed_) {
    auto record = std::make_shared<RunRecord>(record_);
    close_loops(*slam_, *record);
    closed_ = std::move(record);
  }
  return closed_;
}

}  // namespace tilth::python
