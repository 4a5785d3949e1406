#include <filesystem>

#include <tilth/core/error.hpp>
#include <tilth/io/payload_file.hpp>
#include <tilth/sources/bag_reader.hpp>
#include <tilth/sources/bag_source.hpp>
#include <tilth/sources/folder_source.hpp>
#include <tilth/sources/live_source.hpp>
#include <tilth/sources/open_source.hpp>
#include <tilth/sources/packet_files.hpp>
#include <tilth/sources/ros2_source.hpp>
#include <tilth/sources/scan_files.hpp>
#include <tilth/sources/simulated_source.hpp>
#include <tilth/sources/source_uri.hpp>

namespace tilth {
namespace {

namespace fs = std::filesystem;

/// Packets of `path`, where it is a file of packets.
std::unique_ptr<ScanSource> open_packet_file(const fs::path& path, const OptionValues& values) {
  const auto options = [&] { return options_of<PacketSourceOptions>("the packets of " + path.string(), values); };
  if (is_capture(path)) return open_packets(capture_feed(path), options());
  if (is_payload_file(path)) return open_packets(payload_feed(path), options());
  return nullptr;
}

std::unique_ptr<ScanSource> open_topic(const std::string& uri, const SourceOptions& options) {
  OptionValues values = options.values;
  if (!options.frame.empty()) values["frame"] = options.frame;
  return std::make_unique<Ros2Source>(listen(parse_ros2_uri(uri, values), options.stopped));
}

}  // namespace

std::unique_ptr<ScanSource> open_source(const std::string& uri, const SourceOptions& options) {
  if (uri.starts_with(kSimulatedScheme)) {
    if (!options.values.empty()) throw Error("option " + options.values.begin()->first, "means nothing for " + uri);
    return open_simulation(uri);
  }
  if (uri.starts_with(kLiveScheme)) {
    const LiveAddress address = parse_live_uri(uri, options.values);
    return std::make_unique<LiveSource>(listen(address, options.stopped), address.options);
  }
  if (uri.starts_with(kRos2Scheme)) return open_topic(uri, options);
  const SourceUri source = parse_path_uri(uri);
  SourceOptions merged = options;
  merged.values = source.values;
  merged.values.insert(options.values.begin(), options.values.end());
  const fs::path path(source.what);
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) throw Error(source.what, "no such file or folder");
  if (fs::is_regular_file(status)) {
    if (std::unique_ptr<ScanSource> packets = open_packet_file(path, merged.values)) return packets;
  }
  if (is_bag(path)) return open_bag(path, merged);
  if (fs::is_directory(status) || is_scan_file(path)) return open_folder(path, merged);
  throw Error(source.what,
              "is no folder of scans, .pcd, .ply, .bin, .bag, .db3, .mcap, .pcap, .pcapng or file of packets");
}

}  // namespace tilth
