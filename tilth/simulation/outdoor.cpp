#include <cmath>
#include <numbers>

#include <tilth/simulation/outdoor.hpp>

namespace tilth {
namespace {

using Eigen::Vector3d;

Pose at(const Vector3d& position) {
  return upright(position, 0);
}

Vector3d random_direction(CounterRandom& random) {
  return Vector3d(random.normal(), random.normal(), random.normal()).normalized();
}

/// Loose triangles strewn through an ellipsoid: most beams stop in it, some pass.
void add_foliage(Mesh& mesh, const Vector3d& center, const Vector3d& radii, int leaves, CounterRandom& random) {
  const SurfaceId surface = add_surface(mesh, {"leaves", Material::matte, 0.4});
  for (int i = 0; i < leaves; ++i) {
    const double depth = std::cbrt(random.uniform(0.3, 1.0));
    const Vector3d middle = center + depth * radii.cwiseProduct(random_direction(random));
    const Vector3d a = 0.16 * random_direction(random);
    const Vector3d b = 0.16 * a.cross(random_direction(random)).normalized();
    const std::uint32_t first = std::uint32_t(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), {middle + a, middle - 0.5 * a + b, middle - 0.5 * a - b});
    mesh.triangles.push_back({{first, first + 1, first + 2}, surface, 0});
  }
}

/// One floor of a front: windows 1.4 m wide every 2.8 m, or a door where there is room in the middle.
Wall front_floor(const Vector3d& from, const Vector3d& to, double foot, double height, const Opening& window) {
  Wall wall{from + Vector3d(0, 0, foot), to + Vector3d(0, 0, foot), height, {}};
  const double length = (to - from).norm();
  for (double s = 1.0; s + window.width < length - 0.8; s += 2.8) {
    wall.openings.push_back(window);
    wall.openings.back().at = s;
  }
  return wall;
}

}  // namespace

void add_tree(Mesh& mesh, const Vector3d& foot, CounterRandom& random) {
  const SurfaceId bark = add_surface(mesh, {"trunk", Material::matte, 0.35, true});
  const double height = random.uniform(2.0, 2.8), radius = random.uniform(0.1, 0.2), crown = random.uniform(1.3, 2.0);
  add_cylinder(mesh, bark, at(foot), radius, height + 0.5 * crown);
  const Vector3d center = foot + Vector3d(0, 0, height + 0.8 * crown);
  add_foliage(mesh, center, {crown, crown, 0.85 * crown}, int(260 * crown * crown), random);
}

void add_lamp_post(Mesh& mesh, const Vector3d& foot, double height) {
  const SurfaceId pole = add_surface(mesh, {"pole", Material::matte, 0.4, true});
  add_cylinder(mesh, pole, at(foot), 0.06, height);
  add_cylinder(mesh, pole, at(foot), 0.11, 0.4);
  add_box(mesh, pole, at(foot + Vector3d(0.25, 0, height)), {0.7, 0.25, 0.12});
}

void add_flower_bed(Mesh& mesh, const Vector3d& foot, double radius, CounterRandom& random) {
  const MovableMark mark(mesh, foot);
  const SurfaceId stone = add_surface(mesh, {"flower bed", Material::matte, 0.6});
  add_cylinder(mesh, stone, at(foot), radius, 0.45);
  add_foliage(mesh, foot + Vector3d(0, 0, 0.6), {0.85 * radius, 0.85 * radius, 0.4}, int(160 * radius * radius),
              random);
}

void add_bench(Mesh& mesh, const Pose& T_world_foot) {
  const MovableMark mark(mesh, T_world_foot.translation());
  const SurfaceId wood = add_surface(mesh, {"bench", Material::matte, 0.5});
  add_box(mesh, wood, T_world_foot * at({0, 0, 0.42}), {1.8, 0.45, 0.06});
  add_box(mesh, wood, T_world_foot * at({0, 0.22, 0.55}), {1.8, 0.05, 0.35});
  for (const double x : {-0.75, 0.75}) add_box(mesh, wood, T_world_foot * at({x, 0, 0}), {0.08, 0.4, 0.42});
}

