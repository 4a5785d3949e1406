// The server as it stands in the network: what it gives to whom, and what it survives.
#include <chrono>
#include <io/expect_error.hpp>
#include <random>
#include <thread>

#include <gtest/gtest.h>

#include "raw_client.hpp"
#include <tilth/view/view_server.hpp>

namespace tilth {
namespace {

constexpr const char* kTf = "3";  // its channel

std::string request(const std::string& method, const std::string& target) {
  return method + " " + target + " HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n";
}

class View : public testing::Test {
 protected:
  std::string answer(const std::string& bytes) const {
    const RawClient client(server_.port());
    client.send(bytes);
    return client.receive();
  }
  void expect_alive() const { EXPECT_NE(answer(request("GET", "/")).find("200 OK"), std::string::npos); }

  ViewServer server_{{"127.0.0.1", 0}, "test"};
};

TEST_F(View, GivesOnePageAndNoFile) {
  const std::string page = answer(request("GET", "/"));
  EXPECT_TRUE(page.starts_with("HTTP/1.1 200 OK\r\n")) << page.substr(0, 80);
  EXPECT_NE(page.find("Content-Security-Policy: default-src 'none'"), std::string::npos);
  EXPECT_NE(page.find("</html>"), std::string::npos);
  EXPECT_EQ(answer(request("HEAD", "/")).find("</html>"), std::string::npos);
  for (const char* path : {"/etc/passwd", "/../../../../etc/passwd", "//etc/passwd", "/%2e%2e/etc/passwd",
                           "/report.html", "file:///etc/passwd", "*"})
    EXPECT_TRUE(answer(request("GET", path)).starts_with("HTTP/1.1 404")) << path;
  for (const char* method : {"POST", "PUT", "DELETE", "OPTIONS", "TRACE"})
    EXPECT_TRUE(answer(request(method, "/")).starts_with("HTTP/1.1 405")) << method;
}

TEST_F(View, SpeaksBothProtocolsWithPagesOfThisMachineOnly) {
  for (const char* protocol : {"foxglove.sdk.v1", "foxglove.websocket.v1"}) {
    const RawClient client(server_.port());
    client.send(handshake("Origin: http://localhost:8765\r\n", protocol));
    const std::string greeting = client.receive("advertise");
    EXPECT_TRUE(greeting.starts_with("HTTP/1.1 101")) << greeting.substr(0, 80);
    EXPECT_NE(greeting.find(std::string("Sec-WebSocket-Protocol: ") + protocol), std::string::npos);
    EXPECT_NE(greeting.find("serverInfo"), std::string::npos);
  }
  EXPECT_TRUE(answer(handshake("", "chat")).starts_with("HTTP/1.1 400"));
  EXPECT_TRUE(answer(handshake("Origin: https://example.com\r\n")).starts_with("HTTP/1.1 403"));
}

TEST_F(View, SendsWhatIsAskedForAndTheLastOfItToWhoComesLater) {
  EXPECT_FALSE(server_.wanted(RunTopic::tf));
  const RawClient first(server_.port());
  subscribe(first, kTf);
  ASSERT_TRUE(becomes_wanted(server_, RunTopic::tf));
  EXPECT_FALSE(server_.wanted(RunTopic::map));
  server_.send(RunTopic::tf, 1.5, std::vector<std::byte>(5, std::byte('x')));
  EXPECT_NE(first.receive("xxxxx").find(std::string("\x82\x12\x01\x03\0\0\0\0\x2f\x68\x59\0\0\0\0xxxxx", 20)),
            std::string::npos)
      << "opcode, subscription, nanoseconds, message";
  const RawClient second(server_.port());
  subscribe(second, kTf);
  EXPECT_NE(second.receive("xxxxx").find("xxxxx"), std::string::npos);
}

TEST_F(View, ForgetsWhoLeaves) {
  {
    const RawClient client(server_.port());
    subscribe(client, kTf);
    ASSERT_TRUE(becomes_wanted(server_, RunTopic::tf));
  }
  EXPECT_TRUE(becomes_wanted(server_, RunTopic::tf, false));
}

TEST_F(View, NobodyWaitsForAClientThatDoesNotRead) {
  const RawClient client(server_.port());
  subscribe(client, kTf);
  ASSERT_TRUE(becomes_wanted(server_, RunTopic::tf));
  const auto begin = std::chrono::steady_clock::now();
  for (int i = 0; i < 2000; ++i) server_.send(RunTopic::tf, i, std::vector<std::byte>(100'000, std::byte('y')));
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(2));
  expect_alive();
  EXPECT_NE(client.receive("left out").find("left out"), std::string::npos) << "it is told when it reads again";
}

TEST_F(View, CutsOffWhatIsTooLong) {
  EXPECT_FALSE(answer(request("GET", std::string(100'000, '/'))).starts_with("HTTP/1.1 200"));
  const RawClient client(server_.port());
  client.send(handshake());
  client.receive("advertise");
  client.send(client_frame(std::string(1 << 17, ' ')));
  client.receive("", 1000);
  EXPECT_EQ(client.receive("", 200), "") << "closed";
  expect_alive();
}

TEST_F(View, SurvivesBytesOfAnyKind) {
  std::mt19937 random(5);
  const std::string frames = client_frame(R"({"op":"subscribe","subscriptions":[{"id":3,"channelId":3}]})") +
                             client_frame("{}", 0x82) + client_frame("", 0x89);
  const auto mutated = [&](std::string bytes) {
    for (unsigned i = 0; i < 1 + random() % 8; ++i) bytes[random() % bytes.size()] = char(random());
    bytes.resize(1 + random() % bytes.size());
    return bytes;
  };
  for (int round = 0; round < 300; ++round) {
    const bool opens = round % 2 == 0;
    const RawClient client(server_.port());
    ASSERT_TRUE(client.connected());
    client.send(opens ? handshake() : mutated(handshake()));
    if (opens) client.receive("advertise");
    if (opens) client.send(mutated(frames));
    client.send_no_more();
    if (round % 10 == 0) client.receive("", 100);
  }
  expect_alive();
}

TEST_F(View, TakesNoMoreConnectionsThanItCanServe) {
  std::vector<std::unique_ptr<RawClient>> idle;
  for (int i = 0; i < 100; ++i) idle.push_back(std::make_unique<RawClient>(server_.port()));
  idle.clear();
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  expect_alive();
}

TEST(ViewServer, TakesAnotherPortWhereOneIsTakenAndRefusesForeignAddresses) {
  const ViewServer first({"127.0.0.1", 0}, "first");
  const ViewServer second({"127.0.0.1", first.port()}, "second");
  EXPECT_NE(second.port(), first.port());
  expect_error([] { ViewServer({"localhost", 0}, ""); }, {"localhost"});
  expect_error([] { ViewServer({"192.0.2.7", 0}, ""); }, {"192.0.2.7"});
}

TEST(ViewServer, SaysGoodbyeAfterTheLastMessage) {
  auto server = std::make_unique<ViewServer>(ViewAddress{"127.0.0.1", 0}, "short");
  const RawClient client(server->port());
  subscribe(client, kTf);
  ASSERT_TRUE(becomes_wanted(*server, RunTopic::tf));
  server->send(RunTopic::tf, 1, std::vector<std::byte>(9, std::byte('z')));
  std::thread ending([&] { server.reset(); });
  const std::string last = client.receive("zzzzzzzzz");
  ending.join();
  EXPECT_NE(last.find("zzzzzzzzz"), std::string::npos);
}

}  // namespace
}  // namespace tilth
