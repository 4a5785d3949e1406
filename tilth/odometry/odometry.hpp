// What every pipeline offers: a scan in, a pose out, with its own diagnosis.
#pragma once

#include <functional>
#include <optional>
#include <string_view>

#include <tilth/core/point_cloud.hpp>
#include <tilth/core/scan.hpp>
#include <tilth/core/scan_motion.hpp>
#include <tilth/core/se3.hpp>
#include <tilth/core/track_state.hpp>
#include <tilth/registration/align_result.hpp>

namespace tilth {

/// How many points went through each stage.
struct ScanCounts {
  std::size_t points_in = 0;  ///< finite points within range
  std::size_t outliers = 0;   ///< removed by the outlier filter
  std::size_t edges = 0, planes = 0;
};

struct OdometryResult {
  double stamp = 0.0;  ///< [s] of the pose: the middle of the scan if its points have times, else its stamp
  Pose T_world_lidar = Pose::Identity();  ///< at `stamp`; world = the LiDAR at the first scan's `stamp`
  MotionInScan motion;                    ///< about `stamp`, as used for deskewing
  AlignResult alignment;                  ///< of the registration that gave the pose
  /// [rad^2, m^2] of T_world_lidar (right perturbation), drift included, where the pipeline accounts for it
  std::optional<Matrix6d> covariance = {};
  bool ambiguous = false;  ///< another motion fits as well as the one that was taken
  bool poor = false;       ///< it fits too little for the pipeline to believe that it lies here
  bool in_map = true;      ///< later scans are registered to this one as well
  bool relative = false;   ///< to a map that was begun after a loss, where the pose was thought to be
  Track track;             ///< of odometries that make_odometry() made
  ScanCounts counts;
  std::optional<Pose> T_lidar_sensor = {};  ///< where that is mounted whose rings `filtered` has, if not at its origin
  PointCloud filtered;                      ///< the scan without outliers, as measured (not deskewed)
};

/// Whether it is the first of a map that was begun after a loss: nothing tells how the robot came there.
inline bool begins_map(const OdometryResult& result) {
  return result.relative && result.alignment.converged && result.alignment.matches == 0;
}

/// Called with the name of each stage as it begins ("neighbors", "outliers", ...), so that a caller can time them.
using StageListener = std::function<void(std::string_view stage)>;

class Odometry {
 public:
  virtual ~Odometry() = default;

  /// Registers the next scan; stamps must ascend. A scan that cannot be registered keeps the predicted pose and says
  /// so in `alignment`.
  virtual OdometryResult register_scan(const Scan& scan) = 0;

  /// The points or Gaussian means that the next scan will be registered to, in the world frame.
  virtual PointCloud local_map() const = 0;

  void listen(StageListener listener) { listener_ = std::move(listener); }

 protected:
  void begin_stage(std::string_view name) const {
    if (listener_) listener_(name);
  }

 private:
  StageListener listener_;
};

}  // namespace tilth
