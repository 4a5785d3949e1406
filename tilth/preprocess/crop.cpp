#include <tilth/preprocess/crop.hpp>

namespace tilth {

PointCloud crop_range(const PointCloud& cloud, double min_range, double max_range) {
  std::vector<std::uint8_t> keep(cloud.size());
  std::size_t kept = 0;
  const double min2 = min_range * min_range, max2 = max_range * max_range;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const double r2 = cloud.points[i].squaredNorm();
    keep[i] = std::uint8_t((r2 >= min2) & (r2 <= max2));  // false for NaN and infinity
    kept += keep[i];
  }
  return kept == cloud.size() ? cloud : select_kept(cloud, keep);
}

}  // namespace tilth
