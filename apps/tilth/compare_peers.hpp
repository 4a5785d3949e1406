// Odometries of others, from PyPI, as methods of a comparison: scripts/run_peer.py runs them on the same scans.
#pragma once

#include <string>
#include <vector>

#include "run_matrix.hpp"

namespace tilth::app {

struct Peers {
  std::vector<Method> methods;
  std::vector<std::string> used;     ///< package, version and settings of each, one sentence a peer
  std::vector<std::string> skipped;  ///< those whose package is missing, and which
};

/// The peers of a comma-separated list; none where it is empty. Throws Error on one that is not known.
Peers find_peers(const std::string& list, const MatrixArguments& arguments);

}  // namespace tilth::app
