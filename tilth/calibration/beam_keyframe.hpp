// What calibration keeps of a scan: some of its returns as they were measured, where the sensor was, and how it moved.
#pragma once

#include <cstdint>
#include <vector>

#include <tilth/core/point_cloud.hpp>
#include <tilth/core/scan_motion.hpp>
#include <tilth/core/se3.hpp>

namespace tilth {

/// The mean of a few successive returns of one beam, of one surface as far as their ranges tell.
struct BeamReturn {
  Eigen::Vector3f point;  ///< [m] in the sensor's frame, as measured
  float time;             ///< [s] since the stamp of the scan
  float intensity;        ///< as the sensor gives it
  std::uint16_t ring;
  std::uint16_t count = 1;  ///< returns
};

struct BeamKeyframe {
  Pose T_map_lidar = Pose::Identity();  ///< at `reference_time`
  double reference_time = 0.0;          ///< [s] since the stamp of the scan
  MotionInScan motion;                  ///< about that time
  std::vector<BeamReturn> returns;
};

/// Which returns are kept.
struct ReturnChoice {
  double min_range = 0.8, max_range = 60.0;  ///< [m]
  std::size_t most;                          ///< means of returns: of every ring the same share, evenly
};

/// The returns of a cloud with rings; those without intensities count as bright.
std::vector<BeamReturn> choose_returns(const PointCloud& cloud, const ReturnChoice& choice);

}  // namespace tilth
