#include <tilth/io/trajectory_file.hpp>
#include <tilth/run/base_frame.hpp>
#include <tilth/run/localization_journal.hpp>
#include <tilth/run/run_record.hpp>

namespace tilth {

LocalizationJournal::LocalizationJournal(const std::filesystem::path& folder)
    : poses_(folder / kLocalizationFiles[0], true), rows_(folder / kLocalizationFiles[1], true) {
  rows_.write_line(localization_header());
}

void LocalizationJournal::take(const Scan&, const OdometryResult&, const RunRecord& record) {
  const LocalizationRow& row = record.localization->rows.back();
  rows_.write_line(localization_line(row, record.T_base_lidar));
  if (row.T_map_lidar) poses_.write_line(tum_line({row.stamp, pose_of_base(*row.T_map_lidar, record.T_base_lidar)}));
}

void LocalizationJournal::finish(const RunRecord&) {}

}  // namespace tilth
