// What a scene is made of: triangles with surfaces, put together from quads, boxes, cylinders and walls with openings.
// Sides that bound a structure are marked as edges, so that points near them can be labelled.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <tilth/core/se3.hpp>

namespace tilth {

enum class Material : std::uint8_t {
  matte,   ///< scatters: always a return from where the beam lands
  metal,   ///< mirrors part of the beam: ghosts behind it
  glass,   ///< lets most of the beam through, mirrors a part
  glossy,  ///< returns nothing where the beam grazes it
};

using SurfaceId = std::uint16_t;

struct Surface {
  std::string name;
  Material material = Material::matte;
  double reflectivity = 0.5;  ///< [0, 1] of the intensity
  bool slender = false;       ///< a pole or trunk: an edge structure as a whole
};

struct Triangle {
  std::array<std::uint32_t, 3> vertices{};
  SurfaceId surface = 0;
  std::uint8_t edges = 0;  ///< bit i: the side from vertex i to the next bounds a structure
};

/// Parts of a mesh that belong to a thing that people move: furniture, a parked car.
struct MovablePart {
  std::array<std::size_t, 2> vertices{}, triangles{};  ///< first, and one past the last
  Eigen::Vector3d foot = Eigen::Vector3d::Zero();      ///< [m] where it stands
};

struct Mesh {
  std::vector<Eigen::Vector3d> vertices;  ///< [m] in the world frame, z up
  std::vector<Triangle> triangles;
  std::vector<Surface> surfaces;
  std::vector<MovablePart> movables;
};

/// All that is added to the mesh while this lives is one movable thing.
class MovableMark {
 public:
  MovableMark(Mesh& mesh, const Eigen::Vector3d& foot)
      : mesh_(mesh), part_{{mesh.vertices.size(), 0}, {mesh.triangles.size(), 0}, foot} {}
  ~MovableMark() {
    part_.vertices[1] = mesh_.vertices.size(), part_.triangles[1] = mesh_.triangles.size();
    mesh_.movables.push_back(part_);
  }
  MovableMark(const MovableMark&) = delete;
  MovableMark& operator=(const MovableMark&) = delete;

 private:
  Mesh& mesh_;
  MovablePart part_;
};

SurfaceId add_surface(Mesh& mesh, Surface surface);

/// Which sides of a quad bound a structure: bit 0 along u at the corner, then around the quad.
inline constexpr std::uint8_t kAllSides = 0b1111;
inline constexpr std::uint8_t kNoSides = 0;

/// The parallelogram corner + a u + b v, a and b in [0, 1].
void add_quad(Mesh& mesh, SurfaceId surface, const Eigen::Vector3d& corner, const std::array<Eigen::Vector3d, 2>& sides,
              std::uint8_t edges);

/// A box of `size` [m] whose bottom centre is at the origin of T_world_box.
void add_box(Mesh& mesh, SurfaceId surface, const Pose& T_world_box, const Eigen::Vector3d& size);

/// A closed cylinder that stands on the origin of T_world_base, along its z axis.
void add_cylinder(Mesh& mesh, SurfaceId surface, const Pose& T_world_base, double radius, double height);

/// A gap in a wall. The panel lies `recess` [m] behind the wall; reveals join the two.
struct Opening {
  double at = 0.0;       ///< [m] along the wall from its start
  double width = 1.0;    ///< [m]
  double bottom = 0.0;   ///< [m] above the foot of the wall
  double top = 2.1;      ///< [m] above the foot of the wall
  double recess = 0.08;  ///< [m]
  int panel = kPassage;  ///< surface of the panel, or kPassage where one can walk through
  static constexpr int kPassage = -1;
};

/// An upright wall from `from` to `to` (on the floor), seen from its left side, with openings ascending along it.
struct Wall {
  Eigen::Vector3d from, to;  ///< [m]
  double height = 3.0;       ///< [m]
  std::vector<Opening> openings;
};
void add_wall(Mesh& mesh, SurfaceId surface, const Wall& wall);

/// A pose upright at `position`, its x axis turned by `yaw` [rad].
Pose upright(const Eigen::Vector3d& position, double yaw);

}  // namespace tilth
