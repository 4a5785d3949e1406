// One pose in the words of many programs: whatever the order, the names and the units of its columns, it is the same.
#include <gtest/gtest.h>

#include "io/expect_error.hpp"
#include <tilth/io/pose_file.hpp>

namespace tilth {
namespace {

// The pose: 1403636579.75 s, (1, -2, 3) m, qx qy qz qw = 0.1 0.5 0.7 0.5.
void expect_the_pose(const std::string& text) {
  const PoseFile file = parse_pose_file(text, "poses");
  ASSERT_FALSE(file.trajectory.empty()) << text;
  const StampedPose& pose = file.trajectory.front();
  EXPECT_TRUE(file.has_stamps) << text;
  EXPECT_DOUBLE_EQ(pose.stamp, 1403636579.75) << text;
  EXPECT_TRUE(pose.T_world_lidar.translation().isApprox(Eigen::Vector3d(1, -2, 3), 1e-12)) << text;
  const Eigen::Quaterniond q(0.5, 0.1, 0.5, 0.7);
  EXPECT_TRUE(pose.T_world_lidar.linear().isApprox(q.toRotationMatrix(), 1e-12)) << text;
}

const std::string kTum = "1403636579.75 1 -2 3 0.1 0.5 0.7 0.5\n";
const std::string kScalarFirst = "1403636579.75,1,-2,3,0.5,0.1,0.5,0.7\n";

TEST(PoseFile, HeadersNameTheOrder) {
  for (const char* header :
       {"timestamp,x,y,z,qw,qx,qy,qz", "timestamp,tx,ty,tz,q_w,q_x,q_y,q_z",
        "\"Time\",\"X\",\"Y\",\"Z\",\"QW\",\"QX\",\"QY\",\"QZ\"",
        "stamp [s], x [m], y [m], z [m], qw [], qx [], qy [], qz []", "t;px;py;pz;quat_w;quat_x;quat_y;quat_z",
        "sec,posX,posY,posZ,rot_w,rot_x,rot_y,rot_z", "time,x,y,z,w,x,y,z", "time,tx,ty,tz,w,x,y,z",
        "#timestamp x y z q_w q_x q_y q_z", "# columns: timestamp tx ty tz qw qx qy qz",
        "% stamp [s] x [m] y [m] z [m] qw [] qx [] qy [] qz []",
        "// time, position.x, position.y, position.z, orientation.w, orientation.x, orientation.y, orientation.z"}) {
    SCOPED_TRACE(header);
    expect_the_pose(std::string(header) + "\n" + kScalarFirst);
    expect_the_pose("\xef\xbb\xbf" + std::string(header) + "\r\n" + kScalarFirst);
  }
}

TEST(PoseFile, CommentsThatNameNoColumnsAreComments) {
  for (const char* comment :
       {"# ground truth trajectory", "# file: 'a_xyz.bag'", "#", "# a, b, c", "# timestamp tx ty tz qx qy qz qw",
        "# poses of the LiDAR: stamp, position, quaternion",
        "# the repo's poses; timestamp = frame index (no times are given)", "# x, y and z in metres"}) {
    expect_the_pose(std::string(comment) + "\n\n" + kTum);
    EXPECT_TRUE(parse_pose_file(std::string(comment) + "\n" + kTum, "poses").notices.empty()) << comment;
  }
}

TEST(PoseFile, EuRoC) {
  expect_the_pose(
      "#timestamp, p_RS_R_x [m], p_RS_R_y [m], p_RS_R_z [m], q_RS_w [], q_RS_x [], q_RS_y [], q_RS_z [], "
      "v_RS_R_x [m s^-1], v_RS_R_y [m s^-1], v_RS_R_z [m s^-1], b_w_RS_S_x [rad s^-1], b_w_RS_S_y [rad s^-1], "
      "b_w_RS_S_z [rad s^-1], b_a_RS_S_x [m s^-2], b_a_RS_S_y [m s^-2], b_a_RS_S_z [m s^-2]\r\n"
      "1403636579750000000,1,-2,3,0.5,0.1,0.5,0.7,9,9,9,9,9,9,9,9,9\r\n");
}

TEST(PoseFile, RosTables) {
  expect_the_pose(
      "%time,field.header.seq,field.header.stamp,field.header.frame_id,field.child_frame_id,field.pose.pose.position.x,"
      "field.pose.pose.position.y,field.pose.pose.position.z,field.pose.pose.orientation.x,field.pose.pose.orientation."
      "y,"
      "field.pose.pose.orientation.z,field.pose.pose.orientation.w,field.pose.covariance0,field.twist.twist.linear.x,"
      "field.twist.twist.angular.x\n"
      "1403636580000000000,7,1403636579750000000,odom,,1,-2,3,0.1,0.5,0.7,0.5,9,9,9\n");
  expect_the_pose(
      "__time,/odom/pose/pose/orientation/w,/odom/pose/pose/orientation/x,/odom/pose/pose/orientation/y,"
      "/odom/pose/pose/orientation/z,/odom/pose/pose/position/x,/odom/pose/pose/position/y,/odom/pose/pose/position/z,"
      "/odom/twist/twist/linear/x\n"
      "1403636579.75,0.5,0.1,0.5,0.7,1,-2,3,\n");
}

TEST(PoseFile, SecondsAndNanosecondsAsInNewerCollege) {
  expect_the_pose("#counter, sec, nsec, x, y, z, qx, qy, qz, qw\n12,1403636579,750000000,1,-2,3,0.1,0.5,0.7,0.5\n");
  expect_the_pose("secs nsecs x y z qx qy qz qw\n1403636579 750000000 1 -2 3 0.1 0.5 0.7 0.5\n");
  expect_error([] { parse_pose_file("sec,nsec,x,y,z,qx,qy,qz,qw\n1,1403636579750000000,1,2,3,0,0,0,1\n", "p.csv"); },
               {"p.csv, line 2, field 2", "no part of a second"});
}

TEST(PoseFile, UnitsThatTheHeaderTells) {
  for (const char* row :
       {"timestamp [ns],x,y,z,qx,qy,qz,qw\n1403636579750000000", "time_ns,x,y,z,qx,qy,qz,qw\n1403636579750000000",
        "nsec,x,y,z,qx,qy,qz,qw\n1403636579750000000", "stamp (us),x,y,z,qx,qy,qz,qw\n1403636579750000",
        "utime,x,y,z,qx,qy,qz,qw\n1403636579750000", "time_ms,x,y,z,qx,qy,qz,qw\n1403636579750"}) {
    expect_the_pose(std::string(row) + ",1,-2,3,0.1,0.5,0.7,0.5\n");
  }
  expect_the_pose("t,x [mm],y [mm],z [mm],qx,qy,qz,qw\n1403636579.75,1000,-2000,3000,0.1,0.5,0.7,0.5\n");
}

TEST(PoseFile, UnitsThatTheSizeOfStampsTells) {
  for (const auto& [stamp, unit] :
       {std::pair{"1403636579750000000", "ns"}, {"1403636579750000", "us"}, {"1403636579750", "ms"}}) {
    const std::string text = std::string(stamp) + " 1 -2 3 0.1 0.5 0.7 0.5\n";
    expect_the_pose(text);
    const PoseFile file = parse_pose_file(text, "poses");
    ASSERT_EQ(file.notices.size(), 1u);
    EXPECT_NE(file.notices[0].find(std::string("in ") + unit), std::string::npos) << file.notices[0];
  }
}

TEST(PoseFile, UnitsThatTheIntervalTells) {
  const auto stamp_of_third = [](const std::string& interval) {
    std::string text;
    for (const char* i : {"0", "1", "2"}) text += i + (i[0] == '0' ? "" : interval) + " 0 0 0 0 0 0 1\n";
    return parse_pose_file(text, "poses").trajectory.back().stamp;
  };
  EXPECT_DOUBLE_EQ(stamp_of_third("00000000"), 0.2) << "nanoseconds from zero";
  EXPECT_DOUBLE_EQ(stamp_of_third("00000"), 0.2) << "microseconds from zero";
  EXPECT_DOUBLE_EQ(stamp_of_third("0"), 20) << "seconds";
  EXPECT_DOUBLE_EQ(stamp_of_third(""), 2) << "seconds";
}

TEST(PoseFile, WithoutStampsPosesAreNumbered) {
  const PoseFile named = parse_pose_file("x,y,z,qw,qx,qy,qz\n1,2,3,1,0,0,0\n1,2,3,1,0,0,0\n", "poses");
  EXPECT_FALSE(named.has_stamps);
  EXPECT_EQ(named.trajectory.back().stamp, 1);
  const PoseFile kitti = parse_pose_file("\xef\xbb\xbf# KITTI\r\n1 0 0 4 0 1 0 5 0 0 1 6\r\n", "poses");
  EXPECT_FALSE(kitti.has_stamps);
  EXPECT_EQ(kitti.trajectory[0].T_world_lidar.translation(), Eigen::Vector3d(4, 5, 6));
}

TEST(PoseFile, ColumnsThatAreReadByNameAreTold) {
  const PoseFile file = parse_pose_file("timestamp,x,y,z,qw,qx,qy,qz\n" + kScalarFirst, "a.csv");
  ASSERT_EQ(file.notices.size(), 1u);
  for (const char* part : {"a.csv", "line 1", "stamp 1", "tx 2", "qw 5"})
    EXPECT_NE(file.notices[0].find(part), std::string::npos) << file.notices[0];
}

TEST(PoseFile, WhatIsNotUnderstoodIsRefused) {
  const auto refuse = [](const std::string& text, const std::vector<std::string>& parts) {
    expect_error([&] { parse_pose_file(text, "p.csv"); }, parts);
  };
  refuse("", {"p.csv", "no pose"});
  refuse("timestamp,x,y,z,qx,qy,qz,qw\n", {"p.csv", "no pose"});
  refuse("timestamp,x,y,z,roll,pitch,yaw\n1,0,0,0,0,0,0\n", {"p.csv, line 1", "no column for qx qy qz qw"});
  refuse("timestamp,latitude,longitude\n1,0,0\n", {"p.csv, line 1", "no column for tx ty tz"});
  refuse("t,x,y,z,q0,q1,q2,q3\n1,0,0,0,0,0,0,1\n", {"p.csv, line 1", "q0", "which is w"});
  refuse("# t x y z q0 q1 q2 q3\n1 0 0 0 0 0 0 1\n", {"p.csv, line 1", "order of the quaternion"});
  refuse("# quaternions are (w, x, y, z)\n1 0 0 0 0 0 0 1\n", {"p.csv, line 1", "order of the quaternion"});
  refuse("t,x,y,z,qx,qy,qz,qw\n1,0,0,0,0,0,0,1,5\n", {"p.csv, line 2", "has 9 values, expected 8, as line 1 names"});
  refuse("t,a_x,b_x\n1,2,3\n", {"p.csv, line 1"});
  refuse("t,tx,p_x,y,z,qx,qy,qz,qw\n1,2,3,4,5,0,0,0,1\n", {"p.csv, line 1", "tx twice", "2 and 3"});
  refuse("t,x [ft],y,z,qx,qy,qz,qw\n1,2,3,4,0,0,0,1\n", {"p.csv, line 1", "'ft'"});
  refuse("t [min],x,y,z,qx,qy,qz,qw\n1,2,3,4,0,0,0,1\n", {"p.csv, line 1", "'min'"});
  refuse("t,x,y,z,qx,qy,qz,qw\n1,0,0,0,0,0,0,1\n2,0,0,,0,0,0,1\n", {"p.csv, line 3, field 4 (tz)", "''"});
  refuse("t,x,y,z,qx,qy,qz,qw\n1,0,0,0,0,0,0,1\n2,0,0,0,0,0,1\n", {"p.csv, line 3", "has 7 values, expected 8"});
  refuse("1 0 0 0 1 2 3\n", {"p.csv, line 1", "7 columns", "a header that names"});
  refuse("1 0.7 0 0 0.7 10 20 30\n", {"p.csv, line 1", "quaternion of length", "not 1"});
  refuse(
      "\xff\xfe"
      "1",
      {"p.csv", "UTF-16"});
}

}  // namespace
}  // namespace tilth
