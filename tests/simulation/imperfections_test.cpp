// Every imperfection by its rate: none at 0, and else as many points as the rate says, in a room where each beam's fate
// can be worked out.
#include <cmath>
#include <map>

#include <gtest/gtest.h>

#include <tilth/simulation/mesh_world.hpp>
#include <tilth/simulation/simulate_scan.hpp>

namespace tilth {
namespace {

/// A closed room of 80 x 50 x 3 m about the sensor; its floor and walls are of `material`, its ceiling is matte.
MeshWorld room_of(Material material) {
  Mesh mesh;
  const SurfaceId made = add_surface(mesh, {"made", material, 0.6}), ceiling = add_surface(mesh, {"ceiling"});
  const Eigen::Vector3d corner(-40, -25, -1), x(80, 0, 0), y(0, 50, 0), z(0, 0, 3);
  add_quad(mesh, made, corner, {x, y}, kNoSides);
  add_quad(mesh, made, corner, {x, z}, kNoSides);
  add_quad(mesh, made, corner, {y, z}, kNoSides);
  add_quad(mesh, made, corner + y, {x, z}, kNoSides);
  add_quad(mesh, made, corner + x, {y, z}, kNoSides);
  add_quad(mesh, ceiling, corner + z, {x, y}, kNoSides);
  return MeshWorld(std::move(mesh), {});
}

NoiseOptions nothing() {
  NoiseOptions options = gazebo_noise();
  options.noise = 0;
  return options;
}

LabelledScan scan_of(const World& world, const NoiseOptions& options, std::uint64_t index = 0) {
  return simulate_scan(world, {vlp16()}, {{0, Pose::Identity()}}, options, {0, 5, index});
}

/// Of all beams of a snapshot, what each meets.
std::vector<Hit> hits_of(const World& world) {
  const LidarModel lidar = vlp16();
  std::vector<Ray> rays;
  for (std::size_t column = 0; column < lidar.columns; ++column) {
    for (std::size_t ring = 0; ring < lidar.rings(); ++ring) {
      const double turned = double(column) * lidar.period / double(lidar.columns);
      rays.push_back({Eigen::Vector3d::Zero(), lidar.direction(ring, turned), 0});
    }
  }
  std::vector<Hit> hits = world.cast(rays);
  for (std::size_t i = 0; i < hits.size(); ++i) hits[i].edge_distance = std::abs(hits[i].normal.dot(rays[i].direction));
  return hits;  // with the cosine of incidence in place of the distance to an edge
}

double cosine_of(const Hit& hit) {
  return hit.edge_distance;
}

double count_of(const LabelledScan& scan, PointKind kind) {
  return double(std::count_if(scan.labels.begin(), scan.labels.end(),
                              [&](std::uint8_t label) { return (label & ~kEdgeBit) == std::uint8_t(kind); }));
}

/// Within five deviations of what a binomial draw of that mean scatters by.
void expect_drawn(double count, double mean) {
  EXPECT_NEAR(count, mean, 5 * std::sqrt(mean) + 1);
}

TEST(Imperfections, OfNoneLeaveEveryBeamOnItsSurface) {
  for (const Material material : {Material::matte, Material::metal, Material::glossy}) {
    const MeshWorld room = room_of(material);
    const LabelledScan scan = scan_of(room, nothing());
    const std::vector<Hit> hits = hits_of(room);
    ASSERT_EQ(scan.labels.size(), hits.size());
    EXPECT_EQ(count_of(scan, PointKind::surface), double(hits.size()));
  }
}

TEST(Imperfections, NoiseHasItsDeviation) {
  const MeshWorld room = room_of(Material::matte);
  const LabelledScan clean = scan_of(room, nothing());
  for (const double noise : {0.008, 0.03}) {
    NoiseOptions options = nothing();
    options.noise = noise;
    const LabelledScan noisy = scan_of(room, options);
    ASSERT_EQ(noisy.labels.size(), clean.labels.size());
    double sum = 0;
    for (std::size_t i = 0; i < noisy.labels.size(); ++i) {
      const double off = noisy.scan.cloud.points[i].norm() - clean.scan.cloud.points[i].norm();
      sum += off * off;
    }
    EXPECT_NEAR(std::sqrt(sum / double(noisy.labels.size())) / noise, 1, 0.02);
  }
}

TEST(Imperfections, OutliersAreTheirShareOfTheReturns) {
  const MeshWorld room = room_of(Material::matte);
  for (const double rate : {0.005, 0.02, 0.2}) {
    NoiseOptions options = nothing();
    options.outliers = rate;
    const LabelledScan scan = scan_of(room, options);
    const double beams = double(hits_of(room).size()), lost = beams - double(scan.labels.size());
    expect_drawn(count_of(scan, PointKind::outlier) + lost, rate * beams);  // some are nearer than the sensor sees
    EXPECT_LT(lost, 0.1 * rate * beams);
  }
}

/// Sum of `share(hit)` over all beams.
template <class F>
double expected(const World& world, const F& ratio) {
  double sum = 0;
  for (const Hit& hit : hits_of(world)) sum += std::max(0.0, ratio(hit));
  return sum;
}

TEST(Imperfections, GrazedMatteSurfacesLoseTheirShare) {
  const MeshWorld room = room_of(Material::matte);
  for (const double rate : {0.3, 0.9, 1.0}) {
    NoiseOptions options = nothing();
    options.grazing = rate;
    const double mean = expected(room, [&](const Hit& hit) { return rate * (1 - cosine_of(hit) / 0.06); });
    EXPECT_GT(mean, 20);
    expect_drawn(double(hits_of(room).size() - scan_of(room, options).labels.size()), mean);
    options.grazing = 0, options.glossy = rate;  // is for other surfaces
    EXPECT_EQ(scan_of(room, options).labels.size(), hits_of(room).size());
  }
}

TEST(Imperfections, PolishedAndMetalSurfacesLoseTheirShareFromSteeperAnglesOn) {
  for (const auto& [material, limit] : {std::pair{Material::glossy, 0.35}, {Material::metal, 0.5}}) {
    const MeshWorld room = room_of(material);
    for (const double rate : {0.2, 0.9}) {
      NoiseOptions options = nothing();
      options.glossy = rate;
      const double mean = expected(room, [&](const Hit& hit) {
        return hit.surface->material == Material::matte ? 0 : rate * (1 - cosine_of(hit) / limit);
      });
      EXPECT_GT(mean, 100);
      expect_drawn(double(hits_of(room).size() - scan_of(room, options).labels.size()), mean);
    }
  }
}

TEST(Imperfections, MirrorsGiveTheirShareOfGhosts) {
  for (const double rate : {0.1, 0.3, 1.0}) {
    const MeshWorld room = room_of(Material::metal);
    NoiseOptions options = nothing();
    options.ghosts = rate;
    const double mean = expected(room, [&](const Hit& hit) {
      return hit.surface->material == Material::metal ? rate * (1 - cosine_of(hit)) : 0;
    });
    const LabelledScan scan = scan_of(room, options);
    EXPECT_GE(scan.labels.size() + 5, hits_of(room).size());  // a closed room, but some paths are beyond 100 m
    expect_drawn(count_of(scan, PointKind::ghost), mean);
  }
}

TEST(Imperfections, MixedPointsAreTheirShareOfTheBeamsAcrossAnEdge) {
  Mesh mesh = room_of(Material::matte).mesh();
  for (int i = 0; i < 10; ++i) {
    add_box(mesh, 0, upright({std::cos(0.6 * i) * 2.5, std::sin(0.6 * i) * 2.5, -1}, 0.3 * i), {0.3, 0.3, 3});
  }
  const MeshWorld world(std::move(mesh), {});
  const auto mixed = [&](double rate) {
    NoiseOptions options = nothing();
    options.mixed = rate, options.divergence = 0.02;
    double count = 0;
    for (std::uint64_t index = 0; index < 4; ++index)
      count += count_of(scan_of(world, options, index), PointKind::mixed);
    return count;
  };
  const double all = mixed(1);
  EXPECT_GT(all, 1000);
  expect_drawn(mixed(0.5), 0.5 * all);
  expect_drawn(mixed(0.1), 0.1 * all);
  EXPECT_EQ(mixed(0), 0);
}

}  // namespace
}  // namespace tilth
