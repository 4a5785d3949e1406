// Clouds that a library hands over become scans, with the bits of a recording; what is lost, silent or wrong is said.
#include <algorithm>
#include <atomic>
#include <clocale>
#include <cstdlib>
#include <dlfcn.h>
#include <fstream>
#include <functional>
#include <io/temporary_folder.hpp>
#include <sources/driven_clouds.hpp>
#include <thread>

#include <gtest/gtest.h>

#include <tilth/core/error.hpp>
#include <tilth/sources/cloud_source.hpp>
#include <tilth/sources/ros2_library.hpp>
#include <tilth/sources/ros2_source.hpp>

struct TilthRos2Topic {
  std::vector<tilth::Message> clouds = {};
  std::size_t next = 0, lost = 0;  ///< lost before each
  std::string text = "nobody sends it";
  bool fails = false;  ///< at the end
};

namespace tilth {
namespace {

/// What the library has when it is opened next.
TilthRos2Topic& prepared() {
  static TilthRos2Topic topic;
  return topic;
}

int next_cloud(TilthRos2Topic* topic, int milliseconds, TilthRos2Cloud* cloud) {
  if (topic->next < topic->clouds.size()) {
    const std::vector<std::byte>& bytes = topic->clouds[topic->next++].bytes;
    *cloud = {reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size(), topic->lost};
    return 1;
  }
  if (topic->fails) return -1;
  std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds / 10));
  return 0;
}

std::atomic<int> opened = 0;

TilthRos2Topic* open_prepared(const char*, bool, std::size_t) {
  auto* const topic = new TilthRos2Topic(prepared());
  ++opened;
  return topic;
}

const TilthRos2Library kLibrary{open_prepared, next_cloud, [](TilthRos2Topic* topic) { return topic->text.c_str(); },
                                [](TilthRos2Topic* topic) { delete topic; }};

std::unique_ptr<Ros2Topic> topic_with(const TilthRos2Topic& content,
                                      const std::string& options = "queue=100&idle=0.3") {
  prepared() = content;
  const int before = opened;
  auto topic = std::make_unique<Ros2Topic>(kLibrary, parse_ros2_uri("ros2:/points?" + options, {}), nullptr);
  while (opened == before) std::this_thread::sleep_for(std::chrono::milliseconds(1));  // by the topic's own thread
  return topic;
}

const std::vector<Message>& clouds() {
  static const std::vector<Message> all = driven_clouds("sim://corridor?seed=5&columns=450&duration=2", 0.0);
  return all;
}

