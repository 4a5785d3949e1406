// The longer docstrings of the module.
#pragma once

namespace tilth::python {

inline constexpr const char* kScanDoc = R"(One revolution of a spinning LiDAR.

    points: (n, 3) x y z [m] in the LiDAR frame (x forward, y left, z up), each as seen from where the sensor was at the
        time of that point; NaN and infinite ones are passed over. float32, float64 or integers, of any strides.
    times: (n,) [s] since `stamp`, 0 .. 10; without them the scan counts as taken at once.
    rings: (n,) integers, 0 the lowest beam; without them neighbourhoods are searched.
    intensities: (n,) as the sensor gives them.
    stamp: [s] of the first point.
    T_cloud_sensor: (4, 4) where what spins about its z axis sits in the frame of the points; None: at its origin.

Its arrays share its memory: what is written to them changes it. Raises tilth.Error naming argument, entry and bound.)";

inline constexpr const char* kResultDoc = R"(What an odometry made of one scan.

It keeps the scan without its outliers, about 1 MB: keep what you need of a long drive's results, not the results.)";

inline constexpr const char* kRegistrationDoc =
    R"(Two clouds registered to one another, and how far that is to be believed.)";

inline constexpr const char* kPatchesDoc = R"(The pieces of surface (surfels) of a scan, one entry a patch.)";

}  // namespace tilth::python
