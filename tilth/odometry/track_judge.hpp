// Whether a track is to be believed, judged scan by scan from what every pipeline says of its registrations: how much
// of a scan fits the map, against how much has fitted so far; how the pose leaps; for how long nothing was registered.
#pragma once

#include <cstddef>
#include <optional>

#include <tilth/core/track_state.hpp>
#include <tilth/odometry/odometry.hpp>
#include <tilth/odometry/usual_fit.hpp>

namespace tilth {

class TrackJudge {
 public:
  /// Of the next result; stamps must ascend.
  Track judge(const OdometryResult& result);

  /// [s] for which the motion was not known since the last pose that is believed; 0 on a track that is.
  double unknown_for() const { return unknown_; }

 private:
  struct Last {
    double stamp = 0.0;  // [s]
    Pose T_world_lidar = Pose::Identity();
    Vector6d velocity = Vector6d::Zero();  // [rad/s, m/s] since the pose before
  };

  TrackReason doubt(const OdometryResult& result, double interval) const;
  Vector6d velocity_to(const OdometryResult& result, double interval) const;
  Track doubted(TrackReason reason, const OdometryResult& result, double interval);
  Track believed(double interval);

  UsualFit usual_{{.poor = 0.56, .sure = 0.8}};  // whatever the pipeline: good runs of some fall to 0.57
  RunningMedian sizes_{21};                      // candidates of the scans that were believed
  RunningMedian recent_{5};                      // fits of the scans that were matched at all
  std::optional<Last> last_;
  Track track_;
  double unknown_ = 0.0;
  bool map_spoilt_ = false;      // by scans that were not where they were thought to be
  std::size_t since_doubt_ = 0;  // scans
};

}  // namespace tilth
