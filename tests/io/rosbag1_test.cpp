#include <algorithm>
#include <random>

#include <gtest/gtest.h>

#include "io/expect_error.hpp"
#include "io/temporary_folder.hpp"
#include <tilth/io/rosbag1.hpp>
#include <tilth/io/rosbag1_record.hpp>
#include <tilth/io/rosbag1_writer.hpp>

namespace tilth {
namespace {

using rosbag1::Op;
using rosbag1::raw;
using rosbag1::record_text;

constexpr std::uint64_t kBegin = 1'600'000'000'000'000'123;  // [ns]
constexpr std::uint64_t kTenth = 100'000'000;

std::vector<std::byte> payload(std::uint32_t seed, std::size_t size) {
  std::mt19937 random(seed);
  std::vector<std::byte> bytes(size);
  for (std::byte& byte : bytes) byte = std::byte(random() % 7);
  return bytes;
}

// Clouds of 20 kB and small messages of a second topic, the latter half a second late: chunks overlap in time.
void write_bag(const std::filesystem::path& path, BagCompression compression, std::uint32_t count) {
  Rosbag1Writer writer(path, compression);
  const std::uint32_t cloud = writer.add_connection({0, "/points", "sensor_msgs/PointCloud2", "1158d4", "Header h"});
  const std::uint32_t other = writer.add_connection({0, "/imu", "sensor_msgs/Imu", "6a62c6", "# imu"});
  for (std::uint32_t i = 0; i < count; ++i) {
    writer.write(cloud, kBegin + i * kTenth, payload(i, 20000));
    writer.write(other, kBegin + i * kTenth - 5 * kTenth + 1, payload(1000 + i, 10));
  }
  writer.close();
}

std::vector<Message> read_all(Rosbag1Reader& reader) {
  std::vector<Message> messages;
  while (std::optional<Message> message = reader.next()) messages.push_back(std::move(*message));
  return messages;
}

struct Outcome {
  std::vector<Message> messages;
  bool truncated;
  std::string problem;
};

Outcome read_bytes(const std::vector<std::byte>& bytes) {
  Rosbag1Reader reader(InputFile(bytes, "a.bag"));
  std::vector<Message> messages = read_all(reader);
  return {std::move(messages), reader.truncated(), reader.problem()};
}

// A bag as a crashed recorder leaves it: no index at all.
std::string crashed_bag(const std::string& compression, const std::string& chunk, std::uint32_t size) {
  const std::string head = record_text({{"op", raw(Op::bag_header)},
                                        {"index_pos", raw(std::uint64_t{0})},
                                        {"conn_count", raw(0)},
                                        {"chunk_count", raw(0)}},
                                       std::string(100, ' '));
  return std::string(rosbag1::kMagic) + head +
         record_text({{"op", raw(Op::chunk)}, {"compression", compression}, {"size", raw(size)}}, chunk);
}

std::string two_messages() {
  const std::string connection = record_text(
      {{"op", raw(Op::connection)}, {"conn", raw(7)}, {"topic", "/p"}},
      rosbag1::fields_text({{"topic", "/p"}, {"type", "t/T"}, {"md5sum", "*"}, {"message_definition", ""}}));
  std::string text = connection;
  for (const std::uint64_t time : {2000000005ULL, 1000000004ULL}) {
    text += record_text({{"op", raw(Op::message)}, {"conn", raw(7)}, {"time", rosbag1::raw_time(time)}},
                        "at " + std::to_string(time));
  }
  return text;
}

TEST(Rosbag1, RoundTripInTimeOrder) {
  const TemporaryFolder folder;
  for (const BagCompression compression : {BagCompression::none, BagCompression::lz4}) {
    write_bag(folder / "a.bag", compression, 100);
    Rosbag1Reader reader(folder / "a.bag");
    ASSERT_EQ(reader.connections().size(), 2u);
    EXPECT_EQ(reader.connections()[0].topic, "/points");
    EXPECT_EQ(reader.connections()[0].type, "sensor_msgs/PointCloud2");
    EXPECT_EQ(reader.connections()[0].md5, "1158d4");
    EXPECT_EQ(reader.connections()[0].definition, "Header h");
    EXPECT_EQ(reader.connections()[1].messages, 100u);
    const std::vector<Message> messages = read_all(reader);
    ASSERT_EQ(messages.size(), 200u);
    for (std::size_t i = 1; i < messages.size(); ++i) EXPECT_LT(messages[i - 1].stamp, messages[i].stamp);
    for (const Message& message : messages) {
      const bool cloud = message.connection == 0;
      const auto i = std::uint32_t((message.stamp - kBegin + (cloud ? 0 : 5 * kTenth - 1)) / kTenth);
      EXPECT_EQ(message.bytes, payload(cloud ? i : 1000 + i, cloud ? 20000 : 10));
    }
    EXPECT_FALSE(reader.truncated());
    EXPECT_EQ(reader.problem(), "");
  }
}

TEST(Rosbag1, SelectTakesOneTopicFromTheStart) {
  const TemporaryFolder folder;
  write_bag(folder / "a.bag", BagCompression::none, 60);
  Rosbag1Reader reader(folder / "a.bag");
  ASSERT_TRUE(reader.next());
  reader.select({"/points"});
  const std::vector<Message> messages = read_all(reader);
  ASSERT_EQ(messages.size(), 60u);
  for (std::uint32_t i = 0; i < 60; ++i) EXPECT_EQ(messages[i].stamp, kBegin + i * kTenth);
  expect_error([&] { reader.select({"/cloud"}); }, {"a.bag", "no topic /cloud", "/points", "/imu"});
}

TEST(Rosbag1, BagWithoutMessagesIsWhole) {
  const TemporaryFolder folder;
  write_bag(folder / "a.bag", BagCompression::lz4, 0);
  Rosbag1Reader reader(folder / "a.bag");
  EXPECT_EQ(reader.connections().size(), 2u);
  EXPECT_FALSE(reader.next());
  EXPECT_EQ(reader.problem(), "");
}

TEST(Rosbag1, CrashedRecordingIsReadWithoutIndex) {
  const std::string chunk = two_messages();
  for (const std::string& bag : {crashed_bag("none", chunk, std::uint32_t(chunk.size())),  // its chunk was closed
                                 crashed_bag("none", "", 0) + chunk}) {                    // or not
    const Outcome outcome = read_bytes(bytes_of(bag));
    EXPECT_TRUE(outcome.truncated);
    EXPECT_NE(outcome.problem.find("no index"), std::string::npos) << outcome.problem;
    ASSERT_EQ(outcome.messages.size(), 2u);
    EXPECT_EQ(outcome.messages[0].stamp, 1000000004u);
    EXPECT_EQ(outcome.messages[0].bytes, bytes_of("at 1000000004"));
    EXPECT_EQ(outcome.messages[1].bytes, bytes_of("at 2000000005"));
  }
}

TEST(Rosbag1, TruncatedAnywhereGivesTheMessagesBefore) {
  const TemporaryFolder folder;
  for (const BagCompression compression : {BagCompression::none, BagCompression::lz4}) {
    write_bag(folder / "a.bag", compression, 60);
    const std::vector<std::byte> bytes = read_file(folder / "a.bag");
    std::size_t most = 0;
    for (std::size_t length = 5000; length < bytes.size(); length += 9973) {
      const Outcome outcome = read_bytes({bytes.begin(), bytes.begin() + std::ptrdiff_t(length)});
      EXPECT_TRUE(outcome.truncated) << length;
      EXPECT_NE(outcome.problem, "") << length;
      EXPECT_GE(outcome.messages.size(), most) << length;
      most = outcome.messages.size();
      const std::size_t at_least = compression == BagCompression::none ? 120 * length / bytes.size() : 3;
      EXPECT_GE(most + 3, at_least) << length;
    }
    EXPECT_EQ(most, 120u) << "all messages stand before the index";
  }
}

TEST(Rosbag1, EveryTruncationOfASmallBag) {
  const TemporaryFolder folder;
  Rosbag1Writer writer(folder / "a.bag", BagCompression::lz4);
  writer.add_connection({0, "/p", "t/T", "*", ""});
  for (std::uint32_t i = 0; i < 5; ++i) writer.write(0, kBegin + i, payload(i, 30));
  writer.close();
  const std::vector<std::byte> bytes = read_file(folder / "a.bag");
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    const std::vector<std::byte> part(bytes.begin(), bytes.begin() + std::ptrdiff_t(length));
    if (length < rosbag1::kMagic.size()) {
      EXPECT_THROW(read_bytes(part), Error) << length;
    } else {
      EXPECT_TRUE(read_bytes(part).truncated) << length;
    }
  }
  EXPECT_EQ(read_bytes(bytes).messages.size(), 5u);
  expect_corruption_survived(bytes, 5000, [](const auto& corrupt) { read_bytes(corrupt); });
}

TEST(Rosbag1, DamagedChunkCostsItsMessagesOnly) {
  const TemporaryFolder folder;
  write_bag(folder / "a.bag", BagCompression::lz4, 100);
  std::vector<std::byte> bytes = read_file(folder / "a.bag");
  const std::size_t middle = bytes.size() / 2;
  for (std::size_t i = 0; i < 64; ++i) bytes[middle + i] ^= std::byte{0x5a};
  const Outcome outcome = read_bytes(bytes);
  EXPECT_FALSE(outcome.truncated);
  EXPECT_NE(outcome.problem.find("chunk at byte"), std::string::npos) << outcome.problem;
  EXPECT_NE(outcome.problem.find("messages lost)"), std::string::npos) << outcome.problem;
  EXPECT_GT(outcome.messages.size(), 100u);
  EXPECT_LT(outcome.messages.size(), 200u);
}

TEST(Rosbag1, LyingSizesAllocateNothing) {
  for (const std::string compression : {"none", "bz2", "lz4", "zip"}) {
    for (const std::uint32_t size : {0U, 1U, 1U << 30, 0xffffffffU}) {
      const Outcome outcome = read_bytes(bytes_of(crashed_bag(compression, "abc", size)));
      EXPECT_TRUE(outcome.truncated);
      EXPECT_EQ(outcome.messages.size(), 0u);
    }
  }
  std::string bag = crashed_bag("none", "", 0);
  const Outcome outcome = read_bytes(bytes_of(bag + raw(0xfffffff0U) + "abc"));
  EXPECT_NE(outcome.problem.find("breaks off at byte " + std::to_string(bag.size())), std::string::npos);
}

TEST(Rosbag1, WhatIsNoBagIsRefused) {
  expect_error([] { read_bytes({}); }, {"a.bag", "empty"});
  expect_error([] { read_bytes(bytes_of("#ROSBAG V1.2\nabc")); }, {"a.bag", "version other than 2.0"});
  expect_error([] { read_bytes(bytes_of("SQLite format 3")); }, {"a.bag", "no ROS 1 bag"});
  expect_error([] { Rosbag1Reader("/nowhere/a.bag"); }, {"/nowhere/a.bag", "No such file"});
}

TEST(Rosbag1, FullDiskIsReported) {
  expect_error([] { write_bag("/dev/full", BagCompression::none, 3); }, {"/dev/full", "No space left on device"});
}

}  // namespace
}  // namespace tilth
