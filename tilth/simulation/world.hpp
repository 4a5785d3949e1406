// What a beam can meet. One call a scan, so that an implementation can cast its rays in packets.
#pragma once

#include <limits>
#include <span>
#include <vector>

#include <tilth/simulation/mesh.hpp>

namespace tilth {

struct Ray {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();      ///< [m] in the world frame
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();  ///< of length 1
  double time = 0.0;                                     ///< [s] at which the world is looked at
};

struct Hit {
  double distance = std::numeric_limits<double>::infinity();       ///< [m]; infinite where nothing is met
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();                ///< of length 1, towards the ray's origin
  const Surface* surface = nullptr;                                ///< nullptr where nothing is met
  double edge_distance = std::numeric_limits<double>::infinity();  ///< [m] to the nearest side that bounds a structure
  bool moving = false;                                             ///< a person or a door leaf

  bool met() const { return surface != nullptr; }
};

class World {
 public:
  virtual ~World() = default;

  /// What each ray meets first. May be called from several threads at once.
  virtual std::vector<Hit> cast(std::span<const Ray> rays) const = 0;
};

}  // namespace tilth
