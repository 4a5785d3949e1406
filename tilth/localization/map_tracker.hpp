// Where the LiDAR is in a map, by odometry and by registrations to the map, each weighed by what it is worth: a filter
// over the pose (right perturbation in the LiDAR's frame). O(1) a scan.
#pragma once

#include <tilth/core/options.hpp>
#include <tilth/core/se3.hpp>
#include <tilth/slam/submap_information.hpp>

namespace tilth {

struct MapTrackerOptions {
  double noise = 0.01;
  double turn_noise = 0.1;
  double covariance_scale = 10.0;
  double max_squared_error = 25.0;
};

template <class V>
void visit(MapTrackerOptions& o, V&& v) {
  v("noise", o.noise, Bounds{1e-6, 10}, "[m per root metre] random walk of odometry");
  v("turn_noise", o.turn_noise, Bounds{1e-6, 90}, "[deg per root metre] the same of the rotation");
  v("covariance_scale", o.covariance_scale, Bounds{0, 1e6},
    "[-] by which the covariances of odometry's registrations are enlarged and added to it");
  v("max_squared_error", o.max_squared_error, Bounds{0, 1e9},
    "[sigma^2] by which a registration to the map may differ from what is expected and be heard");
}

class MapTracker {
 public:
  MapTracker(const MapTrackerOptions& options, const Pose& T_map_lidar, const Matrix6d& covariance)
      : options_(options), T_map_lidar_(T_map_lidar), covariance_(covariance) {}

  /// Moves on by odometry: `T_last_now`, whose registrations had `covariance` in all.
  void move(const Pose& T_last_now, const Matrix6d& covariance);

  /// Takes a registration to the map; false where it contradicts what is known, and is not heard.
  bool correct(const Pose& T_map_lidar, const Matrix6d& information);

  const Pose& T_map_lidar() const { return T_map_lidar_; }
  const Matrix6d& covariance() const { return covariance_; }  ///< [rad^2, m^2] right perturbation

 private:
  MapTrackerOptions options_;
  Pose T_map_lidar_;
  Matrix6d covariance_;
};

}  // namespace tilth
