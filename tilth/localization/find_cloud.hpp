// Where one cloud lies on another that shows some of the same, from nothing: all that stands upright is searched from
// above, as a place in a map is (place_finder.hpp), and the answer is one only where each cloud finds the other there.
// About 0.1 to 0.5 s for two scans of 28,000 points.
#pragma once

#include <tilth/localization/place_finder.hpp>
#include <tilth/odometry/align_clouds.hpp>

namespace tilth {

struct FindCloudOptions {
  PlaceFinderOptions find{.search = {.off_way = 12.0}, .min_overlap = 0.4, .min_landmarks = 0.25, .min_likeness = 0.25};
  PlaceCheckOptions check;
  AlignCloudsOptions align;
};

template <class V>
void visit(FindCloudOptions& o, V&& v) {
  visit(o.align, v);
  v("find", o.find, "[-] search of one cloud in the other");
  v("check", o.check, "[-] registration and judgement of a place that was found");
}

struct FoundCloud {
  PlaceAnswer answer = PlaceAnswer::not_found;
  std::vector<Pose> hypotheses = {};  ///< T_target_source that may be, best first; of `found`, the answer alone
  AlignResult registration = {};      ///< of what was found; else not converged
};

/// Each cloud counts as measured at once (deskew() it before) from the origin of its frame, whose z is upwards to 45
/// degrees where the cloud shows a floor, else to some degrees. The source is looked for within `find.search.off_way`
/// of the target's origin.
FoundCloud find_cloud(const PointCloud& source, const PointCloud& target, const FindCloudOptions& options = {});

}  // namespace tilth
