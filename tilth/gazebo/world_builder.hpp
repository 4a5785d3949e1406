// The models and actors of an SDF world, part after part, as a mesh and movers.
#pragma once

#include <string>

#include <sdf/Actor.hh>
#include <sdf/Link.hh>
#include <sdf/Model.hh>
#include <sdf/World.hh>

#include <tilth/gazebo/shapes.hpp>
#include <tilth/gazebo/world_file.hpp>

namespace tilth {

class WorldBuilder {
 public:
  WorldBuilder(const ModelPath& model_path, Warnings& warnings) : warnings_(warnings), shapes_(model_path, warnings) {}

  void add_ground_plane();  ///< Gazebo's own, of 100 x 100 m
  /// All models, where the world's saved state has them, and then the actors, who stand on them.
  void add_world(const sdf::World& world, const std::string& sdf_version);
  /// Its links and nested models.
  void add_model(const sdf::Model& model, const std::string& name, const Pose& T_world_model);

  WorldFile take() { return std::move(made_); }

 private:
  template <class Part>
  Pose resolved(const Part& part, const std::string& name);
  void add_actor(const sdf::Actor& actor, const std::string& sdf_version);
  void add_link(const sdf::Link& link, const std::string& name, const Pose& T_world_link);
  void add_shape(Place place, const Surface& surface, const sdf::Geometry& geometry);

  Warnings& warnings_;
  ShapeReader shapes_;
  WorldFile made_;
};

}  // namespace tilth
