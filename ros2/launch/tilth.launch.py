"""The node on one topic, shown in RViz with rviz:=true.

ros2 launch tilth_ros2 tilth.launch.py points:=/velodyne_points base_from_lidar:=0.2,0,0.5,0,0,0
"""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.conditions import IfCondition
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.parameter_descriptions import ParameterValue
from launch_ros.substitutions import FindPackageShare

ARGUMENTS = (
    ("points", "/points", "topic of the clouds (sensor_msgs/PointCloud2)"),
    ("base_from_lidar", "", "x,y,z,roll,pitch,yaw [m, deg] of the LiDAR on the robot; empty: poses are of the LiDAR"),
    ("loop_closure", "false", "correct map -> odom where places are seen again"),
    ("map", "", "folder of a saved map to be found in; empty: a map is made"),
    ("use_sim_time", "false", "time is that of /clock"),
    ("rviz", "false", "show it"),
)
PARAMETERS = {"base_from_lidar": str, "loop_closure": bool, "map": str, "use_sim_time": bool}


def generate_launch_description():
    node = Node(
        package="tilth_ros2",
        executable="tilth_node",
        name="tilth",
        output="screen",
        parameters=[{key: ParameterValue(LaunchConfiguration(key), value_type=kind) for key, kind in PARAMETERS.items()}],
        remappings=[("points", LaunchConfiguration("points"))],
    )
    rviz = Node(
        package="rviz2",
        executable="rviz2",
        arguments=["-d", PathJoinSubstitution([FindPackageShare("tilth_ros2"), "rviz", "tilth.rviz"])],
        condition=IfCondition(LaunchConfiguration("rviz")),
    )
    arguments = [DeclareLaunchArgument(key, default_value=value, description=text) for key, value, text in ARGUMENTS]
    return LaunchDescription([*arguments, node, rviz])
