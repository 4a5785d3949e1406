#include <initializer_list>

#include <tilth/messages/ros2_definitions.hpp>

namespace tilth {
namespace {

struct Part {
  const char *name, *text;
};

constexpr Part kTime{"builtin_interfaces/Time", "int32 sec\nuint32 nanosec\n"};
constexpr Part kHeader{"std_msgs/Header", "builtin_interfaces/Time stamp\nstring frame_id\n"};
constexpr Part kPoint{"geometry_msgs/Point", "float64 x\nfloat64 y\nfloat64 z\n"};
constexpr Part kVector{"geometry_msgs/Vector3", "float64 x\nfloat64 y\nfloat64 z\n"};
constexpr Part kQuaternion{"geometry_msgs/Quaternion", "float64 x 0\nfloat64 y 0\nfloat64 z 0\nfloat64 w 1\n"};
constexpr Part kPose{"geometry_msgs/Pose", "geometry_msgs/Point position\ngeometry_msgs/Quaternion orientation\n"};
constexpr Part kPoseStamped{"geometry_msgs/PoseStamped", "std_msgs/Header header\ngeometry_msgs/Pose pose\n"};
constexpr Part kPoseCovariance{"geometry_msgs/PoseWithCovariance", "geometry_msgs/Pose pose\nfloat64[36] covariance\n"};
constexpr Part kTwist{"geometry_msgs/Twist", "geometry_msgs/Vector3 linear\ngeometry_msgs/Vector3 angular\n"};
constexpr Part kTwistCovariance{"geometry_msgs/TwistWithCovariance",
                                "geometry_msgs/Twist twist\nfloat64[36] covariance\n"};
constexpr Part kTransform{"geometry_msgs/Transform",
                          "geometry_msgs/Vector3 translation\ngeometry_msgs/Quaternion rotation\n"};
constexpr Part kTransformStamped{"geometry_msgs/TransformStamped",
                                 "std_msgs/Header header\nstring child_frame_id\ngeometry_msgs/Transform transform\n"};
constexpr Part kPointField{"sensor_msgs/PointField",
                           "uint8 INT8=1\nuint8 UINT8=2\nuint8 INT16=3\nuint8 UINT16=4\nuint8 INT32=5\n"
                           "uint8 UINT32=6\nuint8 FLOAT32=7\nuint8 FLOAT64=8\n"
                           "string name\nuint32 offset\nuint8 datatype\nuint32 count\n"};

constexpr Part kKeyValue{"diagnostic_msgs/KeyValue", "string key\nstring value\n"};
constexpr Part kDiagnosticStatus{"diagnostic_msgs/DiagnosticStatus",
                                 "byte OK=0\nbyte WARN=1\nbyte ERROR=2\nbyte STALE=3\n"
                                 "byte level\nstring name\nstring message\nstring hardware_id\n"
                                 "diagnostic_msgs/KeyValue[] values\n"};

std::string with_parts(std::string text, std::initializer_list<Part> parts) {
  for (const Part& part : parts) text += std::string(80, '=') + "\nMSG: " + part.name + "\n" + part.text;
  return text;
}

}  // namespace

Ros2Type point_cloud2_type() {
  return {"sensor_msgs/msg/PointCloud2",
          with_parts("std_msgs/Header header\nuint32 height\nuint32 width\nsensor_msgs/PointField[] fields\n"
                     "bool is_bigendian\nuint32 point_step\nuint32 row_step\nuint8[] data\nbool is_dense\n",
                     {kHeader, kTime, kPointField})};
}

Ros2Type odometry_type() {
  return {"nav_msgs/msg/Odometry",
          with_parts("std_msgs/Header header\nstring child_frame_id\ngeometry_msgs/PoseWithCovariance pose\n"
                     "geometry_msgs/TwistWithCovariance twist\n",
                     {kHeader, kTime, kPoseCovariance, kPose, kPoint, kQuaternion, kTwistCovariance, kTwist, kVector})};
}

Ros2Type path_type() {
  return {"nav_msgs/msg/Path", with_parts("std_msgs/Header header\ngeometry_msgs/PoseStamped[] poses\n",
                                          {kHeader, kTime, kPoseStamped, kPose, kPoint, kQuaternion})};
}

Ros2Type tf_type() {
  return {"tf2_msgs/msg/TFMessage", with_parts("geometry_msgs/TransformStamped[] transforms\n",
                                               {kTransformStamped, kHeader, kTime, kTransform, kVector, kQuaternion})};
}

Ros2Type diagnostics_type() {
  return {"diagnostic_msgs/msg/DiagnosticArray",
          with_parts("std_msgs/Header header\ndiagnostic_msgs/DiagnosticStatus[] status\n",
                     {kHeader, kTime, kDiagnosticStatus, kKeyValue})};
}

}  // namespace tilth
