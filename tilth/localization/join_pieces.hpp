// A drive whose track was lost and which went on with a new map: that map is looked for, from nothing, in what was
// mapped before, and joined where known ground was seen again. A new map that is not found stays relative to itself.
#pragma once

#include <cstddef>
#include <utility>

#include <tilth/localization/localizer.hpp>
#include <tilth/slam/loop_closer.hpp>

namespace tilth {

/// Joins what can be joined, and optimises; returns how many new maps were found. Nothing is done where no track was
/// lost. About 0.1 s for 3 m of a new map.
std::size_t join_pieces(LoopCloser& loops, const LocalizerOptions& options);

/// The same while the drive goes on, for Slam::after_keyframe: every 6 m the last 9 m of a map that hangs on nothing
/// are looked for.
class PieceJoiner {
 public:
  explicit PieceJoiner(LocalizerOptions options) : options_(std::move(options)) {}
  void operator()(LoopCloser& loops);

 private:
  LocalizerOptions options_;
  double tried_ = 0.0;  // [m] of the way, where it was looked for last
};

}  // namespace tilth
