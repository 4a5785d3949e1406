#include <algorithm>

#include <tilth/core/point_cloud.hpp>

namespace tilth {
namespace {

template <class T>
std::vector<T> pick(const std::vector<T>& values, std::span<const std::uint32_t> indices) {
  if (values.empty()) return {};
  std::vector<T> picked(indices.size());
  for (std::size_t i = 0; i < indices.size(); ++i) picked[i] = values[indices[i]];
  return picked;
}

struct Run {
  std::ptrdiff_t begin, end;
};

std::vector<Run> kept_runs(std::span<const std::uint8_t> keep) {
  std::vector<Run> runs;
  const auto is_kept = [](std::uint8_t k) { return k != 0; };
  for (auto begin = keep.begin(); begin != keep.end();) {
    begin = std::find_if(begin, keep.end(), is_kept);
    const auto end = std::find(begin, keep.end(), std::uint8_t{0});
    if (begin != end) runs.push_back({begin - keep.begin(), end - keep.begin()});
    begin = end;
  }
  return runs;
}

template <class T>
std::vector<T> pick(const std::vector<T>& values, std::span<const Run> runs) {
  std::vector<T> picked;
  if (values.empty()) return picked;
  picked.reserve(values.size());
  for (const Run& run : runs) picked.insert(picked.end(), values.begin() + run.begin, values.begin() + run.end);
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
  const std::vector<Run> runs = kept_runs(keep);
  return {pick(cloud.points, runs), pick(cloud.intensities, runs), pick(cloud.times, runs), pick(cloud.rings, runs)};
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
