#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <type_traits>

#include <sdf/Collision.hh>
#include <sdf/Element.hh>
#include <sdf/Material.hh>
#include <sdf/Pbr.hh>
#include <sdf/Visual.hh>

#include <tilth/gazebo/actors.hpp>
#include <tilth/gazebo/sdf_pose.hpp>
#include <tilth/gazebo/world_builder.hpp>

namespace tilth {
namespace {

constexpr double kGlassFrom = 0.5;   // transparency of a visual that makes it a pane
constexpr double kMetalFrom = 0.5;   // metalness of a material that makes it a mirror
constexpr double kGroundSize = 100;  // [m]

bool is_metal(const sdf::Material& material) {
  const sdf::Pbr* pbr = material.PbrMaterial();
  const sdf::PbrWorkflow* metal = pbr ? pbr->Workflow(sdf::PbrWorkflowType::METAL) : nullptr;
  const bool told = metal && metal->Element() && metal->Element()->HasElement("metalness");
  return told && metal->MetalnessMap().empty() && metal->Metalness() > kMetalFrom;
}

/// What its material says of a surface.
Surface surface_of(const sdf::Visual& visual, const std::string& name) {
  Surface surface{name};
  if (visual.Transparency() > kGlassFrom) surface.material = Material::glass;
  const sdf::Material* material = visual.Material();
  if (!material) return surface;
  if (material->Element() && material->Element()->HasElement("diffuse")) {
    const auto colour = material->Diffuse();
    const double brightness = 0.3 * double(colour.R()) + 0.59 * double(colour.G()) + 0.11 * double(colour.B());
    if (std::isfinite(brightness)) surface.reflectivity = std::clamp(brightness, 0.05, 0.95);
  }
  if (is_metal(*material)) surface.material = Material::metal;
  return surface;
}

/// Where a saved world has its models come to rest.
std::map<std::string, Pose> states_of(const sdf::World& world) {
  using SdfPose = std::decay_t<decltype(sdf::Model().RawPose())>;
  std::map<std::string, Pose> states;
  const sdf::ElementPtr element = world.Element();
  if (!element || !element->HasElement("state")) return states;
  const sdf::ElementPtr state = element->GetElement("state");
  if (!state->HasElement("model")) return states;
  for (sdf::ElementPtr model = state->GetElement("model"); model; model = model->GetNextElement("model")) {
    if (!model->HasElement("pose")) continue;
    states.emplace(model->Get<std::string>("name"), pose_of(model->Get<SdfPose>("pose")));
  }
  return states;
}

bool is_finite(const ScriptedWalker& walker) {
  const auto finite = [](const Footing& f) { return f.position.allFinite() && std::isfinite(f.time + f.yaw); };
  return std::isfinite(walker.delay) && std::all_of(walker.script.begin(), walker.script.end(), finite);
}

}  // namespace

/// The pose of a part in its parent, as its frames say; its own where they are broken.
template <class Part>
Pose WorldBuilder::resolved(const Part& part, const std::string& name) {
  auto pose = part.RawPose();
  const sdf::Errors errors = part.SemanticPose().Resolve(pose);
  if (!errors.empty()) warnings_.add(name + ": " + errors.front().Message());
  return pose_of(errors.empty() ? pose : part.RawPose());
}

void WorldBuilder::add_ground_plane() {
  const SurfaceId surface = add_surface(made_.mesh, {"ground_plane"});
  const Eigen::Vector3d x(kGroundSize, 0, 0), y(0, kGroundSize, 0);
  add_quad(made_.mesh, surface, -0.5 * (x + y), {x, y}, kNoSides);
}

void WorldBuilder::add_world(const sdf::World& world, const std::string& sdf_version) {
  const std::map<std::string, Pose> states = states_of(world);
  for (std::uint64_t i = 0; i < world.ModelCount(); ++i) {
    const sdf::Model& model = *world.ModelByIndex(i);
    const auto state = states.find(model.Name());
    add_model(model, model.Name(), state == states.end() ? resolved(model, model.Name()) : state->second);
  }
  for (std::uint64_t i = 0; i < world.ActorCount(); ++i) add_actor(*world.ActorByIndex(i), sdf_version);
}

void WorldBuilder::add_model(const sdf::Model& model, const std::string& name, const Pose& T_world_model) {
  for (std::uint64_t i = 0; i < model.LinkCount(); ++i) {
    const sdf::Link& link = *model.LinkByIndex(i);
    const std::string own = name + "/" + link.Name();
    add_link(link, own, T_world_model * resolved(link, own));
  }
  for (std::uint64_t i = 0; i < model.ModelCount(); ++i) {
    const sdf::Model& nested = *model.ModelByIndex(i);
    const std::string own = name + "/" + nested.Name();
    add_model(nested, own, T_world_model * resolved(nested, own));
  }
}

void WorldBuilder::add_actor(const sdf::Actor& actor, const std::string& sdf_version) {
  ScriptedWalker walker = walker_of(actor, sdf_version, made_.mesh);
  if (is_finite(walker)) {
    made_.movers.scripted.push_back(std::move(walker));
  } else {
    warnings_.add("actor " + actor.Name() + " has a way-point that is no number; left out");
  }
}

void WorldBuilder::add_link(const sdf::Link& link, const std::string& name, const Pose& T_world_link) {
  for (std::uint64_t i = 0; i < link.VisualCount(); ++i) {
    const sdf::Visual& visual = *link.VisualByIndex(i);
    const std::string own = name + "/" + visual.Name();
    if (visual.Geom()) add_shape({own, T_world_link * resolved(visual, own)}, surface_of(visual, own), *visual.Geom());
  }
  if (link.VisualCount() > 0) return;
  for (std::uint64_t i = 0; i < link.CollisionCount(); ++i) {
    const sdf::Collision& collision = *link.CollisionByIndex(i);
    const std::string own = name + "/" + collision.Name();
    if (collision.Geom()) add_shape({own, T_world_link * resolved(collision, own)}, {own}, *collision.Geom());
  }
}

void WorldBuilder::add_shape(Place place, const Surface& surface, const sdf::Geometry& geometry) {
  Mesh& mesh = made_.mesh;
  if (mesh.surfaces.size() == std::numeric_limits<SurfaceId>::max()) {
    warnings_.add("the world has more than 65535 visuals; the last ones are left out");
    return;
  }
  place.surface = add_surface(mesh, surface);
  shapes_.add(mesh, place, geometry);
}

}  // namespace tilth
