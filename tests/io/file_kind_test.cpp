// Kinds of files by their names, recordings of odd but valid shape, dates.
#include <fstream>

#include <gtest/gtest.h>

#include "io/expect_error.hpp"
#include "io/temporary_folder.hpp"
#include <tilth/io/date_times_file.hpp>
#include <tilth/io/file_kind.hpp>
#include <tilth/io/rosbag2_metadata.hpp>

namespace tilth {
namespace {

void touch(const std::filesystem::path& path, const std::string& text = "") {
  std::ofstream(path) << text;
}

TEST(FileKind, IsTheExtensionInLowerCase) {
  for (const char* name : {"a.bag", "A.BAG", "a.bag.active", "a.Bag.ACTIVE", "2024.06.01.bag"})
    EXPECT_EQ(kind_of_file(name), ".bag") << name;
  EXPECT_EQ(kind_of_file("b.db3.zstd"), ".db3");
  EXPECT_EQ(kind_of_file("b.MCAP.active"), ".mcap");
  EXPECT_EQ(kind_of_file("no_extension"), "");
  EXPECT_TRUE(is_hidden("folder/._000001.pcd"));
  EXPECT_FALSE(is_hidden(".folder/000001.pcd"));
}

TEST(Rosbag2Metadata, StorageMayBeEmptyAndFilesUnlisted) {
  const std::string head = "rosbag2_bagfile_information:\n  version: 5\n";
  for (const char* storage : {"", "  storage_identifier: \"\"\n", "  storage_identifier:\n"}) {
    for (const char* list : {"  relative_file_paths: [a.mcap]\n", "  relative_file_paths: []\n", ""}) {
      const TemporaryFolder folder;
      touch(folder / "metadata.yaml", head + storage + list);
      touch(folder / "a.mcap"), touch(folder / "._a.mcap");
      EXPECT_EQ(rosbag2_files(folder / ""), std::vector{folder / "a.mcap"}) << storage << list;
    }
  }
  expect_error([&] { parse_rosbag2_metadata(head + "  storage_identifier: leveldb\n", "m"); }, {"m", "leveldb"});
}

TEST(DateTimes, AreSecondsSince1970) {
  const std::vector<double> times =
      parse_date_times("2011-09-26 13:02:25.951199337\n\n1970-01-01 00:00:00\r\n2024-02-29 23:59:59.5\n", "t");
  ASSERT_EQ(times.size(), 3u);
  EXPECT_NEAR(times[0], 1317042145.951199337, 1e-6);
  EXPECT_EQ(times[1], 0.0);
  EXPECT_EQ(times[2], 1709251199.5);
}

TEST(DateTimes, NamesTheLineThatIsNone) {
  for (const char* line : {"12.5", "2011-02-30 00:00:00", "2011-09-26", "2011-09-26 24:00:00", "2011-09-26 1:2", "a b",
                           "2011-09-26 -1:00:00", "99999-01-01 00:00:00", "2011-09-26 00:00:nan"}) {
    expect_error([&] { parse_date_times(std::string("2011-09-26 13:02:25.95\n") + line + "\n", "t.txt"); },
                 {"t.txt, line 2", "no date and time"});
  }
  expect_error([] { parse_date_times("\n", "t.txt"); }, {"t.txt", "no times"});
}

}  // namespace
}  // namespace tilth
