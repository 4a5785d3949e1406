// Scans of a list as a source, and a pipeline that knows the answer: what a session is tried with.
#pragma once

#include <utility>
#include <vector>

#include <tilth/core/error.hpp>
#include <tilth/odometry/odometry.hpp>
#include <tilth/sources/scan_source.hpp>

namespace tilth {

class ScanList : public ScanSource {
 public:
  explicit ScanList(std::vector<Scan> scans = {}) : scans_(std::move(scans)) { decisions_ = {"times are made up"}; }

  std::optional<Scan> next() override {
    if (next_ == breaks_off_at) throw Error("list", "is torn");
    if (next_ == skips_at && skipped_.empty()) skipped_.push_back({next_, "record 7", "is no scan"});
    if (next_ == scans_.size()) return std::nullopt;
    return scans_[next_++];
  }
  std::optional<std::size_t> size() const override { return scans_.size(); }
  std::vector<std::string> notices() const override { return {"a packet was lost"}; }

  std::size_t breaks_off_at = std::size_t(-1), skips_at = std::size_t(-1);

 private:
  std::vector<Scan> scans_;
  std::size_t next_ = 0;
};

/// One metre a scan along x; refuses a scan without points.
class MetreAScan : public Odometry {
 public:
  OdometryResult register_scan(const Scan& scan) override {
    begin_stage("step");
    if (scan.cloud.empty()) throw Error("scan", "has no points");
    OdometryResult result;
    result.stamp = scan.stamp;
    result.T_world_lidar = Eigen::Translation3d(x_++, 0, 0);
    result.filtered = scan.cloud;
    return result;
  }
  PointCloud local_map() const override { return {}; }

 private:
  double x_ = 0.0;
};

/// `count` scans of one point, 0.1 s apart.
inline std::vector<Scan> small_scans(std::size_t count) {
  std::vector<Scan> scans(count);
  for (std::size_t i = 0; i < count; ++i) {
    scans[i].stamp = 0.1 * double(i);
    scans[i].cloud.points = {{0, 5, 0}};
    scans[i].cloud.intensities = {1};
  }
  return scans;
}

}  // namespace tilth
