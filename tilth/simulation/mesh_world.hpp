// A mesh and what moves in it, cast with Intel Embree (Wald et al., ACM TOG 2014). About 0.2 us a ray in a corridor.
#pragma once

#include <memory>

#include <tilth/simulation/movers.hpp>
#include <tilth/simulation/world.hpp>

namespace tilth {

class MeshWorld : public World {
 public:
  MeshWorld(Mesh mesh, Movers movers);
  ~MeshWorld() override;
  MeshWorld(const MeshWorld&) = delete;
  MeshWorld& operator=(const MeshWorld&) = delete;

  std::vector<Hit> cast(std::span<const Ray> rays) const override;

  /// [m] from each point to the nearest point of the mesh; what moves is not asked. O(log triangles) a point, in
  /// parallel.
  std::vector<double> distances(std::span<const Eigen::Vector3d> points) const;

  const Mesh& mesh() const { return mesh_; }
  const Movers& movers() const { return movers_; }

 private:
  struct Tree;    // Embree's scene
  struct Facet {  // a triangle's plane, and the planes through its sides at right angles to it: n . p = offset
    Eigen::Vector3d normal;
    double offset;
    std::array<Eigen::Vector3d, 3> sides;
    std::array<double, 3> side_offsets;
  };
  static Facet facet_of(const Mesh& mesh, const Triangle& triangle);
  Hit hit_of(const Ray& ray, std::uint32_t triangle) const;

  Mesh mesh_;
  Movers movers_;
  std::vector<Facet> facets_;
  std::unique_ptr<Tree> tree_;
};

}  // namespace tilth
