// Two saved maps that overlap made one, in the frame of the first: its graph and the other's are tied where they show
// the same and optimised together; where the other map was made later, its places take the place of those nearby, and
// what its beams went through is taken out.
#pragma once

#include <filesystem>
#include <vector>

#include <tilth/atlas/map_folder.hpp>
#include <tilth/freespace/changes.hpp>
#include <tilth/localization/localizer.hpp>

namespace tilth {

struct MergedMaps {
  std::size_t ties = 0;              ///< places of the other map that were found in the first
  std::size_t places = 0;            ///< with patches, of the new map
  std::size_t replaced = 0;          ///< places of the first map that later ones stand in for
  std::size_t gone = 0;              ///< patches that were taken out
  std::vector<Change> changes = {};  ///< what left and what came since the first map, by the stamps of each; its frame
};

/// Writes the map of both, `later` being the one that was made later, into `folder`, which may be that of either.
/// Throws Error where they do not overlap, or nothing tells where.
MergedMaps merge_maps(const MapFolder& map, const MapFolder& later, const LocalizerOptions& options,
                      const std::filesystem::path& folder);

}  // namespace tilth
