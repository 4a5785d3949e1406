// Foxglove's protocol as texts and bytes: what is said, and what is refused of a client.
#include <io/expect_error.hpp>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <tilth/view/client_feed.hpp>
#include <tilth/view/visitor.hpp>

namespace tilth {
namespace {

using Json = nlohmann::json;

ViewMessage message_of(RunTopic topic, std::uint64_t number) {
  return {topic, number, std::make_shared<const std::vector<std::byte>>(3, std::byte(number))};
}

std::vector<ViewFrame> all_of(ClientFeed& feed) {
  std::vector<ViewFrame> frames;
  while (std::optional<ViewFrame> frame = feed.next()) frames.push_back(std::move(*frame));
  return frames;
}

std::string subscription(std::uint32_t id, RunTopic topic) {
  const Json entry{{"id", id}, {"channelId", std::size_t(topic) + 1}};
  return Json{{"op", "subscribe"}, {"subscriptions", Json::array({entry})}}.dump();
}

TEST(Foxglove, TakesTheFirstProtocolThatItSpeaks) {
  EXPECT_EQ(chosen_protocol("foxglove.sdk.v1"), "foxglove.sdk.v1");
  EXPECT_EQ(chosen_protocol("chat, foxglove.websocket.v1,foxglove.sdk.v1"), "foxglove.websocket.v1");
  for (const char* other : {"", ",", "foxglove.websocket.v2", "foxglove.sdk.v1x", "FOXGLOVE.SDK.V1"})
    EXPECT_EQ(chosen_protocol(other), "") << other;
}

TEST(Foxglove, AdvertisesWhatARecordingHolds) {
  const Json said = Json::parse(advertisement(view_channels()));
  EXPECT_EQ(said["op"], "advertise");
  ASSERT_EQ(said["channels"].size(), kRunTopics);
  const Json& odometry = said["channels"][std::size_t(RunTopic::odometry)];
  EXPECT_EQ(odometry["topic"], "/odometry");
  EXPECT_EQ(odometry["encoding"], "cdr");
  EXPECT_EQ(odometry["schemaEncoding"], "ros2msg");
  EXPECT_EQ(odometry["schemaName"], "nav_msgs/msg/Odometry");
  EXPECT_EQ(Json::parse(server_info("a \"name\" \xff", "7"))["op"], "serverInfo") << "also of a name that is no UTF-8";
}

TEST(Foxglove, HeadsAMessageByThirteenBytes) {
  const std::string head = message_head(0x01020304, 0x1112131415161718);
  EXPECT_EQ(head, std::string("\x01\x04\x03\x02\x01\x18\x17\x16\x15\x14\x13\x12\x11"));
}

TEST(Foxglove, RefusesRequestsByName) {
  const auto refused = [](const std::string& text, const std::string& why) {
    expect_error([&] { parse_request(text); }, {why});
  };
  refused("", "no object");
  refused("[1]", "no object");
  refused(std::string(60000, '['), "no object");
  refused("{\"op\":5}", "operation");
  refused(R"({"op":"fetchAsset","uri":"file:///etc/passwd","requestId":1})", "fetchAsset");
  refused(R"({"op":"subscribe"})", "subscriptions");
  refused(R"({"op":"subscribe","subscriptions":[{"id":1}]})", "channelId");
  refused(R"({"op":"subscribe","subscriptions":[{"id":-1,"channelId":1}]})", "id");
  refused(R"({"op":"subscribe","subscriptions":[{"id":4294967296,"channelId":1}]})", "32 bits");
  refused(R"({"op":"unsubscribe","subscriptionIds":[1.5]})", "32 bits");
  refused(R"({"op":"unsubscribe","subscriptionIds":[)" +
              [] {
                std::string many = "0";
                for (int i = 0; i < 1000; ++i) many += ",0";
                return many;
              }() +
              "]}",
          "1000");
}

TEST(ClientFeed, SendsWhatIsSubscribedTo) {
  ClientFeed feed({"hello"});
  feed.offer(message_of(RunTopic::tf, 1));
  EXPECT_EQ(feed.take_text(subscription(9, RunTopic::tf)), std::vector{RunTopic::tf});
  feed.offer(message_of(RunTopic::tf, 2));
  feed.offer(message_of(RunTopic::map, 3));
  const std::vector<ViewFrame> frames = all_of(feed);
  ASSERT_EQ(frames.size(), 2U);
  EXPECT_EQ(frames[0].text, "hello");
  EXPECT_FALSE(frames[1].is_text);
  EXPECT_EQ(frames[1].text, message_head(9, 2));
  EXPECT_EQ(frames[1].bytes->front(), std::byte(2));
  feed.take_text(R"({"op":"unsubscribe","subscriptionIds":[9]})");
  feed.offer(message_of(RunTopic::tf, 4));
  EXPECT_TRUE(all_of(feed).empty());
}

TEST(ClientFeed, TheNewestWinAndItIsSaid) {
  ClientFeed feed({});
  feed.take_text(subscription(1, RunTopic::scan));
  feed.take_text(subscription(2, RunTopic::map));
  for (std::uint64_t i = 0; i < 1000; ++i) {
    feed.offer(message_of(RunTopic::scan, i));
    feed.offer(message_of(RunTopic::map, i));
  }
  const std::size_t most = kWaiting[std::size_t(RunTopic::scan)];
  EXPECT_EQ(feed.dropped(), 1000 - most) << "a newer map holds the older one";
  std::vector<std::uint64_t> scans;
  std::size_t maps = 0, told = 0;
  for (const ViewFrame& frame : all_of(feed)) {
    if (frame.is_text) {
      ++told;
      EXPECT_NE(frame.text.find(std::to_string(1000 - most) + " messages left out"), std::string::npos) << frame.text;
    } else if (frame.text[1] == 1) {
      scans.push_back(std::uint8_t(frame.text[5]) + 256 * std::uint8_t(frame.text[6]));
    } else {
      ++maps;
    }
  }
  EXPECT_EQ(told, 1U);
  EXPECT_EQ(maps, 1U);
  ASSERT_EQ(scans.size(), most);
  EXPECT_EQ(scans.back(), 999U);
}

TEST(ClientFeed, SaysWhatIsWrongAndCutsOffWhoAsksWithoutReading) {
  ClientFeed feed({});
  feed.take_text("nonsense");
  feed.take_binary();
  feed.take_text(subscription(1, RunTopic(200)));
  feed.take_text(subscription(1, RunTopic::map));
  feed.take_text(subscription(2, RunTopic::map));
  feed.take_text(subscription(1, RunTopic::tf));
  const std::vector<ViewFrame> answers = all_of(feed);
  ASSERT_EQ(answers.size(), 5U);
  for (const ViewFrame& answer : answers) EXPECT_EQ(Json::parse(answer.text)["op"], "status");
  for (int i = 0; i < 50; ++i) feed.take_text("nonsense");
  EXPECT_FALSE(feed.flooding());
  for (int i = 0; i < 100; ++i) feed.take_text("nonsense");
  EXPECT_TRUE(feed.flooding());
}

TEST(Visitors, AreProgramsAndPagesOfThisMachine) {
  const std::string_view here = "127.0.0.1:8765";
  for (const char* welcome : {"", "http://localhost:8765", "http://127.0.0.1:8765", "http://[::1]:1", "file://",
                              "https://app.foxglove.dev", "app://lichtblick", "http://localhost"})
    EXPECT_TRUE(may_visit(welcome, here)) << welcome;
  for (const char* refused : {"null", "http://example.com", "https://foxglove.dev.example.com",
                              "http://app.foxglove.dev", "https://evilfoxglove.dev", "http://localhost.example.com",
                              "http://192.168.1.5:8765", "http://", "https://127.0.0.1.example.com:8765"})
    EXPECT_FALSE(may_visit(refused, here)) << refused;
  EXPECT_TRUE(may_visit("http://192.168.1.5:8765", "192.168.1.5:8765"));
  EXPECT_FALSE(may_visit("http://evil.example.com:8765", "evil.example.com:8765")) << "a name turned to this address";
}

}  // namespace
}  // namespace tilth
