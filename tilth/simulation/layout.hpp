// From a way to what stands about it: the corners a drive takes, outlines at a distance from it, walkers beside it.
#pragma once

#include <vector>

#include <tilth/simulation/counter_random.hpp>
#include <tilth/simulation/motion.hpp>
#include <tilth/simulation/movers.hpp>
#include <tilth/simulation/scenes.hpp>

namespace tilth {

using Path = std::vector<Eigen::Vector3d>;  ///< corners on the floor, z = 0 [m]; a ring ends where it begins

/// Start, the corner that each turning leg cuts, and end of a drive that starts at the origin along +x.
Path path_of(std::span<const Leg> legs);

/// The way moved `left` [m] to its left (negative: right), mitred at the corners.
Path offset(const Path& path, double left);

/// The way with `more` [m] added at both ends.
Path lengthened(Path path, double more);

double length_of(const Path& path);                                  ///< [m]
double arc_of(const Path& path, const Eigen::Vector3d& point);       ///< [m] along it of its point nearest to `point`
double distance_to(const Path& path, const Eigen::Vector3d& point);  ///< [m] in the plane

/// The way that a trajectory took, a corner every 0.25 m, on the floor.
Path footprint(const Trajectory& trajectory);

/// Closed outlines of all that lies within `half_width` of the way, that ground on their left; each first corner comes
/// once. One outline, two of a ring.
std::vector<Path> outlines(const Path& path, double half_width);

/// Speed, vibration and seed of a scene.
MotionOptions motion_of(const SceneOptions& options);

/// The first `duration` [s] of poses at 200 Hz; all of them where it is 0.
Trajectory cut(Trajectory trajectory, double duration);

/// The sensor's drive along `legs` with the scene's speed, wobble and vibration, cut at the scene's duration.
Trajectory travel(std::span<const Leg> legs, const SceneOptions& options);

/// What tells where people walk: the rest of the scene's own numbers, or the seed's where the world has its own.
CounterRandom random_of_people(const CounterRandom& of_scene, const SceneOptions& options);

/// People who walk to and fro `beside` [m] the way, alternately on its left and its right.
std::vector<Walker> walkers_beside(const Path& path, int count, double beside, CounterRandom& random);

/// The walkers set off so that none comes within 0.6 m of the sensor; who cannot is left out.
std::vector<Walker> kept_clear(std::vector<Walker> walkers, const Trajectory& trajectory);

}  // namespace tilth
