// The beams of a LiDAR found in the elevations of its points: peaks of a smoothed histogram at the coarsest smoothing
// whose peaks stand apart from one another. O(n) and a few passes over the histogram.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

namespace tilth {

double elevation_of(const Eigen::Vector3d& point);  ///< [rad]

/// [rad] ascending elevations of 8 to 128 beams, or none where the points do not lie on beams.
std::vector<double> find_beams(std::span<const double> elevations);

/// The beam [number] nearest to an elevation [rad], and the distance [rad] from a beam to the nearer one beside it.
std::size_t nearest_beam(std::span<const double> beams, double elevation);
double spacing_at(std::span<const double> beams, std::size_t beam);

/// The beam nearest in elevation for each point. O(n log beams). `beams` must not be empty.
std::vector<std::uint16_t> nearest_beams(std::span<const Eigen::Vector3d> points, std::span<const double> beams);

}  // namespace tilth
