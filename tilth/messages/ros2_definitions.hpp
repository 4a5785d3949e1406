// The texts of ROS 2 message types with those they hold, as recordings carry them (ros2msg): from the interface
// packages of ROS 2, without their comments.
#pragma once

#include <string>

namespace tilth {

struct Ros2Type {
  std::string name;        ///< "nav_msgs/msg/Path"
  std::string definition;  ///< with the types it holds
};

Ros2Type point_cloud2_type();
Ros2Type odometry_type();
Ros2Type path_type();
Ros2Type tf_type();
Ros2Type diagnostics_type();

}  // namespace tilth
