// Ctrl-C while the library is at work: Python learns of a signal only when it is asked, and only in the thread that it
// calls from.
#pragma once

#include <atomic>
#include <chrono>
#include <exception>
#include <future>
#include <nanobind/nanobind.h>
#include <thread>

namespace tilth::python {

class Interrupt {
 public:
  Interrupt() = default;
  ~Interrupt();  ///< with the interpreter's lock
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  /// Whether a signal came whose handler raised, or something else is kept. Without the interpreter's lock.
  bool came();

  /// came() from now on.
  void stop() { stop_ = true; }

  /// Keeps what a function of Python raised; the first one stays. With the lock.
  void keep(nanobind::python_error& error);

  /// f() without the interpreter's lock, which the caller holds. What is kept afterwards is raised, whatever f() threw.
  /// What waits (for a sensor) is done in another thread, while this one asks for signals.
  template <class F>
  auto unlocked(bool waits, const F& f) {
    try {
      auto result = [&] {
        const nanobind::gil_scoped_release unlocked;
        caller_ = std::this_thread::get_id();
        return waits ? watched(f) : f();
      }();
      raise();
      return result;
    } catch (const std::exception&) {
      raise();
      throw;
    }
  }

 private:
  template <class F>
  auto watched(const F& f) {
    auto result = std::async(std::launch::async, f);
    while (result.wait_for(std::chrono::milliseconds(50)) != std::future_status::ready) came();
    return result.get();
  }
  void raise();

  std::thread::id caller_;
  std::atomic<bool> stop_ = false;
  PyObject* raised_ = nullptr;  // owned
};

}  // namespace tilth::python
