// What a registration says of its scan, as a row of scans.csv.
#pragma once

#include <tilth/core/scan.hpp>
#include <tilth/odometry/odometry.hpp>
#include <tilth/run/scan_table.hpp>

namespace tilth {

/// All but the times that it took.
ScanRow row_of(const Scan& scan, const OdometryResult& result);

}  // namespace tilth
