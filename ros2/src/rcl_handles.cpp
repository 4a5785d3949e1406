#include "rcl_handles.hpp"

#include <algorithm>
#include <iterator>
#include <rcl/error_handling.h>
#include <rcl/logging.h>

#include <tilth/core/error.hpp>

namespace tilth::ros2 {
namespace {

/// Closing fails only where nothing can be done about it any more.
void close(rcl_ret_t) {
  rcl_reset_error();
}

}  // namespace

void check(rcl_ret_t result, const std::string& what) {
  if (result == RCL_RET_OK) return;
  const std::string reason = rcutils_get_error_string().str;
  rcl_reset_error();
  throw Error(what, reason);
}

RclNode::RclNode(int count, const char* const* arguments, const char* name)
    : context_(rcl_get_zero_initialized_context()), node_(rcl_get_zero_initialized_node()) {
  const rcl_allocator_t allocator = rcl_get_default_allocator();
  rcl_init_options_t options = rcl_get_zero_initialized_init_options();
  check(rcl_init_options_init(&options, allocator), "rcl");
  check(rcl_init(count, arguments, &options, &context_), "rcl");
  close(rcl_init_options_fini(&options));
  check(rcl_logging_configure(&context_.global_arguments, &allocator), "logging");
  const rcl_node_options_t node_options = rcl_node_get_default_options();
  check(rcl_node_init(&node_, name, "", &context_, &node_options), "node " + std::string(name));
}

RclNode::~RclNode() {
  close(rcl_node_fini(&node_));
  close(rcl_shutdown(&context_));
  close(rcl_logging_fini());
  close(rcl_context_fini(&context_));
}

MessagePublisher::MessagePublisher(RclNode& node, const rosidl_message_type_support_t* type, const std::string& topic,
                                   const rmw_qos_profile_t& qos)
    : node_(node), publisher_(rcl_get_zero_initialized_publisher()) {
  rcl_publisher_options_t options = rcl_publisher_get_default_options();
  options.qos = qos;
  check(rcl_publisher_init(&publisher_, node.get(), type, topic.c_str(), &options), "topic " + topic);
}

MessagePublisher::~MessagePublisher() {
  close(rcl_publisher_fini(&publisher_, node_.get()));
}

void MessagePublisher::publish(std::span<const std::byte> message) {
  rcl_serialized_message_t bytes = rmw_get_zero_initialized_serialized_message();
  bytes.buffer = reinterpret_cast<std::uint8_t*>(const_cast<std::byte*>(message.data()));  // rcl only reads it
  bytes.buffer_length = bytes.buffer_capacity = message.size();
  check(rcl_publish_serialized_message(&publisher_, &bytes, nullptr), rcl_publisher_get_topic_name(&publisher_));
}

std::size_t MessagePublisher::listeners() const {
  std::size_t count = 0;
  check(rcl_publisher_get_subscription_count(&publisher_, &count), "subscriptions");
  return count;
}

MessageSubscription::MessageSubscription(RclNode& node, const rosidl_message_type_support_t* type,
                                         const std::string& topic, const rmw_qos_profile_t& qos)
    : node_(node),
      subscription_(rcl_get_zero_initialized_subscription()),
      message_(rmw_get_zero_initialized_serialized_message()),
      last_(rmw_get_zero_initialized_message_info()) {
  rcl_subscription_options_t options = rcl_subscription_get_default_options();
  options.qos = qos;
  check(rcl_subscription_init(&subscription_, node.get(), type, topic.c_str(), &options), "topic " + topic);
  const rcl_allocator_t allocator = rcl_get_default_allocator();
  check(rmw_serialized_message_init(&message_, 0, &allocator), "topic " + topic);
}

MessageSubscription::~MessageSubscription() {
  close(rmw_serialized_message_fini(&message_));
  close(rcl_subscription_fini(&subscription_, node_.get()));
}

std::vector<std::byte> MessageSubscription::take() {
  rmw_message_info_t info = rmw_get_zero_initialized_message_info();
  const rcl_ret_t result = rcl_take_serialized_message(&subscription_, &message_, &info, nullptr);
  if (result == RCL_RET_SUBSCRIPTION_TAKE_FAILED) return {};
  check(result, rcl_subscription_get_topic_name(&subscription_));
  const std::uint64_t before = last_.publication_sequence_number, number = info.publication_sequence_number;
  const bool counted = number != RMW_MESSAGE_INFO_SEQUENCE_NUMBER_UNSUPPORTED && before > 0 && number > before &&
                       std::equal(std::begin(info.publisher_gid.data), std::end(info.publisher_gid.data),
                                  std::begin(last_.publisher_gid.data));
  lost_ = counted ? std::size_t(number - before - 1) : 0;
  last_ = info;
  const auto* begin = reinterpret_cast<const std::byte*>(message_.buffer);
  return {begin, begin + message_.buffer_length};
}

ServiceServer::ServiceServer(RclNode& node, const rosidl_service_type_support_t* type, const std::string& name)
    : node_(node), service_(rcl_get_zero_initialized_service()) {
  const rcl_service_options_t options = rcl_service_get_default_options();
  check(rcl_service_init(&service_, node.get(), type, name.c_str(), &options), "service " + name);
}

ServiceServer::~ServiceServer() {
  close(rcl_service_fini(&service_, node_.get()));
}

WaitSet::WaitSet(RclNode& node, std::size_t subscriptions, std::size_t services)
    : set_(rcl_get_zero_initialized_wait_set()) {
  check(rcl_wait_set_init(&set_, subscriptions, 0, 0, 0, services, 0, node.context(), rcl_get_default_allocator()),
        "wait set");
}

WaitSet::~WaitSet() {
  close(rcl_wait_set_fini(&set_));
}

bool WaitSet::wait(std::span<const rcl_subscription_t* const> subscriptions,
                   std::span<const rcl_service_t* const> services, std::int64_t longest) {
  check(rcl_wait_set_clear(&set_), "wait set");
  for (const rcl_subscription_t* subscription : subscriptions)
    check(rcl_wait_set_add_subscription(&set_, subscription, nullptr), "wait set");
  for (const rcl_service_t* service : services) check(rcl_wait_set_add_service(&set_, service, nullptr), "wait set");
  const rcl_ret_t result = rcl_wait(&set_, longest);
  if (result == RCL_RET_TIMEOUT) return false;
  check(result, "wait set");
  return true;
}

}  // namespace tilth::ros2
