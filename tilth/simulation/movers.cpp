#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include <tilth/simulation/movers.hpp>
#include <tilth/simulation/smooth_step.hpp>

namespace tilth {
namespace {

using Eigen::Vector3d;

const Surface kPerson{"person", Material::matte, 0.35, false};
const Surface kDoorLeaf{"door leaf", Material::matte, 0.55, false};
constexpr double kLeafThickness = 0.04;  // [m]

struct Capsule {
  Vector3d from, to;
  double radius;
};

struct Meeting {
  double distance;
  Vector3d normal;
};

/// Where a ray enters a ball.
std::optional<Meeting> meet_ball(const Ray& ray, const Vector3d& center, double radius) {
  const Vector3d offset = ray.origin - center;
  const double b = offset.dot(ray.direction), c = offset.squaredNorm() - radius * radius;
  const double d = b * b - c;
  if (d < 0 || c < 0 || -b - std::sqrt(d) < 0) return std::nullopt;
  const double t = -b - std::sqrt(d);
  return Meeting{t, (offset + t * ray.direction) / radius};
}

/// Where a ray enters a capsule: its round side, else one of its two caps.
std::optional<Meeting> meet_capsule(const Ray& ray, const Capsule& capsule) {
  const Vector3d axis = (capsule.to - capsule.from).normalized();
  const double length = (capsule.to - capsule.from).norm();
  const Vector3d offset = ray.origin - capsule.from;
  const Vector3d d = ray.direction - ray.direction.dot(axis) * axis, m = offset - offset.dot(axis) * axis;
  const double a = d.squaredNorm(), b = m.dot(d), c = m.squaredNorm() - capsule.radius * capsule.radius;
  if (a > 1e-12 && b * b - a * c >= 0) {
    const double t = (-b - std::sqrt(b * b - a * c)) / a;
    const double along = (offset + t * ray.direction).dot(axis);
    if (t > 0 && along >= 0 && along <= length) return Meeting{t, (m + t * d) / capsule.radius};
  }
  std::optional<Meeting> first = meet_ball(ray, capsule.from, capsule.radius);
  const std::optional<Meeting> second = meet_ball(ray, capsule.to, capsule.radius);
  return second && (!first || second->distance < first->distance) ? second : first;
}

void bring_nearer(Hit& hit, const std::optional<Meeting>& meeting, const Surface& surface) {
  if (!meeting || meeting->distance >= hit.distance) return;
  hit = {meeting->distance, meeting->normal, &surface, std::numeric_limits<double>::infinity(), true};
}

/// A body of legs that swing with the gait, a trunk, two arms and a head, after `walked` metres.
std::array<Capsule, 6> body_of(const Pose& T, double height, double walked) {
  const double h = height, stride = 0.22 * std::sin(2 * std::numbers::pi * walked / 1.4);
  const auto limb = [&](Vector3d from, Vector3d to, double radius) { return Capsule{T * from, T * to, radius}; };
  return {limb({stride, 0.1, 0.08}, {0, 0.09, 0.48 * h}, 0.075),
          limb({-stride, -0.1, 0.08}, {0, -0.09, 0.48 * h}, 0.075),
          limb({0, 0, 0.55 * h}, {0, 0, 0.74 * h}, 0.16),
          limb({-0.8 * stride, 0.24, 0.45 * h}, {0, 0.2, 0.78 * h}, 0.05),
          limb({0.8 * stride, -0.24, 0.45 * h}, {0, -0.2, 0.78 * h}, 0.05),
          limb({0, 0, 0.91 * h}, {0, 0, 0.94 * h}, 0.1)};
}

double walked_at(const Walker& walker, double time) {
  return walker.start + walker.speed * time;
}

template <class Person>
void cast_one(const Person& person, const Ray& ray, Hit& hit) {
  const Pose T = pose_at(person, ray.time);
  for (const Capsule& part : body_of(T, person.height, walked_at(person, ray.time))) {
    bring_nearer(hit, meet_capsule(ray, part), kPerson);
  }
}

/// Where a ray enters the box between `low` and `high`, both given in the ray's frame (slab test).
std::optional<Meeting> meet_box(const Ray& ray, const Vector3d& low, const Vector3d& high) {
  double enter = 0, leave = std::numeric_limits<double>::infinity();
  Vector3d normal = Vector3d::Zero();
  for (int i = 0; i < 3; ++i) {
    const double inverse = 1 / ray.direction[i];
    const double near = ((inverse > 0 ? low : high)[i] - ray.origin[i]) * inverse;
    const double far = ((inverse > 0 ? high : low)[i] - ray.origin[i]) * inverse;
    if (near > enter) enter = near, normal = (inverse > 0 ? -1.0 : 1.0) * Vector3d::Unit(i);
    leave = std::min(leave, far);
  }
  if (enter <= 0 || enter > leave) return std::nullopt;
  return Meeting{enter, normal};
}

void cast_one(const Door& door, const Ray& ray, Hit& hit) {
  const Pose T = pose_at(door, ray.time);
  const Pose T_door_world = T.inverse(Eigen::Isometry);
  const Ray local{T_door_world * ray.origin, T_door_world.linear() * ray.direction, ray.time};
  std::optional<Meeting> meeting = meet_box(local, {0, -kLeafThickness, 0.005}, {door.width, 0, door.height});
  if (meeting) meeting->normal = T.linear() * meeting->normal;
  bring_nearer(hit, meeting, kDoorLeaf);
}

struct Ball {
  Vector3d center;
  double radius;
};

constexpr double kHeld = 0.5;  // [s] before and after a time for which a ball holds a mover

Ball ball_about(const Walker& walker, double time) {
  const Vector3d center = pose_at(walker, time) * Vector3d(0, 0, 0.5 * walker.height);
  return {center, 0.6 * walker.height + kHeld * walker.speed};
}

Ball ball_about(const ScriptedWalker& walker, double time) {
  const Eigen::AlignedBox3d feet = feet_between(walker, time - kHeld, time + kHeld);
  return {feet.center() + Vector3d(0, 0, 0.5 * walker.height), 0.6 * walker.height + 0.5 * feet.diagonal().norm()};
}

Ball ball_about(const Door& door, double) {
  return {door.hinge + Vector3d(0, 0, 0.5 * door.height), std::hypot(door.width, 0.5 * door.height) + kLeafThickness};
}

template <class Mover>
void cast_near(const Mover& mover, std::span<const Ray> rays, std::span<Hit> hits) {
  double time = rays.front().time;
  Ball ball = ball_about(mover, time);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (std::abs(rays[i].time - time) > kHeld) time = rays[i].time, ball = ball_about(mover, time);
    const Vector3d offset = ball.center - rays[i].origin;
    const double along = offset.dot(rays[i].direction);
    const bool far = along < -ball.radius || offset.squaredNorm() - along * along > ball.radius * ball.radius;
    if (!far) cast_one(mover, rays[i], hits[i]);
  }
}

}  // namespace

