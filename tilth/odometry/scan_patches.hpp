// A scan as the flagship knows it.
#pragma once

#include <tilth/core/surface_patch.hpp>

namespace tilth {

struct ScanPatches {
  double stamp = 0.0;      ///< [s] of the first point
  double duration = 0.0;   ///< [s] from it to the last one
  SurfacePatches patches;  ///< each as seen at its own time

  double middle() const { return 0.5 * duration; }        ///< [s] since `stamp`
  double time() const { return stamp + 0.5 * duration; }  ///< [s] of the middle
};

}  // namespace tilth
