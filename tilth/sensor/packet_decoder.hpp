// Packets in, scans out: every shot with its ring, time and intensity, cut where the azimuth wraps. The frame is x
// forward (azimuth 0), y left, z up, on the axis of rotation. About 2 ms a scan of 28,800 shots.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <tilth/core/options.hpp>
#include <tilth/core/scan.hpp>
#include <tilth/sensor/device_packet.hpp>
#include <tilth/sensor/missing_packets.hpp>
#include <tilth/sensor/packet_clock.hpp>
#include <tilth/sensor/recognise_packets.hpp>

namespace tilth {

/// Which echoes of a shot become points, where the sensor reports two.
enum class Echoes { both, strongest, farthest };
std::span<const std::string_view> names_of(Echoes);

struct PacketOptions {
  std::string sensor;  ///< beginning of a name of packet_formats(); empty: recognised
  Echoes echoes = Echoes::both;
};

template <class V>
void visit(PacketOptions& o, V&& v) {
  v("sensor", o.sensor,
    "[-] vlp16, puck_hires, hdl32, leishen_c16 (or one of its generations), hesai_xt16; empty: recognised");
  v("echoes", o.echoes, "[-] of a sensor that reports two a shot; both: where they differ");
}

struct PacketCounts {
  std::size_t data = 0, device = 0, position = 0;  ///< packets
  std::size_t other = 0;                           ///< packets of another kind, length or sensor
  std::size_t lost = 0;                            ///< packets missing between those that came, by their times
  std::size_t unsent = 0;      ///< packets of the part of the turn that the sensor's view leaves out
  std::size_t late = 0;        ///< data packets left out: repeated, after a later one, or overlapping one
  std::size_t incomplete = 0;  ///< turns left out: less than half of one, or cut off by the end of the packets
  std::size_t clock_jumps = 0, receiver_jumps = 0;  ///< times at which a clock was set
  std::size_t pauses = 0;                           ///< of a second or more without packets
  double longest_pause = 0.0;                       ///< [s]
};

class PacketDecoder {
 public:
  /// Decides from the first packets, which are to be decoded as well. Throws Error as recognise_packets.
  PacketDecoder(std::span<const Packet> first, const PacketOptions& options);

  /// The next packet; a scan where it completes one.
  std::optional<Scan> decode(const Packet& packet);

  /// The scan that the last packet left, where it is whole.
  std::optional<Scan> finish();

  const std::vector<std::string>& decisions() const { return decisions_; }
  const PacketFormat& format() const { return convention_.format; }
  const PacketCounts& counts() const { return counts_; }
  const std::optional<PositionInfo>& position() const { return position_; }  ///< of the last position packet

 private:
  struct Head {
    double azimuth, time;  // [0.01 deg] [s] of a column
  };
  struct Column;  // a block, or two with the echoes of the same shots
  std::optional<bool> is_next_head(const DataPacket& packet) const;
  void count_missing(const DataPacket& packet, double first_shot);
  std::optional<Scan> decode_data(const DataPacket& packet, double first_shot);
  std::optional<Scan> turn_to(double azimuth, double time);
  void add_column(const DataPacket& packet, const Column& column);
  void add_point(const Column& column, std::size_t slot, double range, float intensity);
  std::optional<Scan> close(double least_turn);

  PacketConvention convention_;
  Echoes echoes_;
  PacketClock clock_;
  std::vector<std::string> decisions_;
  PacketCounts counts_;
  std::optional<PositionInfo> position_;
  std::vector<double> cosines_, sines_;          // of the channels' elevations
  std::array<double, kMostSlots> slot_times_{};  // [s]
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
