#include "job.hpp"

#include <array>
#include <cstdio>

#include <nlohmann/json.hpp>

#include "child_process.hpp"
#include "file_lock.hpp"
#include "interrupt.hpp"
#include <tilth/core/error.hpp>
#include <tilth/io/input_file.hpp>
#include <tilth/io/output_file.hpp>
#include <tilth/run/stopwatch.hpp>

namespace tilth::app {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr int kSignalExit = 128;  // exit codes from here on: ended by a signal, as shells say it
constexpr const char *kJob = "job.json", *kDone = "done.json", *kLog = "log.txt", *kLock = "lock";

Json to_json(const Job& job) {
  return {
      {"program", job.program},
      {"recording",
       {{"folder", job.recording.folder.string()}, {"make", job.recording.make}, {"program", job.recording.program}}},
      {"commands", job.commands}};
}

std::string text_of(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw Error(folder.string(), "cannot be made: " + error.message());
}

/// What a file of an earlier end says, or nothing where there is none that can be read.
Json read_end(const fs::path& file) {
  try {
    return Json::parse(as_text(read_file(file)));
  } catch (const std::exception&) {
    return Json();
  }
}

void remove_earlier(const fs::path& folder) {
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const fs::path name = entry.path().filename();
    if (name != kJob && name != kLock) fs::remove_all(entry.path());
  }
}

/// The last lines of a log, in one.
std::string tail_of(const fs::path& log) {
  constexpr std::size_t kMost = 300;
  const std::vector<std::byte> bytes = read_file(log);
  std::string text(as_text(bytes));
  while (!text.empty() && text.back() == '\n') text.pop_back();
  const std::size_t error = text.rfind("tilth: error: ");
  if (error != std::string::npos) text = text.substr(error + 14);
  return text.size() > kMost ? "..." + text.substr(text.size() - kMost) : text;
}

Command with_own_program(Command command) {
  if (command.front() == "tilth") command.front() = own_program().string();
  return command;
}

std::string failure_of(const ChildEnd& end, const Command& command, const fs::path& log) {
  const std::string name = command.front() + (command.size() > 1 ? " " + command[1] : "");
  if (end.signal != 0) return name + " was ended by signal " + std::to_string(end.signal);
  if (end.exit_code == 0) return "";
  return name + " ended with " + std::to_string(end.exit_code) + ": " + tail_of(log);
}

bool killed(const ChildEnd& end) {
  return end.signal != 0 || end.exit_code > kSignalExit;
}

/// Makes the scans where they are not there yet. Returns what went wrong.
std::string provide(const Job& job, const fs::path& log) {
  const Recording& recording = job.recording;
  if (recording.make.empty()) return "";
  make_folder(recording.folder);
  const FileLock lock(recording.folder / kLock);
  const Json wanted{{"program", recording.program}, {"make", recording.make}};
  if (read_end(recording.folder / kDone) == wanted) return "";
  remove_earlier(recording.folder);
  const ChildEnd end = run_child(with_own_program(recording.make), log);
  const std::string failure = failure_of(end, recording.make, log);
  if (failure.empty()) write_text(recording.folder / kDone, text_of(wanted));
  return failure;
}

/// Runs the commands up to the first that fails.
Json run_commands(const Job& job, const fs::path& log) {
  const Stopwatch stopwatch;
  std::string failure = provide(job, log);
  bool was_killed = !failure.empty();  // scans may yet be made another time
  double cpu_seconds = 0;
  for (const Command& command : job.commands) {
    if (!failure.empty()) break;
    const ChildEnd end = run_child(with_own_program(command), log);
    failure = failure_of(end, command, log);
    was_killed = killed(end);
    cpu_seconds += end.cpu_seconds;
  }
  return {{"job", to_json(job)},
          {"done", !was_killed},
          {"failure", failure},
          {"cpu_seconds", cpu_seconds},
          {"wall_seconds", stopwatch.seconds()}};
}

}  // namespace

std::string fingerprint(const fs::path& file) {
  std::uint64_t hash = 14695981039346656037U;  // FNV-1a
  for (const std::byte byte : read_file(file)) hash = (hash ^ std::uint64_t(byte)) * 1099511628211U;
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%016llx", static_cast<unsigned long long>(hash));
  return text.data();
}

const std::string& own_name() {
  static const std::string name = "tilth " TILTH_VERSION ", " + fingerprint(own_program());
  return name;
}

void write_job(const Job& job) {
  make_folder(job.folder);
  write_text(job.folder / kJob, text_of(to_json(job)));
}

Job read_job(const fs::path& folder) {
  const fs::path file = fs::absolute(folder) / kJob;
  const std::vector<std::byte> bytes = read_file(file);
  try {
    const Json json = Json::parse(as_text(bytes));
    const Json& recording = json.at("recording");
    Job job;
    job.folder = file.parent_path();
    job.recording.folder = recording.at("folder").get<std::string>();
    job.recording.make = recording.at("make").get<Command>();
    job.recording.program = recording.at("program").get<std::string>();
    job.commands = json.at("commands").get<std::vector<Command>>();
    job.program = json.at("program").get<std::string>();
    return job;
  } catch (const Json::exception& e) {
    throw Error(file.string(), std::string("is no job: ") + e.what());
  }
}

JobEnd end_of(const Job& job) {
  const Json end = read_end(job.folder / kDone);
  if (!end.is_object() || end.value("job", Json()) != to_json(job)) return {false, "it was not run"};
  return {end.value("done", false), end.value("failure", "")};
}

JobEnd perform(const Job& job) {
  make_folder(job.folder);
  const FileLock lock(job.folder / kLock);
  const JobEnd before = end_of(job);
  if (before.done) return before;
  remove_earlier(job.folder);
  const Json end = run_commands(job, job.folder / kLog);
  if (interrupted() != 0) return {false, "interrupted"};
  write_text(job.folder / kDone, text_of(end));
  return end_of(job);
}

void remove_scans(const Recording& recording) {
  if (recording.make.empty()) return;
  const FileLock lock(recording.folder / kLock);
  fs::remove(recording.folder / kDone);
  for (const char* part : {"scans", "labels"}) fs::remove_all(recording.folder / part);
}

}  // namespace tilth::app
