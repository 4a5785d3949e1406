#include <algorithm>

#include <tilth/slam/graph_pieces.hpp>

namespace tilth {

std::vector<std::size_t> pieces_of(const std::vector<Keyframe>& keyframes) {
  std::vector<std::size_t> pieces(keyframes.size(), 0);
  for (std::size_t i = 1; i < keyframes.size(); ++i) pieces[i] = keyframes[i].severed ? i : pieces[i - 1];
  return pieces;
}

std::vector<std::size_t> pieces_of(const std::vector<Keyframe>& keyframes, const std::vector<LoopClosure>& closures) {
  std::vector<std::size_t> pieces = pieces_of(keyframes);
  for (const LoopClosure& c : closures)
    if (c.verdict == Verdict::accepted) join(pieces, c.constraint.from, c.constraint.to);
  return pieces;
}

void join(std::vector<std::size_t>& pieces, std::size_t a, std::size_t b) {
  const std::size_t first = std::min(pieces[a], pieces[b]), second = std::max(pieces[a], pieces[b]);
  std::replace(pieces.begin(), pieces.end(), second, first);
}

}  // namespace tilth
