// What stands in the open: trees, lamps, flower beds, benches, paving, facades, parked cars.
#pragma once

#include <tilth/simulation/counter_random.hpp>
#include <tilth/simulation/mesh.hpp>

namespace tilth {

void add_tree(Mesh& mesh, const Eigen::Vector3d& foot, CounterRandom& random);
void add_lamp_post(Mesh& mesh, const Eigen::Vector3d& foot, double height);
void add_flower_bed(Mesh& mesh, const Eigen::Vector3d& foot, double radius,
                    CounterRandom& random);  ///< round, 0.45 m high
void add_bench(Mesh& mesh, const Pose& T_world_foot);
void add_car(Mesh& mesh, const Pose& T_world_foot, CounterRandom& random);  ///< x forward, 4.4 m long

/// Slabs of `tile` [m] that lie up to 6 mm too high or too low, over a bed of sand.
void add_paving(Mesh& mesh, const Eigen::AlignedBox2d& area, double tile, CounterRandom& random);

/// A front of several floors with rows of windows set back in it, seen from the left of from -> to; a door in the
/// middle.
void add_facade(Mesh& mesh, const Eigen::Vector3d& from, const Eigen::Vector3d& to, int floors);

/// Broad steps that rise along x from T_world_foot (0.15 m each, 0.35 m deep).
void add_steps(Mesh& mesh, const Pose& T_world_foot, double width, int count);

}  // namespace tilth
