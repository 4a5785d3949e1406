// The pipeline `tilth`: patches of surface whose shape two or three beams agree on, a map of Gaussians by the way they
// face, and pose and velocity estimated together.
#pragma once

#include <optional>

#include <tilth/features/surface_patches.hpp>
#include <tilth/map/patch_map.hpp>
#include <tilth/odometry/odometry.hpp>
#include <tilth/odometry/pose_uncertainty.hpp>
#include <tilth/preprocess/ring_support.hpp>
#include <tilth/registration/continuous_time_registration.hpp>
#include <tilth/registration/vibration.hpp>

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
    "since, and the world laid where it is found");
  v("covariance_scale", o.covariance_scale, Bounds{1e-6, 1e6},
    "[-] of the poses' covariances: what residuals and surfaces do not show");
  v("max_patches", o.max_patches, Bounds{100, 1e9},
    "[patches] of a scan that are registered, evenly chosen; all of them go into the map");
  v("outliers", o.outliers, "[-] outlier removal, by the beams beside a point");
  v("patches", o.patches, "[-] patches of surface");
  v("align", o.align, "[-] registration of pose and velocity");
  v("map", o.map, "[-] local map");
}

class TilthOdometry : public Odometry {
 public:
  explicit TilthOdometry(const TilthOptions& options) : options_(options), map_(options.map) {
    motion_.vibration = first_evidence(options.align.vibration);
  }
  OdometryResult register_scan(const Scan& scan) override;
  PointCloud local_map() const override;

 private:
  ContinuousTimeAlignment align_to_map(const SurfacePatches& patches, double middle, const MotionPrior& prior) const;
  ContinuousTimeAlignment register_patches(const SurfacePatches& patches, double middle);
  Matrix6d covariance_of(const ContinuousTimeAlignment& alignment, double time);
  /// Whether the world is the LiDAR in the scan of this alignment, which is not in the map yet.
  bool is_first(const ContinuousTimeAlignment& alignment) const { return registered_ == 0 && alignment.pose.converged; }
  void insert(const SurfacePatches& patches, double middle, const ContinuousTimeAlignment& alignment);
  /// Lays the world where the first scan is in the map of now.
  void reanchor();

  struct FirstScan {
    SurfacePatches patches;
    double middle;            ///< [s] since its stamp
    MotionPrior motion = {};  ///< from the second scan back; known once that is in the map
  };

  TilthOptions options_;
  RingLayout rings_;  // of the scan
  PatchMap map_;
  MotionPrior motion_;
  double last_middle_ = 0.0;        // [s] of the last scan
  std::size_t registered_ = 0;      // scans in the map
  double begin_ = 0.0;              // [s] middle of the first scan
  std::optional<FirstScan> first_;  // until the world is settled, which until then is the map's frame
  Pose T_world_map_ = Pose::Identity();
  PoseUncertainty uncertainty_;
};

}  // namespace tilth
