// A curve with fewer points that looks the same: of every run of points the lowest and the highest stay. O(n).
#pragma once

#include <tilth/plot/plot.hpp>

namespace tilth {

/// `curve` itself where it has no more than `most` points. The first and the last point stay. Of a path (which has no
/// lowest point) every n-th point stays.
Curve thinned(const Curve& curve, std::size_t most, PlotKind kind);

}  // namespace tilth
