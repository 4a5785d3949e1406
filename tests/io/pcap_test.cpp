// Network captures: every link, VLAN tags, fragments, both byte orders, pcapng, and what is cut or lies.
#include <cmath>
#include <cstring>
#include <io/expect_error.hpp>
#include <io/temporary_folder.hpp>

#include <gtest/gtest.h>

#include <tilth/io/input_file.hpp>
#include <tilth/io/pcap.hpp>
#include <tilth/io/pcap_writer.hpp>

namespace tilth {
namespace {

using Bytes = std::vector<std::byte>;

Bytes bytes(std::initializer_list<unsigned> values) {
  Bytes all;
  for (const unsigned v : values) all.push_back(std::byte(v));
  return all;
}

Bytes operator+(Bytes a, const Bytes& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

Bytes number(std::uint32_t value, std::size_t size, bool big = false) {
  Bytes all;
  for (std::size_t i = 0; i < size; ++i) all.push_back(std::byte(value >> 8 * (big ? size - 1 - i : i) & 0xFF));
  return all;
}

Bytes payload(std::size_t size) {
  Bytes all;
  for (std::size_t i = 0; i < size; ++i) all.push_back(std::byte(i * 7 & 0xFF));
  return all;
}

Bytes udp(const Bytes& payload) {
  return number(2369, 2, true) + number(2368, 2, true) + number(std::uint32_t(payload.size() + 8), 2, true) +
         number(0, 2) + payload;
}

/// `fragment`: offset in units of 8 bytes, 0x2000 where more follow.
Bytes ip(const Bytes& content, unsigned fragment = 0, unsigned protocol = 17, std::size_t options = 0) {
  return bytes({0x45 + unsigned(options / 4), 0}) + number(std::uint32_t(20 + options + content.size()), 2, true) +
         number(77, 2, true) + number(fragment, 2, true) +
         bytes({64, protocol, 0, 0, 192, 168, 1, 200, 192, 168, 1, 102}) + Bytes(options) + content;
}

Bytes ethernet(const Bytes& content, std::initializer_list<unsigned> type = {0x08, 0x00}) {
  return Bytes(12) + bytes(type) + content;
}

Bytes record(const Bytes& frame, std::uint32_t length = 0, bool big = false) {
  return number(1'700'000'000, 4, big) + number(250'000, 4, big) + number(std::uint32_t(frame.size()), 4, big) +
         number(length == 0 ? std::uint32_t(frame.size()) : length, 4, big) + frame;
}

Bytes capture(std::uint32_t link, const std::vector<Bytes>& frames, bool big = false) {
  Bytes all = number(0xA1B2C3D4, 4, big) + number(2, 2, big) + number(4, 2, big) + number(0, 4) + number(0, 4) +
              number(65535, 4, big) + number(link, 4, big);
  for (const Bytes& frame : frames) all = all + record(frame, 0, big);
  return all;
}

std::vector<Datagram> read_all(PcapReader& reader) {
  std::vector<Datagram> all;
  while (auto datagram = reader.next()) all.push_back(std::move(*datagram));
  return all;
}

void expect_one(const Bytes& file, const Bytes& expected, const char* what) {
  PcapReader reader(file, what);
  const std::vector<Datagram> all = read_all(reader);
  ASSERT_EQ(all.size(), 1U) << what;
  EXPECT_EQ(all[0].payload, expected) << what;
  EXPECT_EQ(all[0].source, 0xC0A801C8U) << what;
  EXPECT_EQ(all[0].source_port, 2369) << what;
  EXPECT_EQ(all[0].destination_port, 2368) << what;
  EXPECT_NEAR(all[0].arrival, 1'700'000'000.25, 1e-6) << what;
  EXPECT_EQ(reader.problem(), "") << what;
}

TEST(Pcap, ReadsDatagramsOfEveryLink) {
  const Bytes p = payload(1206), packet = ip(udp(p));
  expect_one(capture(1, {ethernet(packet)}), p, "Ethernet");
  expect_one(capture(1, {ethernet(packet)}, true), p, "big-endian");
  expect_one(capture(1, {ethernet(packet + Bytes(6))}), p, "Ethernet with padding");
  expect_one(capture(1, {ethernet(bytes({0, 5, 8, 0}) + packet, {0x81, 0x00})}), p, "VLAN");
  expect_one(capture(1, {ethernet(bytes({0, 5, 0x81, 0, 0, 6, 8, 0}) + packet, {0x88, 0xA8})}), p, "two VLAN tags");
  expect_one(capture(1, {ethernet(ip(udp(p), 0, 17, 8))}), p, "IP options");
  expect_one(capture(101, {packet}), p, "raw IP");
  expect_one(capture(113, {Bytes(14) + bytes({8, 0}) + packet}), p, "Linux cooked");
  expect_one(capture(276, {bytes({8, 0}) + Bytes(18) + packet}), p, "Linux cooked 2");
  expect_one(capture(0, {bytes({2, 0, 0, 0}) + packet}), p, "loopback");
}

TEST(Pcap, PutsFragmentsTogetherInAnyOrder) {
  const Bytes p = payload(1206), whole = udp(p);
  const auto part = [&](std::size_t from, std::size_t to) {
    return Bytes(whole.begin() + std::ptrdiff_t(from), whole.begin() + std::ptrdiff_t(to));
  };
  const Bytes a = ethernet(ip(part(0, 560), 0x2000)), b = ethernet(ip(part(560, 1120), 0x2000 | 70));
  const Bytes c = ethernet(ip(part(1120, whole.size()), 140));
  expect_one(capture(1, {a, b, c}), p, "in order");
  expect_one(capture(1, {c, a, b}), p, "out of order");
  expect_one(capture(1, {a, a, c, b}), p, "one twice");
  const Bytes file = capture(1, {a, c});
  PcapReader reader(file, "one missing");
  EXPECT_FALSE(reader.next());
  EXPECT_EQ(reader.counts().fragments, 2U);
}

TEST(Pcap, CountsWhatIsNoDatagram) {
  const Bytes packet = ip(udp(payload(100)));
  Bytes lying = packet;
  lying[2] = std::byte(0x7F);  // its length
  Bytes lying_udp = packet;
  lying_udp[24] = std::byte(0x7F);
  Bytes tiny_header = packet;
  tiny_header[0] = std::byte(0x42);
  const Bytes file = capture(
      1, {ethernet(ip(udp(payload(9)), 0, 6)), ethernet(packet, {0x86, 0xDD}), Bytes(5), Bytes(), ethernet(lying),
          ethernet(lying_udp), ethernet(tiny_header), ethernet(bytes({0x45})), ethernet(packet)});
  PcapReader reader(file, "mixed");
  EXPECT_EQ(read_all(reader).size(), 1U);
  EXPECT_EQ(reader.counts().frames, 9U);
  EXPECT_EQ(reader.counts().other, 4U);
  EXPECT_EQ(reader.counts().cut, 4U);
}

TEST(Pcap, ReadsPcapng) {
  const Bytes p = payload(50), frame = ethernet(ip(udp(p)));
  const Bytes padded = frame + Bytes((4 - frame.size() % 4) % 4);
  const auto block = [](std::uint32_t type, const Bytes& body) {
    const Bytes length = number(std::uint32_t(body.size() + 12), 4);
    return number(type, 4) + length + body + length;
  };
  const std::uint64_t us = 1'700'000'000'250'000ULL;
  const Bytes file =
      block(0x0A0D0D0A,
            number(0x1A2B3C4D, 4) + number(1, 2) + number(0, 2) + number(0xFFFFFFFF, 4) + number(0xFFFFFFFF, 4)) +
      block(1, number(1, 2) + number(0, 2) + number(65535, 4)) +
      block(6, number(0, 4) + number(std::uint32_t(us >> 32), 4) + number(std::uint32_t(us), 4) +
                   number(std::uint32_t(frame.size()), 4) + number(std::uint32_t(frame.size()), 4) + padded);
  expect_one(file, p, "pcapng");
}

TEST(Pcap, ReadsWhatTheWriterWrote) {
  const TemporaryFolder folder;
  {
    PcapWriter writer(folder / "a.pcap");
    writer.write(1'700'000'000.25, {0xC0A801C8, 0xC0A80166, 2369, 2368}, payload(1212));
    writer.close();
  }
  expect_one(read_file(folder / "a.pcap"), payload(1212), "written");
  PcapWriter writer(folder / "b.pcap");
  EXPECT_THROW(writer.write(0.0, {}, payload(65494)), Error);
  EXPECT_THROW(writer.write(-1.0, {}, payload(10)), Error);
  EXPECT_THROW(writer.write(NAN, {}, payload(10)), Error);
}

TEST(Pcap, ATruncatedFileIsReadUpToTheBreak) {
  const Bytes frame = ethernet(ip(udp(payload(40))));
  const Bytes file = capture(1, {frame, frame, frame});
  const std::size_t each = 16 + frame.size();
  for (std::size_t size = 0; size < file.size(); ++size) {
    const Bytes cut(file.begin(), file.begin() + std::ptrdiff_t(size));
    if (size < 24) {
      EXPECT_THROW(PcapReader(cut, "cut"), Error) << size;
      continue;
    }
    PcapReader reader(cut, "cut");
    EXPECT_EQ(read_all(reader).size(), (size - 24) / each) << size;
    EXPECT_EQ(reader.problem().empty(), (size - 24) % each == 0) << size << reader.problem();
  }
}

TEST(Pcap, OtherFilesAreRefusedByName) {
  expect_error([] { PcapReader("/nowhere/a.pcap"); }, {"/nowhere/a.pcap", "No such file"});
  const Bytes text = payload(500), wireless = capture(105, {});
  expect_error([&] { PcapReader(text, "text.pcap"); }, {"text.pcap"});
  expect_error([&] { PcapReader(wireless, "wireless.pcap"); }, {"wireless.pcap", "105"});
}

}  // namespace
}  // namespace tilth
