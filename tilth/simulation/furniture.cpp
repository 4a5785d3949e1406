#include <numbers>

#include <tilth/simulation/furniture.hpp>

namespace tilth {
namespace {

using Eigen::Vector3d;

Pose at(double x, double y, double z) {
  return upright({x, y, z}, 0);
}

}  // namespace

void add_room(Mesh& mesh, const Room& room, double door_width) {
  const SurfaceId wall = add_surface(mesh, {"room wall", Material::matte, 0.7});
  const SurfaceId floor = add_surface(mesh, {"room floor", Material::matte, 0.4});
  const SurfaceId pane = add_surface(mesh, {"pane", Material::glass, 0.3});
  const Pose& T = room.T_world_entry;
  const double near = room.wall, far = room.wall + room.depth, half = room.width / 2;
  const auto corner = [&](double x, double y) -> Vector3d { return T * Vector3d(x, y, 0); };
  const Opening door{half - door_width / 2, door_width, 0, 2.1, 0, Opening::kPassage};
  const Opening window{half - 0.9, 1.8, 0.9, 2.2, 0.15, int(pane)};
  add_wall(mesh, wall, {corner(near, half), corner(near, -half), room.height, {door}});
  add_wall(mesh, wall, {corner(near, -half), corner(far, -half), room.height, {}});
  add_wall(mesh, wall, {corner(far, -half), corner(far, half), room.height, {window}});
  add_wall(mesh, wall, {corner(far, half), corner(near, half), room.height, {}});
  const Vector3d x = room.depth * T.linear().col(0), y = room.width * T.linear().col(1);
  add_quad(mesh, floor, corner(near, -half), {x, y}, kAllSides);
  add_quad(mesh, wall, corner(near, -half) + Vector3d(0, 0, room.height), {x, y}, kAllSides);
  const Vector3d sill = door_width * T.linear().col(1);
  add_quad(mesh, floor, corner(0, -door_width / 2), {near * T.linear().col(0), sill}, kNoSides);
}

void add_bed(Mesh& mesh, const Pose& T_world_foot) {
  const MovableMark mark(mesh, T_world_foot.translation());
  const SurfaceId linen = add_surface(mesh, {"bed", Material::matte, 0.8});
  const SurfaceId frame = add_surface(mesh, {"bed frame", Material::metal, 0.5});
  add_box(mesh, linen, T_world_foot * at(0, 1.05, 0.45), {0.95, 2.0, 0.2});
  add_box(mesh, frame, T_world_foot * at(0, 0.02, 0.3), {0.95, 0.04, 0.75});
  add_box(mesh, frame, T_world_foot * at(0, 2.08, 0.3), {0.95, 0.04, 0.55});
  for (const double x : {-0.42, 0.42}) {
    for (const double y : {0.1, 2.0}) add_cylinder(mesh, frame, T_world_foot * at(x, y, 0), 0.03, 0.45);
  }
}

void add_cabinet(Mesh& mesh, const Pose& T_world_foot, const Vector3d& size) {
  const MovableMark mark(mesh, T_world_foot.translation());
  const SurfaceId metal = add_surface(mesh, {"cabinet", Material::metal, 0.6});
  add_box(mesh, metal, T_world_foot * at(0, size.y() / 2, 0.08), size - Vector3d(0, 0, 0.08));
  add_box(mesh, metal, T_world_foot * at(0, size.y() / 2, 0), {size.x() - 0.1, size.y() - 0.1, 0.08});
}

void add_desk(Mesh& mesh, const Pose& T_world_foot) {
  const MovableMark mark(mesh, T_world_foot.translation());
  const SurfaceId wood = add_surface(mesh, {"desk", Material::matte, 0.5});
  const SurfaceId dark = add_surface(mesh, {"screen", Material::glossy, 0.1});
  const SurfaceId cloth = add_surface(mesh, {"chair", Material::matte, 0.25});
  add_box(mesh, wood, T_world_foot * at(0, 0.4, 0.71), {1.6, 0.8, 0.03});
  for (const double x : {-0.77, 0.77}) add_box(mesh, wood, T_world_foot * at(x, 0.4, 0), {0.05, 0.7, 0.71});
  add_box(mesh, dark, T_world_foot * at(0, 0.2, 0.84), {0.6, 0.04, 0.36});
  add_box(mesh, cloth, T_world_foot * at(0.1, 1.15, 0.44), {0.48, 0.46, 0.08});
  add_box(mesh, cloth, T_world_foot * at(0.1, 1.4, 0.52), {0.46, 0.06, 0.5});
  add_cylinder(mesh, cloth, T_world_foot * at(0.1, 1.15, 0), 0.05, 0.44);
}

void add_shelf(Mesh& mesh, const Pose& T_world_foot) {
  const MovableMark mark(mesh, T_world_foot.translation());
  const SurfaceId wood = add_surface(mesh, {"shelf", Material::matte, 0.55});
  const SurfaceId book = add_surface(mesh, {"books", Material::matte, 0.35});
  for (const double x : {-0.585, 0.585}) add_box(mesh, wood, T_world_foot * at(x, 0.175, 0), {0.03, 0.35, 2.0});
  for (int i = 0; i < 5; ++i) {
    const double z = 0.08 + 0.46 * i;
    add_box(mesh, wood, T_world_foot * at(0, 0.175, z), {1.14, 0.35, 0.03});
    if (i < 4) add_box(mesh, book, T_world_foot * at(-0.2 + 0.1 * i, 0.13, z + 0.03), {0.6, 0.22, 0.28});
  }
}

}  // namespace tilth
