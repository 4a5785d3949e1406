// Points of a mesh: the one nearest to a place, and some spread evenly over its surface.
#pragma once

#include <vector>

#include <tilth/simulation/mesh.hpp>

namespace tilth {

/// The point of a triangle of `mesh` that is nearest to `p` [m]: on its face where `p` lies above it, else on a side.
Eigen::Vector3d closest_point(const Mesh& mesh, const Triangle& triangle, const Eigen::Vector3d& p);

/// Points of the surface, one for every `spacing`^2 [m^2] of it, whatever the size of its triangles. The same for the
/// same mesh. O(points + triangles).
std::vector<Eigen::Vector3d> sampled_surface(const Mesh& mesh, double spacing);

}  // namespace tilth
