// The only header that both sides include, and C++17: those of ROS 1 do not compile as C++20, those of Tilth are C++20.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace tilth::ros1 {

using Parameters = std::map<std::string, std::string>;  ///< "loop.keyframe.distance" -> "2.5"

struct Topic {
  std::string name;  ///< "~/odometry"
  std::string type;  ///< "nav_msgs/Odometry"
  bool latched;
};
std::vector<Topic> topics();

/// As tilth::NodeOutlet; `topic` counts those of topics().
class Outlet {
 public:
  virtual ~Outlet() = default;
  virtual void publish(std::size_t topic, const std::uint8_t* message, std::size_t bytes) = 0;
  virtual bool wanted(std::size_t topic) = 0;
  virtual void note(const std::string& sentence) = 0;
  virtual void warn(const std::string& sentence) = 0;
};

/// As tilth::SlamNode.
class Node {
 public:
  Node(const Parameters& parameters, Outlet& outlet);
  ~Node();

  void take(const std::uint8_t* cloud, std::size_t bytes, std::uint64_t arrival);
  void take_static_transforms(const std::uint8_t* message, std::size_t bytes);
  void take_guess(const std::uint8_t* message, std::size_t bytes);
  std::size_t queue() const;  ///< [clouds] that may wait

  struct Answer {
    bool success;
    std::string message;
  };
  static std::vector<std::string> services();
  Answer serve(const std::string& service);

 private:
  struct Inside;
  std::unique_ptr<Inside> inside_;
};

/// A number as parameters are written.
std::string parameter_text(double value);

}  // namespace tilth::ros1
