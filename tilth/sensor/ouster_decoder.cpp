#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <numeric>
#include <utility>

#include <tilth/core/error.hpp>
#include <tilth/sensor/clock_convention.hpp>
#include <tilth/sensor/ouster_decoder.hpp>

namespace tilth {
namespace {

constexpr double kLeastTurn = 0.5, kWholeTurn = 0.99;
constexpr double kPause = 1.0;                           // [s]
constexpr std::uint64_t kLongestPacket = 1'000'000'000;  // [ns] between its columns

double seconds_of(std::uint64_t nanoseconds) {
  constexpr std::uint64_t kSecond = 1'000'000'000;
  return double(nanoseconds / kSecond) + double(nanoseconds % kSecond) * 1e-9;
}

std::vector<std::uint16_t> rings_of(const std::vector<double>& altitudes) {
  std::vector<std::size_t> order(altitudes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return altitudes[a] < altitudes[b]; });
  std::vector<std::uint16_t> rings(order.size());
  for (std::size_t ring = 0; ring < order.size(); ++ring) rings[order[ring]] = std::uint16_t(ring);
  return rings;
}

template <class... A>
std::string text(const char* format, A... values) {
  std::array<char, 200> line{};
  std::snprintf(line.data(), line.size(), format, values...);
  return line.data();
}

}  // namespace

OusterDecoder::OusterDecoder(std::span<const Packet> first, const PacketOptions& options, const SensorFile& file)
    : metadata_(file.ouster.value()), echoes_(options.echoes), rings_(rings_of(metadata_.altitudes)) {
  for (std::size_t row = 0; row < metadata_.rows(); ++row) {
    const double up = metadata_.altitudes[row], aside = -metadata_.azimuths[row];
    directions_.emplace_back(std::cos(aside) * std::cos(up), std::sin(aside) * std::cos(up), std::sin(up));
  }
  std::vector<ClockReading> readings;
  bool other_start = false;
  for (const Packet& packet : first) {
    if (packet.payload.size() != packet_size(metadata_)) continue;
    const OusterPacket columns(packet.payload, metadata_);
    if (readings.empty()) require_same_sensor(columns, metadata_, file.name);
    other_start = metadata_.start != 0 && columns.start() != 0 && columns.start() != metadata_.start;
    if (const auto valid = first_valid(columns))
      readings.push_back({seconds_of(columns.timestamp(*valid)), packet.arrival});
  }
  if (readings.empty()) {
    throw Error(file.name, "is of another sensor or setting: a packet of " + std::string(name_of(metadata_.profile)) +
                               " with " + std::to_string(metadata_.rows()) + " beams has " +
                               std::to_string(packet_size(metadata_)) + " bytes, and here is none that was measured");
  }
  ClockTraits traits;
  traits.step = double(metadata_.columns_a_packet) * metadata_.column_period();
  traits.absolute = readings.front().sensor > kEarliestClock && readings.front().sensor < kLatestClock;
  clock_.emplace(readings, traits);
  decide(file.name);
  if (other_start)
    decisions_.push_back(file.name + ": of another start of the sensor, whose settings may have changed");
}

void OusterDecoder::decide(const std::string& file) {
  const OusterMetadata& m = metadata_;
  decisions_.push_back("sensor: Ouster " + m.product + " (ouster), serial " + m.serial + ", firmware " + m.firmware +
                       text(", %zu columns a turn, %g turns a second, packets of ", m.columns, m.rate) +
                       std::string(name_of(m.profile)));
  decisions_.emplace_back(m.profile == OusterProfile::dual ? "returns: two a shot" : "returns: one a shot");
  decisions_.push_back(text("ring: of the beam, 0 the lowest of %zu; angles of the unit itself, from ", m.rows()) +
                       file);
  if (m.window_size() < m.columns)
    decisions_.push_back(text("view: cropped by the sensor to its columns %zu to %zu", m.window_begin, m.window_end));
  decisions_.emplace_back("time: of each column, as the sensor stamps it");
  const Eigen::Vector3d& t = m.T_sensor_lidar.translation();
  decisions_.push_back(
      text("frame: Ouster's Lidar frame, x towards the connector; its origin is at %.4g, %.4g, %.4g m of "
           "the Sensor frame, which looks the other way",
           t.x(), t.y(), t.z()));
  decisions_.push_back(clock_->decision());
}

