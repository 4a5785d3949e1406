#include "job_queue.hpp"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <csignal>
#include <cstdio>
#include <deque>
#include <exception>
#include <map>
#include <mutex>
#include <set>
#include <thread>

#include "child_process.hpp"
#include "interrupt.hpp"

namespace tilth::app {
namespace {

using namespace std::chrono_literals;

struct Finished {
  const Job* job;
  JobEnd end;
};

/// What the workers share.
struct Board {
  std::mutex mutex;
  std::condition_variable changed;
  std::deque<const Job*> waiting;
  std::deque<Finished> finished;                       // not told yet
  std::map<std::filesystem::path, std::size_t> users;  // jobs not done yet, by recording
  std::exception_ptr broken;
  int working = 0;
};

const Job* take(Board& board) {
  const std::scoped_lock lock(board.mutex);
  if (board.waiting.empty() || board.broken || interrupted() != 0) return nullptr;
  const Job* job = board.waiting.front();
  board.waiting.pop_front();
  return job;
}

void work(Board& board) {
  while (const Job* job = take(board)) {
    try {
      const JobEnd end = perform(*job);
      const std::scoped_lock lock(board.mutex);
      board.finished.push_back({job, end});
    } catch (...) {
      const std::scoped_lock lock(board.mutex);
      board.broken = std::current_exception();
    }
    board.changed.notify_one();
  }
  const std::scoped_lock lock(board.mutex);
  --board.working;
  board.changed.notify_one();
}

std::string duration_text(double seconds) {
  char text[32];
  if (seconds < 90) {
    std::snprintf(text, sizeof text, "%.0f s", seconds);
  } else {
    std::snprintf(text, sizeof text, "%.0f min", seconds / 60);
  }
  return text;
}

std::string short_name(const Job& job) {
  return (job.folder.parent_path().filename() / job.folder.filename()).string();
}

/// Tells what is finished and how far the whole is.
class Teller {
 public:
  Teller(std::size_t total, std::size_t before, Console& console) : total_(total), done_(before), console_(console) {}

  void tell(const Finished& finished) {
    if (!finished.end.done && finished.end.failure == "interrupted") return;
    ++done_;
    ++fresh_;
    const std::string count = std::to_string(done_) + " of " + std::to_string(total_) + ": ";
    console_.note(count + short_name(*finished.job) +
                  (finished.end.failure.empty() ? "" : ", failed: " + finished.end.failure));
  }

  void show() {
    std::string text = std::to_string(done_) + " of " + std::to_string(total_) + " runs  ";
    text += std::to_string(total_ == 0 ? 100 : 100 * done_ / total_) + " %";
    if (fresh_ > 0) text += "  " + duration_text(clock_.seconds() / double(fresh_) * double(total_ - done_)) + " left";
    console_.show_progress(text);
  }

 private:
  std::size_t total_, done_, fresh_ = 0;
  Console& console_;
  Stopwatch clock_;
};

std::deque<const Job*> undone(const std::vector<Job>& jobs) {
  std::deque<const Job*> waiting;
  for (const Job& job : jobs) {
    if (!end_of(job).done) waiting.push_back(&job);
  }
  return waiting;
}

/// How many jobs wait for each recording's scans.
std::map<std::filesystem::path, std::size_t> count_users(const std::deque<const Job*>& waiting) {
  std::map<std::filesystem::path, std::size_t> users;
  for (const Job* job : waiting) ++users[job->recording.folder];
  return users;
}

/// Until every worker has gone home; the lock is held but while waiting.
void supervise(Board& board, const QueueOptions& options, Teller& teller) {
  std::unique_lock lock(board.mutex);
  while (board.working > 0 || !board.finished.empty()) {
    board.changed.wait_for(lock, 200ms);
    while (!board.finished.empty()) {
      const Finished finished = board.finished.front();
      board.finished.pop_front();
      lock.unlock();
      teller.tell(finished);
      const Recording& recording = finished.job->recording;
      const bool last = finished.end.done && --board.users[recording.folder] == 0;
      if (last && !options.keep_recordings) remove_scans(recording);
      lock.lock();
    }
    if (interrupted() != 0 || board.broken) signal_children(SIGTERM);
    teller.show();
  }
}

}  // namespace

void perform_all(const std::vector<Job>& jobs, const QueueOptions& options, Console& console) {
  remember_interrupts();
  Board board;
  board.waiting = undone(jobs);
  board.users = count_users(board.waiting);
  Teller teller(jobs.size(), jobs.size() - board.waiting.size(), console);
  const std::size_t processors = std::max(1U, std::thread::hardware_concurrency());
  const std::size_t wanted = options.at_once == 0 ? processors : std::size_t(options.at_once);
  board.working = int(std::min(wanted, board.waiting.size()));
  std::vector<std::jthread> workers;
  for (int i = 0, count = board.working; i < count; ++i) workers.emplace_back([&board] { work(board); });
  supervise(board, options, teller);
  workers.clear();
  console.clear_progress();
  if (board.broken) std::rethrow_exception(board.broken);
}

void remove_finished_recordings(const std::vector<Job>& jobs) {
  const auto users = count_users(undone(jobs));
  std::set<std::filesystem::path> removed;
  for (const Job& job : jobs) {
    const std::filesystem::path& folder = job.recording.folder;
    if (!users.contains(folder) && removed.insert(folder).second) remove_scans(job.recording);
  }
}

}  // namespace tilth::app