void add_car(Mesh& mesh, const Pose& T_world_foot, CounterRandom& random) {
  const MovableMark mark(mesh, T_world_foot.translation());
  const SurfaceId paint = add_surface(mesh, {"car body", Material::matte, random.uniform(0.15, 0.8)});
  const SurfaceId glass = add_surface(mesh, {"car window", Material::glass, 0.2});
  const SurfaceId tyre = add_surface(mesh, {"tyre", Material::matte, 0.1});
  const double height = random.uniform(1.4, 1.75), length = random.uniform(4.0, 4.7);
  add_box(mesh, paint, T_world_foot * at({0, 0, 0.3}), {length, 1.75, 0.62});
  add_box(mesh, glass, T_world_foot * at({-0.25, 0, 0.92}), {0.5 * length, 1.5, height - 0.98});
  add_box(mesh, paint, T_world_foot * at({-0.25, 0, height - 0.06}), {0.45 * length, 1.4, 0.06});
  add_box(mesh, paint, T_world_foot * at({-0.25, 0, 0.92}), {0.48 * length, 1.3, height - 1.0});
  Pose sideways = Pose::Identity();
  sideways.linear() = Eigen::AngleAxisd(-std::numbers::pi / 2, Vector3d::UnitX()).toRotationMatrix();
  for (const double x : {-0.3 * length, 0.3 * length}) {
    for (const double y : {-0.88, 0.66}) {
      add_cylinder(mesh, tyre, T_world_foot * at({x, y, 0.32}) * sideways, 0.32, 0.22);
    }
  }
}

void add_paving(Mesh& mesh, const Eigen::AlignedBox2d& area, double tile, CounterRandom& random) {
  const SurfaceId sand = add_surface(mesh, {"sand bed", Material::matte, 0.4});
  const SurfaceId stone = add_surface(mesh, {"paving", Material::matte, 0.45});
  const Eigen::Vector2d size = area.sizes();
  add_quad(mesh, sand, {area.min().x(), area.min().y(), -0.02},
           {size.x() * Vector3d::UnitX(), size.y() * Vector3d::UnitY()}, kNoSides);
  for (double x = area.min().x(); x + tile <= area.max().x(); x += tile) {
    for (double y = area.min().y(); y + tile <= area.max().y(); y += tile) {
      add_quad(mesh, stone, {x, y, random.uniform(-0.006, 0.006)}, {tile * Vector3d::UnitX(), tile * Vector3d::UnitY()},
               kNoSides);
    }
  }
}

void add_facade(Mesh& mesh, const Vector3d& from, const Vector3d& to, int floors) {
  const double floor_height = 3.4;
  const SurfaceId plaster = add_surface(mesh, {"facade", Material::matte, 0.65});
  const SurfaceId blind = add_surface(mesh, {"window", Material::matte, 0.25});
  const Opening low{0, 1.4, 0.9, 2.5, 0.18, int(blind)}, tall{0, 1.4, 0.0, 2.6, 0.25, int(blind)};
  add_wall(mesh, plaster, front_floor(from, to, 0, floor_height, tall));
  for (int floor = 1; floor < floors; ++floor) {
    add_wall(mesh, plaster, front_floor(from, to, floor * floor_height, floor_height, low));
  }
}

void add_steps(Mesh& mesh, const Pose& T_world_foot, double width, int count) {
  const SurfaceId stone = add_surface(mesh, {"step", Material::matte, 0.55});
  const double rise = 0.15, tread = 0.35, landing = 1.5;
  for (int i = 0; i < count; ++i) {
    const double depth = (count - i) * tread + landing;
    add_box(mesh, stone, T_world_foot * at({i * tread + depth / 2, 0, i * rise}), {depth, width, rise});
  }
}

}  // namespace tilth
