#include <tilth/report/html_report.hpp>
#include <tilth/report/report_sink.hpp>
#include <tilth/report/run_report.hpp>

namespace tilth {

std::unique_ptr<Sink> report_sink(const std::filesystem::path& path, const ReportOptions& options) {
  return file_sink(path, [options](const std::filesystem::path& to, const RunRecord& record) {
    write_report(to.parent_path(), report_of(record, options.points));
  });
}

}  // namespace tilth
