// Places of whole planes, and their patches as a sensor in motion sees them.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include <tilth/registration/continuous_time_registration.hpp>

namespace tilth {

constexpr double kPeriod = 0.1, kMiddle = 0.05;  // [s]
inline const Vector6d kVelocity = (Vector6d() << 0.1, -0.2, 1.0, 1.5, -0.4, 0.1).finished();
inline const Pose kTruth = exp((Vector6d() << 0.02, -0.03, 0.7, 1.0, -0.5, 0.2).finished());

inline Eigen::Matrix3d thin(const Eigen::Vector3d& normal, double along, double across) {
  return along * Eigen::Matrix3d::Identity() + (across - along) * normal * normal.transpose();
}

/// A place of whole planes, each looked up by the way it faces.
struct Place {
  struct Plane {
    Eigen::Vector3d mean, normal;
    Eigen::Matrix3d covariance;
    double variance;
    float seen_at = 0.0F;
    std::uint32_t patches = 60;
    bool planar = true;
  };
  std::vector<Plane> planes;

  void add(const Eigen::Vector3d& mean, const Eigen::Vector3d& normal) {
    planes.push_back({mean, normal, thin(normal, 1.0, 1e-4), 1e-4});
  }
  const Plane* find(const Eigen::Vector3d&, const Eigen::Vector3d& normal, bool) const {
    const auto faces_less = [&](const Plane& a, const Plane& b) { return a.normal.dot(normal) < b.normal.dot(normal); };
    return planes.empty() ? nullptr : &*std::max_element(planes.begin(), planes.end(), faces_less);
  }
};

inline Place tunnel() {
  Place place;
  for (const int axis : {1, 2}) {
    for (const double side : {-1.0, 1.0}) {
      const Eigen::Vector3d out = side * Eigen::Vector3d::Unit(axis);
      place.add((axis == 1 ? 3.0 : 1.5) * out, -out);
    }
  }
  return place;
}

inline Place room() {
  Place place = tunnel();
  place.add({6, 0, 0}, {-1, 0, 0});
  place.add({-5, 0, 0}, {1, 0, 0});
  return place;
}

/// Patches of the planes, at random up to 5 m from their means, each as it is seen at its own time: the sensor turns
/// once in a period, and is at `T_map_middle` in the middle of it.
inline SurfacePatches seen(const Place& place, const Pose& T_map_middle, const MotionInScan& motion,
                           std::size_t count) {
  std::mt19937 rng(5);
  std::uniform_real_distribution<double> u(-5, 5);
  SurfacePatches patches;
  while (patches.size() < count) {
    const Place::Plane& plane = place.planes[patches.size() % place.planes.size()];
    const double x = u(rng), y = u(rng), z = u(rng);
    const Eigen::Vector3d d(x, y, z), in_map = plane.mean + d - d.dot(plane.normal) * plane.normal;
    const Eigen::Vector3d roughly = T_map_middle.inverse() * in_map;
    const double time = kPeriod * (0.5 + std::atan2(roughly.y(), roughly.x()) / (2 * std::numbers::pi));
    const Pose T_map_then = T_map_middle * motion.after(double(float(time)) - kMiddle);
    const Eigen::Vector3d normal = T_map_then.linear().transpose() * plane.normal;
    patches.push_back({.mean = T_map_then.inverse() * in_map,
                       .covariance = thin(normal, 1e-2, 1e-5),
                       .normal = normal,
                       .time = float(time),
                       .thickness = 1e-5f,
                       .flat = true});
  }
  return patches;
}

inline SurfacePatches seen(const Place& place, const Pose& T_map_middle, const Vector6d& velocity, std::size_t count) {
  return seen(place, T_map_middle, MotionInScan{velocity}, count);
}

inline const ContinuousTimeOptions kOptions{.max_distance = 100};

/// The prior of a sensor that has moved with `velocity` for a period, `surprise` from what was expected.
inline MotionPrior prior_of(const Vector6d& velocity, const Vector6d& surprise) {
  return {.T_map_last = kTruth * exp(-velocity * kPeriod),
          .velocity = velocity + surprise,
          .last_motion = velocity,
          .steady_velocity = velocity + surprise,
          .interval = kPeriod,
          .known = true};
}

inline const Vector6d kSurprise = (Vector6d() << 0.1, 0.1, -0.3, 0.4, 0.3, -0.2).finished();

inline double pose_error(const ContinuousTimeAlignment& alignment) {
  return log(kTruth.inverse() * alignment.pose.T_target_source).norm();
}

}  // namespace tilth
