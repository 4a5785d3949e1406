// Who may touch a session: the thread that runs it but while it waits for a scan, then whoever asked.
#pragma once

#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>

#include <tilth/sources/scan_source.hpp>

namespace tilth {

class SessionDoor {
 public:
  void open();  ///< others may come in
  void shut();  ///< after all who wait at it were in

  /// Calls `f` inside, once the door is open.
  template <class F>
  auto visit(const F& f) {
    std::unique_lock lock(mutex_);
    ++visitors_;
    changed_.wait(lock, [&] { return open_; });
    const Leaving leaving{*this};
    return f();
  }

 private:
  struct Leaving {
    SessionDoor& door;
    ~Leaving() {
      --door.visitors_;
      door.changed_.notify_all();
    }
  };

  std::mutex mutex_;  // of all below
  std::condition_variable changed_;
  bool open_ = true;
  int visitors_ = 0;
};

/// `source`; the door is open while it is waited for.
std::unique_ptr<ScanSource> behind(SessionDoor& door, std::unique_ptr<ScanSource> source);

}  // namespace tilth
