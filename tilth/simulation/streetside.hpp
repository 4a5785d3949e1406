// What stands beside a street: rows of houses, and at the kerb parked cars, trees and lamps. Sides are 1 for the left
// of the way and -1 for its right.
#pragma once

#include <functional>

#include <tilth/simulation/layout.hpp>
#include <tilth/simulation/mesh.hpp>

namespace tilth {

inline constexpr double kKerb = 5.0, kHouses = 9.0;  ///< [m] left and right of the middle of the street

/// Whether a disc of radius `clear` [m] about the place lies beside all streets.
using IsFree = std::function<bool(const Eigen::Vector3d& place, double clear)>;

/// A frame on the way `arc` [m] from its start, x along it.
Pose frame_at(const Path& path, double arc);

/// Houses of 9 to 16 m, now and then a gap; each stands a little further back or forward than its neighbour.
void add_houses(Mesh& mesh, const Path& path, double side, const IsFree& is_free, CounterRandom& random);

/// Cars, trees and lamps, one place every 5.2 to 9 m.
void add_kerbside(Mesh& mesh, const Path& path, double side, const IsFree& is_free, CounterRandom& random);

}  // namespace tilth
