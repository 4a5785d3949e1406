// How long a turn takes, told by how far apart a beam's points lie: spinning LiDARs fire at a rate of their own,
// whatever they turn at. Velodyne 46 to 55 us, Hesai, RoboSense and Leishen 48 to 56 us after their manuals; Ouster
// divides every turn, at 10 or 20 Hz, into 512, 1024 or 2048.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include <Eigen/Core>

namespace tilth {

/// [rad] azimuth from one point of a beam to its next, usually; nothing where `rings` (one entry a point) does not
/// tell. O(n).
std::optional<double> column_step(std::span<const Eigen::Vector3d> points, std::span<const std::uint16_t> rings);

/// A sensor that turns once in `period` [s] would fire `step` [rad] apart as known ones do.
bool fires_as_known(double period, double step);

struct LeftOutTurns {
  double period = 0.0;    ///< [s] of one turn
  std::size_t turns = 0;  ///< left out between scans
};

/// Of a sensor that fires so where it turns at a usual rate (10, 20, 5 Hz) and some turns were not recorded: scans
/// follow one another every `scan_step` [s], and the head goes on by `turned` [turns] from one to the next, or by whole
/// turns more.
std::optional<LeftOutTurns> turns_left_out(double scan_step, double turned, double column_step);

}  // namespace tilth
