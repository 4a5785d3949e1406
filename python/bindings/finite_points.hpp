// The finite points of a cloud, and which they are.
#pragma once

#include <cstdint>
#include <vector>

#include <tilth/core/point_cloud.hpp>

namespace tilth::python {

struct FinitePoints {
  PointCloud cloud;
  std::vector<std::uint32_t> indices;

  explicit FinitePoints(const PointCloud& all) {
    for (std::uint32_t i = 0; i < all.size(); ++i) {
      if (all.points[i].allFinite()) indices.push_back(i);
    }
    cloud = select(all, indices);
  }
};

}  // namespace tilth::python
