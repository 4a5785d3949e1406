// The program itself, run as its users run it: arguments in; exit code, standard output and standard error out.
#pragma once

#include <algorithm>
#include <csignal>
#include <fcntl.h>
#include <fstream>
#include <io/temporary_folder.hpp>
#include <iterator>
#include <string>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

namespace tilth::app {

struct Outcome {
  int exit_code = -1;  ///< 128 + signal where a signal ended it
  std::string out, err;
};

inline std::string text_of(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

inline std::size_t lines_in(const std::string& text) {
  return std::size_t(std::count(text.begin(), text.end(), '\n'));
}

class Program {
 public:
  /// Starts `tilth` with `arguments`.
  explicit Program(std::vector<std::string> arguments) {
    arguments.emplace(arguments.begin(), TILTH_BINARY);
    std::vector<char*> argv;
    for (std::string& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);
    const std::string out = (folder_ / "out").string(), err = (folder_ / "err").string();
    id_ = ::fork();
    if (id_ != 0) return;
    redirect(out, STDOUT_FILENO);
    redirect(err, STDERR_FILENO);
    ::signal(SIGINT, SIG_DFL);  // a shell has it ignored by what runs in its background
    ::execv(TILTH_BINARY, argv.data());
    ::_exit(127);
  }

  void signal(int signal) const { ::kill(id_, signal); }
  std::string out_so_far() const { return text_of(folder_ / "out"); }

  bool running() const {
    siginfo_t ended{};
    ::waitid(P_PID, id_t(id_), &ended, WEXITED | WNOHANG | WNOWAIT);
    return ended.si_pid == 0;
  }

  Outcome wait() const {
    int status = 0;
    ::waitpid(id_, &status, 0);
    const int code = WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
    return {code, text_of(folder_ / "out"), text_of(folder_ / "err")};
  }

 private:
  static void redirect(const std::string& path, int to) {
    ::dup2(::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), to);
  }

  TemporaryFolder folder_;
  pid_t id_ = -1;
};

inline Outcome tilth(const std::vector<std::string>& arguments) {
  return Program(arguments).wait();
}

}  // namespace tilth::app
