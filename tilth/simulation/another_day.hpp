// The same scene another day: things were moved, taken away or added, and a sensor is carried off on its way.
#pragma once

#include <tilth/simulation/scenes.hpp>

namespace tilth {

/// Moves, takes away and adds what is marked as movable, a third each of the share `options.changed` of it, by
/// `options.seed`: up to 1.5 m and turned by up to 90 degrees. What would come within 0.8 m of the way is taken away.
void change(Scene& scene, const SceneOptions& options);

/// The way with a jump: at `options.kidnap` [s] the sensor is `options.kidnap_jump` [m] farther along it, rests there
/// for `options.covered` [s], and goes on. The same poses where the way ends before.
Trajectory kidnapped(const Trajectory& way, const SceneOptions& options);

/// Whether the sensor sees nothing at `stamp` [s].
bool is_covered(double stamp, const SceneOptions& options);

}  // namespace tilth
