// Packets in, scans out: every shot with its ring, time and intensity, cut into turns. Sensors whose packets hold
// blocks of an azimuth are decoded by BlockDecoder; Ouster's columns by OusterDecoder.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <tilth/core/options.hpp>
#include <tilth/core/scan.hpp>
#include <tilth/sensor/device_packet.hpp>
#include <tilth/sensor/packet.hpp>
#include <tilth/sensor/sensor_file.hpp>

namespace tilth {

/// Which echoes of a shot become points, where the sensor reports two.
enum class Echoes { both, strongest, farthest };
std::span<const std::string_view> names_of(Echoes);

struct MeasuredEcho {
  double range = 0.0;  ///< 0: no return
  float intensity = 0.0F;
};
struct EchoChoice {
  bool first = false, second = false;
};

/// Which of the two echoes of a shot become points.
EchoChoice choose_echoes(Echoes wanted, const MeasuredEcho& first, const MeasuredEcho& second);

struct PacketOptions {
  std::string sensor;  ///< beginning of a name of packet_formats(); empty: recognised
  Echoes echoes = Echoes::both;
};

template <class V>
void visit(PacketOptions& o, V&& v) {
  v("sensor", o.sensor, "[-] as `tilth sensors` names it, or the beginning of such a name; empty: recognised");
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
  virtual ~PacketDecoder() = default;

  /// The next packet; a scan where it completes one.
  virtual std::optional<Scan> decode(const Packet& packet) = 0;

  /// The scan that the last packet left, where it is whole.
  virtual std::optional<Scan> finish() = 0;

  virtual std::size_t rings() const = 0;
  const std::vector<std::string>& decisions() const { return decisions_; }
  const PacketCounts& counts() const { return counts_; }
  virtual bool clock_runs_free() const = 0;                                  ///< see PacketClock::runs_free()
  const std::optional<PositionInfo>& position() const { return position_; }  ///< of the last position packet

 protected:
  std::vector<std::string> decisions_;
  PacketCounts counts_;
  std::optional<PositionInfo> position_;
};

/// Decides from the first packets, which are to be decoded as well. `file` is what the sensor's file tells, where there
/// is one. Throws Error where no packet is a known sensor's, or the sensor needs a file that is not there.
std::unique_ptr<PacketDecoder> make_packet_decoder(std::span<const Packet> first, const PacketOptions& options,
                                                   const SensorFile& file = {});

}  // namespace tilth
