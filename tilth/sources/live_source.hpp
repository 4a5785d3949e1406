// Scans of a sensor as it sends them: udp://[ADDRESS]:PORT?key=value&... Packets are received and decoded in the
// background. Where the caller is too slow the newest scan wins: a few may wait, then the oldest makes way and is
// counted.
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <tilth/sources/live_scans.hpp>
#include <tilth/sources/packet_receiver.hpp>

namespace tilth {

struct LiveOptions {
  PacketSourceOptions packets;
  ReceiverOptions receiver;
  std::uint64_t queue = 5;
};

template <class V>
void visit(LiveOptions& o, V&& v) {
  visit(o.packets, v);
  visit(o.receiver, v);
  v("queue", o.queue, Bounds{1, 1000}, "[scans] that may wait to be registered; then the oldest makes way");
}

struct LiveCounts {
  ReceiverCounts packets;
  std::size_t scans = 0;    ///< decoded
  std::size_t dropped = 0;  ///< of these, those that made way
  bool caught_up = false;   ///< what came before the sensor was recognised is decoded: from now on the newest win
};

class LiveSource : public LiveScans {
 public:
  /// Waits until the sensor is recognised (2000 packets, or the end). Those packets are scans as well: they are worked
  /// off before newer ones win. Throws Error where the port is taken, or it ends before a known sensor has sent.
  LiveSource(std::unique_ptr<PacketReceiver> receiver, const LiveOptions& options);
  ~LiveSource() override;
  LiveSource(const LiveSource&) = delete;
  LiveSource& operator=(const LiveSource&) = delete;

  std::optional<Scan> next() override;
  std::vector<std::string> notices() const override;
  Losses losses() const override;
  LiveCounts counts() const;

 private:
  void decode();
  void wait_for_room(std::unique_lock<std::mutex>& lock);
  void hand_over(Scan scan);

  std::shared_ptr<PacketReceiver> receiver_;  // shared with the feed of packets_
  std::unique_ptr<ScanSource> packets_;
  std::size_t queue_;

  mutable std::mutex mutex_;  // of all below
  std::condition_variable changed_;
  std::deque<Scan> waiting_;
  std::vector<SkippedScan> newly_skipped_;
  std::vector<std::string> packet_notices_;
  std::size_t scans_ = 0, dropped_ = 0, skipped_before_ = 0;
  bool ended_ = false, stopping_ = false;
  bool backlog_waits_ = true;  // the scan handed over last belonged to the backlog

  std::jthread decoder_;  // last: it uses the members above
};

struct LiveAddress {
  UdpAddress local;
  LiveOptions options;
};

/// `values` are those of LiveOptions; those in `uri` are stronger. Throws Error on what is not understood.
LiveAddress parse_live_uri(const std::string& uri, const OptionValues& values);

/// The first half of opening a LiveSource: from now on packets are kept. Throws as PacketReceiver.
std::unique_ptr<PacketReceiver> listen(const LiveAddress& address, std::function<bool()> stopped);

}  // namespace tilth
