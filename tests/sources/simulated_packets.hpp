// A simulated recording as packets, in memory and on the network.
#pragma once

#include <chrono>
#include <string>
#include <thread>
#include <vector>

#include <tilth/sources/packet_feeds.hpp>
#include <tilth/sources/udp_socket.hpp>

namespace tilth {

inline std::vector<ReceivedPacket> simulated_packets(const std::string& sensor, const std::string& duration) {
  const PacketFeed feed =
      open_packet_feed("sim://corridor?sensor=" + sensor + "&duration=" + duration + "&people=0&seed=5", "");
  std::vector<ReceivedPacket> packets;
  while (std::optional<ReceivedPacket> packet = feed.next()) packets.push_back(std::move(*packet));
  return packets;
}

constexpr std::uint32_t kLoopback = 0x7F000001;  // 127.0.0.1

/// Sends them with a short rest now and then, so that a receiver on a busy computer keeps up.
inline void send_packets(const std::vector<ReceivedPacket>& packets, std::uint16_t port) {
  constexpr std::size_t kAtOnce = 10;
  UdpSocket socket = UdpSocket::sending();
  for (std::size_t i = 0; i < packets.size(); ++i) {
    socket.send({kLoopback, port}, packets[i].payload);
    if (i % kAtOnce == 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

template <class Condition>
bool comes_true(const Condition& condition) {
  constexpr int kTries = 3000;  // 30 s: a computer may be busy
  for (int i = 0; i < kTries && !condition(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  return condition();
}

}  // namespace tilth
