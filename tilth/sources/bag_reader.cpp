#include <algorithm>
#include <memory>
#include <vector>

#include <tilth/io/file_kind.hpp>
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

/// The files of a split recording one after the other.
BagReader chained(const std::vector<std::filesystem::path>& files) {
  const auto parts = std::make_shared<std::vector<BagReader>>();
  for (const std::filesystem::path& file : files) parts->push_back(wrapped<McapReader>(file));
  BagReader chain = parts->front();
  for (std::size_t i = 1; i < parts->size(); ++i) {
    for (const Connection& c : (*parts)[i].connections) chain.connections.push_back(c);
  }
  chain.select = [parts](const std::string& topic) {
    for (BagReader& part : *parts) {
      const auto is_it = [&](const Connection& c) { return c.topic == topic; };
      if (std::any_of(part.connections.begin(), part.connections.end(), is_it))
        part.select(topic);
      else
        part.next = [] { return std::nullopt; };
    }
  };
  chain.next = [parts, at = std::size_t{0}]() mutable -> std::optional<Message> {
    for (; at < parts->size(); ++at) {
      if (std::optional<Message> message = (*parts)[at].next()) return message;
    }
    return std::nullopt;
  };
  chain.problem = [parts] {
    std::string problem;
    for (const BagReader& part : *parts)
      problem += (problem.empty() || part.problem().empty() ? "" : "; ") + part.problem();
    return problem;
  };
  return chain;
}

}  // namespace

bool is_bag(const std::filesystem::path& path) {
  const std::string kind = kind_of_file(path);
  return kind == ".bag" || kind == ".mcap" || is_rosbag2(path);
}

BagReader open_bag_reader(const std::filesystem::path& path) {
  if (kind_of_file(path) == ".bag") return wrapped<Rosbag1Reader>(path);
  if (kind_of_file(path) == ".mcap") return wrapped<McapReader>(path);
  if (!std::filesystem::is_directory(path)) return wrapped<Rosbag2Reader>(path);
  const std::vector<std::filesystem::path> files = rosbag2_files(path);
  return kind_of_file(files.front()) == ".mcap" ? chained(files) : wrapped<Rosbag2Reader>(path);
}

}  // namespace tilth
