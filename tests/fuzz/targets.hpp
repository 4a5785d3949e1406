// What is fuzzed: every decoder of packets and reader of files, each fed with bytes. Bad bytes may throw tilth::Error;
// any other exception, a wrong result or a crash is a finding.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <span>
#include <string_view>
#include <vector>

#include "sensor_targets.hpp"
#include "temporary_file.hpp"
#include <tilth/atlas/map_files.hpp>
#include <tilth/atlas/patch_bytes.hpp>
#include <tilth/atlas/place_table.hpp>
#include <tilth/core/error.hpp>
#include <tilth/io/beam_file.hpp>
#include <tilth/io/config_file.hpp>
#include <tilth/io/date_times_file.hpp>
#include <tilth/io/g2o.hpp>
#include <tilth/io/kitti_bin.hpp>
#include <tilth/io/las_reader.hpp>
#include <tilth/io/mcap.hpp>
#include <tilth/io/payload_file.hpp>
#include <tilth/io/pcap.hpp>
#include <tilth/io/pcd.hpp>
#include <tilth/io/ply.hpp>
#include <tilth/io/pose_file.hpp>
#include <tilth/io/rosbag1.hpp>
#include <tilth/io/rosbag2.hpp>
#include <tilth/io/rosbag2_metadata.hpp>
#include <tilth/io/times_file.hpp>
#include <tilth/io/unpack.hpp>
#include <tilth/messages/packet_message.hpp>
#include <tilth/messages/point_cloud2.hpp>
#include <tilth/messages/pose_estimate.hpp>
#include <tilth/messages/tf_message.hpp>
#include <tilth/recording/recording_decoder.hpp>
#include <tilth/view/client_feed.hpp>
#include <tilth/view/visitor.hpp>

