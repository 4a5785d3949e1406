// The messages of Foxglove's WebSocket protocol (github.com/foxglove/ws-protocol, version 1) that a view needs: texts
// in JSON both ways, and binary messages to the client. Nothing here knows of sockets.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <tilth/messages/ros2_definitions.hpp>

namespace tilth {

/// The sub-protocols that are spoken, which have the same messages: that of the SDK, and the one before it.
inline constexpr std::string_view kFoxgloveProtocols[] = {"foxglove.sdk.v1", "foxglove.websocket.v1"};

/// The one of them that stands first in a list "a, b"; empty where there is none.
std::string_view chosen_protocol(std::string_view offered);

struct ViewChannel {
  std::uint32_t id = 0;
  std::string topic;
  Ros2Type type;
};

std::string server_info(const std::string& name, const std::string& session);
std::string advertisement(std::span<const ViewChannel> channels);

enum class StatusLevel : std::uint8_t { info, warning, error };
std::string status(StatusLevel level, const std::string& message);

/// The head of a binary message with data: 13 bytes, behind which comes the message itself.
std::string message_head(std::uint32_t subscription, std::uint64_t nanoseconds);

/// What a client asks for in a text.
struct ClientRequest {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> subscribe;  ///< subscription, channel
  std::vector<std::uint32_t> unsubscribe;                          ///< subscriptions
};

/// Throws Error naming what is wrong with the text, or the operation that is not offered.
ClientRequest parse_request(std::string_view text);

}  // namespace tilth
