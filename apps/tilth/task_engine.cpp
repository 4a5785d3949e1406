#include "task_engine.hpp"

#include <nlohmann/json.hpp>

#include "child_process.hpp"
#include "interrupt.hpp"
#include <tilth/core/error.hpp>
#include <tilth/io/output_file.hpp>

namespace tilth::app {
namespace {

namespace fs = std::filesystem;

nlohmann::json commands_of(const std::vector<Job>& jobs) {
  nlohmann::json commands = nlohmann::json::array();
  for (const Job& job : jobs) {
    if (!end_of(job).done) commands.push_back({own_program().string(), "job", job.folder.string()});
  }
  return commands;
}

}  // namespace

std::string job_line(const Job& job) {
  return quoted(own_program().string()) + " job " + quoted(job.folder.string());
}

void perform_on_dask(const std::vector<Job>& jobs, const DaskOptions& options) {
  if (options.scheduler.empty()) throw Error("--engine dask", "needs --scheduler ADDRESS, such as tcp://host:8786");
  const nlohmann::json commands = commands_of(jobs);
  if (commands.empty()) return;
  write_text(options.list, commands.dump());
  remember_interrupts();
  const std::vector<std::string> command{options.python, script_file("run_jobs_dask.py").string(), "--scheduler",
                                         options.scheduler, options.list.string()};
  const ChildEnd end = run_child(command, "");
  if (interrupted() == 0 && (end.signal != 0 || end.exit_code != 0))
    throw Error("--engine dask", "gave up, see above; what is done stays done");
}

fs::path script_file(const std::string& name) {
  const fs::path installed = own_program().parent_path().parent_path() / "share" / "tilth" / name;
  const fs::path built = fs::path(TILTH_SCRIPTS) / name;
  for (const fs::path& file : {installed, built}) {
    if (fs::is_regular_file(file)) return file;
  }
  throw Error(installed.string(), "is missing, and so is " + built.string());
}

}  // namespace tilth::app
