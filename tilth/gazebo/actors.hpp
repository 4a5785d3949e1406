// Actors of an SDF world as people who follow their script.
#pragma once

#include <string>

#include <sdf/Actor.hh>

#include <tilth/simulation/mesh.hpp>
#include <tilth/simulation/scripted_walker.hpp>

namespace tilth {

/// The actor's way-points one trajectory after the other; one without a script stands where its pose is. Up to SDF 1.6
/// way-points are in the world, as Gazebo classic takes them; from 1.7 on in the frame of the actor's pose. The feet
/// are on the highest surface of `ground` at or below the way-point (an actor's origin is at its hips or at its feet,
/// as its skin has it).
ScriptedWalker walker_of(const sdf::Actor& actor, const std::string& sdf_version, const Mesh& ground);

}  // namespace tilth