namespace tilth::fuzz {

inline void pcap(Bytes bytes) {
  PcapReader reader(bytes, "fuzzed");
  while (const auto datagram = reader.next()) require(datagram->payload.size() <= 65535);
  require(reader.counts().datagrams <= reader.counts().frames);
}

inline void payload_file(Bytes bytes) {
  PayloadFileReader reader(InputFile(bytes, "fuzzed"));
  std::size_t taken = 0;
  while (const auto payload = reader.next()) taken += payload->size();
  require(taken + reader.skipped() == bytes.size());
}

inline void decode_records(const PointRecords& records) {
  require(records.bytes.size() == records.count * records.stride);
  StampedRecords stamped{{1.0, std::nullopt}, records};
  RecordingDecoder decoder(std::span(&stamped, 1), {});
  const Scan scan = decoder.decode(stamped);
  for (const Eigen::Vector3d& point : scan.cloud.points) require(point.allFinite());
}

inline void point_cloud2(Bytes bytes) {
  decode_records(parse_point_cloud2(bytes).records);
}

inline void rosbag1(Bytes bytes) {
  Rosbag1Reader reader(InputFile(bytes, "fuzzed"));
  for (int i = 0; i < 10000 && reader.next(); ++i) {
  }
}

inline void mcap(Bytes bytes) {
  McapReader reader(InputFile(bytes, "fuzzed"));
  for (int i = 0; i < 10000 && reader.next(); ++i) {
  }
}

inline void zstd_file(Bytes bytes) {
  std::uint64_t most = 0;
  unpack_zstd_file(InputFile(bytes, "fuzzed"),
                   [&](Bytes piece) { most = std::max<std::uint64_t>(most, piece.size()); });
  require(most <= kMostUnpacked);
}

inline void rosbag2(Bytes bytes) {
  const TemporaryFile file(bytes);
  Rosbag2Reader reader(file.path());
  for (int i = 0; i < 10000 && reader.next(); ++i) {
  }
}

/// The first byte tells type (three bits) and serialisation.
inline void packet_message(Bytes bytes) {
  if (bytes.empty()) return;
  const auto kind = std::to_integer<unsigned>(bytes[0]);
  const bool hesai = kind & 4;
  const char* type = kind & 1 ? (hesai ? "pandar_msgs/PandarScan" : "velodyne_msgs/VelodyneScan")
                              : (hesai ? "pandar_msgs/PandarPacket" : "lslidar_msgs/LslidarPacket");
  const Serialization serialization = kind & 2 ? Serialization::cdr : Serialization::ros1;
  if (kind & 8) {
    const char* buffer = kind & 1 ? "rslidar_msg/RslidarPacket" : "ouster_ros/PacketMsg";
    for (const StampedPayload& packet : parse_packet_message(buffer, bytes.subspan(1), serialization))
      require(packet.payload.size() <= bytes.size());
    return;
  }
  for (const StampedPayload& packet : parse_packet_message(type, bytes.subspan(1), serialization))
    require(hesai ? packet.payload.size() <= 1500 : packet.payload.size() == 1206 || packet.payload.size() == 1212);
}

inline void point_cloud2_cdr(Bytes bytes) {
  decode_records(parse_point_cloud2(bytes, Serialization::cdr).records);
}

/// The first byte tells the serialisation.
inline void tf_message(Bytes bytes) {
  if (bytes.empty()) return;
  const Serialization serialization = bytes[0] == std::byte(0) ? Serialization::ros1 : Serialization::cdr;
  for (const StampedTransform& transform : parse_tf(bytes.subspan(1), serialization))
    require(transform.T_world_body.matrix().allFinite());
}

/// The first byte tells the serialisation.
inline void pose_guess(Bytes bytes) {
  if (bytes.empty()) return;
  const Serialization serialization = bytes[0] == std::byte(0) ? Serialization::ros1 : Serialization::cdr;
  require(parse_pose_guess(bytes.subspan(1), serialization).T_world_body.matrix().allFinite());
}

inline void pcd(Bytes bytes) {
  decode_records(read_pcd(TemporaryFile(bytes).path()));
}

inline void ply(Bytes bytes) {
  decode_records(read_ply(TemporaryFile(bytes).path()));
}

inline void las(Bytes bytes) {
  decode_records(parse_las(bytes, "fuzzed"));
}

/// The files of a saved map, past their checksums; the first byte tells which. What is read is written as it was.
inline void map_file(Bytes bytes) {
  if (bytes.empty()) return;
  const unsigned kind = std::to_integer<unsigned>(bytes[0]) & 3;
  bytes = bytes.subspan(1);
  if (kind == 0) {
    constexpr std::uint64_t kPatchBytes = 1 << 20;
    for (const PlaceRecord& r : records_of(bytes, kPatchBytes, "fuzzed"))
      require(r.begin + r.size <= kPatchBytes && r.place.T_map_lidar.matrix().allFinite());
  } else if (kind == 1) {
    require(std::ranges::equal(bytes_of(cells_of(bytes, "fuzzed")), bytes));
  } else if (kind == 2) {
    for (const SurfacePatch& p : patches_of(bytes, "fuzzed")) require(p.mean.allFinite() && p.normal.allFinite());
  } else {
    const std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const MapList list = parse_map_list(text, "fuzzed");
    const MapList again = parse_map_list(text_of(list), "written");
    require(again.places == list.places && again.files.size() == list.files.size());
  }
}

inline void kitti_bin(Bytes bytes) {
  decode_records(read_kitti_bin(TemporaryFile(bytes).path()));
}

inline void pose_file(Bytes bytes) {
  for (const StampedPose& pose : read_pose_file(TemporaryFile(bytes).path()).trajectory)
    require(pose.T_world_lidar.matrix().allFinite());
}

inline void date_times_file(Bytes bytes) {
  for (const double time : read_date_times(TemporaryFile(bytes).path())) require(std::isfinite(time));
}

inline void times_file(Bytes bytes) {
  for (const double time : read_times(TemporaryFile(bytes).path())) require(std::isfinite(time));
}

inline void config(Bytes bytes) {
  read_config(TemporaryFile(bytes).path());
}

inline void beam_file(Bytes bytes) {
  const BeamEstimate estimate = parse_beams({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, "fuzzed");
  require(estimate.model.beams() <= 256 && estimate.model.bright > 0 && estimate.covariance.allFinite());
  require(parameters_of(estimate.model, estimate.model.beams()).allFinite());
}

inline void g2o(Bytes bytes) {
  const PoseGraph graph = parse_g2o({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, "fuzzed");
  for (const Constraint& c : graph.constraints) require(std::max(c.from, c.to) < graph.poses.size());
}

inline void rosbag2_metadata(Bytes bytes) {
  parse_rosbag2_metadata({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, "fuzzed");
}

/// What a client of a live view sends: a text a line, the first two as headers of its request.
inline void view_client(Bytes bytes) {
  std::string_view left{reinterpret_cast<const char*>(bytes.data()), bytes.size()};
  const auto line = [&] {
    const std::string_view first = left.substr(0, left.find('\n'));
    left.remove_prefix(std::min(left.size(), first.size() + 1));
    return first;
  };
  chosen_protocol(line());
  may_visit(line(), "127.0.0.1:8765");
  ClientFeed feed({"hello"});
  const auto message = std::make_shared<const std::vector<std::byte>>(4);
  while (!left.empty()) {
    for (const RunTopic topic : feed.take_text(line())) require(std::size_t(topic) < kRunTopics);
    for (std::size_t topic = 0; topic < kRunTopics; ++topic) {
      for (int i = 0; i < 3; ++i) feed.offer({RunTopic(topic), 1, message});
    }
  }
  std::size_t frames = 0;
  while (const auto frame = feed.next()) require(frame->is_text || frame->bytes), ++frames;
  require(frames < 500);
}

struct Target {
  std::string_view name;
  void (*run)(Bytes);
};

inline constexpr std::array kTargets{
    Target{"packets", packets},
    Target{"pcap", pcap},
    Target{"payload_file", payload_file},
    Target{"rosbag1", rosbag1},
    Target{"pcd", pcd},
    Target{"ply", ply},
    Target{"las", las},
    Target{"map_file", map_file},
    Target{"kitti_bin", kitti_bin},
    Target{"pose_file", pose_file},
    Target{"times_file", times_file},
    Target{"date_times_file", date_times_file},
    Target{"config", config},
    Target{"beam_file", beam_file},
    Target{"point_cloud2", point_cloud2},
    Target{"tf_message", tf_message},
    Target{"pose_guess", pose_guess},
    Target{"point_cloud2_cdr", point_cloud2_cdr},
    Target{"packet_message", packet_message},
    Target{"rosbag2", rosbag2},
    Target{"mcap", mcap},
    Target{"zstd_file", zstd_file},
    Target{"device_packet", device_packet},
    Target{"ouster", ouster},
    Target{"sensor_file", sensor_file},
    Target{"hdl64_status", hdl64_status},
    Target{"g2o", g2o},
    Target{"rosbag2_metadata", rosbag2_metadata},
    Target{"view_client", view_client},
};

inline void run(const Target& target, Bytes bytes) {
  try {
    target.run(bytes);
  } catch (const Error&) {  // bad bytes are to be refused
  }
}

}  // namespace tilth::fuzz
