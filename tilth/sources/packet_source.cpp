#include <algorithm>
#include <array>
#include <ctime>
#include <deque>
#include <map>
#include <utility>

#include <tilth/core/counted.hpp>
#include <tilth/core/error.hpp>
#include <tilth/io/pcap.hpp>
#include <tilth/sources/packet_source.hpp>
#include <tilth/sources/sensor_files.hpp>

namespace tilth {
namespace {

constexpr std::size_t kFirstBytes = 4 << 20;
constexpr std::size_t kFirstPackets = 2000;  ///< one device packet of Leishen among them, which sends one a second

std::string date_text(double utc) {
  const auto seconds = std::time_t(utc);
  std::tm date{};
  gmtime_r(&seconds, &date);
  std::array<char, 40> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%d %H:%M:%S UTC", &date);
  return text.data();
}

std::string seconds_text(double seconds) {
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%.1f s", seconds);
  return text.data();
}

/// What Velodyne's position packets say at last.
std::string position_text(std::size_t packets, const PositionInfo& last) {
  constexpr std::array kPulse{"no pulse of a GPS receiver", "the GPS receiver's pulse is being locked on to",
                              "locked to the GPS receiver's pulse", "the GPS receiver's pulse is in error"};
  return "position packets: " + std::to_string(packets) +
         (last.pulse ? std::string("; ") + kPulse[std::size_t(*last.pulse)] : std::string()) +
         (last.utc ? "; last fix at " + date_text(*last.utc) : "; no GPS fix");
}

class PacketSource : public ScanSource {
 public:
  PacketSource(PacketFeed feed, const PacketSourceOptions& options) : feed_(std::move(feed)) {
    read_first();
    choose_sender(options.host);
    std::vector<Packet> packets;
    for (const ReceivedPacket& p : first_) {
      if (p.sender == sender_) packets.push_back({p.payload, p.arrival});
    }
    decoder_ = make_packet_decoder(packets, options.decoder, file_of(packets, options.sensor_file));
    contents_ = feed_.contents;
    for (const auto& [sender, count] : senders_) {
      if (sender == 0) continue;
      contents_.push_back("sender " + address_text(sender) + ": " + counted(count, "data packet") + " of the first " +
                          std::to_string(first_.size()));
    }
    decisions_.push_back("source: packets of " + feed_.name +
                         (sender_ != 0 ? ", sent by " + address_text(sender_) : ""));
    decisions_.insert(decisions_.end(), decoder_->decisions().begin(), decoder_->decisions().end());
  }

  std::optional<Scan> next() override {
    while (std::optional<ReceivedPacket> packet = take()) {
      if (packet->sender != sender_) {
        ++foreign_;
        continue;
      }
      std::optional<Scan> scan = decoder_->decode({packet->payload, packet->arrival});
      if (scan && in_order(*scan)) return scan;
    }
    if (ended_) return std::nullopt;
    ended_ = true;
    if (const std::string problem = feed_.problem(); !problem.empty())
      skipped_.push_back({scans_, feed_.name, "the recording is damaged: " + problem});
    std::optional<Scan> scan = decoder_->finish();
    return scan && in_order(*scan) ? std::move(scan) : std::nullopt;
  }

  std::vector<std::string> notices() const override {
    const PacketCounts& counts = decoder_->counts();
    std::vector<std::string> all{"packets: " + std::to_string(counts.data) + " with points, " +
                                 std::to_string(counts.device + counts.position) + " about the sensor"};
    if (decoder_->clock_runs_free())
      all.emplace_back(
          "the sensor's clock runs free: stamps agree with other sensors' only to the delay of the network, and drift; "
          "PTP "
          "or the pulse of a GPS receiver would set it");
    if (decoder_->position()) all.push_back(position_text(counts.position, *decoder_->position()));
    const auto tell = [&](std::size_t n, const std::string& noun, const std::string& rest) {
      if (n > 0) all.push_back(counted(n, noun) + " " + rest);
    };
    tell(counts.lost, "packet",
         "lost: their points are missing. A network or computer with too much to do is the usual cause");
    tell(counts.unsent, "packet", "not sent: the view of the sensor is cropped to a part of the turn");
    tell(counts.pauses, "pause", "of the packets, the longest of " + seconds_text(counts.longest_pause));
    tell(counts.late, "packet", "left out: repeated, or overtaken by later ones");
    tell(counts.other + unknown_, "datagram", "of the same port or sender left out: no packets of this sensor");
    tell(foreign_, "packet", "of another sender left out; --host chooses");
    tell(counts.incomplete, "incomplete turn", "left out");
    tell(counts.clock_jumps, "jump", "of the sensor's clock evened out");
    tell(counts.receiver_jumps, "jump", "of the receiver's clock not followed: the sensor's went on");
    for (std::string& notice : feed_.notices()) all.push_back(std::move(notice));
    return all;
  }

