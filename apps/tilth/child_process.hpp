// A program run as a child: what it says goes to a file; it does not outlive the one who started it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tilth::app {

struct ChildEnd {
  int exit_code = 0;         ///< where no signal ended it
  int signal = 0;            ///< that ended it, or zero
  double cpu_seconds = 0.0;  ///< [s] user and system, of all its threads
};

/// Runs `command` (program and arguments) and waits; its output and errors are added to
/// `log`, or are those of this program where `log` is empty. Its libraries' threads are
/// limited to one where they ask the environment. Throws Error where no process can be made; a program that cannot be
/// started ends with 127. May be called from several threads at once.
ChildEnd run_child(const std::vector<std::string>& command, const std::filesystem::path& log);

/// Sends `signal` to every child that runs.
void signal_children(int signal);

/// The file of this program.
std::filesystem::path own_program();

/// `word` in quotes, as a shell takes it for one word.
std::string quoted(const std::string& word);

}  // namespace tilth::app
