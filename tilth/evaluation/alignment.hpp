// How an estimate is moved onto the truth before it is judged: not at all, by its first pose, or by all positions.
#pragma once

#include <array>
#include <string_view>

#include <tilth/evaluation/associate.hpp>
#include <tilth/evaluation/umeyama.hpp>

namespace tilth {

enum class Alignment {
  none,    ///< judged where it is
  origin,  ///< the first matched poses made equal
  se3,     ///< rotation and translation by umeyama
  sim3     ///< and scale
};

constexpr std::array<std::string_view, 4> kAlignmentNames{"none", "origin", "se3", "sim3"};
inline const auto& names_of(Alignment) {
  return kAlignmentNames;
}

/// What moves matches.estimate onto matches.truth. Throws Error where the positions do not determine it.
Similarity alignment_of(const MatchedPoses& matches, Alignment alignment);

/// `trajectory` moved by S: positions scaled, rotated and shifted; orientations rotated.
Trajectory transform(Trajectory trajectory, const Similarity& S);

}  // namespace tilth
