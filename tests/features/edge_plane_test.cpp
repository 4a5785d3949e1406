// Features on made-up rings: which points are edges, which are planes.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include <tilth/features/edge_plane.hpp>

namespace tilth {
namespace {

TEST(Curvature, IsOneOnALineRootTwoOnAPatchRootThreeInABlob) {
  EXPECT_NEAR(corrected_curvature(Eigen::Vector3f(4, 0, 0).asDiagonal()), 1.0f, 1e-6f);
  EXPECT_NEAR(corrected_curvature(Eigen::Vector3f(2, 2, 0).asDiagonal()), std::numbers::sqrt2_v<float>, 1e-6f);
  EXPECT_NEAR(corrected_curvature(Eigen::Vector3f(3, 3, 3).asDiagonal()), std::numbers::sqrt3_v<float>, 1e-6f);
  EXPECT_EQ(corrected_curvature(Eigen::Matrix3f::Zero()), 0.0f);
}

// Four rings of 600 points on a cylinder of 5 m; curvature 1.01, but 1.5 at every 50th point.
struct MadeUp {
  PointCloud cloud;
  std::vector<float> curvature;
};
MadeUp made_up_rings() {
  MadeUp m;
  for (std::uint16_t ring = 0; ring < 4; ++ring) {
    for (int i = 0; i < 600; ++i) {
      const double a = 2 * std::numbers::pi * i / 600;
      m.cloud.points.push_back({5 * std::cos(a), 5 * std::sin(a), 0.5 * ring});
      m.cloud.rings.push_back(ring);
      m.curvature.push_back(i % 50 == 25 ? 1.5f : 1.01f);
    }
  }
  return m;
}

TEST(Features, EdgesAreTheMostCurvedPointsOfEachSector) {
  const MadeUp m = made_up_rings();
  const auto edges = select_edges(m.cloud, m.curvature, {.edges = 24});  // one a sector
  EXPECT_EQ(edges.size(), 24u);
  for (const std::uint32_t i : edges) EXPECT_EQ(m.curvature[i], 1.5f);
  EXPECT_EQ(select_edges(m.cloud, m.curvature, {.edges = 1000}).size(), 48u);  // there are no more
}

TEST(Features, EdgesKeepTheirDistance) {
  MadeUp m = made_up_rings();
  for (float& c : m.curvature) c = 1.5f;
  const auto edges = select_edges(m.cloud, m.curvature, {.edges = 10000, .edge_spacing = 5});
  for (std::size_t i = 1; i < edges.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const int a = int(edges[i]), b = int(edges[j]);
      const bool same_sector = a / 100 == b / 100;
      EXPECT_TRUE(!same_sector || std::abs(a - b) > 5) << a << ' ' << b;
    }
  }
}

TEST(Features, PlanesAreSpreadOverCellsAndAreNoEdges) {
  const MadeUp m = made_up_rings();
  const auto planes =
      select_planes(m.cloud, m.curvature, {.planes = 10000, .max_plane_curvature = 1.3, .plane_cell = 0.5});
  EXPECT_GT(planes.size(), 4u * 50);
  EXPECT_LT(planes.size(), 4u * 110);
  for (const std::uint32_t i : planes) EXPECT_EQ(m.curvature[i], 1.01f);
  EXPECT_EQ(select_planes(m.cloud, m.curvature, {.planes = 100, .max_plane_curvature = 1.3, .plane_cell = 0.5}).size(),
            100u);
}

TEST(Features, PointsThatAreNoCandidatesAreNeverTaken) {
  const MadeUp m = made_up_rings();
  const std::vector<float> none(m.cloud.size(), 0.0f);
  EXPECT_TRUE(select_edges(m.cloud, none, {}).empty());
  EXPECT_TRUE(select_planes(m.cloud, none, {}).empty());
  EXPECT_TRUE(select_planes({}, {}, {}).empty());
}

}  // namespace
}  // namespace tilth
