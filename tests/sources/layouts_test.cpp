// Recordings whose messages are no turns, of several sensors, or laid out as tools leave them.
#include <fstream>
#include <io/expect_error.hpp>
#include <io/temporary_folder.hpp>
#include <sensor/spinning_lidar.hpp>

#include <gtest/gtest.h>

#include <tilth/io/kitti_bin.hpp>
#include <tilth/io/mcap_writer.hpp>
#include <tilth/io/pcd.hpp>
#include <tilth/io/rosbag1_writer.hpp>
#include <tilth/messages/point_cloud2.hpp>
#include <tilth/messages/ros2_definitions.hpp>
#include <tilth/sources/open_source.hpp>

namespace tilth {
namespace {

namespace fs = std::filesystem;

struct StampedCloud {
  double stamp = 0.0;
  std::string frame;
  PointRecords records;
};

/// Messages of `degrees` each, one after another, of a sensor at 10 Hz.
std::vector<StampedCloud> messages_of(double degrees, int count, bool timed = true) {
  std::vector<StampedCloud> messages;
  Spin spin{beams_deg(16, -15, 2), 0.1, 170, degrees, true, 1000.0, 900};
  for (int k = 0; k < count; ++k) {
    const double stamp = spin.start;
    std::vector<RecordField> fields{intensity_field(), ring_field()};
    if (timed) fields.push_back({"time", FieldType::f32, [stamp](const Shot& s) { return s.time - stamp; }});
    messages.push_back({stamp, "lidar", records_of(shots_of(spin), fields)});
    spin.start += 0.1 * degrees / 360.0;
    spin.start_deg -= degrees;
  }
  return messages;
}

void write_ros1(const fs::path& path, const std::vector<StampedCloud>& messages) {
  Rosbag1Writer bag(path);
  Connection connection;
  connection.topic = "/points";
  connection.type = kPointCloud2Type;
  connection.md5 = kPointCloud2Md5;
  connection.definition = kPointCloud2Definition;
  const std::uint32_t id = bag.add_connection(connection);
  for (const StampedCloud& m : messages)
    bag.write(id, std::uint64_t((m.stamp + 0.11) * 1e9), serialize_point_cloud2({m.stamp, m.frame, m.records}));
  bag.close();
}

void write_mcap(const fs::path& path, const std::vector<StampedCloud>& messages) {
  McapWriter bag(path);
  Connection connection;
  connection.topic = "/points";
  connection.type = "sensor_msgs/msg/PointCloud2";
  connection.encoding = "cdr";
  const std::uint32_t id = bag.add_connection(connection);
  for (const StampedCloud& m : messages) {
    bag.write(id, std::uint64_t((m.stamp + 0.11) * 1e9),
              serialize_point_cloud2({m.stamp, m.frame, m.records}, Serialization::cdr));
  }
  bag.close();
}

void write_folder(const fs::path& path, const std::vector<StampedCloud>& messages) {
  fs::create_directories(path);
  std::ofstream times(path / "times.txt");
  times.precision(15);
  for (std::size_t k = 0; k < messages.size(); ++k) {
    write_pcd(path / (std::to_string(k) + ".pcd"), messages[k].records);
    times << messages[k].stamp << "\n";
  }
}

std::vector<Scan> all_of(ScanSource& source) {
  std::vector<Scan> scans;
  while (auto scan = source.next()) scans.push_back(std::move(*scan));
  return scans;
}

bool says(const std::vector<std::string>& sentences, const std::string& text) {
  for (const std::string& sentence : sentences) {
    if (sentence.find(text) != std::string::npos) return true;
  }
  return false;
}

/// Turns of 0.1 s from 1000 s on.
void expect_turns(const fs::path& path, std::size_t count, const std::string& said) {
  SCOPED_TRACE(path.string());
  const auto source = open_source(path.string(), {});
  const std::vector<Scan> scans = all_of(*source);
  ASSERT_EQ(scans.size(), count);
  for (std::size_t k = 0; k < count; ++k) {
    EXPECT_NEAR(scans[k].stamp, 1000.0 + 0.1 * double(k), 3e-3) << k;
    EXPECT_NEAR(double(scans[k].cloud.size()), 16.0 * 900, 16.0 * 15);
    ASSERT_TRUE(scans[k].cloud.has_times() && scans[k].cloud.has_rings());
    EXPECT_NEAR(duration(scans[k].cloud), 0.1, 3e-3);
  }
  EXPECT_TRUE(says(source->decisions(), said));
  EXPECT_TRUE(source->skipped().empty());
  EXPECT_NEAR(double(source->size().value()), double(count), 1.0);
}

TEST(Layouts, PartsOfTurnsArePutTogetherWhateverHoldsThem) {
  const TemporaryFolder folder;
  for (const auto& [name, degrees, count] :
       {std::tuple{"half", 180.0, 12}, {"eighth", 45.0, 48}, {"packet", 4.8, 450}}) {
    const auto messages = messages_of(degrees, count);
    write_ros1(folder / (std::string(name) + ".bag"), messages);
    write_mcap(folder / (std::string(name) + ".mcap"), messages);
    write_folder(folder / name, messages);
    for (const char* kind : {".bag", ".mcap", ""})
      expect_turns(folder / (std::string(name) + kind), 6, "messages are put together");
  }
}

TEST(Layouts, PartsWithoutTimesArePutTogether) {
  const TemporaryFolder folder;
  write_ros1(folder / "half.bag", messages_of(180, 12, false));
  write_ros1(folder / "packet.bag", messages_of(4.8, 450, false));
  expect_turns(folder / "half.bag", 6, "messages are put together");
  expect_turns(folder / "packet.bag", 6, "messages are put together");
}

TEST(Layouts, SeveralTurnsInAMessageAreCutApart) {
  const TemporaryFolder folder;
  for (const bool timed : {true, false}) {
    write_ros1(folder / "two.bag", messages_of(720, 5, timed));
    write_mcap(folder / "two.mcap", messages_of(720, 5, timed));
    write_folder(folder / "two", messages_of(720, 5, timed));
    for (const char* kind : {".bag", ".mcap", ""}) expect_turns(folder / (std::string("two") + kind), 10, "cut apart");
  }
}

/// Two sensors in turn, the second turned round.
std::vector<StampedCloud> two_sensors() {
  std::vector<StampedCloud> messages;
  for (StampedCloud& front : messages_of(360, 10)) {
    StampedCloud rear = front;
    rear.stamp += 0.0002;
    rear.frame = "rear";
    front.frame = "front";
    rear.records.count -= 100;
    messages.push_back(std::move(front));
    messages.push_back(std::move(rear));
  }
  return messages;
}

TEST(Layouts, OfSeveralSensorsOnATopicOneIsReadAndTold) {
  const TemporaryFolder folder;
  write_ros1(folder / "a.bag", two_sensors());
  write_mcap(folder / "a.mcap", two_sensors());
  for (const char* name : {"a.bag", "a.mcap"}) {
    for (const auto& [asked, frame, points] : {std::tuple{"", "front", 14400u}, {"rear", "rear", 14300u}}) {
      const auto source = open_source((folder / name).string(), {.frame = asked});
      EXPECT_TRUE(says(source->decisions(), "read are the messages of '" + std::string(frame) + "', --frame chooses"));
      const std::vector<Scan> scans = all_of(*source);
      ASSERT_EQ(scans.size(), 10u);
      for (const Scan& scan : scans) EXPECT_EQ(scan.cloud.size(), points);
      EXPECT_TRUE(says(source->notices(), "(10); --frame chooses"));
    }
    expect_error([&] { open_source((folder / name).string(), {.frame = "top"}); },
                 {"frame_id 'top'", "'front' (10), 'rear' (10)"});
  }
}

TEST(Layouts, OfOneSensorNothingIsSaid) {
  const TemporaryFolder folder;
  write_ros1(folder / "a.bag", messages_of(360, 10));
  const auto source = open_source((folder / "a.bag").string(), {});
  EXPECT_EQ(all_of(*source).size(), 10u);
  EXPECT_FALSE(says(source->decisions(), "frames:") || says(source->decisions(), "turns:"));
  EXPECT_TRUE(source->notices().empty());
}

TEST(Layouts, BagsThatWereNeverClosedOrHaveAnotherCaseAreRead) {
  const TemporaryFolder folder;
  for (const char* name : {"a.bag.active", "A.BAG"}) {
    write_ros1(folder / name, messages_of(360, 10));
    expect_turns(folder / name, 10, "topic /points");
  }
  write_mcap(folder / "A.MCAP", messages_of(360, 10));
  expect_turns(folder / "A.MCAP", 10, "topic /points");
}

TEST(Layouts, HiddenFilesAreNoScans) {
  const TemporaryFolder folder;
  write_folder(folder / "scans", messages_of(360, 10));
  for (int k = 0; k < 10; ++k) std::ofstream(folder / ("scans/._" + std::to_string(k) + ".pcd")) << "Mac OS X";
  expect_turns(folder / "scans", 10, "times.txt");
}

TEST(Layouts, RawRecordingsOfKittiAreFoundFromAbove) {
  const TemporaryFolder folder;
  const fs::path drive = folder / "2011_09_26/2011_09_26_drive_0001_sync", points = drive / "velodyne_points";
  fs::create_directories(points / "data");
  const auto messages = messages_of(360, 12);
  std::ofstream times(points / "timestamps.txt");
  for (int k = 0; k < 12; ++k) {
    char name[32], time[48];
    std::snprintf(name, sizeof name, "%010d.bin", k);
    std::snprintf(time, sizeof time, "1970-01-01 00:16:%02d.%d00000000\n", 40 + k / 10, k % 10);
    if (k != 5) write_kitti_bin(points / "data" / name, messages[std::size_t(k)].records);
    times << time;
  }
  times.close();
  for (const fs::path& place : {points / "data", points, drive, drive.parent_path()}) {
    const auto source = open_source(place.string(), {});
    EXPECT_TRUE(says(source->decisions(), "timestamps.txt"));
    const std::vector<Scan> scans = all_of(*source);
    ASSERT_EQ(scans.size(), 11u) << place;
    EXPECT_NEAR(scans[4].stamp, 1000.4, 1e-6);
    EXPECT_NEAR(scans[5].stamp, 1000.6, 1e-6) << "by the number of the file";
  }
  std::ofstream(points / "timestamps.txt") << "1970-01-01 00:16:40\n";
  expect_error([&] { open_source(drive.string(), {}); }, {"timestamps.txt", "has 1 times, none for 0000000001.bin"});
  fs::create_directories(drive.parent_path() / "2011_09_26_drive_0002_sync/velodyne_points/data");
  expect_error([&] { open_source(drive.parent_path().string(), {}); }, {"several drives"});
}

TEST(Layouts, ColumnsOfFiveAreReadAndSaid) {
  const TemporaryFolder folder;
  const auto messages = messages_of(360, 8);
  for (std::size_t k = 0; k < messages.size(); ++k) {
    const PointRecords& records = messages[k].records;
    std::ofstream file(folder / (std::to_string(1000000000000 + 100 * k) + ".pcd.bin"), std::ios::binary);
    std::vector<std::vector<double>> columns;
    for (const char* name : {"x", "y", "z", "intensity", "ring"})
      columns.push_back(column(records, *records.find(name)));
    for (std::size_t i = 0; i < records.count; ++i) {
      for (const std::vector<double>& values : columns) {
        const float value = float(values[i]);
        file.write(reinterpret_cast<const char*>(&value), sizeof value);
      }
    }
  }
  const auto source = open_source((folder / "").string(), {});
  EXPECT_TRUE(says(source->decisions(), "columns: told by their values to be x y z intensity ring"));
  const std::vector<Scan> scans = all_of(*source);
  ASSERT_EQ(scans.size(), 8u);
  EXPECT_EQ(scans[3].cloud.size(), messages[3].records.count);
  EXPECT_EQ(scans[3].cloud.rings[5], std::uint16_t(column(messages[3].records, *messages[3].records.find("ring"))[5]));
}

}  // namespace
}  // namespace tilth
