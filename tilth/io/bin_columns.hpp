// The columns of a file of float32 without a header (.bin, .pcd.bin), told by their values. O(1): a sample is enough.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace tilth {

/// Names of the columns: x y z, intensity from four on, then ring (small whole numbers), time (numbers that follow one
/// another), else "column5". Three to eight of them, so that only x y and z fall below 0. Nothing where no number of
/// columns makes sense of the bytes. Less than 20 points are taken for four columns.
std::optional<std::vector<std::string>> bin_columns(std::span<const std::byte> bytes);

}  // namespace tilth
