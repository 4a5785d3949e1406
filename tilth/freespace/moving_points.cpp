#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include <tilth/freespace/moving_points.hpp>

namespace tilth {
namespace {

constexpr float kFarthest = 1e5F;         // [m]
constexpr std::size_t kSurfaceEvery = 8;  // of the points of a scan, those that planes are made of
constexpr std::uint32_t kDelay = 20;      // scans until a thing is looked at: planes about it are known by then
constexpr std::uint32_t kOldPlane = 15;   // scans from first to last
constexpr std::uint32_t kCalmEvery = 8;   // scans in which what is calm is looked at
constexpr float kBelow = 0.1F;            // [m] under a point where the floor that it lies on may be

bool is_near(const Eigen::Vector3f& point) {
  return (point.array().abs() < kFarthest).all();  // false for what is not finite
}

/// Scans apart up to which a thing is looked at in a scan: many of those near by, ever fewer of those farther off.
/// Numbers of scans that higher powers of two divide reach farther; odd ones are not looked at.
std::uint32_t reach_of(std::uint32_t scan) {
  constexpr std::array<std::uint32_t, 7> kReach{0, 16, 48, 96, 200, 400, 0xFFFFFFFF};
  return kReach[std::min<std::size_t>(std::size_t(std::countr_zero(scan)), kReach.size() - 1)];
}

/// What a pass counts: in full through the middle of what is looked at, a quarter at its rim.
int tenths_of(float miss, float radius) {
  return int(SeenThing::kPass * std::min(1.0F, 1.25F - miss / radius));
}

std::size_t bit_of(const Eigen::Vector3i& cell) {
  return std::size_t((cell.x() & 3) | (cell.y() & 3) << 2 | (cell.z() & 3) << 4);
}

}  // namespace

MovingPoints::MovingPoints(const MovingOptions& options) : options_(options), edge_(float(2 * options.voxel)) {}

std::vector<std::uint32_t> MovingPoints::add(const SeenScan& scan, std::span<const Eigen::Vector3f> points) {
  ++scan_;
  stamps_.push_back(scan.stamp);
  find_surfaces(scan);
  first_of_scan_.push_back(std::uint32_t(things_.size()));
  std::vector<std::uint32_t> things;
  things.reserve(points.size());
  for (const Eigen::Vector3f& point : points) things.push_back(watch(point, scan.place()));
  const std::uint32_t reach = reach_of(scan_);
  if (reach > 0) {
    next_view().take(scan, options_, workspace_);
    look(views_.back(), reach < scan_ ? first_of_scan_[scan_ - 1 - reach] : 0, looked_);
  }
  if (scan_ > kDelay) catch_up(scan_ - kDelay);
  return things;
}

void MovingPoints::find_surfaces(const SeenScan& scan) {
  for (std::size_t i = scan_ % kSurfaceEvery; i < scan.points.size(); i += kSurfaceEvery) {
    const Eigen::Vector3f& p = scan.points[i];
    if (is_near(p)) blocks_[block_of(p)].surface.add(p, scan_, float(options_.thickness));
  }
}

/// The thing at the point, made anew where there is none that stands.
std::uint32_t MovingPoints::watch(const Eigen::Vector3f& point, const Eigen::Vector3f& place) {
  if (!is_near(point)) return kNone;
  const Eigen::Vector3f at = point / edge_;
  const Eigen::Vector3i cell = voxel_of(at.cast<double>());
  const Eigen::Vector3f inside = at - cell.cast<float>();
  const auto upper = [&](int axis) { return inside[axis] >= 0.5F ? 1U << unsigned(axis) : 0U; };
  SeenThing thing;
  thing.point = point, thing.born = scan_, thing.voxel = std::uint8_t(upper(0) | upper(1) | upper(2));
  thing.block = block_of(point), thing.block_below = block_of(point - kBelow * Eigen::Vector3f::UnitZ());
  thing.seen_from = (point - place).norm();
  for (std::uint32_t t = blocks_[thing.block].heads[bit_of(cell)]; t != kNone; t = things_[t].next) {
    if (things_[t].voxel == thing.voxel && !things_[t].gone) return t;
  }
  judgements_.emplace_back();
  return insert(thing);
}

/// Adds a thing to those of its cell.
std::uint32_t MovingPoints::insert(const SeenThing& thing) {
  const auto number = std::uint32_t(things_.size());
  const std::size_t bit = bit_of(voxel_of((thing.point / edge_).cast<double>()));
  things_.push_back(thing);
  things_.back().next = std::exchange(blocks_[thing.block].heads[bit], number);
  return number;
}

/// The number of the block that holds a point, made where there is none.
std::uint32_t MovingPoints::block_of(const Eigen::Vector3f& point) {
  const Eigen::Vector3i cell = voxel_of((point / edge_).cast<double>());
  const Eigen::Vector3i place = cell.unaryExpr([](int c) { return c >> 2; });
  const std::uint32_t number = table_.insert(voxel_key(place, 0));
  if (number == blocks_.size()) blocks_.push_back({place, SurfaceBlock(point), {}}), blocks_.back().heads.fill(kNone);
  return number;
}

/// A view for this scan, in the room of one that nothing is looked at in any longer.
ScanView& MovingPoints::next_view() {
  const auto old = std::find_if(views_.begin(), views_.end(), [&](const KeptView& kept) {
    return scan_ - kept.scan > std::min(reach_of(kept.scan), scan_) + kDelay;
  });
  if (old == views_.end())
    views_.emplace_back();
  else
    std::rotate(old, old + 1, views_.end());
  views_.back().scan = scan_;
  return views_.back().view;
}

/// Looks at the things that scans up to `scan` saw first, in all that is kept.
void MovingPoints::catch_up(std::uint32_t scan) {
  const std::uint32_t end = scan < scan_ ? first_of_scan_[scan] : std::uint32_t(things_.size());
  if (looked_ == end) return;
  for (std::uint32_t t = looked_; t < end; ++t) things_[t].calm = on_old_plane(things_[t]);
  for (const KeptView& kept : views_) {
    if (kept.scan > scan || scan - kept.scan <= reach_of(kept.scan)) look(kept, looked_, end);
  }
  for (; looked_ < end; ++looked_) {
    if (things_[looked_].last < things_[looked_].born) things_[looked_].meet(things_[looked_].born, options_);
  }
}

/// What a scan says of the things from one number to another; scans must come in their order.
void MovingPoints::look(const KeptView& kept, std::uint32_t from, std::uint32_t to) {
  const bool calm_as_well = kept.scan % kCalmEvery == 0;
  std::array<std::uint32_t, ScanView::kBatch> chosen;
  std::array<Eigen::Vector3f, ScanView::kBatch> places;
  std::array<Glimpse, ScanView::kBatch> seen;
  while (from < to) {
    std::size_t n = 0;
    for (; from < to && n < chosen.size(); ++from) {
      const SeenThing& thing = things_[from];
      if (!thing.gone && (calm_as_well || !thing.calm)) chosen[n] = from, places[n++] = thing.point;
    }
    kept.view.look({places.data(), n}, seen);
    for (std::size_t i = 0; i < n; ++i) note(things_[chosen[i]], kept.scan, seen[i]);
  }
}

void MovingPoints::note(SeenThing& thing, std::uint32_t scan, const Glimpse& seen) {
  if (thing.last < thing.born && scan > thing.born) thing.meet(thing.born, options_);
  if (seen.kind == Glimpse::Kind::met || thing.born == scan) {
    thing.meet(scan, options_);
    if (thing.met >= 2 * options_.firm_hits && thing.between == 0) thing.calm = true;
  } else if (seen.kind == Glimpse::Kind::passed && !grazes(thing, seen.direction)) {
    if (scan < thing.born) thing.free_until = scan;
    thing.pass(tenths_of(seen.miss, float(options_.beam_radius)));
    thing.gone = scan > thing.born && thing.vacated(options_);
  }
}

/// Whether a beam by the thing has nothing to say of it: it grazes the plane that it lies in.
bool MovingPoints::grazes(const SeenThing& thing, const Eigen::Vector3f& direction) const {
  const auto clearance = float(options_.clearance), sine = float(options_.grazing);
  return blocks_[thing.block].surface.grazes(thing.point, direction, clearance, sine) ||
         blocks_[thing.block_below].surface.grazes(thing.point, direction, clearance, sine);
}

bool MovingPoints::on_old_plane(const SeenThing& thing) const {
  const auto thickness = float(options_.thickness);
  return blocks_[thing.block].surface.holds(thing.point, kOldPlane, thickness) ||
         blocks_[thing.block_below].surface.holds(thing.point, kOldPlane, thickness);
}

}  // namespace tilth
