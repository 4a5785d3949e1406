#include <algorithm>
#include <bit>
#include <cmath>

#include <tilth/freespace/scan_view.hpp>

namespace tilth {
namespace {

constexpr float kQuarter = 16384, kRangeUnit = 0.004F;  // units of a quarter of a turn, [m]
constexpr int kCellBits = 6;                            // of azimuth
constexpr int kMostCells = 1;                           // to either side that are searched
constexpr int kSortBits = 5;                            // of elevation, that beams are not sorted by
constexpr int kSorted = (1 << kSortBits) - 1;
constexpr int kSteps = 1025;  // of elevation, from straight down to straight up
constexpr float kTiny = 1e-20F;
constexpr float kSteep = 0.3F;  // [m] over the ground within which azimuths tell nothing

/// A measure of an angle between -2 and 2 that grows with it and needs no trigonometry: (x, y) moved along its ray onto
/// the square |x| + |y| = 1.
inline float square_angle(float y, float x) {
  const float along = x / (std::abs(x) + std::abs(y) + kTiny);
  return std::copysign(1 - along, y);
}

/// Sorts by key(item), keeping the order of equals; `begins` of each key, and the end.
template <class Key>
void counting_sort(std::span<const PackedBeam> items, std::span<PackedBeam> sorted, std::span<std::uint32_t> begins,
                   const Key& key) {
  std::fill(begins.begin(), begins.end(), 0);
  for (const PackedBeam& item : items) ++begins[key(item) + 1];
  for (std::size_t i = 1; i < begins.size(); ++i) begins[i] += begins[i - 1];
  for (const PackedBeam& item : items) sorted[begins[key(item)]++] = item;
  for (std::size_t i = begins.size() - 1; i > 0; --i) begins[i] = begins[i - 1];
  begins[0] = 0;
}

/// Whether a beam is among about `n` of `of` that lie evenly among them, whatever their order.
bool is_chosen(std::size_t beam, std::size_t n, std::size_t of) {
  return n >= of || std::uint32_t(beam) * 2654435761U < std::uint32_t(4294967295.0 * double(n) / double(of));
}

}  // namespace

/// Where places lie as seen by the scan.
struct ScanView::Aims {
  std::array<float, kBatch> x, y, z, rough;                // [m] from where the sensor was then; distance to its middle
  std::array<float, kBatch> level, range;                  // [m]
  std::array<float, kBatch> azimuth, elevation;            // units
  std::array<float, kBatch> azimuth_step, elevation_step;  // [m] a unit
};

struct ScanView::Search {
  float range, azimuth_step, elevation_step;  // [m], [m] a unit
  int azimuth, elevation, aside, up;          // units; farthest that is sought
  Eigen::Vector3f way;
};

void ScanView::take(const SeenScan& scan, const MovingOptions& options, ViewWorkspace& work) {
  radius_ = float(options.beam_radius), near_ = float(options.near), reach_ = float(options.reach);
  margin_ = float(options.margin), met_ = float(options.met);
  origins_ = scan.origins;
  place_ = scan.place();
  work.beams.clear();
  std::array<bool, kCells> known{};
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    if (!is_chosen(i, options.most_beams, scan.points.size())) continue;
    const Eigen::Vector3f way = scan.points[i] - origins_[scan.origin_of[i]];
    const float level = way.head<2>().norm(), range = way.norm() / kRangeUnit;
    if (!(range < 65535.0F) || !(level > 0)) continue;
    const auto azimuth = std::uint16_t(int(kQuarter * square_angle(way.y(), way.x())));
    const auto elevation = std::uint16_t(kQuarter * (1 + way.z() / (level + std::abs(way.z()))));
    work.beams.push_back({azimuth, elevation, std::uint16_t(range)});
    origin_of_[azimuth >> kCellBits] = scan.origin_of[i];
    known[azimuth >> kCellBits] = true;
  }
  fill_origins(known);
  work.sorted.resize(work.beams.size()), beams_.resize(work.beams.size());
  std::array<std::uint32_t, kSteps + 1> steps;
  counting_sort(work.beams, work.sorted, steps,
                [](const PackedBeam& b) { return std::size_t(b.elevation >> kSortBits); });
  counting_sort(work.sorted, beams_, begins_, [](const PackedBeam& b) { return std::size_t(b.azimuth >> kCellBits); });
  index_levels();
}

/// Cells without beams take the origin of the one before them.
void ScanView::fill_origins(const std::array<bool, kCells>& known) {
  const auto first = std::find(known.begin(), known.end(), true);
  if (first == known.end()) return;
  const auto begin = std::size_t(first - known.begin());
  for (std::size_t i = begin + 1; i < begin + kCells; ++i) {
    if (!known[i % kCells]) origin_of_[i % kCells] = origin_of_[(i - 1) % kCells];
  }
}

int ScanView::level_of(float elevation) const {
  return std::clamp(int((elevation - lowest_) * levels_a_unit_), 0, 64 * kWords - 1);
}

