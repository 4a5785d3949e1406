#include "run_session.hpp"

#include <charconv>

#include <CLI/CLI.hpp>

#include "interrupt.hpp"
#include "option_flags.hpp"
#include "run_console.hpp"
#include <tilth/core/error.hpp>
#include <tilth/sources/describe_source.hpp>

namespace tilth::app {
namespace {

/// The number that follows --view, or `usual` where none does.
std::uint16_t port_of(const std::string& text, std::uint16_t usual) {
  if (text.empty() || text == "true") return usual;
  std::uint16_t port = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), port);
  if (error != std::errc{} || end != text.data() + text.size())
    throw Error("--view " + text, "is no port: expected a number from 0 (any that is free) to 65535");
  return port;
}

}  // namespace

int exit_code_of(RunEnd end, bool lost, bool strict) {
  if (end == RunEnd::interrupted) return signal_exit_code();
  if (end == RunEnd::bad_record || ((end == RunEnd::input_broken || lost) && strict)) return 1;
  return lost ? kTrackLostExit : 0;
}

void add_output_flags(CLI::App& command, RunArguments& arguments) {
  add_option_flags(command, describe(MapOptions{}), arguments.map);
  add_option_flags(command, describe(OutputOptions{}), arguments.output);
  add_option_flags(command, describe(ReportOptions{}), arguments.report);
}

void add_threads_flag(CLI::App& command, RunArguments& arguments) {
  command.add_option("--threads", arguments.threads, "0: as many as there are processors")->check(CLI::Range(0, 1024));
}

void add_beams_flag(CLI::App& command, RunArguments& arguments) {
  command.add_option("--beams", arguments.beams, kBeamsMeaning)->option_text("FILE");
}

CLI::Option* add_learn_beams_flag(CLI::App& command, RunArguments& arguments) {
  return command.add_flag("--learn-beams", arguments.learn_beams, kLearnBeamsMeaning);
}

CLI::Option* add_keep_beams_flag(CLI::App& command, RunArguments& arguments) {
  return command.add_flag("--keep-beams", arguments.keep_beams, kKeepBeamsMeaning);
}

void add_base_flag(CLI::App& command, RunArguments& arguments) {
  command
      .add_option("--base-from-lidar", arguments.base_from_lidar,
                  "where the LiDAR is mounted on the robot: poses are then of base_link, and the map begins there")
      ->option_text("x,y,z,roll,pitch,yaw [m, deg] or x,y,z,qx,qy,qz,qw");
}

CLI::Option* add_level_flag(CLI::App& command, RunArguments& arguments) {
  return command.add_flag("--level", arguments.level,
                          "turn the map so that the floor below the first seconds is level");
}

void add_view_flags(CLI::App& command, RunArguments& arguments) {
  const auto view = [&]() -> ViewAddress& { return arguments.view ? *arguments.view : arguments.view.emplace(); };
  CLI::Option* port = command.add_option_function<std::string>(
      "--view", [view](const std::string& text) { view().port = port_of(text, view().port); },
      "let browsers on this machine and Foxglove watch the run while it goes on");
  port->expected(0, 1)->option_text("[PORT] (8765)");
  command
      .add_option_function<std::string>(
          "--view-host", [view](const std::string& host) { view().host = host; },
          "address to be watched at; 0.0.0.0: from every machine that reaches this one")
      ->needs(port)
      ->option_text("ADDRESS (127.0.0.1)");
}

void add_prior_flag(CLI::App& command, RunArguments& arguments) {
  command.add_option("--prior", arguments.prior, kPriorMeaning)->option_text("FILE");
}

bool tell_end(const RunRecord& record, const std::string& folder, const std::vector<std::string>& files,
              const std::vector<std::string>& failures, Console& console) {
  report_run(record, folder, files, console);
  for (const std::string& failure : failures) console.error(failure);
  return failures.empty();
}

}  // namespace tilth::app
