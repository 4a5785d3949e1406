// A person who follows a script: at given times at given places, between them on straight lines. O(way-points) a look.
#pragma once

#include <vector>

#include <tilth/core/se3.hpp>

namespace tilth {

/// Where a person stands at a time.
struct Footing {
  double time = 0.0;                                   ///< [s] since the script began
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< [m] of the feet in the world
  double yaw = 0.0;                                    ///< [rad]
};

struct ScriptedWalker {
  std::vector<Footing> script;  ///< at least one, times ascending; one alone: stands there
  bool loop = true;             ///< begins anew after the last way-point; else stays there
  double delay = 0.0;           ///< [s] for which the person waits before each round
  double height = 1.75;         ///< [m]
};

Pose pose_at(const ScriptedWalker& walker, double time);      ///< of the feet, x forward
double walked_at(const ScriptedWalker& walker, double time);  ///< [m] since the round began

/// Holds the feet from `begin` to `end` [s].
Eigen::AlignedBox3d feet_between(const ScriptedWalker& walker, double begin, double end);

}  // namespace tilth
