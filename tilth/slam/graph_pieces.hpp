// What of a pose graph hangs together, where the track was lost on the way: each piece is named by its first keyframe.
#pragma once

#include <cstddef>
#include <vector>

#include <tilth/slam/keyframe.hpp>
#include <tilth/slam/loop_closure.hpp>

namespace tilth {

/// The piece of each keyframe, by known motion alone.
std::vector<std::size_t> pieces_of(const std::vector<Keyframe>& keyframes);

/// The same, where accepted closures join pieces.
std::vector<std::size_t> pieces_of(const std::vector<Keyframe>& keyframes, const std::vector<LoopClosure>& closures);

/// Makes one piece of those of the keyframes `a` and `b`. O(keyframes).
void join(std::vector<std::size_t>& pieces, std::size_t a, std::size_t b);

}  // namespace tilth
