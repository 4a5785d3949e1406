#include <algorithm>
#include <cmath>

#include <tilth/simulation/rooms_beside.hpp>

namespace tilth {
namespace {

constexpr double kBetween = 0.1;  // [m] of ground kept between two rooms and before another corridor

bool within(const Room& room, const Eigen::Vector3d& point) {
  const Eigen::Vector3d p = room.T_world_entry.inverse(Eigen::Isometry) * point;
  return p.x() > room.wall - kBetween && p.x() < room.wall + room.depth + kBetween &&
         std::abs(p.y()) < room.width / 2 + kBetween;
}

/// Points all over a room's ground, 0.25 m apart at most.
Path grid_of(const Room& room) {
  Path points;
  const int nx = int(std::ceil(room.depth / 0.25)), ny = int(std::ceil(room.width / 0.25));
  for (int i = 0; i <= nx; ++i) {
    for (int j = 0; j <= ny; ++j) {
      const double x = room.wall + room.depth * i / nx, y = room.width * (double(j) / ny - 0.5);
      points.push_back(room.T_world_entry * Eigen::Vector3d(x, y, 0));
    }
  }
  return points;
}

}  // namespace

bool RoomsBeside::free(const Room& room) const {
  const Path points = grid_of(room);
  return std::none_of(points.begin(), points.end(), [&](const Eigen::Vector3d& point) {
    return distance_to(path_, point) < half_width_ + kBetween ||
           std::any_of(taken_.begin(), taken_.end(), [&](const Taken& t) { return within(t.room, point); });
  });
}

bool RoomsBeside::take(const Room& wanted, double door_width) {
  if (!free(wanted)) return false;
  taken_.push_back({wanted, door_width});
  return true;
}

}  // namespace tilth