std::optional<Scan> OusterDecoder::decode(const Packet& packet) {
  if (packet.payload.size() != packet_size(metadata_) || kind_of(packet.payload) != PacketKind::ouster) {
    ++counts_.other;
    return std::nullopt;
  }
  ++counts_.data;
  const OusterPacket columns(packet.payload, metadata_);
  const std::optional<std::size_t> first = first_valid(columns);
  if (!first) return std::nullopt;  // outside of the sensor's window
  const Place place{columns.frame(*first), columns.measurement(*first)};
  ClockReading reading{seconds_of(columns.timestamp(*first)), packet.arrival, std::nullopt};
  if (last_) reading.next_head = later(place) && columns_before(place) == 0;
  const std::optional<double> time = later(place) ? clock_->time(reading) : std::nullopt;
  counts_.clock_jumps = clock_->jumps(), counts_.receiver_jumps = clock_->receiver_jumps();
  if (!time || (last_ && *time <= last_time_)) {
    ++counts_.late;
    return std::nullopt;
  }
  count_missing(place, *time);
  return add_columns(columns, *first, *time);
}

std::optional<std::size_t> OusterDecoder::first_valid(const OusterPacket& packet) const {
  for (std::size_t column = 0; column < packet.columns(); ++column) {
    if (packet.valid(column)) return column;
  }
  return std::nullopt;
}

/// Whether it comes after the last column: the number of the turn wraps at 65536.
bool OusterDecoder::later(const Place& place) const {
  if (!last_) return true;
  const auto turns = std::int16_t(std::uint16_t(place.frame - last_->frame));
  return turns > 0 || (turns == 0 && place.measurement > last_->measurement);
}

/// Columns of the sensor's window between the last one and `next`, which comes later.
std::size_t OusterDecoder::columns_before(const Place& next) const {
  std::size_t missing = 0;
  std::size_t turns = std::uint16_t(next.frame - last_->frame);
  std::size_t at = last_->measurement + 1;
  if (turns > 1) missing += (turns - 1) * metadata_.window_size(), turns = 1;
  for (; turns == 1 && at < metadata_.columns; ++at) missing += metadata_.in_window(at) ? 1 : 0;
  if (turns == 1) at = 0;
  for (; at < next.measurement; ++at) missing += metadata_.in_window(at) ? 1 : 0;
  return missing;
}

void OusterDecoder::count_missing(const Place& next, double time) {
  if (!last_) return;
  if (const double gap = time - last_time_; gap >= kPause) {
    ++counts_.pauses;
    counts_.longest_pause = std::max(counts_.longest_pause, gap);
    return;
  }
  counts_.lost += (columns_before(next) + metadata_.columns_a_packet / 2) / metadata_.columns_a_packet;
}

std::optional<Scan> OusterDecoder::add_columns(const OusterPacket& packet, std::size_t first, double time) {
  std::optional<Scan> closed;
  for (std::size_t column = first; column < packet.columns(); ++column) {
    const Place place{packet.frame(column), packet.measurement(column)};
    const std::uint64_t since = packet.timestamp(column) - packet.timestamp(first);
    if (!packet.valid(column) || !later(place) || since > kLongestPacket) continue;
    if (last_ && place.frame != last_->frame && !closed) closed = close(kLeastTurn);
    last_ = place, last_time_ = time + double(since) * 1e-9;
    add_column(packet, {column, place, last_time_});
  }
  return closed;
}

void OusterDecoder::add_column(const OusterPacket& packet, const Column& column) {
  const double angle = -2 * std::numbers::pi * double(column.place.measurement) / double(metadata_.columns);
  const Eigen::Matrix3d R_lidar_head = Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  const double to_beam = metadata_.beam_origin.norm();
  ++open_columns_;
  const auto add = [&](std::size_t row, const OusterPixel& pixel) {
    if (open_.cloud.empty()) open_.stamp = column.time;
    open_.cloud.points.push_back(R_lidar_head * (directions_[row] * (pixel.range - to_beam) + metadata_.beam_origin));
    open_.cloud.times.push_back(float(column.time - open_.stamp));
    open_.cloud.rings.push_back(rings_[row]);
    open_.cloud.intensities.push_back(pixel.intensity);
  };
  for (std::size_t row = 0; row < metadata_.rows(); ++row) {
    const OusterPixel first = packet.pixel(column.index, row, 0);
    const bool dual = metadata_.profile == OusterProfile::dual;
    const OusterPixel second = dual ? packet.pixel(column.index, row, 1) : OusterPixel{};
    const EchoChoice chosen = choose_echoes(echoes_, {first.range, first.intensity}, {second.range, second.intensity});
    if (chosen.first) add(row, first);
    if (chosen.second) add(row, second);
  }
}

/// The open scan, where so much of the sensor's view is in it; a new one is opened.
std::optional<Scan> OusterDecoder::close(double least_turn) {
  Scan scan = std::exchange(open_, Scan{});
  const double turned = double(std::exchange(open_columns_, 0)) / double(metadata_.window_size());
  if (turned >= least_turn && !scan.cloud.empty()) return scan;
  ++counts_.incomplete;
  return std::nullopt;
}

std::optional<Scan> OusterDecoder::finish() {
  if (open_.cloud.empty()) return std::nullopt;
  return close(kWholeTurn);
}

}  // namespace tilth
