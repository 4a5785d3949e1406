// A pipeline with a calibration of the beams beside it.
#pragma once

#include <memory>
#include <optional>

#include <tilth/odometry/beam_learning_odometry.hpp>
#include <tilth/run/pipeline.hpp>

namespace tilth {

/// `odometry` is one that make_odometry() made; its scans are corrected by `known` already.
Pipeline with_beams(std::unique_ptr<Odometry> odometry, BeamLearning learning, std::optional<BeamEstimate> known = {});

}  // namespace tilth
