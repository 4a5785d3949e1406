// The shell of a corridor along a way: floor, ceiling and walls with doors, frames, notice boards and open passages.
#pragma once

#include <functional>

#include <tilth/simulation/layout.hpp>
#include <tilth/simulation/mesh.hpp>

namespace tilth {

/// Sets something before the wall: T_world_foot has x along the wall, y into the corridor; `width` [m] is free along x.
using Adorns = std::function<void(Mesh& mesh, const Pose& T_world_foot, double width)>;

void add_notice_board(Mesh& mesh, const Pose& T_world_foot, double width);

/// Decides whether the wall opens into a room: given the pose of the opening's foot, x into the room, and its width
/// [m].
using Opens = std::function<bool(const Pose& T_world_entry, double width)>;

struct CorridorStyle {
  double half_width = 1.2;  ///< [m]
  double height = 3.0;      ///< [m]
  double least_gap = 1.5;   ///< [m] of plain wall between two features
  double most_gap = 5.0;    ///< [m]
  double adorned = 0.35;    ///< share of the features that are not doors
  Adorns adorn = add_notice_board;
  double recess = 0.07;  ///< [m] of the door panels behind the wall
  Material floor = Material::glossy;
  std::function<bool(double)> bare = [](double) { return false; };  ///< where along the way [m] the walls stay plain
  Opens opens = [](const Pose&, double) { return false; };
};

/// Adds the corridor about the way, a ring or open.
void add_corridor(Mesh& mesh, const Path& path, const CorridorStyle& style, CounterRandom& random);

}  // namespace tilth
