#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include <tilth/sensor/block_decoder.hpp>

namespace tilth {
namespace {

constexpr double kHundredthDegree = std::numbers::pi / 18000.0;
constexpr double kBackwards = 1000.0;  // [0.01 deg] a head at rest may vibrate by less
constexpr double kLeastTurn = 0.5, kWholeTurn = 0.99;
constexpr double kLongestTurn = 1.0;  // [s]
constexpr double kSameHead = 0.3;     // [packets]
constexpr double kPause = 1.0;        // [s]

/// [0.01 deg] from a to b, less than half a turn either way.
double step(double a, double b) {
  return std::remainder(b - a, kAzimuthsATurn);
}

std::optional<double> first_azimuth(const DataPacket& packet) {
  return packet.valid(0) ? std::optional<double>(packet.azimuth(0)) : std::nullopt;
}

PacketClock clock_of(std::span<const Packet> first, const PacketConvention& convention) {
  std::vector<ClockReading> readings;
  for (const Packet& packet : first) {
    if (kind_of(packet.payload) != PacketKind::data) continue;
    const DataPacket data(packet.payload);
    if (&data.layout() == &convention.format.layout())
      readings.push_back(read_clock(data, packet.arrival, convention.clock));
  }
  return {readings, convention.clock.traits};
}

}  // namespace

struct BlockDecoder::Column {
  std::size_t index;     // in the packet
  double azimuth, step;  // [0.01 deg] and to the next column
  double time;           // [s] of its first shot
};

BlockDecoder::BlockDecoder(std::span<const Packet> first, const PacketOptions& options, const SensorFile& file)
    : convention_(recognise_packets(first, options.sensor, file)),
      echoes_(options.echoes),
      clock_(clock_of(first, convention_)),
      geometry_(convention_.format) {
  decisions_ = convention_.decisions;
  decisions_.push_back(clock_.decision());
  for (std::size_t shot = 0; shot < format().layout().column_shots(); ++shot)
    shot_times_.push_back(format().shot_time(shot));
  shot_order_.resize(shot_times_.size());
  std::iota(shot_order_.begin(), shot_order_.end(), std::size_t{0});
  std::stable_sort(shot_order_.begin(), shot_order_.end(),
                   [&](std::size_t a, std::size_t b) { return shot_times_[a] < shot_times_[b]; });
}

std::optional<Scan> BlockDecoder::decode(const Packet& packet) {
  const PacketKind kind = kind_of(packet.payload);
  counts_.device += kind == PacketKind::device ? 1 : 0;
  counts_.position += kind == PacketKind::position ? 1 : 0;
  counts_.other += kind == PacketKind::other ? 1 : 0;
  if (kind == PacketKind::position) position_ = parse_position_packet(packet.payload);
  if (kind != PacketKind::data) return std::nullopt;
  const DataPacket data(packet.payload);
  if (&data.layout() != &format().layout()) {
    ++counts_.other;
    return std::nullopt;
  }
  ++counts_.data;
  ClockReading reading = read_clock(data, packet.arrival, convention_.clock);
  reading.next_head = is_next_head(data);
  const std::optional<double> time = clock_.time(reading);
  counts_.clock_jumps = clock_.jumps(), counts_.receiver_jumps = clock_.receiver_jumps();
  const double before = format().stamp_offset(data.dual());
  if (!time || (head_ && *time - before <= head_->time)) {
    ++counts_.late;
    return std::nullopt;
  }
  return decode_data(data, *time - before);
}

/// Whether the packet begins where the head stands one packet after the last; nothing where that is not known.
std::optional<bool> BlockDecoder::is_next_head(const DataPacket& packet) const {
  const std::optional<double> first = first_azimuth(packet);
  const double advance = mean_step_ * double(packet.columns());
  if (!first || !first_azimuth_ || advance <= 0.0) return std::nullopt;
  return std::abs(step(*first_azimuth_ + advance, *first)) < kSameHead * advance;
}

/// Packets between the last one and this, whose first shot is at `first_shot` [s].
void BlockDecoder::count_missing(const DataPacket& packet, double first_shot) {
  const double gap = last_packet_ ? first_shot - *last_packet_ : 0.0;
  if (gap >= kPause) {
    ++counts_.pauses;
    counts_.longest_pause = std::max(counts_.longest_pause, gap);
  } else if (const double packets = std::round(gap / format().packet_period(last_dual_)); packets > 1.0) {
    missing_.add(head_ ? head_->azimuth : 0.0, std::size_t(packets) - 1);
    counts_.lost = missing_.lost(), counts_.unsent = missing_.unsent();
  } else if (first_azimuth_ && packet.columns() == 1 && packet.valid(0)) {
    mean_step_ = step(*first_azimuth_, packet.azimuth(0));
  }
  last_packet_ = first_shot;
  last_dual_ = packet.dual();
  first_azimuth_ = first_azimuth(packet);
}

std::optional<Scan> BlockDecoder::decode_data(const DataPacket& packet, double first_shot) {
  count_missing(packet, first_shot);
  std::optional<Scan> closed;
  double turned = 0.0, steps = 0.0;  // by the columns so far: the last one has no next
  for (std::size_t column = 0; column < packet.columns(); ++column) {
    if (!packet.valid(column)) continue;
    const double azimuth = packet.azimuth(column), time = first_shot + double(column) * format().column_period();
    const std::size_t next = column + 1;
    const bool followed = next < packet.columns() && packet.valid(next);
    if (followed) turned += step(azimuth, packet.azimuth(next)), steps += 1.0;
    if (steps > 0.0) mean_step_ = turned / steps;
    const double turn = followed ? step(azimuth, packet.azimuth(next)) : mean_step_;
    std::optional<Scan> scan = turn_to(azimuth, time);
    if (scan && !closed) closed = std::move(scan);
    add_column(packet, {column, azimuth, turn, time});
  }
  return closed;
}

/// Goes on to a column at `azimuth`; the scan before it where a new one begins there.
std::optional<Scan> BlockDecoder::turn_to(double azimuth, double time) {
  std::optional<Scan> closed;
  if (head_) {
    const double forward = azimuth - head_->azimuth;
    const double expected = head_->time > begun_ ? turned_ / (head_->time - begun_) * (time - head_->time) : 0.0;
    const bool wraps = forward < -kBackwards || expected - forward > 0.5 * kAzimuthsATurn;
    turned_ += std::max(0.0, wraps && forward < 0.0 ? forward + kAzimuthsATurn : forward);
    if (wraps || time - begun_ > kLongestTurn) {
      closed = close(kLeastTurn);
      turned_ = 0.0, begun_ = time;
    }
  } else {
    begun_ = time;
  }
  head_ = {azimuth, time};
  return closed;
}

void BlockDecoder::add_column(const DataPacket& packet, const Column& column) {
  for (const std::size_t shot : shot_order_) {
    const PacketEcho first = packet.echo(column.index, 0, shot);
    const PacketEcho second = packet.dual() ? packet.echo(column.index, 1, shot) : PacketEcho{};
    const EchoChoice chosen = choose_echoes(echoes_, {double(first.distance), float(first.intensity)},
                                            {double(second.distance), float(second.intensity)});
    if (chosen.first) add_point(column, shot, first);
    if (chosen.second) add_point(column, shot, second);
  }
}

void BlockDecoder::add_point(const Column& column, std::size_t shot, const PacketEcho& echo) {
  const std::size_t channel = shot % format().channels();
  const double ratio = shot_times_[shot] / format().column_period();
  const double azimuth = (column.azimuth + column.step * ratio) * kHundredthDegree;
  PointCloud& cloud = open_.cloud;
  const double time = column.time + shot_times_[shot];
  if (cloud.empty()) open_.stamp = time;
  cloud.points.push_back(geometry_.point(channel, azimuth, echo.distance * format().unit));
  cloud.times.push_back(float(time - open_.stamp));
  cloud.rings.push_back(format().rings[channel]);
  cloud.intensities.push_back(echo.intensity);
}

/// The open scan, where it turned so far and has points; a new one is opened.
std::optional<Scan> BlockDecoder::close(double least_turn) {
  Scan scan = std::exchange(open_, Scan{});
  if (turned_ < least_turn * kAzimuthsATurn || scan.cloud.empty()) {
    ++counts_.incomplete;
    return std::nullopt;
  }
  return scan;
}

std::optional<Scan> BlockDecoder::finish() {
  if (open_.cloud.empty()) return std::nullopt;
  return close(kWholeTurn);
}

}  // namespace tilth
