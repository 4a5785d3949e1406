#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>

#include <tilth/core/error.hpp>
#include <tilth/simulation/mesh.hpp>
#include <tilth/simulation/path.hpp>
#include <tilth/simulation/smooth_step.hpp>

namespace tilth {
namespace {

using Eigen::Vector3d;

constexpr double kRamp = 1.6;    // [s] to take up the speed, and to lose it
constexpr double kSame = 1e-6;   // [m] within which two way-points are one
constexpr double kSteep = 1e-3;  // [m/m] of a leg that goes straight up: it has no heading

std::string_view take(std::string_view& text, char separator) {
  const std::size_t end = std::min(text.find(separator), text.size());
  const std::string_view taken = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return taken;
}

/// Two or three finite numbers.
Vector3d parse_waypoint(std::string_view text, double height) {
  const std::string whole(text);
  Vector3d point(0, 0, height);
  int count = 0;
  for (; !text.empty() && count < 4; ++count) {
    std::string_view word = take(text, ',');
    while (word.starts_with(' ')) word.remove_prefix(1);
    while (word.ends_with(' ')) word.remove_suffix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    const bool number = error == std::errc{} && end == word.data() + word.size() && std::isfinite(value);
    if (!number || count == 3) throw Error("way-point \"" + whole + "\"", "is not x,y or x,y,z in metres");
    point[count] = value;
  }
  if (count < 2) throw Error("way-point \"" + whole + "\"", "is not x,y or x,y,z in metres");
  return point;
}

/// Where two legs meet: `turn` goes over from one to the other within `reach` of `arc`.
struct Corner {
  double arc, reach;   // [m] along the way
  Vector3d direction;  // change of
  double yaw;          // [rad] change of, the shorter way

  double ratio(double at) const { return (at - arc) / (2 * reach) + 0.5; }
};

/// The way as a function of its length: straight, plus what each corner has turned it by.
class RoundedPath {
 public:
  RoundedPath(const std::vector<Vector3d>& points, double corner) : start_(points.front()) {
    std::vector<double> lengths;
    for (std::size_t i = 1; i < points.size(); ++i) lengths.push_back((points[i] - points[i - 1]).norm());
    Vector3d direction = direction_ = (points[1] - points[0]) / lengths[0];
    double yaw = yaw_ = yaw_of(direction, 0);
    for (std::size_t i = 1; i < lengths.size(); ++i) {
      length_ += lengths[i - 1];
      const Vector3d next = (points[i + 1] - points[i]) / lengths[i];
      const double turn = std::remainder(yaw_of(next, yaw) - yaw, 2 * std::numbers::pi);
      const double reach = std::min({corner, lengths[i - 1] / 2, lengths[i] / 2});
      corners_.push_back({length_, reach, next - direction, turn});
      direction = next, yaw += turn;
    }
    length_ += lengths.back();
  }

  double length() const { return length_; }

  Pose at(double arc) const {
    Vector3d position = start_ + arc * direction_;
    double yaw = yaw_;
    for (const Corner& corner : corners_) {
      position += 2 * corner.reach * smooth_step_area(corner.ratio(arc)) * corner.direction;
      yaw += smooth_step(corner.ratio(arc)) * corner.yaw;
    }
    return upright(position, yaw);
  }

 private:
  static double yaw_of(const Vector3d& direction, double otherwise) {
    return direction.head<2>().norm() < kSteep ? otherwise : std::atan2(direction.y(), direction.x());
  }

  Vector3d start_, direction_;
  double yaw_ = 0, length_ = 0;
  std::vector<Corner> corners_;
};

/// A drive of some length from rest to rest.
class Drive {
 public:
  Drive(double length, double speed) : speed_(std::min(speed, length / kRamp)), duration_(length / speed_ + kRamp) {}

  double duration() const { return duration_; }

  double arc(double time) const {
    const double end = duration_ - kRamp;
    return speed_ * kRamp * (smooth_step_area(time / kRamp) - smooth_step_area((time - end) / kRamp));
  }

 private:
  double speed_, duration_;
};

}  // namespace

std::vector<Vector3d> parse_waypoints(std::string_view text, double height) {
  std::vector<Vector3d> points;
  while (!text.empty()) points.push_back(parse_waypoint(take(text, ';'), height));
  if (points.size() < 2) throw Error("waypoints", "are fewer than two; expected \"x,y;x,y\" or more, in metres");
  return points;
}

Trajectory drive_through(const std::vector<Vector3d>& waypoints, const PathOptions& options,
                         const MotionOptions& motion) {
  for (std::size_t i = 1; i < waypoints.size(); ++i) {
    if ((waypoints[i] - waypoints[i - 1]).norm() > kSame) continue;
    throw Error("waypoints", "number " + std::to_string(i) + " and the next one are the same");
  }
  const RoundedPath path(waypoints, options.corner);
  const Drive drive(path.length(), options.cruise * motion.speed_scale);
  if (!(drive.duration() <= kLongestDrive)) throw Error("waypoints", "take more than ten hours at this speed");
  Trajectory trajectory;
  const auto last = std::size_t(std::ceil(drive.duration() * kTruthRate));
  for (std::size_t i = 0; i <= last; ++i) {
    const double time = double(i) / kTruthRate;
    trajectory.push_back({time, shaken(path.at(drive.arc(time)), time, motion)});
  }
  return trajectory;
}

}  // namespace tilth
