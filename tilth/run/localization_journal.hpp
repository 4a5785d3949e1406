// What localisation says, saved while it goes on: a line for every scan at once, so that a program that is killed loses
// none of them.
#pragma once

#include <array>
#include <filesystem>
#include <string_view>

#include <tilth/io/append_file.hpp>
#include <tilth/run/sink.hpp>

namespace tilth {

/// The files of a journal: poses in the map, and a row for every scan.
inline constexpr std::array<std::string_view, 2> kLocalizationFiles{"trajectory.tum", "localization.csv"};

class LocalizationJournal final : public Sink {
 public:
  /// Begins both files anew. Throws Error where they cannot be opened.
  explicit LocalizationJournal(const std::filesystem::path& folder);

  /// Writes the last row of the record's localisation, and its pose where that is known. Throws Error where the disk is
  /// full.
  void take(const Scan& scan, const OdometryResult& result, const RunRecord& record) override;
  void finish(const RunRecord& record) override;

 private:
  AppendFile poses_, rows_;
};

}  // namespace tilth
