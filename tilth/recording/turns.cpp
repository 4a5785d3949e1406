#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include <tilth/core/turn.hpp>
#include <tilth/recording/turns.hpp>
#include <tilth/sensor/azimuth_arc.hpp>
#include <tilth/sensor/firing_order.hpp>

namespace tilth {
namespace {

constexpr double kGap = 0.75;      ///< of a turn without a part: the next one begins another
constexpr double kSame = 0.3;      ///< of a part's width from the one before: no later part of the same turn
constexpr double kRepeated = 0.1;  ///< of a part's width, and the same stamp: the same part again
constexpr double kComplete = 0.9;  ///< of the parts of a turn
constexpr double kEnough = 0.4;    ///< of them, without which a turn is left out

/// Points `begin` to `end`, whose first lies `later` than the scan's stamp.
Scan part_of(const Scan& scan, std::uint32_t begin, std::uint32_t end, double later) {
  std::vector<std::uint32_t> indices(end - begin);
  std::iota(indices.begin(), indices.end(), begin);
  Scan part{scan.stamp + later, select(scan.cloud, indices)};
  if (!part.cloud.has_times()) return part;
  const float first = part.cloud.times.front();
  for (float& time : part.cloud.times) time -= first;
  part.stamp = scan.stamp + double(first);
  return part;
}

/// `part` with its times counted from `stamp`; where it has none, they are spread over `step` as its points follow.
PointCloud timed_from(Scan part, double stamp, double step) {
  const double later = std::max(0.0, part.stamp - stamp);
  const auto n = double(part.cloud.size());
  if (!part.cloud.has_times()) {
    part.cloud.times.resize(part.cloud.size());
    for (std::size_t i = 0; i < part.cloud.size(); ++i) part.cloud.times[i] = float(step * double(i) / n);
  }
  for (float& time : part.cloud.times) time += float(later);
  return std::move(part.cloud);
}

}  // namespace

Scan in_order_of_time(Scan scan) {
  if (!scan.cloud.has_times()) return scan;
  const std::vector<float>& times = scan.cloud.times;
  if (std::is_sorted(times.begin(), times.end())) return scan;
  std::vector<std::uint32_t> order(times.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return times[a] < times[b]; });
  return {scan.stamp, select(scan.cloud, order)};
}

std::vector<Scan> cut_turns(Scan message, double step) {
  Scan scan = in_order_of_time(std::move(message));
  const auto rotation = find_head_rotation(scan.cloud.points, scan.cloud.rings);
  const auto turns = rotation ? std::size_t(std::lround(rotation->covered() / kTurn)) : 1;
  std::vector<Scan> cut;
  if (turns < 2) {
    cut.push_back(std::move(scan));
    return cut;
  }
  const std::vector<double>& progress = rotation->progress;
  std::uint32_t begin = 0;
  for (std::size_t turn = 1; turn <= turns; ++turn) {
    const double end_angle = rotation->covered() * double(turn) / double(turns);
    const auto end_of_turn = std::lower_bound(progress.begin(), progress.end(), end_angle);
    const auto end = turn == turns ? std::uint32_t(progress.size()) : std::uint32_t(end_of_turn - progress.begin());
    if (end > begin) cut.push_back(part_of(scan, begin, end, step * double(turn - 1) / double(turns)));
    begin = end;
  }
  return cut;
}

std::optional<Scan> TurnAssembler::add(Scan part) {
  const double centre = arc_of(part.cloud.points).centre();
  if (!first_centre_) first_centre_ = centre;
  double phase = std::fmod(plan_.direction * (centre - *first_centre_) + 0.5 * plan_.width, kTurn);
  if (phase < 0.0) phase += kTurn;
  std::optional<Scan> turn;
  if (!parts_.empty() && part.stamp == parts_.back().stamp && std::abs(phase - phase_) < kRepeated * plan_.width) {
    ++repeated_;
    return turn;
  }
  if (begins_turn(phase, part.stamp)) turn = finish();
  parts_.push_back(std::move(part));
  phase_ = phase;
  return turn;
}

bool TurnAssembler::begins_turn(double phase, double stamp) const {
  if (parts_.empty()) return false;
  const double since = stamp - parts_.back().stamp;
  return phase < phase_ + kSame * plan_.width || (plan_.period > 0.0 && since > kGap * plan_.period + plan_.step);
}

std::optional<Scan> TurnAssembler::finish() {
  if (parts_.empty()) return std::nullopt;
  std::vector<Scan> parts = std::exchange(parts_, {});
  const double complete = double(parts.size()) / plan_.messages;
  incomplete_ += complete < kComplete ? 1 : 0;
  if (complete < kEnough) {
    ++left_out_;
    return std::nullopt;
  }
  const bool timed = (plan_.step > 0.0 && !snapshots_) ||
                     std::all_of(parts.begin(), parts.end(), [](const Scan& part) { return part.cloud.has_times(); });
  Scan turn{parts.front().stamp, {}};
  for (Scan& part : parts)
    append(turn.cloud, timed ? timed_from(std::move(part), turn.stamp, plan_.step) : std::move(part.cloud));
  return turn;
}

}  // namespace tilth
