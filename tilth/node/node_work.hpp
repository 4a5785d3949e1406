// What a node works on in a thread of its own: one session after the other, each with an inbox of its own.
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include <tilth/atlas/map_folder.hpp>
#include <tilth/core/error.hpp>
#include <tilth/node/node_outlet.hpp>
#include <tilth/node/node_settings.hpp>
#include <tilth/node/node_task.hpp>
#include <tilth/node/session_door.hpp>
#include <tilth/node/static_transforms.hpp>
#include <tilth/sources/cloud_inbox.hpp>

namespace tilth {

class NodeWork {
 public:
  /// As SlamNode.
  NodeWork(const OptionValues& parameters, NodeOutlet& outlet);
  ~NodeWork();
  NodeWork(const NodeWork&) = delete;
  NodeWork& operator=(const NodeWork&) = delete;

  /// That of the next session, where the last one is over or about to be.
  std::shared_ptr<CloudInbox> inbox();

  void take_static_transforms(std::span<const std::byte> message);

  /// Where no cloud came yet, it is kept for the first ones.
  void take_guess(std::span<const std::byte> message);

  /// All of them, as they are by now.
  std::vector<NodeParameter> parameters();

  /// Sets those that may be set while it runs: all of `values` or, throwing Error, none.
  void set(const OptionValues& values);

  /// Calls `service` with the task, while that waits for a scan. Throws Error, naming it, where there is no task.
  template <class F>
  std::string ask(const char* name, const F& service) {
    return door_.visit([&] {
      if (task_ == nullptr) throw Error(name, "no scan is registered yet");
      return service(*task_);
    });
  }

 private:
  class Inside;
  void work();
  void run(const std::shared_ptr<CloudInbox>& clouds);
  bool find_mount(const std::string& lidar, const CloudInbox& clouds);

  OptionValues parameters_;  // behind mutex_
  NodeSettings settings_;    // the mount in it is the working thread's, what may be set behind the door and mutex_
  NodeOutlet& outlet_;
  StaticTransforms fixed_;
  std::optional<MapFolder> map_;  // to be found in
  SessionDoor door_;
  NodeTask* task_ = nullptr;        // behind the door
  std::optional<Pose> T_map_body_;  // behind the door: where the next task is to look first
  std::mutex mutex_;                // of what follows
  std::shared_ptr<CloudInbox> inbox_;
  bool stopping_ = false;
  std::jthread thread_;  // last: it uses the members above
};

}  // namespace tilth
