// What a recording holds, whatever its format: messages as bytes, each of one connection (topic and type).
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace tilth {

struct Connection {
  std::uint32_t id = 0;
  std::string topic, type;
  std::string md5;                ///< of the type, as ROS 1 computes it
  std::string definition;         ///< of the message type, as text
  std::uint64_t messages = 0;     ///< found in the recording
  std::string encoding = "ros1";  ///< of the messages: "ros1", "cdr" or what the recording calls it
};

struct Message {
  std::uint32_t connection = 0;  ///< Connection::id
  std::uint64_t stamp = 0;       ///< [ns] since 1970, when it was recorded (the sensor's own stamp is in the bytes)
  std::vector<std::byte> bytes;  ///< serialised as the connection's type says
};

}  // namespace tilth
