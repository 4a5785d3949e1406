// What changed in a scene while it was mapped: changes.csv, and the list `changes` of summary.json. docs/clean_map.md
// describes the columns.
#pragma once

#include <filesystem>
#include <memory>
#include <span>

#include <tilth/freespace/changes.hpp>
#include <tilth/run/sink.hpp>

namespace tilth {

/// Throws Error where the file cannot be written in full.
void write_changes(const std::filesystem::path& path, std::span<const Change> changes);

/// What left or came within the run.
std::unique_ptr<Sink> changes_sink(const std::filesystem::path& path);

}  // namespace tilth
