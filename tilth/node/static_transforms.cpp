#include <utility>

#include <tilth/messages/tf_message.hpp>
#include <tilth/node/static_transforms.hpp>

namespace tilth {

void StaticTransforms::add(std::span<const std::byte> message, Serialization serialization) {
  const std::vector<StampedTransform> transforms = parse_tf(message, serialization);
  const std::lock_guard lock(mutex_);
  for (const StampedTransform& t : transforms) by_child_[t.frames.body] = {t.frames.world, t.T_world_body};
  changed_.notify_all();
}

std::optional<Pose> StaticTransforms::wait_for(const std::string& base, const std::string& child,
                                               std::chrono::milliseconds longest) {
  std::unique_lock lock(mutex_);
  std::optional<Pose> found;
  changed_.wait_for(lock, longest, [&] { return (found = find(base, child)).has_value(); });
  return found;
}

std::optional<Pose> StaticTransforms::find(const std::string& base, const std::string& child) const {
  const std::optional<Rooted> from = rooted(base), to = rooted(child);
  if (!from || !to || from->root != to->root) return std::nullopt;
  return from->T_root_frame.inverse() * to->T_root_frame;
}

/// Nothing where frames go round in a circle.
std::optional<StaticTransforms::Rooted> StaticTransforms::rooted(std::string frame) const {
  Rooted way{std::move(frame), Pose::Identity()};
  for (std::size_t steps = 0; steps <= by_child_.size(); ++steps) {
    const auto fixed = by_child_.find(way.root);
    if (fixed == by_child_.end()) return way;
    way = {fixed->second.parent, fixed->second.T_parent_child * way.T_root_frame};
  }
  return std::nullopt;
}

}  // namespace tilth
