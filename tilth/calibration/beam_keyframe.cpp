#include <algorithm>
#include <limits>

#include <tilth/calibration/beam_keyframe.hpp>
#include <tilth/core/evenly_chosen.hpp>

namespace tilth {

std::vector<BeamReturn> choose_returns(const PointCloud& cloud, const ReturnChoice& choice) {
  const bool timed = cloud.has_times(), lit = cloud.intensities.size() == cloud.size();
  std::vector<std::vector<BeamReturn>> rings;
  std::size_t within = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const double range = cloud.points[i].norm();
    if (!(range >= choice.min_range && range <= choice.max_range)) continue;
    const std::uint16_t ring = cloud.rings[i];
    if (ring >= rings.size()) rings.resize(ring + std::size_t{1});
    const float intensity = lit ? cloud.intensities[i] : std::numeric_limits<float>::max();
    rings[ring].push_back({cloud.points[i].cast<float>(), timed ? cloud.times[i] : 0.0F, intensity, ring});
    ++within;
  }
  // Ring by ring: every fourth return in the order of firing would be of every fourth ring.
  const double share = within > choice.most ? double(choice.most) / double(within) : 1.0;
  std::vector<BeamReturn> chosen;
  for (const std::vector<BeamReturn>& ring : rings) {
    const auto some = evenly_chosen<BeamReturn>(ring, std::size_t(share * double(ring.size()) + 0.5));
    chosen.insert(chosen.end(), some.begin(), some.end());
  }
  return chosen;
}

}  // namespace tilth
