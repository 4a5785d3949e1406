// Made packets, in memory and on the network.
#pragma once

#include <chrono>
#include <sensor/made_packets.hpp>
#include <thread>
#include <vector>

#include <tilth/sources/packet_source.hpp>
#include <tilth/sources/udp_socket.hpp>

namespace tilth {

constexpr std::uint32_t kLoopback = 0x7F000001;  // 127.0.0.1

/// `count` packets of a VLP-16 or of a Leishen C16, that turns in an empty sphere: 75.4 a turn.
inline std::vector<ReceivedPacket> made_packets(std::size_t count, bool leishen = false) {
  MadeSensor sensor;
  if (leishen) sensor.model = 0x10, sensor.step = 36.0, sensor.period = 100e-6;
  std::vector<ReceivedPacket> packets;
  for (std::size_t k = 0; k < count; ++k)
    packets.push_back({double(k) * sensor.packet_period(), kLoopback, sensor.packet(k).bytes()});
  return packets;
}

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
