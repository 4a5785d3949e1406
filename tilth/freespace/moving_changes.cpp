#include <algorithm>
#include <optional>
#include <vector>

#include <tilth/freespace/moving_points.hpp>

namespace tilth {
namespace {

constexpr double kFirmer = 3.0;        // so many times it was met for each pass, once it had come
constexpr std::uint32_t kEarlier = 3;  // scans that what stood before was seen earlier
constexpr int kPieces = 3;             // things about one that stood before, for each that came with it

}  // namespace

std::optional<Stay> MovingPoints::changed(std::uint32_t number) const {
  if (number == kNone || !judgements_[number].judged) return std::nullopt;
  const bool left = things_[number].gone && judgements_[number].verdict == Verdict::moved && stayed(things_[number]);
  if (!left && !judgements_[number].came) return std::nullopt;
  const double first = stamps_[things_[number].first - 1], last = stamps_[things_[number].last - 1];
  if (left) return Stay{ChangeKind::left, first, last};
  return Stay{ChangeKind::came, first, last, stamps_[std::max(1U, things_[number].free_until) - 1]};
}

/// Whether a thing was seen for so long that it stood.
bool MovingPoints::stayed(const SeenThing& thing) const {
  return thing.met >= options_.firm_hits && stamps_[thing.last - 1] - stamps_[thing.first - 1] >= options_.settled;
}

bool MovingPoints::may_have_come(std::uint32_t number) const {
  const SeenThing& thing = things_[number];
  if (thing.gone || judgements_[number].verdict == Verdict::moved || !stayed(thing)) return false;
  const double before = double(thing.before) / SeenThing::kPass, between = double(thing.between) / SeenThing::kPass;
  return before >= options_.least_passes && kFirmer * between <= thing.met;
}

/// Whether what came with a thing is not just a piece, seen late, of what stood there all the time.
bool MovingPoints::came_with_others(std::uint32_t number, std::span<const std::uint32_t> near) const {
  const SeenThing& thing = things_[number];
  int came = 0, stood = 0;
  for (const std::uint32_t beside : near) {
    const SeenThing& other = things_[beside];
    if (judgements_[beside].came && thing.together(other))
      ++came;
    else if (judgements_[beside].verdict != Verdict::moved && !other.gone && other.first + kEarlier < thing.first)
      ++stood;
  }
  return kPieces * came > stood;
}

/// Of the things that are judged, finds those that came.
void MovingPoints::find_arrivals() {
  for (std::uint32_t t = 0; t < judgements_.size(); ++t)
    judgements_[t].came = judgements_[t].judged && may_have_come(t);
  std::vector<std::uint32_t> near, alone;
  for (const Block& block : blocks_) {
    for (int cell = 0; cell < 64; ++cell) {
      for (std::uint32_t t = block.heads[std::size_t(cell)]; t != kNone; t = things_[t].next) {
        if (!judgements_[t].came) continue;
        gather(around(block), cell, near);
        if (!came_with_others(t, near)) alone.push_back(t);
      }
    }
  }
  for (const std::uint32_t t : alone) judgements_[t].came = false;
}

}  // namespace tilth