 private:
  /// Packets until all is decided: some of an Ouster's, which are large, more of an HDL-64E's, which tell its
  /// calibration.
  void read_first() {
    std::size_t bytes = 0, of_hdl64 = 0;
    while (first_.size() < kFirstPackets || (of_hdl64 > 0 && of_hdl64 < kPacketsOfCalibration)) {
      if (bytes >= kFirstBytes && of_hdl64 == 0) return;
      std::optional<ReceivedPacket> packet = read();
      if (!packet) return;
      const bool data = kind_of(packet->payload) == PacketKind::data;
      of_hdl64 += data && &DataPacket(packet->payload).layout() == &layout_of(PacketFamily::velodyne_64) ? 1 : 0;
      bytes += packet->payload.size();
      first_.push_back(std::move(*packet));
    }
  }

  /// The file that was named, or for an Ouster its metadata beside the recording.
  SensorFile file_of(const std::vector<Packet>& packets, const std::string& named) const {
    if (!named.empty()) return read_sensor_file(named);
    const auto is_ouster = [](const Packet& packet) { return kind_of(packet.payload) == PacketKind::ouster; };
    if (feed_.file.empty() || std::none_of(packets.begin(), packets.end(), is_ouster)) return {feed_.name, {}, {}};
    const std::filesystem::path beside = ouster_metadata_beside(feed_.file);
    return beside.empty() ? SensorFile{feed_.name, {}, {}} : read_sensor_file(beside);
  }

  /// The next packet that may be a sensor's.
  std::optional<ReceivedPacket> read() {
    while (std::optional<ReceivedPacket> packet = feed_.next()) {
      if (kind_of(packet->payload) != PacketKind::other) return packet;
      ++unknown_;
    }
    return std::nullopt;
  }

  std::optional<ReceivedPacket> take() {
    if (first_.empty()) return read();
    std::optional<ReceivedPacket> packet(std::move(first_.front()));
    first_.pop_front();
    return packet;
  }

  void choose_sender(const std::string& host) {
    for (const ReceivedPacket& p : first_) {
      const PacketKind kind = kind_of(p.payload);
      senders_[p.sender] += kind == PacketKind::data || kind == PacketKind::ouster ? 1 : 0;
    }
    if (senders_.empty()) {
      throw Error(feed_.name, "holds no packets of a sensor that `tilth sensors` lists (" +
                                  counted(unknown_, "other datagram") + ")");
    }
    const auto named = std::find_if(senders_.begin(), senders_.end(),
                                    [&](const auto& sender) { return address_text(sender.first) == host; });
    if (!host.empty() && named == senders_.end()) {
      std::string seen;
      for (const auto& [sender, count] : senders_) seen += (seen.empty() ? "" : ", ") + address_text(sender);
      throw Error(feed_.name, "has no packets of host " + host + "; there are those of " + seen);
    }
    const auto most = std::max_element(senders_.begin(), senders_.end(),
                                       [](const auto& a, const auto& b) { return a.second < b.second; });
    sender_ = host.empty() ? most->first : named->first;
  }

  bool in_order(const Scan& scan) {
    ++scans_;
    const bool later = !last_stamp_ || scan.stamp > *last_stamp_;
    if (later)
      last_stamp_ = scan.stamp;
    else
      skipped_.push_back({scans_ - 1, feed_.name, "its stamp does not lie after that of the scan before it"});
    return later;
  }

  PacketFeed feed_;
  std::deque<ReceivedPacket> first_;
  std::map<std::uint32_t, std::size_t> senders_;  // address -> data packets among the first
  std::uint32_t sender_ = 0;
  std::unique_ptr<PacketDecoder> decoder_;
  std::optional<double> last_stamp_;
  std::size_t unknown_ = 0, foreign_ = 0, scans_ = 0;
  bool ended_ = false;
};

}  // namespace

std::unique_ptr<ScanSource> open_packets(PacketFeed feed, const PacketSourceOptions& options) {
  return std::make_unique<PacketSource>(std::move(feed), options);
}

}  // namespace tilth
