#include "scan_writer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <system_error>

#include <tilth/core/error.hpp>
#include <tilth/core/options.hpp>
#include <tilth/io/cloud_records.hpp>
#include <tilth/io/kitti_bin.hpp>
#include <tilth/io/las.hpp>
#include <tilth/io/mcap_writer.hpp>
#include <tilth/io/output_file.hpp>
#include <tilth/io/pcd.hpp>
#include <tilth/io/ply.hpp>
#include <tilth/io/rosbag1_writer.hpp>
#include <tilth/messages/point_cloud2.hpp>
#include <tilth/messages/ros2_definitions.hpp>

namespace tilth::app {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kTopic = "/points";
constexpr std::string_view kFrame = "lidar";
constexpr std::array<std::string_view, 4> kFormats{"pcd", "ply", "las", "kitti"};

std::string numbered(std::size_t index, CloudFile format) {
  const std::string ending = format == CloudFile::kitti ? "bin" : std::string(kFormats[std::size_t(format)]);
  std::array<char, 40> name{};
  std::snprintf(name.data(), name.size(), "%06zu.%s", index, ending.c_str());
  return name.data();
}

std::uint64_t nanoseconds(double stamp) {
  if (!(stamp >= 0.0)) throw Error("stamp", std::to_string(stamp) + " s cannot be recorded: it lies before 1970");
  return std::uint64_t(std::llround(stamp * 1e9));
}

std::vector<std::byte> message_of(const Scan& scan, Serialization serialization) {
  return serialize_point_cloud2({scan.stamp, std::string(kFrame), to_records(scan.cloud)}, serialization);
}

}  // namespace

CloudFile cloud_file(std::string_view name) {
  const auto format = std::find(kFormats.begin(), kFormats.end(), name);
  if (format == kFormats.end())
    throw Error("format " + std::string(name), "is not known; there are " + options_detail::joined(kFormats));
  return CloudFile(format - kFormats.begin());
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw Error(folder.string(), "cannot be made: " + error.message());
}

fs::path scan_folder(const fs::path& folder, CloudFile format) {
  return folder / (format == CloudFile::kitti ? "velodyne" : "scans");
}

ScanWriter scans_in_folder(const fs::path& folder, CloudFile format) {
  const fs::path scans = scan_folder(folder, format);
  make_folder(scans);
  const auto write = [scans, format](std::size_t index, const Scan& scan) {
    const PointRecords records = to_records(scan.cloud);
    const fs::path path = scans / numbered(index, format);
    switch (format) {
      case CloudFile::pcd: return write_pcd(path, records);
      case CloudFile::ply: return write_ply(path, records);
      case CloudFile::las: return write_las(path, records, scan.stamp);
      case CloudFile::kitti: return write_kitti_bin(path, records);
    }
  };
  return {write, [] {}};
}

ScanWriter scans_in_bag(const fs::path& path) {
  const auto bag = std::make_shared<Rosbag1Writer>(path);
  const std::uint32_t topic =
      bag->add_connection({0, std::string(kTopic), std::string(kPointCloud2Type), std::string(kPointCloud2Md5),
                           std::string(kPointCloud2Definition), 0});
  const auto write = [bag, topic](std::size_t, const Scan& scan) {
    bag->write(topic, nanoseconds(scan.stamp), message_of(scan, Serialization::ros1));
  };
  return {write, [bag] { bag->close(); }};
}

ScanWriter scans_in_mcap(const fs::path& path) {
  const auto file = std::make_shared<McapWriter>(path);
  const Ros2Type type = point_cloud2_type();
  const std::uint32_t topic = file->add_connection({0, std::string(kTopic), type.name, "", type.definition, 0, "cdr"});
  const auto write = [file, topic](std::size_t, const Scan& scan) {
    file->write(topic, nanoseconds(scan.stamp), message_of(scan, Serialization::cdr));
  };
  return {write, [file] { file->close(); }};
}

void write_times(const fs::path& path, const std::vector<double>& stamps) {
  std::string times;
  std::array<char, 32> line{};
  for (const double stamp : stamps) {
    std::snprintf(line.data(), line.size(), "%.9f\n", stamp);
    times += line.data();
  }
  write_text(path, times);
}

}  // namespace tilth::app
