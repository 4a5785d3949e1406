#include <memory>

#include <tilth/io/rosbag1.hpp>
#include <tilth/io/rosbag2.hpp>
#include <tilth/sources/bag_reader.hpp>

namespace tilth {
namespace {

template <class Reader>
BagReader wrapped(const std::filesystem::path& path, Serialization serialization) {
  const auto bag = std::make_shared<Reader>(path);
  return {bag->connections(), serialization, [bag](const std::string& topic) { bag->select({topic}); },
          [bag] { return bag->next(); }, [bag] { return bag->problem(); }};
}

}  // namespace

BagReader open_bag_reader(const std::filesystem::path& path) {
  if (is_rosbag2(path)) return wrapped<Rosbag2Reader>(path, Serialization::cdr);
  return wrapped<Rosbag1Reader>(path, Serialization::ros1);
}

}  // namespace tilth
