// Packets of an Ouster sensor as scans: turns by the number that the sensor gives them. The frame is Ouster's Lidar
// frame: x towards the connector (the head's angle 0), z up, on the axis, at the height of the optics.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <tilth/sensor/ouster_packet.hpp>
#include <tilth/sensor/packet_clock.hpp>
#include <tilth/sensor/packet_decoder.hpp>

namespace tilth {

class OusterDecoder : public PacketDecoder {
 public:
  /// `file` holds the sensor's metadata. Throws Error naming it where no packet has the length that it asks for.
  OusterDecoder(std::span<const Packet> first, const PacketOptions& options, const SensorFile& file);

  std::optional<Scan> decode(const Packet& packet) override;
  std::optional<Scan> finish() override;
  std::size_t rings() const override { return metadata_.rows(); }
  bool clock_runs_free() const override { return clock_->runs_free(); }

 private:
  /// A column of a turn.
  struct Place {
    std::uint16_t frame = 0;
    std::size_t measurement = 0;
  };
  struct Column {
    std::size_t index;  // in the packet
    Place place;
    double time;  // [s]
  };
  std::optional<std::size_t> first_valid(const OusterPacket& packet) const;
  bool later(const Place& place) const;
  std::size_t columns_before(const Place& next) const;
  void count_missing(const Place& next, double time);
  std::optional<Scan> add_columns(const OusterPacket& packet, std::size_t first, double time);
  void add_column(const OusterPacket& packet, const Column& column);
  std::optional<Scan> close(double least_turn);
  void decide(const std::string& file);

  OusterMetadata metadata_;
  Echoes echoes_;
  std::vector<std::uint16_t> rings_;         // of each row, 0 the lowest
  std::vector<Eigen::Vector3d> directions_;  // of each row with the head at angle 0
  std::optional<PacketClock> clock_;
  std::optional<Place> last_;  // column seen last
  double last_time_ = 0.0;     // [s] of that
  Scan open_;
  std::size_t open_columns_ = 0;
};

}  // namespace tilth
