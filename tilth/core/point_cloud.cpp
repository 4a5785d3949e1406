#include <algorithm>

#include <tilth/core/point_cloud.hpp>

namespace tilth {
namespace {

template <class T>
std::vector<T> pick(const std::vector<T>& values, std::span<const std::uint32_t> indices) {
  std::vector<T> picked;
  if (values.empty()) return picked;
  picked.reserve(indices.size());
  for (const std::uint32_t i : indices) picked.push_back(values[i]);
  return picked;
}

template <class T>
void join(std::vector<T>& values, const std::vector<T>& more, bool both_have_it) {
  if (both_have_it) {
    values.insert(values.end(), more.begin(), more.end());
  } else {
    values.clear();
  }
}

}  // namespace

PointCloud select(const PointCloud& cloud, std::span<const std::uint32_t> indices) {
  return {pick(cloud.points, indices), pick(cloud.intensities, indices), pick(cloud.times, indices),
          pick(cloud.rings, indices)};
}

PointCloud select_kept(const PointCloud& cloud, std::span<const std::uint8_t> keep) {
  std::vector<std::uint32_t> indices;
  indices.reserve(cloud.size());
  for (std::uint32_t i = 0; i < keep.size(); ++i) {
    if (keep[i] != 0) indices.push_back(i);
  }
  return select(cloud, indices);
}

double duration(const PointCloud& cloud) {
  return cloud.has_times() ? double(*std::max_element(cloud.times.begin(), cloud.times.end())) : 0.0;
}

PointCloud transform(const PointCloud& cloud, const Eigen::Isometry3d& T_target_source) {
  PointCloud moved = cloud;
  for (Eigen::Vector3d& p : moved.points) p = T_target_source * p;
  return moved;
}

void append(PointCloud& cloud, const PointCloud& more) {
  if (more.empty()) return;
  const bool first = cloud.empty();
  const auto both = [&](const auto& a, const auto& b) { return (first || !a.empty()) && !b.empty(); };
  join(cloud.intensities, more.intensities, both(cloud.intensities, more.intensities));
  join(cloud.times, more.times, both(cloud.times, more.times));
  join(cloud.rings, more.rings, both(cloud.rings, more.rings));
  join(cloud.points, more.points, true);
}

}  // namespace tilth
