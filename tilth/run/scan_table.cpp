#include <iomanip>
#include <sstream>

#include <tilth/io/output_file.hpp>
#include <tilth/run/scan_table.hpp>

namespace tilth {
namespace {

constexpr int kStampDecimals = 9;
constexpr int kDigits = 9;

void write_header(std::ostream& out, const std::vector<std::string>& stages) {
  out << "index,stamp,points_read,points_in,outliers,edges,planes,candidates,matches,weight,iterations,converged,error,"
         "degenerate_directions,track,var_rx,var_ry,var_rz,var_tx,var_ty,var_tz,ms_read,ms_register,ms_build_map,"
         "cpu_ms_register";
  for (const std::string& stage : stages) out << ",ms_" << stage;
  out << '\n';
}

void write_row(std::ostream& out, const ScanRow& row, std::size_t index, std::size_t stages) {
  out << index << ',' << std::fixed << std::setprecision(kStampDecimals) << row.stamp << std::defaultfloat
      << std::setprecision(kDigits);
  for (const std::size_t count :
       {row.points_read, row.points_in, row.outliers, row.edges, row.planes, row.candidates, row.matches}) {
    out << ',' << count;
  }
  out << ',' << row.weight << ',' << row.iterations << ',' << int(row.converged) << ',' << row.error << ','
      << row.degenerate_directions << ',' << names_of(row.track.state)[std::size_t(row.track.state)];
  for (const double variance : row.covariance.diagonal()) out << ',' << variance;
  out << std::fixed << std::setprecision(4);
  for (const double ms : {row.read_ms, row.register_ms, row.map_ms, row.register_cpu_ms}) out << ',' << ms;
  for (std::size_t i = 0; i < stages; ++i) out << ',' << (i < row.stage_ms.size() ? row.stage_ms[i] : 0.0);
  out << '\n';
}

}  // namespace

std::string scan_table_header(const std::vector<std::string>& stages) {
  std::ostringstream out;
  write_header(out, stages);
  return out.str();
}

std::string scan_table_row(const ScanRow& row, std::size_t index, std::size_t stages) {
  std::ostringstream out;
  write_row(out, row, index, stages);
  return out.str();
}

void write_scan_table(const std::filesystem::path& path, const ScanTable& table) {
  std::ostringstream out;
  write_header(out, table.stages);
  for (std::size_t i = 0; i < table.rows.size(); ++i) write_row(out, table.rows[i], i, table.stages.size());
  write_text(path, out.str());
}

}  // namespace tilth
