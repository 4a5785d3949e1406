// Lets scripts see files through Tilth's readers and writers:
//   format_probe dump FILE        fields, then numbers, a line a point (.pcd .ply .las .bin), or the messages of a bag
//   format_probe copy FILE FILE   reads one point file or bag, writes another (lz4 where a bag's name has "lz4" in it)
#include <cstdio>
#include <filesystem>
#include <iostream>

#include <tilth/core/error.hpp>
#include <tilth/io/kitti_bin.hpp>
#include <tilth/io/las_reader.hpp>
#include <tilth/io/mcap.hpp>
#include <tilth/io/pcd.hpp>
#include <tilth/io/ply.hpp>
#include <tilth/io/rosbag1.hpp>
#include <tilth/io/rosbag1_writer.hpp>
#include <tilth/io/rosbag2.hpp>
#include <tilth/io/text_lines.hpp>
#include <tilth/io/unpacked_file.hpp>

namespace {

using std::filesystem::path;

tilth::PointRecords read_points(const path& file) {
  if (file.extension() == ".pcd") return tilth::read_pcd(file);
  if (file.extension() == ".ply") return tilth::read_ply(file);
  if (file.extension() == ".las") return tilth::read_las(file);
  return tilth::read_kitti_bin(file);
}

void write_points(const path& file, const tilth::PointRecords& records) {
  if (file.extension() == ".pcd") return tilth::write_pcd(file, records);
  if (file.extension() == ".ply") return tilth::write_ply(file, records);
  tilth::write_kitti_bin(file, records);
}

void dump_points(const tilth::PointRecords& records) {
  std::vector<std::vector<double>> columns;
  for (const tilth::PointField& field : records.fields) {
    std::cout << field.name << " ";
    columns.push_back(tilth::column(records, field));
  }
  std::cout << "\n";
  for (std::size_t i = 0; i < records.count; ++i) {
    for (const std::vector<double>& values : columns) std::cout << tilth::exact_text(values[i]) << " ";
    std::cout << "\n";
  }
}

template <class Reader>
void dump_bag(const path& file) {
  Reader reader(file);
  for (const tilth::Connection& c : reader.connections()) {
    std::cout << "connection " << c.id << " " << c.topic << " " << c.type << " " << c.md5 << " " << c.messages << "\n";
  }
  while (const std::optional<tilth::Message> message = reader.next()) {
    std::cout << "message " << message->connection << " " << message->stamp << " ";
    for (const std::byte byte : message->bytes) std::printf("%02x", std::to_integer<unsigned>(byte));
    std::cout << "\n";
  }
  std::cout << "problem " << reader.problem() << "\n";
}

void copy_bag(const path& from, const path& to) {
  tilth::Rosbag1Reader reader(from);
  const bool lz4 = to.filename().string().find("lz4") != std::string::npos;
  tilth::Rosbag1Writer writer(to, lz4 ? tilth::BagCompression::lz4 : tilth::BagCompression::none);
  std::map<std::uint32_t, std::uint32_t> id_of;
  for (const tilth::Connection& connection : reader.connections()) {
    id_of[connection.id] = writer.add_connection(connection);
  }
  while (const std::optional<tilth::Message> message = reader.next()) {
    writer.write(id_of.at(message->connection), message->stamp, message->bytes);
  }
  writer.close();
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> arguments(argv, argv + argc);
  try {
    const bool dump = arguments.size() == 3 && arguments[1] == "dump";
    const bool copy = arguments.size() == 4 && arguments[1] == "copy";
    if (!dump && !copy) throw tilth::Error("format_probe", "expected: dump FILE, or copy FILE FILE");
    const bool bag = path(arguments[2]).extension() == ".bag";
    std::ios::sync_with_stdio(true);
    if (dump && bag)
      dump_bag<tilth::Rosbag1Reader>(arguments[2]);
    else if (dump && tilth::unpacked_name(arguments[2]).extension() == ".mcap")
      dump_bag<tilth::McapReader>(arguments[2]);
    else if (dump && tilth::is_rosbag2(arguments[2]))
      dump_bag<tilth::Rosbag2Reader>(arguments[2]);
    else if (dump)
      dump_points(read_points(arguments[2]));
    else if (bag)
      copy_bag(arguments[2], arguments[3]);
    else
      write_points(arguments[3], read_points(arguments[2]));
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return 1;
  }
  return 0;
}
