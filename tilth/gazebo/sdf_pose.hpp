// A pose of libsdformat as one of ours, whatever its mathematics library is called.
#pragma once

#include <tilth/core/se3.hpp>

namespace tilth {

template <class P>
Pose pose_of(const P& pose) {
  Pose T = Pose::Identity();
  T.translation() = Eigen::Vector3d(pose.Pos().X(), pose.Pos().Y(), pose.Pos().Z());
  const auto& q = pose.Rot();
  T.linear() = Eigen::Quaterniond(q.W(), q.X(), q.Y(), q.Z()).normalized().toRotationMatrix();
  return T;
}

}  // namespace tilth
