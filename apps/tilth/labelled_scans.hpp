// Scans with their truth: from a folder that `tilth simulate` wrote, or simulated on the spot.
#pragma once

#include <string>
#include <vector>

#include <tilth/core/options.hpp>
#include <tilth/evaluation/filter_score.hpp>

namespace tilth::app {

struct LabelledSource {
  std::string name;         ///< scene, or folder; a folder that has the name of a scene by "./name"
  OptionValues simulation;  ///< options of a scene; a folder is as it is
  std::size_t every = 1;    ///< only each n-th scan, from the first on
};

/// The scans of a source with their labels. Throws Error naming the file or folder of labels that is missing or does
/// not fit its scan, and on a scene that is unknown.
std::vector<LabelledCloud> labelled_scans(const LabelledSource& source);

}  // namespace tilth::app
