// The map of a run with loop closure, saved as a folder for localisation when the run is over.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include <tilth/core/beam_model.hpp>
#include <tilth/localization/localizer.hpp>
#include <tilth/run/sink.hpp>
#include <tilth/slam/slam.hpp>

namespace tilth {

struct SavedMapPlan {
  std::filesystem::path folder;        ///< of the map to write
  std::filesystem::path continues;     ///< folder of a map that the run goes on with; empty: none
  LocalizerOptions localize;           ///< how the run is found in that
  std::optional<BeamModel> beams;      ///< that its scans are corrected by
  std::filesystem::path changes = {};  ///< file for what changed since that map; empty: none
};

/// `slam`, which must outlive the sink, is that of the run. Finishing throws Error where the track was lost, as parts
/// of such a map would lie in the wrong place, and where the run is not found in the map that it goes on with.
std::unique_ptr<Sink> saved_map_sink(SavedMapPlan plan, const Slam& slam);

}  // namespace tilth
