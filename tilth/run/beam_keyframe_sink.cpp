#include <utility>

#include <tilth/run/beam_keyframe_sink.hpp>

namespace tilth {

void BeamKeyframeSink::take(const Scan& scan, const OdometryResult& result, const RunRecord&) {
  if (auto window = gatherer_.take(scan, result.filtered, result)) keep(std::move(*window));
  gathered_.rings = gatherer_.rings();
  gathered_.scans_without_rings = gatherer_.scans_without_rings();
}

void BeamKeyframeSink::finish(const RunRecord&) {
  if (auto window = gatherer_.finish()) keep(std::move(*window));
  gathered_.left_over = gatherer_.left_over();
  gathered_.bright = gatherer_.bright();
}

void BeamKeyframeSink::keep(BeamKeyframeGatherer::Window window) {
  KeyframeWindows& kept = gathered_.windows;
  if (windows_++ % every_ == 0) kept.push_back(std::move(window));
  if (kept.size() <= most_windows_) return;
  for (std::size_t i = 1; 2 * i < kept.size(); ++i) kept[i] = std::move(kept[2 * i]);
  kept.resize((kept.size() + 1) / 2);
  every_ *= 2;
}

}  // namespace tilth
