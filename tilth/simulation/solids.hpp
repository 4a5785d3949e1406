// Round solids as triangles, and which sides of any triangles are edges of a structure. Round surfaces are cut so
// finely that no point lies more than a millimetre inside the true one, up to a radius of 20 m. O(triangles log
// triangles).
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <tilth/simulation/mesh.hpp>

namespace tilth {

/// Corners (distance from the axis, height along it) [m] of half a section, from one end of the axis to the other.
using Profile = std::vector<Eigen::Vector2d>;

Profile sphere_profile(double radius);
Profile cylinder_profile(double radius, double length);  ///< closed, its middle at height 0
Profile capsule_profile(double radius, double length);   ///< a cylinder of `length` between two half spheres

/// The profile turned about the z axis, then moved by `to_world`, which may scale each axis by a factor of its own.
void add_revolved(Mesh& mesh, SurfaceId surface, const Eigen::Affine3d& to_world,
                  std::span<const Eigen::Vector2d> profile);

/// Triangles over vertices of their own, moved by `to_world`; those without an area are left out.
void add_triangles(Mesh& mesh, SurfaceId surface, const Eigen::Affine3d& to_world, const Mesh& part);

/// Marks the sides of the triangles from number `first` on that only one of them has, or where they meet at more than
/// 30 degrees. Vertices within a micrometre count as one.
void mark_edges(Mesh& mesh, std::size_t first);

}  // namespace tilth
