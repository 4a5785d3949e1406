// tilth convert: a recording in another format; what that format cannot hold is said.
#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "commands.hpp"
#include "console.hpp"
#include "interrupt.hpp"
#include "scan_writer.hpp"
#include "source_flags.hpp"
#include <tilth/core/error.hpp>
#include <tilth/io/pcap_writer.hpp>
#include <tilth/sensor/packet.hpp>
#include <tilth/sources/open_source.hpp>
#include <tilth/sources/packet_feeds.hpp>
#include <tilth/sources/packet_files.hpp>
#include <tilth/sources/scan_files.hpp>

namespace tilth::app {
namespace {

namespace fs = std::filesystem;

struct ConvertArguments {
  std::string source, target, format = "pcd";
  SourceOptions input;
  std::size_t max_scans = 0;  // zero: all
  bool force = false, quiet = false;
};

/// Throws Error where something stands in the target's place and is not to be replaced.
void make_place(const ConvertArguments& arguments) {
  const fs::path target(arguments.target);
  if (!fs::exists(target)) return;
  std::error_code error;
  if (fs::equivalent(target, arguments.source, error)) throw Error(arguments.target, "is the source itself");
  const bool empty_folder = fs::is_directory(target) && fs::is_empty(target);
  if (!arguments.force && !empty_folder) throw Error(arguments.target, "exists already; --force replaces it");
}

/// --force: scans that an earlier conversion left would stand among the new ones.
void remove_scans(const fs::path& folder) {
  if (!fs::is_directory(folder)) return;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (is_scan_file(entry.path()) || entry.path().extension() == ".las") fs::remove(entry.path());
  }
}

/// Times of zero say that a scan was taken at once, so that no reader derives others.
Scan with_times(Scan scan) {
  if (!scan.cloud.has_times()) scan.cloud.times.assign(scan.cloud.size(), 0.0F);
  return scan;
}

/// What the target cannot hold of such a scan, one sentence each.
std::vector<std::string> losses(const Scan& scan, const ConvertArguments& arguments, bool to_folder) {
  std::vector<std::string> all{"coordinates become 32-bit floats (at 100 m, steps of 8 micrometres)"};
  if (!to_folder) return all;
  const CloudFile format = cloud_file(arguments.format);
  if (format == CloudFile::las)
    all = {"coordinates are rounded to 0.1 mm, intensities to whole numbers; tilth does not read LAS again"};
  const bool rich = scan.cloud.has_rings() || scan.cloud.has_times();
  if (format == CloudFile::kitti && rich)
    all.emplace_back("rings and times of the points are lost: KITTI's format has no place for them");
  return all;
}

struct Target {
  ScanWriter writer;
  fs::path times;  ///< file of the stamps; empty: the recording holds them
};

Target open_target(const ConvertArguments& arguments) {
  const fs::path path(arguments.target);
  if (path.extension() == ".bag") return {scans_in_bag(path), {}};
  if (path.extension() == ".mcap") return {scans_in_mcap(path), {}};
  const std::vector<std::string> files{".db3", ".pcapng", ".cap", ".pcd", ".ply", ".las", ".laz", ".bin"};
  if (std::count(files.begin(), files.end(), path.extension()) > 0)
    throw Error(arguments.target, "has an ending that is not written: expected .pcap, .bag, .mcap or a folder");
  const CloudFile format = cloud_file(arguments.format);
  remove_scans(scan_folder(path, format));
  return {scans_in_folder(path, format), path / "times.txt"};
}

int convert_scans(const ConvertArguments& arguments, Console& console) {
  const std::unique_ptr<ScanSource> source = open_source(arguments.source, stopped_by_signals(arguments.input));
  const Target target = open_target(arguments);
  std::vector<double> stamps;
  while ((arguments.max_scans == 0 || stamps.size() < arguments.max_scans) && interrupted() == 0) {
    const std::optional<Scan> scan = source->next();
    if (!scan) break;
    if (stamps.empty()) {
      for (const std::string& decision : source->decisions()) console.note(decision);
      for (const std::string& loss : losses(*scan, arguments, !target.times.empty())) console.note("loss: " + loss);
    }
    target.writer.write(stamps.size(), with_times(*scan));
    stamps.push_back(scan->stamp);
    console.progress(stamps.size(), source->size());
  }
  for (const std::string& notice : source->notices()) console.note(notice);
  for (const SkippedScan& skipped : source->skipped()) console.warn("skipped: " + skipped.where + ": " + skipped.what);
  if (stamps.empty()) throw Error(arguments.source, "has no scan that can be converted");
  if (!target.times.empty()) write_times(target.times, stamps);
  if (interrupted() != 0) return signal_exit_code();
  target.writer.close();
  console.note(std::to_string(stamps.size()) + " scans in " + arguments.target);
  return 0;
}

int convert_packets(const ConvertArguments& arguments, Console& console) {
  if (arguments.max_scans > 0) throw Error("--max-scans", "means nothing for packets");
  const PacketFeed feed = open_packet_feed(arguments.source, arguments.input.topic);
  PcapWriter file(arguments.target);
  std::size_t packets = 0;
  while (interrupted() == 0) {
    const std::optional<ReceivedPacket> packet = feed.next();
    if (!packet) break;
    const std::uint16_t port = factory_port(packet->payload);
    file.write(packet->arrival.value_or(0.0), {packet->sender, 0xFFFFFFFF, port, port}, packet->payload);
    console.progress(++packets, std::nullopt);
  }
  console.clear_progress();
  if (!feed.problem().empty()) console.warn(feed.name + " is damaged: " + feed.problem());
  if (packets == 0) throw Error(arguments.source, "has no packet that can be converted");
  if (interrupted() != 0) return signal_exit_code();
  file.close();
  console.note("loss: times of arrival are rounded to microseconds, ports are those sensors have from the factory");
  console.note(std::to_string(packets) + " packets in " + arguments.target);
  return 0;
}

int convert(const ConvertArguments& arguments) {
  Console console(arguments.quiet);
  make_place(arguments);
  remember_interrupts();
  const fs::path target(arguments.target);
  return target.extension() == ".pcap" ? convert_packets(arguments, console) : convert_scans(arguments, console);
}

}  // namespace

void add_convert(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("convert", "Write a recording in another format");
  const auto a = std::make_shared<ConvertArguments>();
  command->add_option("SOURCE", a->source, "as `tilth run` takes it")->required();
  command->add_option("TARGET", a->target, "FILE.bag (ROS 1), FILE.mcap (ROS 2), FILE.pcap (of packets) or a folder")
      ->required();
  command->add_option("--format", a->format, "of the scans in a folder: pcd, ply, las or kitti (pcd)");
  command->add_flag("--force", a->force, "replace what stands there");
  add_source_flags(*command, a->input);
  command->add_option("--max-scans", a->max_scans, "stop after so many scans");
  command->add_flag("--quiet", a->quiet, "print errors only");
  command->callback([a, &exit_code] { exit_code = convert(*a); });
}

}  // namespace tilth::app
