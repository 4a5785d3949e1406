// What the judge found, as a table for people and as JSON for programs. docs/evaluation.md describes every entry.
#pragma once

#include <string>

#include <tilth/evaluation/evaluate.hpp>

namespace tilth {

/// A table of the statistics; with a hint where the estimate was not aligned and starts somewhere else.
std::string evaluation_table(const Evaluation& evaluation);

/// A JSON object: "ape" and "rpe" with "translation", "rotation" ([deg]), "rotation_rad" and "full", each with every
/// statistic; "matches", "alignment", "options" and, where asked for, "kitti".
std::string evaluation_json(const Evaluation& evaluation);

}  // namespace tilth
