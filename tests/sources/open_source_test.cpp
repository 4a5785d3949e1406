// Folders, files and bags as sources: order, stamps, and what happens to bad records.
#include <fstream>
#include <io/expect_error.hpp>
#include <io/temporary_folder.hpp>
#include <sensor/spinning_lidar.hpp>

#include <gtest/gtest.h>

#include <tilth/io/kitti_bin.hpp>
#include <tilth/io/pcd.hpp>
#include <tilth/io/ply.hpp>
#include <tilth/io/rosbag1_writer.hpp>
#include <tilth/messages/point_cloud2.hpp>
#include <tilth/sources/open_source.hpp>
#include <tilth/sources/scan_files.hpp>

namespace tilth {
namespace {

namespace fs = std::filesystem;

std::vector<Shot> shots(int scan) {
  return shots_of({beams_deg(16, -15, 2), 0.1, 170.0 - 2.0 * scan, 362, true, 0.1005 * scan});
}

PointRecords cloud(int scan) {
  return records_of(shots(scan), {intensity_field(), ring_field()});
}

void write_text(const fs::path& path, const std::string& text) {
  std::ofstream(path) << text;
}

std::vector<Scan> all_of(ScanSource& source) {
  std::vector<Scan> scans;
  while (auto scan = source.next()) scans.push_back(std::move(*scan));
  return scans;
}

bool says(const ScanSource& source, const std::string& text) {
  for (const std::string& sentence : source.decisions()) {
    if (sentence.find(text) != std::string::npos) return true;
  }
  return false;
}

TEST(ScanFiles, AreInNaturalOrder) {
  EXPECT_TRUE(natural_less("9.pcd", "10.pcd"));
  EXPECT_FALSE(natural_less("10.pcd", "9.pcd"));
  EXPECT_TRUE(natural_less("scan_2_b", "scan_10_a"));
  EXPECT_TRUE(natural_less("1.5.pcd", "1.25.pcd")) << "runs of digits are whole numbers";
  EXPECT_TRUE(natural_less("007", "8"));
  EXPECT_NE(natural_less("07", "7"), natural_less("7", "07"));
  EXPECT_FALSE(natural_less("7", "7"));
  EXPECT_TRUE(natural_less("a", "ab"));
  EXPECT_TRUE(natural_less("", "0"));
}

TEST(ScanFiles, StampsComeFromNamesThatAreTimes) {
  const auto stamps = [](const std::string& name) { return stamps_of({"/nowhere/" + name}, 0.0); };
  EXPECT_EQ(stamps("1700000000.123456.pcd").stamps[0], 1700000000.123456);
  EXPECT_NEAR(stamps("1700000000123456789.pcd").stamps[0], 1700000000.123456789, 3e-7);
  EXPECT_NEAR(stamps("1700000000123456.pcd").stamps[0], 1700000000.123456, 3e-7);
  EXPECT_EQ(stamps("0.5.pcd").stamps[0], 0.5);
  for (const char* counter : {"000123.pcd", "12.pcd", "scan_5.pcd", "1.2.3.pcd", "1700000000.pcd"}) {
    EXPECT_TRUE(stamps(counter).nominal) << counter;
    EXPECT_EQ(stamps(counter).stamps[0], 0.0) << counter;
  }
}

TEST(ScanFiles, WithTimesInTheirNamesAreInTheOrderOfTime) {
  const TemporaryFolder folder;
  fs::create_directory(folder / "scans");
  for (const char* name : {"scans/10.5.pcd", "scans/9.75.pcd", "scans/10.25.pcd"}) write_pcd(folder / name, cloud(0));
  const ScanStamps stamps = stamps_of(find_scan_files(folder / ""), 0.0);
  EXPECT_EQ(stamps.stamps, (std::vector<double>{9.75, 10.25, 10.5}));
}

TEST(ScanFiles, NominalStampsFollowTheRate) {
  EXPECT_EQ(stamps_of({"/a/0.pcd", "/a/1.pcd"}, 0.0).stamps, (std::vector<double>{0.0, 0.1}));
  const ScanStamps given = stamps_of({"/a/0.pcd", "/a/1.pcd"}, 20.0);
  EXPECT_EQ(given.stamps, (std::vector<double>{0.0, 0.05}));
  EXPECT_FALSE(given.nominal);
}

TEST(FolderSource, ReadsScansInOrderWithListedTimes) {
  const TemporaryFolder folder;
  fs::create_directory(folder / "clouds");
  std::string times = "# seconds\n";
  for (int k = 0; k < 12; ++k) {
    write_pcd(folder / ("clouds/" + std::to_string(k) + ".pcd"), cloud(k));
    times += std::to_string(5.0 + 362.0 / 3600.0 * k) + "\n";
  }
  write_text(folder / "times.txt", times);
  const auto source = open_source((folder / "").string(), {});
  EXPECT_EQ(source->size(), 12u);
  EXPECT_TRUE(says(*source, "spin period 0.1000 s from the stamps"));
  const std::vector<Scan> scans = all_of(*source);
  ASSERT_EQ(scans.size(), 12u);
  for (int k = 0; k < 12; ++k) {
    const Scan& scan = scans[std::size_t(k)];
    EXPECT_NEAR(scan.stamp, 5.0 + 362.0 / 3600.0 * k, 1e-6);
    EXPECT_EQ(scan.cloud.points[0], shots(k)[0].point.cast<float>().cast<double>());
    EXPECT_TRUE(scan.cloud.has_rings());
    EXPECT_NEAR(scan.cloud.times.back(), 0.1 * 362 / 360, 1e-3);
  }
  EXPECT_TRUE(source->skipped().empty());
  EXPECT_FALSE(source->next());
}

TEST(FolderSource, PassesOverBadScansAndSaysWhy) {
  const TemporaryFolder folder;
  for (int k = 0; k < 8; ++k) write_pcd(folder / (std::to_string(k) + ".pcd"), cloud(k));
  write_text(folder / "0.pcd", "");
  write_text(folder / "2.pcd", "VERSION 0.7\nFIELDS x\n");
  write_pcd(folder / "4.pcd", records_of(std::vector<Shot>(100), {}));
  fs::resize_file(folder / "5.pcd", fs::file_size(folder / "5.pcd") - 1000);
  const auto source = open_source((folder / "").string(), {});
  EXPECT_EQ(all_of(*source).size(), 4u);
  ASSERT_EQ(source->skipped().size(), 4u);
  EXPECT_EQ(source->skipped()[0].index, 0u);
  EXPECT_EQ(source->skipped()[2].where, (folder / "4.pcd").string());
  EXPECT_NE(source->skipped()[2].what.find("100 at (0, 0, 0)"), std::string::npos) << source->skipped()[2].what;
  EXPECT_NE(source->skipped()[3].where.find("5.pcd"), std::string::npos);
}

TEST(FolderSource, MendsTimesThatDoNotAdvance) {
  const TemporaryFolder folder;
  for (int k = 0; k < 8; ++k) write_pcd(folder / (std::to_string(k) + ".pcd"), cloud(k));
  write_text(folder / "times.txt", "0.0\n0.1\n0.1\n0.3\n0.4\n0.05\n0.6\n0.7\n");
  const auto source = open_source((folder / "").string(), {});
  const std::vector<Scan> scans = all_of(*source);
  ASSERT_EQ(scans.size(), 8u);
  for (int k = 0; k < 8; ++k) EXPECT_NEAR(scans[std::size_t(k)].stamp, 0.1 * k, 1e-6);
  EXPECT_TRUE(source->skipped().empty());
  ASSERT_EQ(source->notices().size(), 1u);
  EXPECT_NE(source->notices()[0].find("stamps: 2 were mended"), std::string::npos) << source->notices()[0];
}

TEST(FolderSource, ReadsOneFileAndOnePoint) {
  const TemporaryFolder folder;
  write_pcd(folder / "a.PCD", records_of({{{1, 2, 3}}}, {}));
  const auto source = open_source((folder / "a.PCD").string(), {});
  const std::vector<Scan> scans = all_of(*source);
  ASSERT_EQ(scans.size(), 1u);
  EXPECT_EQ(scans[0].cloud.points, (std::vector<Eigen::Vector3d>{{1, 2, 3}}));
  EXPECT_FALSE(scans[0].cloud.has_times() || scans[0].cloud.has_rings());
}

TEST(FolderSource, RecognisesAKittiSequence) {
  const TemporaryFolder folder;
  fs::create_directory(folder / "velodyne");
  write_text(folder / "calib.txt", "Tr: 1 0 0 0 0 1 0 0 0 0 1 0\n");
  write_text(folder / "times.txt", "0\n0.1037\n");
  for (const char* name : {"velodyne/000000.bin", "velodyne/000001.bin"}) write_kitti_bin(folder / name, cloud(0));
  for (const char* opened : {"", "velodyne"}) {
    const auto source = open_source((folder / opened).string(), {});
    EXPECT_TRUE(says(*source, "KITTI sequence"));
    const std::vector<Scan> scans = all_of(*source);
    ASSERT_EQ(scans.size(), 2u);
    EXPECT_EQ(scans[1].stamp, 0.1037);
    EXPECT_FALSE(scans[1].cloud.has_times());
  }
}

TEST(OpenSource, NamesWhatIsWrong) {
  const TemporaryFolder folder;
  const std::string path = (folder / "").string();
  const auto open = [](const std::string& uri) { return [uri] { open_source(uri, {}); }; };
  expect_error(open(path + "nowhere"), {"nowhere", "no such file or folder"});
  expect_error(open(path), {path, "empty"});
  write_text(folder / "notes.txt", "none");
  expect_error(open(path), {path, "no .pcd, .ply or .bin scans"});
  expect_error(open(path + "notes.txt"), {"notes.txt", "is no folder of scans"});
  write_text(folder / "0.pcd", "");
  expect_error(open(path), {"no scan can be read", "0.pcd"});
  write_pcd(folder / "0.pcd", cloud(0));
  write_pcd(folder / "1.pcd", cloud(1));
  write_text(folder / "times.txt", "0.0\n");
  expect_error(open(path), {"times.txt", "1 times for 2 scans"});
  write_text(folder / "x.bag", "");
  expect_error(open(path + "x.bag"), {"x.bag"});
}

/// A bag of clouds on `topics`, as a velodyne driver writes them: stamped at the end, times before it.
void write_bag(const fs::path& path, const std::vector<std::string>& topics, int scans) {
  Rosbag1Writer bag(path);
  for (const std::string& topic : topics) {
    Connection connection;
    connection.topic = topic;
    connection.type = kPointCloud2Type;
    connection.md5 = kPointCloud2Md5;
    connection.definition = kPointCloud2Definition;
    const std::uint32_t id = bag.add_connection(connection);
    for (int k = 0; k < scans; ++k) {
      const double end = shots(k).back().time;
      const RecordField time{"time", FieldType::f32, [end](const Shot& s) { return s.time - end; }};
      const PointCloud2 message{1000.0 + end, "velodyne",
                                records_of(shots(k), {intensity_field(), ring_field(), time})};
      bag.write(id, std::uint64_t((1000.0 + end + 0.01) * 1e9), serialize_point_cloud2(message));
    }
  }
  Connection other;
  other.topic = "/chatter";
  other.type = "std_msgs/String";
  bag.add_connection(other);
  bag.close();
}

TEST(BagSource, FindsTheOnlyCloudTopicAndStampsTheFirstPoint) {
  const TemporaryFolder folder;
  write_bag(folder / "a.bag", {"/points"}, 10);
  const auto source = open_source((folder / "a.bag").string(), {});
  EXPECT_EQ(source->size(), 10u);
  EXPECT_TRUE(says(*source, "topic /points"));
  const std::vector<Scan> scans = all_of(*source);
  ASSERT_EQ(scans.size(), 10u);
  for (int k = 0; k < 10; ++k) {
    const Scan& scan = scans[std::size_t(k)];
    EXPECT_NEAR(scan.stamp, 1000.0 + 0.1005 * k, 1e-6);
    EXPECT_NEAR(scan.cloud.times.back(), shots(k).back().time - shots(k).front().time, 1e-6);
    EXPECT_EQ(scan.cloud.rings[5], shots(k)[5].ring);
  }
  EXPECT_TRUE(source->skipped().empty());
}

TEST(PointTimes, AreNoneInEveryFormatWhereAskedFor) {
  const TemporaryFolder folder;
  for (const char* name : {"pcd", "ply", "kitti"}) fs::create_directory(folder / name);
  for (int k = 0; k < 8; ++k) {
    const std::string number = std::to_string(5.0 + 0.1005 * k);
    write_pcd(folder / "pcd" / (number + ".pcd"), cloud(k));
    write_ply(folder / "ply" / (number + ".ply"), cloud(k));
    write_kitti_bin(folder / "kitti" / (number + ".bin"), cloud(k));
  }
  write_bag(folder / "a.bag", {"/points"}, 8);
  for (const char* name : {"pcd", "ply", "kitti", "a.bag"}) {
    SCOPED_TRACE(name);
    const std::string path = (folder / name).string();
    EXPECT_TRUE(all_of(*open_source(path, {})).at(3).cloud.has_times());
    for (const auto& source :
         {open_source(path + "?times=none", {}), open_source(path, {.values = {{"times", "none"}}})}) {
      EXPECT_TRUE(says(*source, "time: none, as asked for"));
      const std::vector<Scan> scans = all_of(*source);
      ASSERT_EQ(scans.size(), 8u);
      for (const Scan& scan : scans) EXPECT_TRUE(scan.cloud.times.empty());
    }
    expect_error([&] { open_source(path + "?times=never", {}); }, {"times", "never", "auto | none | derived"});
    expect_error([&] { open_source(path + "?sensor=vlp16", {}); }, {"option sensor", "means nothing for the"});
  }
  const double end = shots(3).back().time;
  EXPECT_NEAR(all_of(*open_source((folder / "a.bag").string() + "?times=none", {}))[3].stamp, 1000.0 + end, 1e-6);
}

TEST(PointTimes, MeanNothingWhereTheyAreKnown) {
  const SourceOptions none{.values = {{"times", "none"}}};
  for (const char* uri : {"sim://corridor?columns=100&duration=1", "udp://127.0.0.1:0"})
    expect_error([&] { open_source(uri, none); }, {"option times", "means nothing for"});
}

TEST(BagSource, AsksWhichOfSeveralTopics) {
  const TemporaryFolder folder;
  write_bag(folder / "a.bag", {"/front", "/rear"}, 2);
  const std::string path = (folder / "a.bag").string();
  expect_error([&] { open_source(path, {}); }, {"/front", "/rear", "--topic", "/chatter (std_msgs/String)"});
  expect_error([&] { open_source(path, {.topic = "/side"}); }, {"/side", "/front"});
  expect_error([&] { open_source(path, {.topic = "/chatter"}); }, {"/chatter holds no sensor_msgs/PointCloud2"});
  EXPECT_EQ(all_of(*open_source(path, {.topic = "/rear"})).size(), 2u);
  write_bag(folder / "none.bag", {}, 0);
  expect_error([&] { open_source((folder / "none.bag").string(), {}); }, {"no topic holds", "/chatter"});
}

TEST(BagSource, ThatIsCutGivesWhatItHasAndSaysSo) {
  const TemporaryFolder folder;
  write_bag(folder / "a.bag", {"/points"}, 12);
  fs::resize_file(folder / "a.bag", fs::file_size(folder / "a.bag") * 7 / 10);
  const auto source = open_source((folder / "a.bag").string(), {});
  const std::size_t scans = all_of(*source).size();
  EXPECT_GE(scans, 4u);
  EXPECT_LT(scans, 12u);
  ASSERT_FALSE(source->skipped().empty());
  EXPECT_NE(source->skipped().back().what.find("damaged"), std::string::npos);
}

}  // namespace
}  // namespace tilth
