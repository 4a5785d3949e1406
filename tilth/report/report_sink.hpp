// report.html, with plots/ beside it, once the run is over.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>

#include <tilth/core/options.hpp>
#include <tilth/run/sink.hpp>

namespace tilth {

struct ReportOptions {
  std::uint64_t points = 2'000'000;  ///< of the map that go into report.html; evenly thinned past that
};

template <class V>
void visit(ReportOptions& o, V&& v) {
  v("report_points", o.points, Bounds{0, 2e7}, "[points] of the map that go into report.html at most");
}

/// `path`: of report.html.
std::unique_ptr<Sink> report_sink(const std::filesystem::path& path, const ReportOptions& options);

}  // namespace tilth
