// The constant errors of a spinning LiDAR's beams, and the one place where they are taken out of a measured point
// (docs/beams.md). Errors are what is measured minus what is true:
//   range      r_m  = (1 + range_scale) r + range[k] + walk q,   q = 1 - min(intensity / bright, 1)
//   elevation  el_m = el + elevation[k]
//   azimuth    az_m = az + azimuth[k] + h(az_m) . encoder,       h(a) = (cos a, sin a, cos 2a, sin 2a)
// of beam (ring) k. Seen from the sensor's own frame, which spins about its z axis.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include <tilth/core/point_cloud.hpp>
#include <tilth/core/scan.hpp>

namespace tilth {

struct BeamModel {
  std::vector<double> range;                          ///< [m] of each ring; empty: none
  std::vector<double> elevation;                      ///< [rad] of each ring; empty: none
  std::vector<double> azimuth;                        ///< [rad] of each ring; empty: none
  Eigen::Vector4d encoder = Eigen::Vector4d::Zero();  ///< [rad] of cos a, sin a, cos 2a, sin 2a
  double range_scale = 0.0;                           ///< [-] of all ranges
  double walk = 0.0;                                  ///< [m] by which the darkest returns read long
  double bright = 255.0;                              ///< intensity from which on a return does not walk

  std::size_t beams() const;  ///< of the longest list
  bool ideal() const;         ///< nothing to correct
};

/// How dim a return is: 0 from `bright` on, 1 the darkest.
double dimness(double intensity, double bright);

/// (cos a, sin a, cos 2a, sin 2a) of the azimuth of a point [-]; zero on the axis.
Eigen::Vector4d encoder_harmonics(const Eigen::Vector3d& point);

/// Where the beam of `ring` that reports the direction `measured` (a unit vector) points.
Eigen::Vector3d true_direction(const BeamModel& beams, std::size_t ring, const Eigen::Vector3d& measured);

/// [m] what the beam of `ring` reports of a return at `range`.
double reported_range(const BeamModel& beams, std::size_t ring, double range, double intensity);

/// [m] the range that the beam of `ring` reports as `reported`, of a return of that dimness.
double true_range(const BeamModel& beams, std::size_t ring, double reported, double dim);

/// The cloud as ideal beams would have measured it. Intensities count where the cloud has them, else every return is
/// taken for bright. Throws Error where the cloud has no rings, or one beyond those of a list. O(points).
PointCloud corrected(const PointCloud& cloud, const BeamModel& beams);

/// The same of a scan, whose cloud may be in another frame than the sensor's own.
Scan corrected(const Scan& scan, const BeamModel& beams);

}  // namespace tilth
