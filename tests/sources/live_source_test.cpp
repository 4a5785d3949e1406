// Packets over the loopback become scans; what finds no room is counted; what is not understood is refused.
#include <arpa/inet.h>
#include <atomic>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <gtest/gtest.h>

#include "sent_packets.hpp"
#include <tilth/core/error.hpp>
#include <tilth/sources/live_source.hpp>
#include <tilth/sources/open_source.hpp>

namespace tilth {
namespace {

const std::string kAnyPort = "udp://127.0.0.1:0";

std::string refusal(const std::string& uri) {
  try {
    open_source(uri, {});
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

/// The scans of packets that never were on a network.
std::vector<Scan> scans_of(const std::vector<ReceivedPacket>& packets) {
  std::size_t next = 0;
  const auto source = open_packets({"memory",
                                    {},
                                    [&]() -> std::optional<ReceivedPacket> {
                                      return next < packets.size() ? std::optional(packets[next++]) : std::nullopt;
                                    },
                                    [] { return std::vector<std::string>{}; },
                                    [] { return std::string{}; }},
                                   {});
  std::vector<Scan> scans;
  while (std::optional<Scan> scan = source->next()) scans.push_back(std::move(*scan));
  return scans;
}

TEST(LiveSource, GivesTheScansThatWereSent) {
  for (const bool leishen : {false, true}) {
    SCOPED_TRACE(leishen);
    const std::vector<ReceivedPacket> packets = made_packets(1000, leishen);
    const LiveAddress address = parse_live_uri(kAnyPort + "?idle=1", {});
    std::unique_ptr<PacketReceiver> receiver = listen(address, {});
    send_packets(packets, receiver->port());
    LiveSource source(std::move(receiver), address.options);
    const std::vector<Scan> expected = scans_of(packets);
    ASSERT_GT(expected.size(), 10U);
    std::optional<double> first;
    for (const Scan& scan : expected) {
      const std::optional<Scan> live = source.next();
      ASSERT_TRUE(live);
      if (!first) first = live->stamp - scan.stamp;
      EXPECT_NEAR(live->stamp - scan.stamp, *first, 1e-6) << "of the sensor's clock, not the network's";
      EXPECT_EQ(live->cloud.points, scan.cloud.points);
      ASSERT_EQ(live->cloud.times.size(), scan.cloud.times.size());
      for (std::size_t i = 0; i < scan.cloud.size(); ++i)
        ASSERT_NEAR(live->cloud.times[i], scan.cloud.times[i], 1e-6) << "a double holds steps of 0.24 us since 1970";
      EXPECT_EQ(live->cloud.rings, scan.cloud.rings);
    }
    EXPECT_FALSE(source.next());
    const LiveCounts counts = source.counts();
    EXPECT_EQ(counts.packets.received, packets.size());
    EXPECT_EQ(counts.packets.dropped + counts.packets.system_dropped + counts.dropped, 0U);
    EXPECT_EQ(counts.scans, expected.size());
  }
}

TEST(LiveSource, TheNewestScansWinOnceTheBacklogIsWorkedOff) {
  const std::vector<ReceivedPacket> packets = made_packets(4500);
  const std::size_t expected = scans_of(packets).size();
  constexpr std::size_t kFirst = 3000;
  const LiveAddress address = parse_live_uri(kAnyPort + "?queue=2", {});
  std::unique_ptr<PacketReceiver> receiver = listen(address, {});
  const std::uint16_t port = receiver->port();
  send_packets({packets.begin(), packets.begin() + kFirst}, port);
  LiveSource source(std::move(receiver), address.options);
  constexpr std::size_t kTaken = 38;  // 39 whole turns were sent
  for (std::size_t i = 0; i < kTaken; ++i) ASSERT_TRUE(source.next());
  EXPECT_EQ(source.counts().dropped, 0U) << "those that were sent while the sensor was recognised are not dropped";
  ASSERT_TRUE(comes_true([&] { return source.counts().caught_up; }));
  send_packets({packets.begin() + kFirst, packets.end()}, port);
  ASSERT_TRUE(comes_true([&] { return source.counts().scans + 1 >= expected; }));
  const LiveCounts counts = source.counts();
  EXPECT_EQ(counts.dropped, counts.scans - kTaken - 2);
  EXPECT_GT(counts.dropped, 15U);
  bool told = false;
  for (const std::string& notice : source.notices()) told |= notice.find("dropped: registration") != std::string::npos;
  EXPECT_TRUE(told);
}

TEST(LiveSource, TheFirstScanAfterTheBacklogWaitsForRoom) {
  const std::vector<ReceivedPacket> packets = made_packets(3060);
  constexpr std::size_t kFirst = 3000;
  const LiveAddress address = parse_live_uri(kAnyPort + "?queue=2&idle=1", {});
  std::unique_ptr<PacketReceiver> receiver = listen(address, {});
  const std::uint16_t port = receiver->port();
  send_packets({packets.begin(), packets.begin() + kFirst}, port);
  LiveSource source(std::move(receiver), address.options);
  std::size_t taken = 0;
  for (; taken < 37; ++taken) ASSERT_TRUE(source.next());
  ASSERT_TRUE(comes_true([&] { return source.counts().caught_up; }));  // two turns wait, part of another is decoded
  send_packets({packets.begin() + kFirst, packets.end()}, port);
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  for (; taken < 40; ++taken) ASSERT_TRUE(source.next());
  EXPECT_EQ(source.counts().dropped, 0U);
}

TEST(PacketReceiver, CountsWhatFindsNoRoom) {
  const std::vector<ReceivedPacket> packets = made_packets(300);
  ReceiverOptions options;
  options.buffer = 100;
  PacketReceiver receiver({kLoopback, 0}, 0, options, {});
  send_packets(packets, receiver.port());
  ASSERT_TRUE(comes_true([&] { return receiver.counts().received + receiver.counts().system_dropped == 300; }));
  EXPECT_EQ(receiver.counts().dropped, receiver.counts().received - 100);
}

TEST(PacketReceiver, LetsOneSenderThrough) {
  const std::vector<ReceivedPacket> packets = made_packets(200);
  PacketReceiver receiver({kLoopback, 0}, 0x0A000001, {}, {});
  send_packets(packets, receiver.port());
  ASSERT_TRUE(comes_true([&] { return receiver.counts().foreign == packets.size(); }));
  EXPECT_EQ(receiver.counts().received, 0U);
  PacketReceiver same({kLoopback, 0}, kLoopback, {}, {});
  send_packets(packets, same.port());
  EXPECT_TRUE(comes_true([&] { return same.counts().received == packets.size(); }));
}

TEST(PacketReceiver, TakesTheDevicePacketsOfTheNextPort) {
  const std::vector<ReceivedPacket> packets = made_packets(200);
  PacketReceiver receiver({kLoopback, 0}, 0, {}, {});
  if (!receiver.warning().empty()) GTEST_SKIP() << "the port beside is taken";
  send_packets(packets, std::uint16_t(receiver.port() + 1));
  EXPECT_TRUE(comes_true([&] { return receiver.counts().received == packets.size(); }));
}

TEST(PacketReceiver, IsStoppedFromOutside) {
  std::atomic<bool> stop = false;
  PacketReceiver receiver({kLoopback, 0}, 0, {}, [&] { return stop.load(); });
  std::jthread later([&] { stop = true; });
  EXPECT_FALSE(receiver.next());
}

TEST(PacketReceiver, JoinsAMulticastGroup) {
  ReceiverOptions options;
  options.multicast = "239.255.23.68";
  PacketReceiver receiver({kLoopback, 0}, 0, options, {});
  const int sender = ::socket(AF_INET, SOCK_DGRAM, 0);
  const in_addr by{htonl(kLoopback)};
  ASSERT_EQ(::setsockopt(sender, IPPROTO_IP, IP_MULTICAST_IF, &by, sizeof by), 0);
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(receiver.port());
  to.sin_addr.s_addr = ::inet_addr("239.255.23.68");
  const bool sent = ::sendto(sender, "packet", 6, 0, reinterpret_cast<const sockaddr*>(&to), sizeof to) == 6;
  ::close(sender);
  if (!sent) GTEST_SKIP() << "this computer sends no multicast over its loopback";
  EXPECT_TRUE(comes_true([&] { return receiver.counts().received == 1; }));
}

TEST(LiveSource, WhatIsNotUnderstoodIsRefused) {
  for (const auto& [uri, reason] :
       std::vector<std::pair<std::string, std::string>>{{"udp://127.0.0.1", "has no port"},
                                                        {"udp://127.0.0.1:70000", "has no port"},
                                                        {"udp://:2x", "has no port"},
                                                        {"udp://no.such.host.invalid:2368", "is no IPv4 address"},
                                                        {"udp://127.0.0.1:0?queue=0", "queue"},
                                                        {"udp://127.0.0.1:0?colour=red", "colour"},
                                                        {"udp://127.0.0.1:0?idle=0.2", "no packet came"},
                                                        {"udp://192.0.2.1:2368", "cannot be listened at"}}) {
    EXPECT_NE(refusal(uri).find(reason), std::string::npos) << uri << " gave: " << refusal(uri);
  }
  const PacketReceiver receiver({kLoopback, 0}, 0, {}, {});
  const std::string taken = "udp://127.0.0.1:" + std::to_string(receiver.port());
  EXPECT_NE(refusal(taken).find("in use"), std::string::npos) << refusal(taken);
}

TEST(LiveSource, OtherDatagramsAreNoSensor) {
  const LiveAddress address = parse_live_uri(kAnyPort + "?idle=0.3", {});
  std::unique_ptr<PacketReceiver> receiver = listen(address, {});
  UdpSocket sender = UdpSocket::sending();
  for (const std::size_t size : {0U, 1U, 1206U, 9000U})
    sender.send({kLoopback, receiver->port()}, std::vector<std::byte>(size));
  try {
    LiveSource source(std::move(receiver), address.options);
    FAIL() << "no Error";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("4 other datagrams"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace tilth