std::string refusal(const std::function<void()>& f) {
  try {
    f();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

bool any_has(const std::vector<std::string>& sentences, const std::string& part) {
  return std::any_of(sentences.begin(), sentences.end(),
                     [&](const std::string& s) { return s.find(part) != std::string::npos; });
}

TEST(Ros2Source, GivesTheScansOfARecording) {
  std::size_t next = 0;
  const auto hand_over = [&]() { return next < clouds().size() ? std::optional(clouds()[next++]) : std::nullopt; };
  const auto recording = open_clouds({.name = "memory", .next = hand_over}, "", {}, {});
  Ros2Source source(topic_with({clouds()}));
  std::size_t scans = 0;
  while (const std::optional<Scan> expected = recording->next()) {
    const std::optional<Scan> scan = source.next();
    ASSERT_TRUE(scan);
    EXPECT_EQ(scan->stamp, expected->stamp);
    EXPECT_EQ(scan->cloud.points, expected->cloud.points);
    EXPECT_EQ(scan->cloud.times, expected->cloud.times);
    EXPECT_EQ(scan->cloud.rings, expected->cloud.rings);
    ++scans;
  }
  EXPECT_GE(scans, 18U);
  EXPECT_FALSE(source.next()) << "it is silent";
  EXPECT_EQ(source.losses().count, 0U);
  EXPECT_TRUE(source.losses().sentence.empty());
  EXPECT_FALSE(source.decisions().empty());
}

TEST(Ros2Source, CountsWhatIsLostAndWhatMakesWay) {
  Ros2Source source(topic_with({.clouds = clouds(), .lost = 2}, "queue=1&idle=0.3"));
  std::size_t scans = 0;
  while (source.next()) ++scans;
  EXPECT_GT(scans, 0U);
  EXPECT_EQ(source.losses().count, clouds().size() - scans + 2 * clouds().size());
  EXPECT_TRUE(any_has(source.notices(), std::to_string(2 * clouds().size()) + " lost on the way"));
}

TEST(Ros2Source, EndsWhereStampsFallBackAndSaysSo) {
  TilthRos2Topic twice{clouds()};
  twice.clouds.insert(twice.clouds.end(), clouds().begin(), clouds().end());
  Ros2Source source(topic_with(twice));
  std::size_t scans = 0;
  while (source.next()) ++scans;
  EXPECT_EQ(scans, clouds().size());
  EXPECT_TRUE(any_has(source.notices(), "fall back by"));
}

TEST(Ros2Source, SaysWhyNothingCame) {
  EXPECT_EQ(refusal([] { Ros2Source source(topic_with({})); }), "topic /points: no cloud came: nobody sends it");
  EXPECT_EQ(refusal([] { Ros2Source source(topic_with({.text = "rcl says no", .fails = true})); }),
            "topic /points: rcl says no");
  Ros2Source source(topic_with({.clouds = clouds(), .text = "gone", .fails = true}));
  while (source.next()) {
  }
  EXPECT_TRUE(any_has(source.notices(), "gone")) << "what was wrong later is said as well";
}

TEST(Ros2Topic, TellsWhetherItBegan) {
  const auto silent = topic_with({}, "idle=30"), begun = topic_with({clouds()});
  EXPECT_FALSE(silent->wait_for_first(std::chrono::milliseconds(50)));
  while (silent->situation().empty()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  EXPECT_EQ(silent->situation(), "nobody sends it");
  EXPECT_TRUE(begun->wait_for_first(std::chrono::seconds(60)));
}

TEST(Ros2Topic, ItsNameIsReadOrRefused) {
  const Ros2Address address = parse_ros2_uri("ros2:/a/b?queue=7&reliable=true", {{"queue", "9"}, {"unit", "mm"}});
  EXPECT_EQ(address.topic, "/a/b");
  EXPECT_EQ(address.options.queue, 7U) << "of the name";
  EXPECT_TRUE(address.options.reliable);
  EXPECT_NE(refusal([] { parse_ros2_uri("ros2:", {}); }).find("names no topic"), std::string::npos);
  EXPECT_NE(refusal([] { parse_ros2_uri("ros2:/a?host=1.2.3.4", {}); }).find("means nothing for a topic of ROS 2"),
            std::string::npos);
}

TEST(Ros2Library, IsLookedForAndRefusedInWords) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder / "lib");
  setenv("AMENT_PREFIX_PATH", (folder / "").c_str(), 1);
  EXPECT_NE(refusal([] { load_ros2_library(""); }).find("libtilth_ros2.so: is not found"), std::string::npos);
  std::ofstream(folder / "lib/libtilth_ros2.so") << "no library";
  EXPECT_NE(refusal([] { load_ros2_library(""); }).find("cannot be loaded"), std::string::npos);
  unsetenv("AMENT_PREFIX_PATH");
  EXPECT_NE(refusal([] { load_ros2_library("libm.so.6"); }).find("cannot be loaded"), std::string::npos);
  Dl_info other{};
  ASSERT_NE(dladdr(reinterpret_cast<void*>(&std::setlocale), &other), 0);
  EXPECT_NE(refusal([&] { load_ros2_library(other.dli_fname); }).find("is not libtilth_ros2"), std::string::npos);
}

}  // namespace
}  // namespace tilth
