// The pipeline `tilth`: patches of surface whose shape two or three beams agree on, a map of Gaussians by the way they
// face, and continuous-time registration: pose, velocity and vibration estimated together. docs/method.md has every
// equation; numbers in comments are those of its equations.
#pragma once

#include <memory>

#include <tilth/features/surface_patches.hpp>
#include <tilth/map/patch_map.hpp>
#include <tilth/odometry/external_motion.hpp>
#include <tilth/odometry/motion_filter.hpp>
#include <tilth/odometry/odometry.hpp>
#include <tilth/odometry/pose_uncertainty.hpp>
#include <tilth/odometry/usual_fit.hpp>
#include <tilth/odometry/world_frame.hpp>
#include <tilth/preprocess/ring_support.hpp>
#include <tilth/registration/continuous_time_registration.hpp>

namespace tilth {

struct TilthOptions {
  double min_range = 0.5;
  double max_range = 100.0;
  double pose_at = 0.5;
  double reanchor_after = 4.0;
  double covariance_scale = 0.3;
  int max_patches = 1500;
  RingSupportOptions outliers;
  PatchOptions patches{.max_misfit = 2.0};
  ContinuousTimeOptions align;
  PatchMapOptions map{.voxel_size = 0.3};
};

template <class V>
void visit(TilthOptions& o, V&& v) {
  v("min_range", o.min_range, Bounds{0, 1e4}, "[m] nearer points are dropped");
  v("max_range", o.max_range, Bounds{0.1, 1e4}, "[m] farther points are dropped");
  v("pose_at", o.pose_at, Bounds{0, 1}, "[-] instant of the pose within the scan: 0 its first point, 1 its last one");
  v("reanchor_after", o.reanchor_after, Bounds{0, 1e9},
    "[s] the world is the LiDAR in its first scan: so long after it, that scan is registered to the map that has grown "
    "since, and the world laid where it is found",
    kAdvanced);
  v("covariance_scale", o.covariance_scale, Bounds{1e-6, 1e6},
    "[-] of the poses' covariances: what residuals and surfaces do not show", kAdvanced);
  v("max_patches", o.max_patches, Bounds{100, 1e9},
    "[patches] of a scan that are registered, evenly chosen; all of them go into the map");
  v("outliers", o.outliers, "[-] outlier removal, by the beams beside a point");
  v("patches", o.patches, "[-] patches of surface", kAdvanced);
  v("align", o.align, "[-] registration of pose and velocity");
  v("map", o.map, "[-] local map");
}

class TilthOdometry : public Odometry {
 public:
  /// `external`: motions of another source, or none.
  explicit TilthOdometry(const TilthOptions& options, std::shared_ptr<const ExternalMotion> external = {})
      : options_(options),
        map_(options.map),
        motion_(options.align.vibration),
        world_(options.reanchor_after),
        external_(std::move(external)) {}
  OdometryResult register_scan(const Scan& scan) override;
  PointCloud local_map() const override;

 private:
  /// The motion since the last scan in the map, as another source tells it.
  std::optional<Pose> told_motion(double time) const;
  MotionPrior expected(double time, const std::optional<Pose>& told) const;
  ContinuousTimeAlignment align(const ScanPatches& scan, const MotionPrior& prior);
  ContinuousTimeAlignment align_to_map(const ScanPatches& scan, const MotionPrior& prior) const;
  ContinuousTimeAlignment align_to_map(const ScanPatches& scan, const MotionPrior& prior,
                                       const MotionState& start) const;
  /// With few patches and iterations.
  ContinuousTimeAlignment try_from(const SurfacePatches& few, const MotionPrior& prior, const MotionState& start) const;
  /// From several starts, where that from the motion expected is in doubt; says whether they can be told apart.
  ContinuousTimeAlignment search(const ScanPatches& scan, const MotionPrior& prior,
                                 const ContinuousTimeAlignment& expected);
  /// The second scan tells how the sensor moved in the first one, which then is straightened anew.
  ContinuousTimeAlignment align_second(const ScanPatches& scan, MotionPrior prior);
  ContinuousTimeAlignment align_with_first(const ScanPatches& scan, MotionPrior prior);
  void straighten_first(const Vector6d& velocity);
  /// The velocity at the start that fits best, where one of many does better than `found`.
  std::optional<Vector6d> search_start(const ScanPatches& scan, MotionPrior prior,
                                       const ContinuousTimeAlignment& found);
  Matrix6d covariance_of(const ContinuousTimeAlignment& alignment, double time);
  bool enough(std::size_t matches) const { return matches >= std::size_t(options_.align.min_matches); }
  bool belongs_in_map(const ContinuousTimeAlignment& alignment, double interval) const;
  /// A new map, where the sensor is thought to be.
  void begin_anew(const Pose& T_map_lidar);
  /// What the scan leaves for those that follow.
  void insert(const ScanPatches& scan, const ContinuousTimeAlignment& alignment);
  void reanchor();

  /// [s] from the middle of the scan to the instant of its pose.
  double lever_of_pose(const ScanPatches& scan) const { return (options_.pose_at - 0.5) * scan.duration; }
  Pose pose_in_scan(const ContinuousTimeAlignment& alignment, const ScanPatches& scan) const;
  OdometryResult result_of(const ContinuousTimeAlignment& alignment, const ScanPatches& scan) const;

  TilthOptions options_;
  RingLayout rings_;  // of the scan
  PatchMap map_;
  MotionFilter motion_;
  WorldFrame world_;
  PoseUncertainty uncertainty_;
  std::shared_ptr<const ExternalMotion> external_;  // or none
  MotionTrust trust_;                               // in it
  UsualFit usual_{{.poor = 0.7, .sure = 0.88}};     // of the scans in the map; good runs: 0.84 at least
  bool ambiguous_ = false;                          // another motion of the last scan fits as well
  bool relative_ = false;                           // the map was begun after a loss
};

}  // namespace tilth
