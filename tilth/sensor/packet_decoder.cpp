#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <tilth/sensor/packet_decoder.hpp>

namespace tilth {
namespace {

constexpr std::array<std::string_view, 3> kEchoes{"both", "strongest", "farthest"};
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
    if (data.size() == convention.format.layout().size)
      readings.push_back(read_clock(data, packet.arrival, convention.clock));
  }
  return {readings, convention.clock.traits};
}

}  // namespace

std::span<const std::string_view> names_of(Echoes) {
  return kEchoes;
}

struct PacketDecoder::Column {
  std::size_t block;     // the first of one or two
  std::size_t echoes;    // blocks
  double azimuth, step;  // [0.01 deg] and to the next column
  double time;           // [s] of its first shot
};

PacketDecoder::PacketDecoder(std::span<const Packet> first, const PacketOptions& options)
    : convention_(recognise_packets(first, options.sensor)),
      echoes_(options.echoes),
      clock_(clock_of(first, convention_)),
      decisions_(convention_.decisions) {
  decisions_.push_back(clock_.decision());
  for (const double elevation : format().elevations) {
    cosines_.push_back(std::cos(elevation));
    sines_.push_back(std::sin(elevation));
  }
  for (std::size_t slot = 0; slot < format().layout().slots; ++slot) slot_times_[slot] = format().slot_time(slot);
}

std::optional<Scan> PacketDecoder::decode(const Packet& packet) {
  const PacketKind kind = kind_of(packet.payload);
  counts_.device += kind == PacketKind::device ? 1 : 0;
  counts_.position += kind == PacketKind::position ? 1 : 0;
  counts_.other += kind == PacketKind::other ? 1 : 0;
  if (kind == PacketKind::position) position_ = parse_position_packet(packet.payload);
  if (kind != PacketKind::data) return std::nullopt;
  const DataPacket data(packet.payload);
  if (data.size() != format().layout().size) {
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
std::optional<bool> PacketDecoder::is_next_head(const DataPacket& packet) const {
  const std::optional<double> first = first_azimuth(packet);
  const double advance = mean_step_ * double(packet.blocks() / (packet.dual() ? 2 : 1));
  if (!first || !first_azimuth_ || advance <= 0.0) return std::nullopt;
  return std::abs(step(*first_azimuth_ + advance, *first)) < kSameHead * advance;
}

/// Packets between the last one and this, whose first shot is at `first_shot` [s].
void PacketDecoder::count_missing(const DataPacket& packet, double first_shot) {
  const double gap = last_packet_ ? first_shot - *last_packet_ : 0.0;
  if (gap >= kPause) {
    ++counts_.pauses;
    counts_.longest_pause = std::max(counts_.longest_pause, gap);
  } else if (const double packets = std::round(gap / format().packet_period(last_dual_)); packets > 1.0) {
    missing_.add(head_ ? head_->azimuth : 0.0, std::size_t(packets) - 1);
    counts_.lost = missing_.lost(), counts_.unsent = missing_.unsent();
  }
  last_packet_ = first_shot;
  last_dual_ = packet.dual();
  first_azimuth_ = first_azimuth(packet);
}

std::optional<Scan> PacketDecoder::decode_data(const DataPacket& packet, double first_shot) {
  count_missing(packet, first_shot);
  const std::size_t echoes = packet.dual() ? 2 : 1;
  std::optional<Scan> closed;
  double turned = 0.0, steps = 0.0;  // by the columns so far: the last one has no next
  for (std::size_t block = 0; block < packet.blocks(); block += echoes) {
    if (!packet.valid(block)) continue;
    const double azimuth = packet.azimuth(block), time = first_shot + double(block / echoes) * format().block_period();
    const std::size_t next = block + echoes;
    const bool followed = next < packet.blocks() && packet.valid(next);
    if (followed) turned += step(azimuth, packet.azimuth(next)), steps += 1.0;
    if (steps > 0.0) mean_step_ = turned / steps;
    const double turn = followed ? step(azimuth, packet.azimuth(next)) : mean_step_;
    std::optional<Scan> scan = turn_to(azimuth, time);
    if (scan && !closed) closed = std::move(scan);
    add_column(packet, {block, echoes, azimuth, turn, time});
  }
  return closed;
}

/// Goes on to a column at `azimuth`; the scan before it where a new one begins there.
std::optional<Scan> PacketDecoder::turn_to(double azimuth, double time) {
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

void PacketDecoder::add_column(const DataPacket& packet, const Column& column) {
  for (std::size_t slot = 0; slot < packet.slots(); ++slot) {
    const std::uint16_t first = packet.distance(column.block, slot);
    const float first_intensity = packet.intensity(column.block, slot);
    const bool two = column.echoes == 2 && packet.valid(column.block + 1);
    const std::uint16_t second = two ? packet.distance(column.block + 1, slot) : std::uint16_t(0);
    const float second_intensity = two ? float(packet.intensity(column.block + 1, slot)) : 0.0F;
    const bool differ = first != 0 && second != 0 && first != second;
    const bool second_wins = echoes_ == Echoes::farthest ? second > first : second_intensity > first_intensity;
    const bool want_first = first != 0 && (!differ || echoes_ == Echoes::both || !second_wins);
    const bool want_second = second != 0 && second != first && (!differ || echoes_ == Echoes::both || second_wins);
    if (want_first) add_point(column, slot, first * format().unit, first_intensity);
    if (want_second) add_point(column, slot, second * format().unit, second_intensity);
  }
}

void PacketDecoder::add_point(const Column& column, std::size_t slot, double range, float intensity) {
  const std::size_t channel = slot % format().channels();
  const double ratio = slot_times_[slot] / format().block_period();
  const double azimuth = (column.azimuth + column.step * ratio) * kHundredthDegree;
  const double across = range * cosines_[channel], behind = azimuth - format().centre_angle;
  const double x = across * std::cos(azimuth) + format().centre_radius * std::cos(behind);
  const double y = -across * std::sin(azimuth) - format().centre_radius * std::sin(behind);
  PointCloud& cloud = open_.cloud;
  const double time = column.time + slot_times_[slot];
  if (cloud.empty()) open_.stamp = time;
  cloud.points.emplace_back(x, y, range * sines_[channel]);
  cloud.times.push_back(float(time - open_.stamp));
  cloud.rings.push_back(format().rings[channel]);
  cloud.intensities.push_back(intensity);
}

/// The open scan, where it turned so far and has points; a new one is opened.
std::optional<Scan> PacketDecoder::close(double least_turn) {
  Scan scan = std::exchange(open_, Scan{});
  if (turned_ < least_turn * kAzimuthsATurn || scan.cloud.empty()) {
    ++counts_.incomplete;
    return std::nullopt;
  }
  return scan;
}

std::optional<Scan> PacketDecoder::finish() {
  if (open_.cloud.empty()) return std::nullopt;
  return close(kWholeTurn);
}

}  // namespace tilth
