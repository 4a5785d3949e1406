// A file that grows is whole after every line, and is made whole again after a crash.
#include <fstream>

#include <gtest/gtest.h>

#include "temporary_folder.hpp"
#include <tilth/core/error.hpp>
#include <tilth/io/append_file.hpp>
#include <tilth/io/input_file.hpp>

namespace tilth {
namespace {

std::string text_of(const std::filesystem::path& path) {
  const std::vector<std::byte> bytes = read_file(path);
  return std::string(as_text(bytes));
}

TEST(AppendFile, HoldsEveryLineAtOnceAndGoesOn) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder / "lines";
  AppendFile file(path, true);
  EXPECT_TRUE(file.empty());
  file.write_line("one\n");
  EXPECT_EQ(text_of(path), "one\n") << "while it is open";
  AppendFile again(path, false);
  EXPECT_FALSE(again.empty());
  again.write_line("two\n");
  EXPECT_EQ(text_of(path), "one\ntwo\n");
  AppendFile anew(path, true);
  EXPECT_EQ(text_of(path), "");
}

TEST(AppendFile, LinesThatWereCutAreTakenAway) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder / "lines";
  EXPECT_EQ(keep_whole_lines(path), 0U);
  std::ofstream(path) << "one\ntwo\nthr";
  EXPECT_EQ(keep_whole_lines(path), 2U);
  EXPECT_EQ(text_of(path), "one\ntwo\n");
  std::ofstream(path) << "cut";
  EXPECT_EQ(keep_whole_lines(path), 0U);
  EXPECT_EQ(text_of(path), "");
}

TEST(AppendFile, SaysWhyItCannotBeWritten) {
  EXPECT_THROW(AppendFile("/no/such/folder/file", true), Error);
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
  AppendFile full("/dev/full", false);
  EXPECT_THROW(full.write_line("x\n"), Error);
}

}  // namespace
}  // namespace tilth
