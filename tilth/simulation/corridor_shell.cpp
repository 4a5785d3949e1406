#include <cmath>
#include <numbers>

#include <tilth/simulation/corridor_shell.hpp>

namespace tilth {
namespace {

using Eigen::Vector3d;

constexpr double kCornerClear = 0.8;                       // [m] without features at both ends of a wall
constexpr double kPassageDepth = 0.2;                      // [m] of a wall one walks through
constexpr double kFrameWidth = 0.07, kFrameDepth = 0.025;  // [m]

struct Look {
  SurfaceId wall, floor, ceiling, door, frame;
};

Look look_of(Mesh& mesh, const CorridorStyle& style) {
  return {add_surface(mesh, {"wall", Material::matte, 0.7}), add_surface(mesh, {"floor", style.floor, 0.35}),
          add_surface(mesh, {"ceiling", Material::matte, 0.8}), add_surface(mesh, {"door", Material::matte, 0.45}),
          add_surface(mesh, {"frame", Material::matte, 0.3})};
}

/// A wall of the outline, its frame and what is decided along it.
struct WallSite {
  Vector3d from, to;
  double yaw;        // [rad] of its direction
  const Path& path;  // of the corridor

  double length() const { return (to - from).norm(); }
  Vector3d at(double s) const { return from + s / length() * (to - from); }
  double arc(double s) const { return arc_of(path, at(s)); }  // [m] along the way
};

/// The floor (or ceiling) of each straight part; parts overlap in the corners.
void add_slabs(Mesh& mesh, SurfaceId surface, const Path& path, double half_width, double z) {
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Path part = lengthened({path[i - 1], path[i]}, half_width);
    const Vector3d along = part[1] - part[0], across = 2 * half_width * Vector3d::UnitZ().cross(along).normalized();
    add_quad(mesh, surface, part[0] - 0.5 * across + Vector3d(0, 0, z), {along, across}, kNoSides);
  }
}

void add_frame(Mesh& mesh, SurfaceId surface, const WallSite& site, const Opening& door) {
  const auto bar = [&](double s, double z, double width, double height) {
    const Vector3d inward = kFrameDepth / 2 * upright(Vector3d::Zero(), site.yaw).linear().col(1);
    add_box(mesh, surface, upright(site.at(s) + inward + Vector3d(0, 0, z), site.yaw), {width, kFrameDepth, height});
  };
  bar(door.at - kFrameWidth / 2, 0, kFrameWidth, door.top + kFrameWidth);
  bar(door.at + door.width + kFrameWidth / 2, 0, kFrameWidth, door.top + kFrameWidth);
  bar(door.at + door.width / 2, door.top, door.width, kFrameWidth);
}

/// Walks along one wall and sets doors, passages and boards into it.
void add_corridor_wall(Mesh& mesh, const Look& look, const CorridorStyle& style, const WallSite& site,
                       CounterRandom& random) {
  Wall wall{site.from, site.to, style.height, {}};
  double s = kCornerClear + random.uniform(0, style.most_gap - style.least_gap);
  while (s < site.length() - kCornerClear - 1.7) {
    const bool adorned = random.chance(style.adorned);
    const double width = adorned ? random.uniform(0.9, 1.6) : random.uniform(0.9, 1.1);
    const double gap = random.uniform(style.least_gap, style.most_gap);
    if (!style.bare(site.arc(s)) && !style.bare(site.arc(s + width))) {
      const Pose entry = upright(site.at(s + width / 2), site.yaw - std::numbers::pi / 2);
      if (adorned) {
        style.adorn(mesh, upright(site.at(s + width / 2), site.yaw), width);
      } else {
        const bool open = style.opens(entry, width);
        wall.openings.push_back(
            {s, width, 0, 2.1, open ? kPassageDepth : style.recess, open ? Opening::kPassage : int(look.door)});
        add_frame(mesh, look.frame, site, wall.openings.back());
      }
    }
    s += width + gap;
  }
  add_wall(mesh, look.wall, wall);
}

}  // namespace

void add_notice_board(Mesh& mesh, const Pose& T_world_foot, double width) {
  const MovableMark mark(mesh, T_world_foot.translation());
  const double thickness = 0.035;
  const SurfaceId board = add_surface(mesh, {"notice board", Material::matte, 0.6});
  add_box(mesh, board, T_world_foot * upright({0, thickness / 2, 0.95}, 0), {width, thickness, 1.0});
}

void add_corridor(Mesh& mesh, const Path& path, const CorridorStyle& style, CounterRandom& random) {
  const Look look = look_of(mesh, style);
  add_slabs(mesh, look.floor, path, style.half_width, 0);
  add_slabs(mesh, look.ceiling, path, style.half_width, style.height);
  for (const Path& corners : outlines(path, style.half_width)) {
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Vector3d from = corners[i], to = corners[(i + 1) % corners.size()];
      const WallSite site{from, to, std::atan2(to.y() - from.y(), to.x() - from.x()), path};
      add_corridor_wall(mesh, look, style, site, random);
    }
  }
}

}  // namespace tilth
