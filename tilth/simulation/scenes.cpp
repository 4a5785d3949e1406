#include <algorithm>
#include <array>

#include <tilth/simulation/another_day.hpp>
#include <tilth/simulation/layout.hpp>
#include <tilth/simulation/scenes.hpp>

namespace tilth {
namespace {

struct NamedScene {
  std::string_view name;
  Scene (*make)(const SceneOptions&);
};

constexpr std::array kScenes{NamedScene{"corridor", corridor},       NamedScene{"corridor_fast", corridor},
                             NamedScene{"corridor_rough", corridor}, NamedScene{"plaza", plaza},
                             NamedScene{"plaza_fast", plaza},        NamedScene{"hospital", hospital},
                             NamedScene{"auditorium", auditorium},   NamedScene{"office", office},
                             NamedScene{"street", street},           NamedScene{"city", city}};

constexpr auto kNames = [] {
  std::array<std::string_view, kScenes.size()> names{};
  for (std::size_t i = 0; i < names.size(); ++i) names[i] = kScenes[i].name;
  return names;
}();

/// Another day, doors that swing do so at other times.
void shift_doors(std::vector<Door>& doors, std::uint64_t seed) {
  constexpr std::uint64_t kDoors = 0xA0;
  CounterRandom random(seed, kDoors);
  for (Door& door : doors) door.phase += random.uniform(0, door.period);
}

}  // namespace

std::span<const std::string_view> scene_names() {
  return kNames;
}

Scene make_scene(std::string_view name, const SceneOptions& options) {
  const auto scene = std::find_if(kScenes.begin(), kScenes.end(), [&](const NamedScene& s) { return s.name == name; });
  if (scene == kScenes.end()) {
    throw Error("scene " + std::string(name),
                "is not known; there are " + options_detail::joined(kNames) + ", and world files (.world, .sdf)");
  }
  Scene made = scene->make(options);
  if (options.world_seed > 0) shift_doors(made.movers.doors, options.seed);
  if (options.changed > 0) change(made, options);
  if (options.kidnap > 0) made.trajectory = kidnapped(made.trajectory, options);
  made.movers.walkers = kept_clear(std::move(made.movers.walkers), made.trajectory);
  return made;
}

}  // namespace tilth
