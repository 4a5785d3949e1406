// What the writer of MCAP writes its reader reads; tests/io/check_outputs.py holds it against other people's readers.
#include <algorithm>
#include <random>

#include <gtest/gtest.h>

#include "temporary_folder.hpp"
#include <tilth/io/mcap.hpp>
#include <tilth/io/mcap_writer.hpp>

namespace tilth {
namespace {

Connection topic(const std::string& name) {
  Connection connection;
  connection.topic = name, connection.type = "pkg/msg/Type", connection.definition = "uint8[] data\n";
  return connection;
}

TEST(McapWriter, GivesBackEveryMessageInTheOrderOfTime) {
  const TemporaryFolder folder;
  std::mt19937 random(7);
  std::vector<Message> sent;
  McapWriter file(folder / "a.mcap");
  const std::uint32_t a = file.add_connection(topic("/a"));
  std::uint32_t b = a;
  for (std::uint64_t i = 0; i < 60; ++i) {
    if (i == 20) b = file.add_connection(topic("/b"));  // in the middle of a chunk
    Message message{i % 3 == 0 ? a : b, 1'600'000'000'000'000'000 + (i ^ 3) * 1000, {}};
    message.bytes.resize(i % 7 * 30'000);
    for (std::byte& byte : message.bytes) byte = std::byte(random() & 7);
    file.write(message.connection, message.stamp, message.bytes);
    sent.push_back(std::move(message));
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "a.mcap")) << "before it is closed";
  file.close();
  std::stable_sort(sent.begin(), sent.end(), [](const auto& x, const auto& y) { return x.stamp < y.stamp; });
  McapReader reader(folder / "a.mcap");
  EXPECT_EQ(reader.problem(), "");
  ASSERT_EQ(reader.connections().size(), 2U);
  EXPECT_EQ(reader.connections()[1].topic, "/b");
  EXPECT_EQ(reader.connections()[1].type, "pkg/msg/Type");
  EXPECT_EQ(reader.connections()[1].encoding, "cdr");
  for (const Message& message : sent) {
    const std::optional<Message> got = reader.next();
    ASSERT_TRUE(got);
    EXPECT_EQ(got->connection, message.connection);
    EXPECT_EQ(got->stamp, message.stamp);
    EXPECT_EQ(got->bytes, message.bytes);
  }
  EXPECT_FALSE(reader.next());
}

TEST(McapWriter, ARecordingWithoutMessagesIsOne) {
  const TemporaryFolder folder;
  McapWriter file(folder / "a.mcap");
  file.add_connection(topic("/a"));
  file.close();
  McapReader reader(folder / "a.mcap");
  EXPECT_EQ(reader.problem(), "");
  EXPECT_FALSE(reader.next());
}

}  // namespace
}  // namespace tilth
