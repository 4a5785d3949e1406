// What moves in a scene, as a function of time: people who walk and door leaves that swing. A ray meets them where they
// are at its own time, exactly, by closed formulas (capsules, boxes); a ray that passes far from one costs one dot
// product.
#pragma once

#include <vector>

#include <tilth/simulation/scripted_walker.hpp>
#include <tilth/simulation/world.hpp>

namespace tilth {

/// Walks to and fro along way-points.
struct Walker {
  std::vector<Eigen::Vector3d> waypoints;  ///< [m] on the floor, at least two
  double speed = 1.2;                      ///< [m/s]
  double start = 0.0;                      ///< [m] along the way at time 0
  double height = 1.75;                    ///< [m]
};

/// A leaf that swings open and shut about an upright hinge.
struct Door {
  Eigen::Vector3d hinge = Eigen::Vector3d::Zero();  ///< [m] foot of the hinge
  double closed_yaw = 0.0;                          ///< [rad] direction of the leaf when shut
  double swing = 1.5;                               ///< [rad] from shut to open
  double width = 1.0, height = 2.1;                 ///< [m]
  double period = 20.0;                             ///< [s] from shut to shut
  double phase = 0.0;                               ///< [s]
};

struct Movers {
  std::vector<Walker> walkers;
  std::vector<Door> doors;
  std::vector<ScriptedWalker> scripted;
};

Pose pose_at(const Walker& walker, double time);  ///< of the feet, x forward
Pose pose_at(const Door& door, double time);      ///< of the hinge, x along the leaf

/// Brings each hit nearer whose ray meets a mover first. A mover costs one dot product for a ray that passes it far
/// off.
void cast(const Movers& movers, std::span<const Ray> rays, std::span<Hit> hits);

}  // namespace tilth
