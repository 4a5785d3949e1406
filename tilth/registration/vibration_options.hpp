// Options of the vibration of a scan.
#pragma once

#include <tilth/core/options.hpp>

namespace tilth {

struct VibrationOptions {
  double tilt = 5e-3;
  double yaw = 2e-4;
  double yaw_ratio = 0.4;
  double translation = 2e-3;
  double lever = 1.0;
  double least_rotation = 1e-4;
  double least_translation = 3e-4;
  double mean = 0.5;
  double first_tilt = 8e-4;
  double first_translation = 1e-3;
  double lowest = 5.0;
  double highest = 25.0;
};

template <class V>
void visit(VibrationOptions& o, V&& v) {
  v("tilt", o.tilt, Bounds{0, 1},
    "[rad] greatest standard deviation of roll and pitch in a scan from constant acceleration; 0: no vibration");
  v("yaw", o.yaw, Bounds{0, 1}, "[rad] the same about the axis of the LiDAR's spin, where nothing tilts", kAdvanced);
  v("yaw_ratio", o.yaw_ratio, Bounds{0, 10}, "[-] ... and this share of roll's and pitch's deviation more", kAdvanced);
  v("translation", o.translation, Bounds{0, 1}, "[m] the same along the axes", kAdvanced);
  v("lever", o.lever, Bounds{0, 1e6},
    "[m] translation over roll and pitch, at most: a platform that shakes turns as well", kAdvanced);
  v("least_rotation", o.least_rotation, Bounds{0, 1}, "[rad] least standard deviation; 0: no vibration", kAdvanced);
  v("least_translation", o.least_translation, Bounds{0, 1}, "[m] the same along the axes", kAdvanced);
  v("mean", o.mean, Bounds{1e-3, 1e6},
    "[-] what a vibration may leave over three seconds, as a share of what chance would leave", kAdvanced);
  v("first_tilt", o.first_tilt, Bounds{0, 1},
    "[rad] standard deviation of a rotation at first, as if eight deviations had shown it", kAdvanced);
  v("first_translation", o.first_translation, Bounds{0, 1}, "[m] the same along the axes", kAdvanced);
  v("lowest", o.lowest, Bounds{0, 1000}, "[Hz] least frequency");
  v("highest", o.highest, Bounds{0.1, 1000}, "[Hz] greatest frequency");
}

}  // namespace tilth
