// tilth job: does jobs that compare or sweep have planned, for engines that spread them over machines.
#include <memory>

#include <CLI/CLI.hpp>

#include "commands.hpp"
#include "interrupt.hpp"
#include "job_queue.hpp"

namespace tilth::app {
namespace {

struct JobArguments {
  std::vector<std::string> folders;
};

/// A run that fails is a result like others; only a job that is not done makes this fail.
int do_jobs(const JobArguments& arguments) {
  std::vector<Job> jobs;
  for (const std::string& folder : arguments.folders) jobs.push_back(read_job(folder));
  Console console(false);
  perform_all(jobs, {1, true}, console);
  if (interrupted() != 0) return kInterruptedExit;
  for (const Job& job : jobs) {
    const JobEnd end = end_of(job);
    if (!end.done) console.error(job.folder.string() + ": " + end.failure);
    if (!end.done) return 1;
  }
  return 0;
}

}  // namespace

void add_job(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("job", "Do jobs that `tilth compare --list-jobs` has listed, unless done");
  const auto arguments = std::make_shared<JobArguments>();
  command->add_option("FOLDER", arguments->folders, "of a job")->required();
  command->callback([arguments, &exit_code] { exit_code = do_jobs(*arguments); });
}

}  // namespace tilth::app
