// --set key=value: one or several after it, before and after what stands on its own, in every command that takes it.
#include <gtest/gtest.h>

#include "program.hpp"
#include "room_recording.hpp"

namespace tilth::app {
namespace {

using Arguments = std::vector<std::string>;

void expect_words(const std::string& text, const Arguments& words) {
  for (const std::string& word : words) EXPECT_NE(text.find(word), std::string::npos) << word << " in\n" << text;
}

TEST(Settings, OfConfigInAnyOrder) {
  for (const Arguments& order : {Arguments{"improved_floam", "--set", "min_range=1.5", "max_range=41"},
                                 Arguments{"--set", "min_range=1.5", "max_range=41", "improved_floam"},
                                 Arguments{"--set", "min_range=1.5", "improved_floam", "--set", "max_range=41"},
                                 Arguments{"--set=min_range=1.5", "max_range=41", "improved_floam"}}) {
    Arguments arguments{"config", "--yaml"};
    arguments.insert(arguments.end(), order.begin(), order.end());
    const Outcome outcome = tilth(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    expect_words(outcome.out, {"min_range: 1.5", "max_range: 41"});
  }
}

TEST(Settings, OfRunInAnyOrder) {
  const TemporaryFolder folder;
  const std::string room = (folder / "room").string(), out = (folder / "out").string();
  write_room(room, 2);
  for (const Arguments& arguments : {Arguments{"run", room, "--set", "min_range=1.5", "max_range=41", "--out", out},
                                     Arguments{"run", "--out", out, "--set", "min_range=1.5", "max_range=41", room}}) {
    const Outcome outcome = tilth(arguments);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    expect_words(text_of(folder / "out" / "summary.json"), {R"("min_range": "1.5")", R"("max_range": "41")"});
    std::filesystem::remove_all(out);
  }
}

TEST(Settings, OfSimulateInAnyOrder) {
  const TemporaryFolder folder;
  const std::string out = (folder / "out").string();
  for (const Arguments& arguments :
       {Arguments{"simulate", "corridor", "--out", out, "--set", "duration=0.3", "columns=90", "seed=7"},
        Arguments{"simulate", "--set", "duration=0.3", "columns=90", "seed=7", "corridor", "--out", out}}) {
    const Outcome outcome = tilth(arguments);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    expect_words(text_of(folder / "out" / "recipe.txt"), {"duration=0.3", "columns=90", "seed=7"});
    std::filesystem::remove_all(out);
  }
}

TEST(Settings, TheLastOfAKeyCounts) {
  expect_words(tilth({"config", "--yaml", "--set", "min_range=1.5", "min_range=2.5"}).out, {"min_range: 2.5"});
}

TEST(Settings, OfExperimentsAreListedLast) {
  for (const Arguments& arguments : {Arguments{"config", "tilth"}, Arguments{"config", "tilth", "--markdown"}}) {
    const std::string listing = tilth(arguments).out;
    const std::size_t heading = listing.find("advanced\n");
    ASSERT_NE(heading, std::string::npos) << listing;
    EXPECT_LT(listing.find("max_range"), heading);
    EXPECT_LT(listing.find("map.voxel_size"), heading);
    EXPECT_GT(listing.find("reanchor_after"), heading);
    EXPECT_GT(listing.find("patches.segments.length"), heading);
  }
}

TEST(Settings, EveryFileOfConfigsIsTaken) {
  std::size_t files = 0;
  for (const auto& file : std::filesystem::directory_iterator(std::filesystem::path(TILTH_SOURCE_DIR) / "configs")) {
    ++files;
    const Outcome outcome = tilth({"config", "--yaml", "--config", file.path().string()});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    expect_words(outcome.out, {"pipeline: "});
  }
  EXPECT_GT(files, 0u);
}

TEST(Settings, WhatIsNoSettingIsNoneOfThem) {
  const Outcome stray = tilth({"config", "improved_floam", "--set", "min_range=1.5", "max_range"});
  EXPECT_NE(stray.exit_code, 0);
  expect_words(stray.err, {"max_range"});
  const Outcome path = tilth({"run", "--out", "out", "--set", "min_range=1.5", "./a=b/no_such_room"});
  EXPECT_NE(path.exit_code, 0);
  expect_words(path.err, {"./a=b/no_such_room", "no such"});
}

}  // namespace
}  // namespace tilth::app
