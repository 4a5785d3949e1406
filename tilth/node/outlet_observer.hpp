// What a run says, on its way out of a node.
#pragma once

#include <string>

#include <tilth/node/node_outlet.hpp>
#include <tilth/run/run_observer.hpp>

namespace tilth {

class OutletObserver final : public RunObserver {
 public:
  explicit OutletObserver(NodeOutlet& outlet) : outlet_(outlet) {}
  void note(const std::string& sentence) override { outlet_.note(sentence); }
  void warn(const std::string& sentence) override { outlet_.warn(sentence); }

 private:
  NodeOutlet& outlet_;
};

}  // namespace tilth
