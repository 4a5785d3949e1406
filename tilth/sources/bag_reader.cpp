#include <memory>

#include <tilth/core/error.hpp>
#include <tilth/io/mcap.hpp>
#include <tilth/io/rosbag1.hpp>
#include <tilth/io/rosbag2.hpp>
#include <tilth/io/rosbag2_metadata.hpp>
#include <tilth/sources/bag_reader.hpp>

namespace tilth {
namespace {

template <class Reader>
BagReader wrapped(const std::filesystem::path& path) {
  const auto bag = std::make_shared<Reader>(path);
  return {bag->connections(), [bag](const std::string& topic) { bag->select({topic}); }, [bag] { return bag->next(); },
          [bag] { return bag->problem(); }};
}

}  // namespace

bool is_bag(const std::filesystem::path& path) {
  return path.extension() == ".bag" || path.extension() == ".mcap" || is_rosbag2(path);
}

BagReader open_bag_reader(const std::filesystem::path& path) {
  if (path.extension() == ".bag") return wrapped<Rosbag1Reader>(path);
  if (path.extension() == ".mcap") return wrapped<McapReader>(path);
  if (!std::filesystem::is_directory(path)) return wrapped<Rosbag2Reader>(path);
  const std::vector<std::filesystem::path> files = rosbag2_files(path);
  if (files.front().extension() != ".mcap") return wrapped<Rosbag2Reader>(path);
  if (files.size() > 1) throw Error(path.string(), "is split into several .mcap files; give them one by one");
  return wrapped<McapReader>(files.front());
}

}  // namespace tilth
