#include <algorithm>

#include <tilth/core/error.hpp>
#include <tilth/search/neighbor_moments.hpp>

namespace tilth {
namespace {

using Four = Eigen::Array4f;

void set_points(std::vector<Four>& points, const PointCloud& cloud, std::span<const std::uint8_t> keep) {
  points.resize(cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3f p = cloud.points[i].cast<float>();
    points[i] = Four(p.x(), p.y(), p.z(), keep.empty() || keep[i] != 0 ? 1.0f : 0.0f);
  }
}

/// Sums over the kept neighbours of the products of their offset (x, y, z, 1) with its x, y, z and 1.
struct Products {
  Four x = Four::Zero(), y = Four::Zero(), z = Four::Zero(), one = Four::Zero();
};

Products sum_products(const std::vector<Four>& points, std::size_t i, std::span<const std::uint32_t> neighbors) {
  const Four center(points[i][0], points[i][1], points[i][2], 0.0f);
  Products sums;
  for (const std::uint32_t n : neighbors) {
    const Four offset = points[n] - center;
    const Four kept = offset * offset[3];
    sums.x += kept * offset[0];
    sums.y += kept * offset[1];
    sums.z += kept * offset[2];
    sums.one += kept;
  }
  return sums;
}

void write_covariance(const Products& sums, std::size_t i, LocalCovariances& out) {
  const float n = sums.one[3];
  const float scale = n > 1.0f ? 1.0f / (n - 1.0f) : 0.0f;
  const Four mean = sums.one / std::max(n, 1.0f);
  const Four x = scale * (sums.x - sums.one[0] * mean);
  const Four y = scale * (sums.y - sums.one[1] * mean);
  out.xx[i] = x[0];
  out.xy[i] = x[1];
  out.xz[i] = x[2];
  out.yy[i] = y[1];
  out.yz[i] = y[2];
  out.zz[i] = scale * (sums.z[2] - sums.one[2] * mean[2]);
  out.counts[i] = std::uint8_t(n);
}

}  // namespace

const LocalCovariances& NeighborMoments::compute(const PointCloud& cloud, const NeighborTable& neighbors,
                                                 std::span<const std::uint8_t> keep) {
  if (neighbors.k > 0 && neighbors.size() != cloud.size()) throw Error("neighbors", "is not the table of this cloud");
  if (!keep.empty() && keep.size() != cloud.size())
    throw Error("keep", "must be empty or have an entry for each point");
  if (neighbors.k > 255) throw Error("neighbors", "more than 255 neighbours of a point");
  LocalCovariances& out = covariances_;
  for (std::vector<float>* v : {&out.xx, &out.xy, &out.xz, &out.yy, &out.yz, &out.zz}) v->assign(cloud.size(), 0.0f);
  out.counts.assign(cloud.size(), 0);
  set_points(points_, cloud, keep);
  for (std::size_t i = 0; i < neighbors.size(); ++i) {
    write_covariance(sum_products(points_, i, neighbors.neighbors(i)), i, out);
  }
  return out;
}

LocalCovariances local_covariances(const PointCloud& cloud, const NeighborTable& neighbors,
                                   std::span<const std::uint8_t> keep) {
  NeighborMoments moments;
  return moments.compute(cloud, neighbors, keep);
}

}  // namespace tilth
