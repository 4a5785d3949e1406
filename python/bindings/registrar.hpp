// A pipeline that Python feeds scan by scan: one thread at a time, stamps that ascend.
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "result.hpp"
#include <tilth/core/scan.hpp>
#include <tilth/odometry/odometry.hpp>
#include <tilth/run/pipeline.hpp>

namespace tilth::python {

class Registrar {
 public:
  explicit Registrar(std::unique_ptr<Odometry> odometry) : odometry_(std::move(odometry)) {}
  virtual ~Registrar() = default;

  /// Throws Error where the stamp is not after the last one, and where another thread is at work here.
  ScanResult register_scan(const Scan& scan);

  /// The points that the next scan will be registered to, in the world frame. Throws Error likewise.
  PointCloud local_map() const;

 protected:
  /// Throws Error where another thread is at work here.
  std::unique_lock<std::mutex> lock() const;

 private:
  virtual void keep(const Scan&, const OdometryResult&) {}

  std::unique_ptr<Odometry> odometry_;
  mutable std::mutex busy_;
  std::optional<double> last_stamp_;
};

/// The same with loops closed, and with the map of all that was seen.
class SlamRegistrar final : public Registrar {
 public:
  SlamRegistrar(Pipeline pipeline, const MapOptions& map);

  /// Writes the folder that a Localizer opens. Throws Error where it cannot be written, and where the track was lost
  /// and what came after is joined to nothing.
  void save_places(const std::string& folder);

  /// Trajectory, map and loops after an optimisation with all closures so far; made anew after further scans.
  std::shared_ptr<const RunRecord> closed();

 private:
  void keep(const Scan& scan, const OdometryResult& result) override;

  Slam* slam_;                               // of the pipeline
  RunRecord record_;                         // by odometry alone
  std::shared_ptr<const RunRecord> closed_;  // of all scans so far; null: not made yet
};

}  // namespace tilth::python
