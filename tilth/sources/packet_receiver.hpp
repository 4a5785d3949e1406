// Packets off the network: a thread a socket puts them into one bounded queue, so that whoever decodes them may be
// late. What finds no room is dropped and counted, here and in the system's own buffer.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <tilth/sources/packet_source.hpp>
#include <tilth/sources/udp_socket.hpp>

namespace tilth {

struct ReceiverOptions {
  std::string multicast;
  std::uint16_t device_port = 0;
  std::uint64_t buffer = 30'000;
  double idle = 0.0;
};

template <class V>
void visit(ReceiverOptions& o, V&& v) {
  v("multicast", o.multicast, "[-] group to join, as 239.1.2.3; empty: none");
  v("device_port", o.device_port, Bounds{0, 65535},
    "[-] listened at as well, for a Leishen's device packets; 0: the next port");
  v("buffer", o.buffer, Bounds{100, 1e7}, "[packets] that may wait to be decoded; those that come then are dropped");
  v("idle", o.idle, Bounds{0, 1e6}, "[s] without a packet that end it; 0: waits for ever");
}

struct ReceiverCounts {
  std::size_t received = 0;
  std::size_t dropped = 0;         ///< for want of room in the queue
  std::size_t system_dropped = 0;  ///< by the system, before they could be received
  std::size_t foreign = 0;         ///< of other senders than the one asked for
};

class PacketReceiver {
 public:
  /// Takes packets of `sender`, or of all where it is 0. `stopped` is asked ten times a second; it may be empty. Throws
  /// Error where the port is taken or the group cannot be joined.
  PacketReceiver(const UdpAddress& local, std::uint32_t sender, const ReceiverOptions& options,
                 std::function<bool()> stopped);
  ~PacketReceiver();
  PacketReceiver(const PacketReceiver&) = delete;
  PacketReceiver& operator=(const PacketReceiver&) = delete;

  /// The next packet, waiting for it; nothing once it has ended and the queue is empty.
  std::optional<ReceivedPacket> next();

  void stop();  ///< at once: what waits is lost

  /// False from expect_backlog() until next() finds the queue empty.
  bool caught_up() const;
  bool ended() const;
  void expect_backlog();

  ReceiverCounts counts() const;
  std::uint16_t port() const { return sockets_.front().port(); }
  const std::string& name() const { return name_; }        ///< "udp://0.0.0.0:2368"
  const std::string& warning() const { return warning_; }  ///< where the device port is taken; empty: it is not
  std::string problem() const;                             ///< why it ended early; empty: it did not

 private:
  using Clock = std::chrono::steady_clock;
  UdpSocket opened(const UdpAddress& local) const;
  void listen_for_device_packets(const UdpAddress& local, std::uint16_t port);
  void receive(std::size_t socket, const std::stop_token& token);
  void take(UdpDatagram datagram);
  bool done() const;

  std::string name_, warning_;
  std::uint32_t sender_;
  ReceiverOptions options_;
  std::function<bool()> stopped_;
  std::vector<UdpSocket> sockets_;

  mutable std::mutex mutex_;  // of all below
  std::condition_variable arrived_;
  std::deque<ReceivedPacket> queue_;
  std::vector<std::uint64_t> system_dropped_;  // by socket
  ReceiverCounts counts_;
  Clock::time_point last_ = Clock::now();  // a packet came
  bool caught_up_ = false, ended_ = false;
  std::string problem_;

  std::vector<std::jthread> threads_;  // last: they use the members above
};

}  // namespace tilth
