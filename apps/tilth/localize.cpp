// tilth localize: where in a saved map a recording was taken.
#include <memory>

#include <CLI/CLI.hpp>

#include "commands.hpp"
#include "interrupt.hpp"
#include "localize_session.hpp"
#include "locked_folder.hpp"
#include "source_flags.hpp"
#include <tilth/sources/open_source.hpp>

namespace tilth::app {
namespace {

int localize_recording(const LocalizeArguments& a, const SourceOptions& input) {
  Console console(a.run.quiet);
  LocalizeSession session(a);
  std::unique_ptr<ScanSource> source = open_source(a.run.source, stopped_by_signals(input));
  const LockedFolder folder(a.run.out, session.files());
  remember_interrupts();
  const LocalizeSession::End end = session.run(std::move(source), console, console);
  return end.whole ? exit_code_of(end.end, !end.is_known, a.run.session.strict) : 1;
}

}  // namespace

void add_localize(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("localize", "Find a recording in a saved map, and follow it there");
  const auto a = std::make_shared<LocalizeArguments>();
  const auto input = std::make_shared<SourceOptions>();
  command->add_option("SOURCE", a->run.source, "recording, as `tilth run` takes it")->required();
  command->add_option("--map", a->map, "folder of the map (`tilth run --save-map`)")->required();
  command->add_option("--out", a->run.out, "folder for the results; made where missing")->required();
  add_at_flag(*command, *a);
  command->add_option("--restart-every", a->restart_every, "forget the place after so many scans, and find it anew");
  command->add_flag("--restart-when-found", a->restart_when_found, "the same as soon as it is found");
  add_source_flags(*command, *input);
  add_beams_flag(*command, a->run);
  add_base_flag(*command, a->run);
  command->add_option("--max-scans", a->run.session.max_scans, "stop after so many scans");
  command->add_flag("--strict", a->run.session.strict, "a record that cannot be used ends the run with an error");
  command->add_option("--pipeline", a->run.options.pipeline, "see `tilth pipelines`; default: the first of them");
  add_setting_arguments(*command, a->run.options);
  add_view_flags(*command, a->run);
  add_threads_flag(*command, a->run);
  command->add_flag("--quiet", a->run.quiet, "print errors only");
  command->callback([a, input, &exit_code] { exit_code = localize_recording(*a, *input); });
}

}  // namespace tilth::app
