// How high the ground is: the lowest level with enough points of each patch of floor, spread from the way of the sensor
// outwards; from a patch to the next it rises or falls no more than a ramp. Where no floor was seen it goes on level.
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

namespace tilth {

class GroundHeight {
 public:
  /// Of points [m] in the world, z up, over the box from `low` to `high` [m]; `way`: of the sensor.
  GroundHeight(std::span<const Eigen::Vector3f> points, std::span<const Eigen::Vector3f> way,
               const Eigen::Vector2f& low, const Eigen::Vector2f& high);

  /// [m] z of the ground at a place in the box; between patches it is interpolated.
  float at(float x, float y) const;

 private:
  static constexpr float kPatch = 0.5F;  // [m]

  std::size_t number(int column, int row) const {
    return std::size_t(row) * std::size_t(columns_) + std::size_t(column);
  }
  int column_of(float x) const;
  int row_of(float y) const;
  std::vector<float> floors(std::span<const Eigen::Vector3f> points) const;
  void spread(const std::vector<float>& floors, std::vector<int> from);

  Eigen::Vector2f low_;
  int columns_, rows_;
  std::vector<float> heights_;
};

}  // namespace tilth
