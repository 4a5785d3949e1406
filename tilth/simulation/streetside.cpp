#include <cmath>
#include <numbers>

#include <tilth/simulation/outdoor.hpp>
#include <tilth/simulation/streetside.hpp>

namespace tilth {

using Eigen::Vector3d;

Pose frame_at(const Path& path, double arc) {
  for (std::size_t i = 1;; ++i) {
    const Vector3d side = path[i] - path[i - 1];
    if (arc <= side.norm() || i + 1 == path.size()) {
      return upright(path[i - 1] + arc * side.normalized(), std::atan2(side.y(), side.x()));
    }
    arc -= side.norm();
  }
}

void add_houses(Mesh& mesh, const Path& path, double side, const IsFree& is_free, CounterRandom& random) {
  for (double arc = -10; arc < length_of(path) + 10;) {
    const double width = random.uniform(9, 16), back = random.uniform(0, 1.8), depth = 9;
    const double middle = arc + width / 2;
    const Pose T = frame_at(path, std::max(middle, 0.0)) *
                   upright({std::min(middle, 0.0), side * (kHouses + back), 0}, side > 0 ? std::numbers::pi : 0.0);
    const int floors = 2 + int(random.uniform(0, 3));
    arc += width + (random.chance(0.25) ? random.uniform(3, 7) : 0.0);
    const auto corner = [&](double x, double y) -> Vector3d { return T * Vector3d(x, y, 0); };
    const Vector3d a = corner(width / 2, 0), b = corner(-width / 2, 0);
    if (!is_free(a, kHouses - 1.5) || !is_free(b, kHouses - 1.5) || !is_free(corner(0, -depth), kHouses)) continue;
    const Vector3d c = corner(-width / 2, -depth), d = corner(width / 2, -depth);
    add_facade(mesh, a, b, floors);
    const SurfaceId gable = add_surface(mesh, {"gable", Material::matte, 0.5});
    for (const auto& [from, to] : {std::pair{b, c}, std::pair{c, d}, std::pair{d, a}}) {
      add_wall(mesh, gable, {from, to, 3.4 * floors, {}});
    }
  }
}

void add_kerbside(Mesh& mesh, const Path& path, double side, const IsFree& is_free, CounterRandom& random) {
  for (double arc = 3; arc < length_of(path) - 3; arc += random.uniform(5.2, 9.0)) {
    const Pose T = frame_at(path, arc);
    const auto beside = [&](double y) -> Vector3d { return T * Vector3d(0, side * y, 0); };
    if (random.chance(0.5) && is_free(beside(3.9), 3.6)) {
      add_car(mesh, T * upright({0, side * 3.9, 0}, random.chance(0.5) ? 0 : std::numbers::pi), random);
    }
    const double choice = random.uniform();
    if (!is_free(beside(5.7), 5.2)) continue;
    if (choice < 0.3)
      add_tree(mesh, beside(5.7), random);
    else if (choice < 0.5)
      add_lamp_post(mesh, beside(5.4), 6.0);
  }
}

}  // namespace tilth