/// Marks the levels that have beams; they lie evenly between the lowest and the highest beam.
void ScanView::index_levels() {
  occupied_.fill({});
  if (beams_.empty()) return;
  const auto [low, high] = std::minmax_element(
      beams_.begin(), beams_.end(), [](const PackedBeam& a, const PackedBeam& b) { return a.elevation < b.elevation; });
  lowest_ = float(low->elevation);
  levels_a_unit_ = 64 * kWords / (float(high->elevation - low->elevation) + 1);
  for (const PackedBeam& beam : beams_) {
    const int level = level_of(beam.elevation);
    occupied_[beam.azimuth >> kCellBits][std::size_t(level >> 6)] |= std::uint64_t{1} << (level & 63);
  }
}

void ScanView::aim(std::span<const Eigen::Vector3f> places, Aims& a) const {
  for (std::size_t i = 0; i < places.size(); ++i)
    a.x[i] = places[i].x(), a.y[i] = places[i].y(), a.z[i] = places[i].z();
  std::array<int, kBatch> cell;
  for (std::size_t i = 0; i < kBatch; ++i) {
    const float x = a.x[i] - place_.x(), y = a.y[i] - place_.y(), z = a.z[i] - place_.z();
    a.rough[i] = x * x + y * y + z * z;
    cell[i] = int(kQuarter * square_angle(y, x)) >> kCellBits & (kCells - 1);
  }
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Eigen::Vector3f& origin = origins_[origin_of_[std::size_t(cell[i])]];
    a.x[i] -= origin.x(), a.y[i] -= origin.y(), a.z[i] -= origin.z();
  }
  for (std::size_t i = 0; i < kBatch; ++i) {
    const float level = std::sqrt(a.x[i] * a.x[i] + a.y[i] * a.y[i]);
    const float range = std::sqrt(level * level + a.z[i] * a.z[i]);
    const float wide = std::abs(a.x[i]) + std::abs(a.y[i]), high = level + std::abs(a.z[i]);
    a.level[i] = level, a.range[i] = range;
    a.azimuth[i] = kQuarter * square_angle(a.y[i], a.x[i]);
    a.elevation[i] = kQuarter * (1 + a.z[i] / high);
    a.azimuth_step[i] = wide * wide / (level * kQuarter);
    a.elevation_step[i] = high * high / (range * kQuarter);
  }
}

void ScanView::look(std::span<const Eigen::Vector3f> places, std::span<Glimpse> seen) const {
  Aims a{};
  aim(places, a);
  for (std::size_t i = 0; i < places.size(); ++i) {
    seen[i] = {};
    if (!(a.rough[i] < reach_ * reach_) || a.rough[i] < near_ * near_ || a.level[i] < kSteep) continue;
    const int most = kMostCells << kCellBits;
    seen[i] = look(Search{a.range[i],
                          a.azimuth_step[i],
                          a.elevation_step[i],
                          int(a.azimuth[i]),
                          int(a.elevation[i]),
                          std::min(int(radius_ / a.azimuth_step[i]), most),
                          int(radius_ / a.elevation_step[i]),
                          {a.x[i], a.y[i], a.z[i]}});
  }
}

bool ScanView::has_beams(std::size_t cell, int low, int high) const {
  const std::array<std::uint64_t, kWords>& words = occupied_[cell];
  const std::uint64_t from = ~std::uint64_t{0} << (low & 63), to = ~std::uint64_t{0} >> (63 - (high & 63));
  const auto first = std::size_t(low >> 6), last = std::size_t(high >> 6);
  return first == last ? (words[first] & from & to) != 0 : ((words[first] & from) | (words[last] & to)) != 0;
}

Glimpse ScanView::look(const Search& sought) const {
  Glimpse best;
  best.miss = radius_;
  const int low = level_of(float(sought.elevation - sought.up)), high = level_of(float(sought.elevation + sought.up));
  const int last = (sought.azimuth + sought.aside) >> kCellBits;
  for (int i = (sought.azimuth - sought.aside) >> kCellBits; i <= last && best.kind != Glimpse::Kind::met; ++i) {
    const auto cell = std::size_t(i & (kCells - 1));
    if (has_beams(cell, low, high)) search(sought, cell, best);
  }
  return best;
}

void ScanView::search(const Search& sought, std::size_t cell, Glimpse& best) const {
  const PackedBeam* beam = beams_.data() + begins_[cell];
  const PackedBeam* const end = beams_.data() + begins_[cell + 1];
  const int low = sought.elevation - sought.up, high = sought.elevation + sought.up;
  while (beam != end && beam->elevation < low) ++beam;
  for (; beam != end && beam->elevation <= high + kSorted; ++beam) {
    const float aside = float(std::int16_t(beam->azimuth - sought.azimuth)) * sought.azimuth_step;
    const float up = float(beam->elevation - sought.elevation) * sought.elevation_step;
    const float miss = aside * aside + up * up, behind = float(beam->range) * kRangeUnit - sought.range;
    if (miss > radius_ * radius_) continue;
    if (std::abs(behind) < met_) {
      best.kind = Glimpse::Kind::met;
      return;
    }
    if (behind < margin_ || miss > best.miss * best.miss) continue;
    best = {Glimpse::Kind::passed, std::sqrt(miss), sought.way / sought.range};
  }
}

}  // namespace tilth
