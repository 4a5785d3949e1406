"""The node on one topic: ros2 launch tilth_ros2 tilth.launch.py points:=/velodyne_points [base_from_lidar:=...] [rviz:=true]"""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.conditions import IfCondition
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.parameter_descriptions import ParameterValue
from launch_ros.substitutions import FindPackageShare


def generate_launch_description():
    arguments = {
        "points": ("/points", "topic of the clouds (sensor_msgs/PointCloud2)"),
        "base_from_lidar": ("", "x,y,z,roll,pitch,yaw [m, deg] of the LiDAR on the robot; empty: poses are of the LiDAR"),
        "loop_closure": ("false", "correct map -> odom where places are seen again"),
        "use_sim_time": ("false", "time is that of /clock"),
        "rviz": ("false", "show it"),
    }
    declared = [DeclareLaunchArgument(name, default_value=value, description=text) for name, (value, text) in arguments.items()]
    parameters = {
        "base_from_lidar": ParameterValue(LaunchConfiguration("base_from_lidar"), value_type=str),
        "loop_closure": ParameterValue(LaunchConfiguration("loop_closure"), value_type=bool),
        "use_sim_time": ParameterValue(LaunchConfiguration("use_sim_time"), value_type=bool),
    }
    node = Node(
        package="tilth_ros2",
        executable="tilth_node",
        name="tilth",
        output="screen",
        parameters=[parameters],
        remappings=[("points", LaunchConfiguration("points"))],
    )
    config = PathJoinSubstitution([FindPackageShare("tilth_ros2"), "rviz", "tilth.rviz"])
    rviz = Node(package="rviz2", executable="rviz2", arguments=["-d", config], condition=IfCondition(LaunchConfiguration("rviz")))
    return LaunchDescription([*declared, node, rviz])
