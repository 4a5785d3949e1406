// Packets that hold blocks of an azimuth and the shots there, as Velodyne's do: scans, cut where the azimuth wraps. The
// frame is x forward (azimuth 0), y left, z up, on the axis of rotation. About 2 ms a scan of 28,800 shots.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <tilth/sensor/laser_geometry.hpp>
#include <tilth/sensor/missing_packets.hpp>
#include <tilth/sensor/packet_clock.hpp>
#include <tilth/sensor/packet_decoder.hpp>
#include <tilth/sensor/recognise_packets.hpp>

namespace tilth {

class BlockDecoder : public PacketDecoder {
 public:
  /// Throws Error as recognise_packets.
  BlockDecoder(std::span<const Packet> first, const PacketOptions& options, const SensorFile& file = {});

  std::optional<Scan> decode(const Packet& packet) override;
  std::optional<Scan> finish() override;
  std::size_t rings() const override { return format().channels(); }
  bool clock_runs_free() const override { return clock_.runs_free(); }
  const PacketFormat& format() const { return convention_.format; }

 private:
  struct Head {
    double azimuth, time;  // [0.01 deg] [s] of a column
  };
  struct Column;
  std::optional<bool> is_next_head(const DataPacket& packet) const;
  void count_missing(const DataPacket& packet, double first_shot);
  std::optional<Scan> decode_data(const DataPacket& packet, double first_shot);
  std::optional<Scan> turn_to(double azimuth, double time);
  void add_column(const DataPacket& packet, const Column& column);
  void add_point(const Column& column, std::size_t shot, const PacketEcho& echo);
  std::optional<Scan> close(double least_turn);

  PacketConvention convention_;
  Echoes echoes_;
  PacketClock clock_;
  LaserGeometry geometry_;
  std::vector<double> shot_times_;       // [s] of a column
  std::vector<std::size_t> shot_order_;  // by time
  MissingPackets missing_;
  std::optional<double> first_azimuth_;  // [0.01 deg] of the last packet
  std::optional<double> last_packet_;    // [s] first shot
  bool last_dual_ = false;
  double mean_step_ = 0.0;  // [0.01 deg] from column to column
  Scan open_;
  double turned_ = 0.0;  // [0.01 deg] since the open scan began
  double begun_ = 0.0;   // [s] when it did
  std::optional<Head> head_;
};

}  // namespace tilth
