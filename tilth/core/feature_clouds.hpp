// The edge and plane points of a scan, or of a map.
#pragma once

#include <tilth/core/point_cloud.hpp>

namespace tilth {

struct FeatureClouds {
  PointCloud edges, planes;
};

}  // namespace tilth
