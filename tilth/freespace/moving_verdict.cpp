#include <algorithm>
#include <optional>
#include <utility>

#include <tilth/freespace/moving_points.hpp>

namespace tilth {
namespace {

constexpr int kRounds = 3;
constexpr int kFewest = 2;            // neighbours that moved, for one that says nothing itself
constexpr double kOpenWeight = 0.5;   // of a neighbour that says nothing against one that moved
constexpr int kOutnumbered = 3;       // so many times must what stands outnumber what moved to keep it
constexpr double kFirmer = 3.0;       // so many times it was met for each pass, where it certainly stands
constexpr int kTall = 5;              // cells, one above the other, that hold neighbours: rings lie far apart
constexpr float kLeftBehind = 10.0F;  // [m] farther than it was seen from

/// The i-th of 27 blocks or cells about one, along an axis.
Eigen::Vector3i step_of(int i) {
  return {i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1};
}

}  // namespace

bool MovingPoints::moved(std::uint32_t thing) const {
  if (thing == kNone) return false;
  return judgements_[thing].judged ? judgements_[thing].verdict == Verdict::moved : things_[thing].gone;
}

bool MovingPoints::judged(std::uint32_t thing) const {
  return thing == kNone || judgements_[thing].judged;
}

std::size_t MovingPoints::bytes() const {
  constexpr std::size_t kTable = 2 * (sizeof(std::int64_t) + sizeof(std::uint64_t));
  std::size_t bytes =
      things_.size() * (sizeof(SeenThing) + sizeof(Judgement)) + blocks_.size() * (sizeof(Block) + kTable);
  for (const KeptView& kept : views_) bytes += kept.view.bytes();
  return bytes;
}

MovingPoints::Verdict MovingPoints::verdict_alone(const SeenThing& thing) const {
  if (thing.gone) return Verdict::moved;
  if (thing.calm) return Verdict::stands;
  const double stay = stamps_[thing.last - 1] - stamps_[thing.first - 1];
  const double before = double(thing.before) / SeenThing::kPass, between = double(thing.between) / SeenThing::kPass;
  const bool came = before >= options_.least_passes && 2 * between < thing.met + 2;
  if (came && stay < options_.stay) return Verdict::moved;
  const bool firm = thing.met >= options_.firm_hits && stay >= options_.firm_stay && kFirmer * between <= thing.met;
  return firm ? Verdict::stands : Verdict::open;
}

/// As most of those say that were seen at the same time close by.
MovingPoints::Verdict MovingPoints::verdict_among(std::uint32_t number, std::span<const std::uint32_t> near,
                                                  bool first) const {
  const Verdict alone = judgements_[number].verdict;
  if (alone != Verdict::open && !(first && alone == Verdict::moved)) return alone;
  const SeenThing& thing = things_[number];
  int moved = 0, stands = 0, open = 0;
  for (const std::uint32_t beside : near) {
    if (beside == number || !thing.together(things_[beside])) continue;
    const Verdict verdict = judgements_[beside].verdict;
    ++(verdict == Verdict::moved ? moved : verdict == Verdict::stands ? stands : open);
  }
  if (alone == Verdict::moved) return stands > kOutnumbered * moved + 1 ? Verdict::stands : Verdict::moved;
  return moved >= kFewest && moved > stands + kOpenWeight * open ? Verdict::moved : Verdict::open;
}

MovingPoints::Around MovingPoints::around(const Block& block) const {
  Around around{};
  for (int i = 0; i < 27; ++i) {
    const std::uint32_t number = table_.find(voxel_key(block.place + step_of(i), 0));
    if (number != VoxelTable::kNone) around[std::size_t(i)] = &blocks_[number];
  }
  return around;
}

/// The things about a cell of the block in the middle.
void MovingPoints::gather(const Around& around, int cell, std::vector<std::uint32_t>& near) const {
  near.clear();
  const Eigen::Vector3i middle(4 + (cell & 3), 4 + (cell >> 2 & 3), 4 + (cell >> 4));
  for (int i = 0; i < 9 * kTall; ++i) {
    const Eigen::Vector3i at = middle + Eigen::Vector3i(i % 3 - 1, i / 3 % 3 - 1, i / 9 - kTall / 2);
    const Block* block = around[std::size_t((at.x() >> 2) + 3 * (at.y() >> 2) + 9 * (at.z() >> 2))];
    if (block == nullptr) continue;
    const auto bit = std::size_t((at.x() & 3) | (at.y() & 3) << 2 | (at.z() & 3) << 4);
    for (std::uint32_t n = block->heads[bit]; n != kNone; n = things_[n].next) near.push_back(n);
  }
}

/// Lets all things vote that may still change their minds, cell by cell.
void MovingPoints::vote(bool first) {
  const auto votes = [&](std::uint32_t t) {
    const Judgement& own = judgements_[t];
    return own.judged && own.verdict != Verdict::stands && (first || own.verdict != Verdict::moved);
  };
  std::vector<Judgement> next = judgements_;
  std::vector<std::uint32_t> voters, near;
  for (const Block& block : blocks_) {
    std::optional<Around> blocks;
    for (int cell = 0; cell < 64; ++cell) {
      voters.clear();
      for (std::uint32_t t = block.heads[std::size_t(cell)]; t != kNone; t = things_[t].next) {
        if (votes(t)) voters.push_back(t);
      }
      if (voters.empty()) continue;
      if (!blocks) blocks = around(block);
      gather(*blocks, cell, near);
      for (const std::uint32_t t : voters) next[t].verdict = verdict_among(t, near, first);
    }
  }
  judgements_ = std::move(next);
}

void MovingPoints::judge(const Eigen::Vector3f& place, float distance) {
  if (distance <= 0) catch_up(scan_);
  for (std::uint32_t t = 0; t < looked_; ++t) {
    const float away = (things_[t].point - place).norm();
    const bool left = distance <= 0 || (away >= distance && away >= things_[t].seen_from + kLeftBehind);
    judgements_[t] = {verdict_alone(things_[t]), left};
  }
  const bool any = std::any_of(judgements_.begin(), judgements_.end(), [](const Judgement& j) { return j.judged; });
  for (int round = 0; any && round < kRounds; ++round) vote(round == 0);
  if (any) find_arrivals();
}

std::vector<std::uint32_t> MovingPoints::forget(const Eigen::Vector3f& place, float distance) {
  const std::vector<SeenThing> things = std::exchange(things_, {});
  const std::vector<Judgement> judgements = std::exchange(judgements_, {});
  const std::vector<Block> blocks = std::exchange(blocks_, {});
  std::vector<std::uint32_t> renumbered(things.size(), kNone), kept_before(things.size() + 1, 0);
  table_.clear();
  for (std::uint32_t t = 0; t < things.size(); ++t) {
    kept_before[t] = std::uint32_t(things_.size());
    if (judgements[t].judged) continue;
    SeenThing thing = things[t];
    for (std::uint32_t* number : {&thing.block, &thing.block_below}) {
      const Block& block = blocks[*number];
      *number = table_.insert(voxel_key(block.place, 0));
      if (*number == blocks_.size()) blocks_.push_back(block), blocks_.back().heads.fill(kNone);
    }
    judgements_.emplace_back();
    renumbered[t] = insert(thing);
  }
  kept_before.back() = std::uint32_t(things_.size());
  for (std::uint32_t& first : first_of_scan_) first = kept_before[first];
  looked_ = kept_before[looked_];
  std::erase_if(views_, [&](const KeptView& kept) { return (kept.view.place() - place).norm() >= distance; });
  return renumbered;
}

}  // namespace tilth
