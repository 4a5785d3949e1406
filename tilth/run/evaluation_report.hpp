// What the judge found, as a table for people and as JSON for programs. docs/evaluation.md describes every entry.
#pragma once

#include <string>
#include <vector>

#include <tilth/evaluation/evaluate.hpp>

namespace tilth {

/// What a reader of the figures must know, one sentence each: how the files were understood, gaps of the truth that
/// were left out, a rotation that the alignment leaves open. Those that put the figures in doubt begin with "warning:
/// ".
std::vector<std::string> notices_of(const Evaluation& evaluation);

/// The notices, then a table of the statistics; with a hint where the estimate was not aligned and starts somewhere
/// else.
std::string evaluation_table(const Evaluation& evaluation);

/// A JSON object: "ape" and "rpe" with "translation", "rotation" ([deg]), "rotation_rad" and "full", each with every
/// statistic; "matches", "alignment", "notices", "truth_gaps", "options" and, where asked for, "kitti".
std::string evaluation_json(const Evaluation& evaluation);

}  // namespace tilth
