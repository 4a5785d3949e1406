// The handles of rcl, each closed when it goes. Messages pass as bytes (CDR): the node works on them as recordings do.
#pragma once

#include <cstddef>
#include <cstdint>
#include <rcl/rcl.h>
#include <span>
#include <string>
#include <vector>

namespace tilth::ros2 {

/// Throws Error with what rcl says of it, unless it went well.
void check(rcl_ret_t result, const std::string& what);

/// A node, and the context of its program. `arguments` are those of main(), --ros-args included.
class RclNode {
 public:
  RclNode(int count, const char* const* arguments, const char* name);
  ~RclNode();
  RclNode(const RclNode&) = delete;
  RclNode& operator=(const RclNode&) = delete;

  rcl_node_t* get() { return &node_; }
  rcl_context_t* context() { return &context_; }
  std::string name() const { return rcl_node_get_fully_qualified_name(&node_); }
  const char* logger() const { return rcl_node_get_logger_name(&node_); }

 private:
  rcl_context_t context_;
  rcl_node_t node_;
};

class MessagePublisher {
 public:
  MessagePublisher(RclNode& node, const rosidl_message_type_support_t* type, const std::string& topic,
                   const rmw_qos_profile_t& qos);
  ~MessagePublisher();
  MessagePublisher(const MessagePublisher&) = delete;
  MessagePublisher& operator=(const MessagePublisher&) = delete;

  void publish(std::span<const std::byte> message);
  std::size_t listeners() const;

 private:
  RclNode& node_;
  rcl_publisher_t publisher_;
};

class MessageSubscription {
 public:
  MessageSubscription(RclNode& node, const rosidl_message_type_support_t* type, const std::string& topic,
                      const rmw_qos_profile_t& qos);
  ~MessageSubscription();
  MessageSubscription(const MessageSubscription&) = delete;
  MessageSubscription& operator=(const MessageSubscription&) = delete;

  const rcl_subscription_t* get() const { return &subscription_; }
  std::string topic() const { return rcl_subscription_get_topic_name(&subscription_); }

  /// The next message that came; empty where there is none.
  std::vector<std::byte> take();

  /// Messages of the last sender that were lost before the one taken last, by its numbers; 0 where it has none.
  std::size_t lost() const { return lost_; }

 private:
  RclNode& node_;
  rcl_subscription_t subscription_;
  rcl_serialized_message_t message_;
  rmw_message_info_t last_;
  std::size_t lost_ = 0;
};

class ServiceServer {
 public:
  virtual ~ServiceServer();
  ServiceServer(const ServiceServer&) = delete;
  ServiceServer& operator=(const ServiceServer&) = delete;

  const rcl_service_t* get() const { return &service_; }

  /// Answers the next request, where there is one.
  virtual void answer() = 0;

 protected:
  ServiceServer(RclNode& node, const rosidl_service_type_support_t* type, const std::string& name);

  RclNode& node_;
  rcl_service_t service_;
};

/// What is waited for together.
class WaitSet {
 public:
  WaitSet(RclNode& node, std::size_t subscriptions, std::size_t services);
  ~WaitSet();
  WaitSet(const WaitSet&) = delete;
  WaitSet& operator=(const WaitSet&) = delete;

  /// Whether something came for one of them, before so many [ns]. No more than the set was made for.
  bool wait(std::span<const rcl_subscription_t* const> subscriptions, std::span<const rcl_service_t* const> services,
            std::int64_t longest);

 private:
  rcl_wait_set_t set_;
};

}  // namespace tilth::ros2
