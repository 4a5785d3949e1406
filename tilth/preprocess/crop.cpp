#include <tilth/preprocess/crop.hpp>

namespace tilth {

PointCloud crop_range(const PointCloud& cloud, double min_range, double max_range) {
  std::vector<std::uint32_t> kept;
  kept.reserve(cloud.size());
  const double min2 = min_range * min_range, max2 = max_range * max_range;
  for (std::uint32_t i = 0; i < cloud.size(); ++i) {
    const double r2 = cloud.points[i].squaredNorm();
    if (r2 >= min2 && r2 <= max2) kept.push_back(i);  // false for NaN and infinity
  }
  return kept.size() == cloud.size() ? cloud : select(cloud, kept);
}

}  // namespace tilth
