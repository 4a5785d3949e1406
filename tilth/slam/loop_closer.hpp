// The keyframes of a drive as a pose graph that closes its loops: each new keyframe is held against earlier ones,
// closures that agree with odometry and with one another are taken in, and the graph is optimised.
// False closures are worse than missed ones: whatever raises a doubt is left out, and says why.
#pragma once

#include <functional>
#include <string_view>
#include <vector>

#include <tilth/slam/keyframe.hpp>
#include <tilth/slam/loop_closure.hpp>
#include <tilth/slam/loop_detector.hpp>
#include <tilth/slam/optimize.hpp>

namespace tilth {

struct UncertaintyOptions {
  double drift = 0.01;
  double turn_drift = 0.05;
  double least = 0.3;
  double least_turn = 2.0;
  double sigmas = 3.0;
  double noise = 0.01;
  double turn_noise = 0.1;
  double covariance_scale = 10.0;
};

template <class V>
void visit(UncertaintyOptions& o, V&& v) {
  v("drift", o.drift, Bounds{0, 1}, "[m/m] standard deviation of odometry's drift, for what a closure may claim");
  v("turn_drift", o.turn_drift, Bounds{0, 180}, "[deg/m] the same of the heading");
  v("least", o.least, Bounds{0, 100}, "[m] a closure may always differ from odometry by this");
  v("least_turn", o.least_turn, Bounds{0, 180}, "[deg] the same of the rotation");
  v("sigmas", o.sigmas, Bounds{0.1, 100}, "[sigma] of drift beyond which a closure contradicts odometry");
  v("noise", o.noise, Bounds{1e-6, 10}, "[m per root metre] random walk of odometry, as the pose graph weighs it");
  v("turn_noise", o.turn_noise, Bounds{1e-6, 90}, "[deg per root metre] the same of the rotation");
  v("covariance_scale", o.covariance_scale, Bounds{0, 1e6},
    "[-] by which a registration's covariance is enlarged and added to it");
}

struct ConsistencyOptions {
  double path = 15.0;
  double distance = 0.1;
  double angle = 0.7;
  double max_squared_error = 25.0;
};

template <class V>
void visit(ConsistencyOptions& o, V&& v) {
  v("path", o.path, Bounds{0, 1e6}, "[m] of travel within which another closure must agree before one is accepted");
  v("distance", o.distance, Bounds{0, 100}, "[m] by which two closures that agree may differ");
  v("angle", o.angle, Bounds{0, 180}, "[deg] the same of the rotation");
  v("max_squared_error", o.max_squared_error, Bounds{0, 1e9},
    "[sigma^2] that the optimised graph may leave of a closure; worse ones are voted out");
}

struct LoopClosingOptions {
  KeyframeOptions keyframe;
  DetectOptions detect;
  VerifyOptions verify;
  int submap_from = 5;
  int submap_to = 2;
  UncertaintyOptions odometry;
  ConsistencyOptions consistency;
  GraphOptions graph;
};

template <class V>
void visit(LoopClosingOptions& o, V&& v) {
  v("keyframe", o.keyframe, "[-] keyframes");
  v("detect", o.detect, "[-] search for earlier passes");
  v("verify", o.verify, "[-] verification of a candidate", kAdvanced);
  v("submap_from", o.submap_from, Bounds{0, 1000}, "[keyframes] on either side of a candidate that join its submap",
    kAdvanced);
  v("submap_to", o.submap_to, Bounds{0, 1000}, "[keyframes] before the newest one that join its submap", kAdvanced);
  v("odometry", o.odometry, "[-] how far odometry is believed", kAdvanced);
  v("consistency", o.consistency, "[-] agreement of closures with one another", kAdvanced);
  v("graph", o.graph, "[-] optimisation of the pose graph", kAdvanced);
}

class LoopCloser {
 public:
  explicit LoopCloser(const LoopClosingOptions& options) : options_(options) {}

  /// Adds the next keyframe and closes what loops it closes. `begin_stage` is told what is being done.
  void add(Keyframe keyframe, const std::function<void(std::string_view)>& begin_stage);

  /// Takes `ties` in as closures, which say where maps that were begun after a loss lie in earlier ones, and optimises.
  void join_pieces(const std::vector<Constraint>& ties);

  /// Optimises the graph with all accepted closures. Those that it leaves too large an error are voted out one by one.
  void optimize();

  const std::vector<Keyframe>& keyframes() const { return keyframes_; }
  const std::vector<Pose>& poses() const { return poses_; }               ///< T_world_lidar of the keyframes
  const std::vector<LoopClosure>& closures() const { return closures_; }  ///< of all candidates
  PoseGraph graph() const;                                                ///< at poses(), with accepted closures
  int optimizations() const { return optimizations_; }

  /// Of each keyframe whether what is known of the motion joins it to the first one: all, but for those after a loss
  /// that no closure was found for.
  std::vector<bool> joined() const;

 private:
  std::vector<Expectation> expectations() const;
  Submap submap(std::size_t center, std::size_t first, std::size_t last) const;
  bool verify_all(const std::vector<LoopCandidate>& candidates, const std::vector<Expectation>& expected,
                  const Submap& newest);
  bool confirm(LoopClosure& closure);
  void bring_together();
  Constraint odometry_constraint(std::size_t to) const;

  LoopClosingOptions options_;
  std::vector<Keyframe> keyframes_;
  std::vector<Pose> poses_;
  std::vector<LoopClosure> closures_;
  int optimizations_ = 0;
};

}  // namespace tilth
