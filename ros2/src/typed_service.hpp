// A service whose request and response are structs that rosidl made.
#pragma once

#include <functional>
#include <rosidl_runtime_c/string_functions.h>
#include <utility>

#include "rcl_handles.hpp"

/// NAME ## Service: what TypedService is to know of PACKAGE/srv/NAME, whose header must have been included.
#define TILTH_ROS2_SERVICE(PACKAGE, NAME)                                                 \
  struct NAME##Service {                                                                  \
    using Request = PACKAGE##__srv__##NAME##_Request;                                     \
    using Response = PACKAGE##__srv__##NAME##_Response;                                   \
    static bool init(Request& r) { return PACKAGE##__srv__##NAME##_Request__init(&r); }   \
    static bool init(Response& r) { return PACKAGE##__srv__##NAME##_Response__init(&r); } \
    static void fini(Request& r) { PACKAGE##__srv__##NAME##_Request__fini(&r); }          \
    static void fini(Response& r) { PACKAGE##__srv__##NAME##_Response__fini(&r); }        \
    static auto type() { return ROSIDL_GET_SRV_TYPE_SUPPORT(PACKAGE, srv, NAME); }        \
  }

namespace tilth::ros2 {

inline void assign(rosidl_runtime_c__String& to, const std::string& text) {
  rosidl_runtime_c__String__assign(&to, text.c_str());
}

/// A struct of rosidl that is closed when it goes.
template <class Service, class T>
struct Owned {
  Owned() { Service::init(value); }
  ~Owned() { Service::fini(value); }
  Owned(const Owned&) = delete;
  Owned& operator=(const Owned&) = delete;
  T value{};
};

template <class Service>
class TypedService final : public ServiceServer {
 public:
  using Handler = std::function<void(const typename Service::Request&, typename Service::Response&)>;

  TypedService(RclNode& node, const std::string& name, Handler handler)
      : ServiceServer(node, Service::type(), name), handler_(std::move(handler)) {}

  void answer() override {
    Owned<Service, typename Service::Request> request;
    Owned<Service, typename Service::Response> response;
    rmw_request_id_t id;
    const rcl_ret_t taken = rcl_take_request(&service_, &id, &request.value);
    if (taken == RCL_RET_SERVICE_TAKE_FAILED) return;
    check(taken, rcl_service_get_service_name(&service_));
    handler_(request.value, response.value);
    check(rcl_send_response(&service_, &id, &response.value), rcl_service_get_service_name(&service_));
  }

 private:
  Handler handler_;
};

}  // namespace tilth::ros2
