#include "child_process.hpp"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <mutex>
#include <set>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <tilth/core/error.hpp>

namespace tilth::app {
namespace {

/// Of libraries that would start threads of their own: OpenMP, OpenBLAS, numexpr, MKL.
constexpr std::array<const char*, 4> kSingleThreaded{"OMP_NUM_THREADS=1", "OPENBLAS_NUM_THREADS=1",
                                                     "NUMEXPR_NUM_THREADS=1", "MKL_NUM_THREADS=1"};

std::mutex children_mutex;
std::set<pid_t> children;

std::vector<char*> pointers(std::vector<std::string>& words) {
  std::vector<char*> all;
  for (std::string& word : words) all.push_back(word.data());
  all.push_back(nullptr);
  return all;
}

std::vector<std::string> environment() {
  std::vector<std::string> all(kSingleThreaded.begin(), kSingleThreaded.end());
  for (char** entry = environ; *entry != nullptr; ++entry) all.emplace_back(*entry);
  return all;
}

double seconds(const timeval& time) {
  return double(time.tv_sec) + 1e-6 * double(time.tv_usec);
}

/// Between fork and exec: system calls only.
[[noreturn]] void become(char* const* argv, char* const* environment, int log, pid_t parent) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(127);
  if (log >= 0) {
    ::dup2(log, STDOUT_FILENO);
    ::dup2(log, STDERR_FILENO);
  }
  ::dup2(::open("/dev/null", O_RDONLY | O_CLOEXEC), STDIN_FILENO);
  ::execvpe(argv[0], argv, environment);
  constexpr char kMissing[] = "the program cannot be started\n";
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, kMissing, sizeof kMissing - 1);
  ::_exit(127);
}

/// The process is known to signal_children before another thread may ask for it.
pid_t start(std::vector<std::string> command, int log) {
  std::vector<std::string> variables = environment();
  const std::vector<char*> argv = pointers(command), envp = pointers(variables);
  const pid_t parent = ::getpid();
  const std::scoped_lock lock(children_mutex);
  const pid_t child = ::fork();
  if (child == 0) become(argv.data(), envp.data(), log, parent);
  if (child > 0) children.insert(child);
  return child;
}

ChildEnd wait_for(pid_t child) {
  int status = 0;
  rusage usage{};
  while (::wait4(child, &status, 0, &usage) < 0 && errno == EINTR) continue;
  const std::scoped_lock lock(children_mutex);
  children.erase(child);
  ChildEnd end;
  if (WIFSIGNALED(status)) end.signal = WTERMSIG(status);
  if (WIFEXITED(status)) end.exit_code = WEXITSTATUS(status);
  end.cpu_seconds = seconds(usage.ru_utime) + seconds(usage.ru_stime);
  return end;
}

}  // namespace

ChildEnd run_child(const std::vector<std::string>& command, const std::filesystem::path& log) {
  const int file = log.empty() ? -1 : ::open(log.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
  if (file < 0 && !log.empty()) throw Error(log.string(), std::strerror(errno));
  const pid_t child = start(command, file);
  const int reason = errno;
  if (file >= 0) ::close(file);
  if (child < 0) throw Error(command.front(), std::string("cannot be started: ") + std::strerror(reason));
  return wait_for(child);
}

void signal_children(int signal) {
  const std::scoped_lock lock(children_mutex);
  for (const pid_t child : children) ::kill(child, signal);
}

std::filesystem::path own_program() {
  return std::filesystem::read_symlink("/proc/self/exe");
}

std::string quoted(const std::string& word) {
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

}  // namespace tilth::app
