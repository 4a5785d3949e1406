// What stands in rooms. A pose gives the middle of the foot: x along the width, y out of the back wall into the room.
#pragma once

#include <tilth/simulation/counter_random.hpp>
#include <tilth/simulation/mesh.hpp>

namespace tilth {

/// A room behind an entry: T_world_entry stands in the doorway with x into the room.
struct Room {
  Pose T_world_entry = Pose::Identity();
  double width = 4.2, depth = 5.0, height = 2.8;  ///< [m]; the entry lies in the middle of the width
  double wall = 0.2;                              ///< [m] of wall between entry and room
};

/// Floor, ceiling and the four walls, the one with the entry seen from inside; a window in the far wall.
void add_room(Mesh& mesh, const Room& room, double door_width);

void add_bed(Mesh& mesh, const Pose& T_world_foot);  ///< 0.95 x 2.05 m with head and foot boards
void add_cabinet(Mesh& mesh, const Pose& T_world_foot, const Eigen::Vector3d& size);  ///< of bare metal
void add_desk(Mesh& mesh, const Pose& T_world_foot);   ///< 1.6 x 0.8 m with a chair and a screen
void add_shelf(Mesh& mesh, const Pose& T_world_foot);  ///< 1.2 x 0.35 x 2 m, open, with boards and books

}  // namespace tilth