Pose pose_at(const Walker& walker, double time) {
  double length = 0;
  for (std::size_t i = 1; i < walker.waypoints.size(); ++i) {
    length += (walker.waypoints[i] - walker.waypoints[i - 1]).norm();
  }
  double s = std::fmod(walker.start + walker.speed * time, 2 * length);
  const bool back = s > length;
  if (back) s = 2 * length - s;
  std::size_t i = 1;
  double leg = (walker.waypoints[1] - walker.waypoints[0]).norm();
  for (; s > leg && i + 1 < walker.waypoints.size(); ++i) {
    s -= leg;
    leg = (walker.waypoints[i + 1] - walker.waypoints[i]).norm();
  }
  const Vector3d heading = (walker.waypoints[i] - walker.waypoints[i - 1]) / leg;
  const double yaw = std::atan2(heading.y(), heading.x()) + (back ? std::numbers::pi : 0.0);
  return upright(walker.waypoints[i - 1] + s * heading, yaw);
}

Pose pose_at(const Door& door, double time) {
  const double turn = std::fmod(time + door.phase, door.period) / door.period;
  const double open = smooth_step(8 * (turn - 0.2)) - smooth_step(8 * (turn - 0.7));
  return upright(door.hinge, door.closed_yaw + door.swing * open);
}

void cast(const Movers& movers, std::span<const Ray> rays, std::span<Hit> hits) {
  if (rays.empty()) return;
  for (const Walker& walker : movers.walkers) cast_near(walker, rays, hits);
  for (const Door& door : movers.doors) cast_near(door, rays, hits);
  for (const ScriptedWalker& walker : movers.scripted) cast_near(walker, rays, hits);
}

}  // namespace tilth
