#include <algorithm>

#include <nlohmann/json.hpp>

#include <tilth/core/error.hpp>
#include <tilth/view/foxglove.hpp>

namespace tilth {
namespace {

using Json = nlohmann::json;

constexpr const char* kWhere = "message";
constexpr std::size_t kMostEntries = 1000;
constexpr char kMessageData = 1;

/// The list `key` of the request.
const Json& list_of(const Json& request, const char* key) {
  const auto it = request.find(key);
  if (it == request.end() || !it->is_array()) throw Error(kWhere, std::string("has no list ") + key);
  if (it->size() > kMostEntries) throw Error(kWhere, std::string(key) + " has more than 1000 entries");
  return *it;
}

std::uint32_t id_of(const Json& value, const char* name) {
  if (!value.is_number_unsigned() || value.get<std::uint64_t>() > UINT32_MAX)
    throw Error(kWhere, std::string(name) + " is no number of 32 bits");
  return value.get<std::uint32_t>();
}

std::uint32_t member(const Json& entry, const char* name) {
  const auto it = entry.is_object() ? entry.find(name) : entry.end();
  if (it == entry.end()) throw Error(kWhere, std::string("an entry has no ") + name);
  return id_of(*it, name);
}

void append_little_endian(std::string& bytes, std::uint64_t value, int size) {
  for (int i = 0; i < size; ++i) bytes.push_back(char(value >> (8 * i) & 0xFF));
}

std::string text_of(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t");
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t") + 1 - begin);
}

}  // namespace

std::string_view chosen_protocol(std::string_view offered) {
  for (std::size_t begin = 0; begin <= offered.size();) {
    const std::size_t end = std::min(offered.find(',', begin), offered.size());
    const std::string_view name = trimmed(offered.substr(begin, end - begin));
    for (const std::string_view known : kFoxgloveProtocols) {
      if (name == known) return known;
    }
    begin = end + 1;
  }
  return {};
}

std::string server_info(const std::string& name, const std::string& session) {
  return text_of({{"op", "serverInfo"},
                  {"name", name},
                  {"capabilities", Json::array()},
                  {"supportedEncodings", Json::array()},
                  {"metadata", Json::object()},
                  {"sessionId", session}});
}

std::string advertisement(std::span<const ViewChannel> channels) {
  Json list = Json::array();
  for (const ViewChannel& channel : channels) {
    list.push_back({{"id", channel.id},
                    {"topic", channel.topic},
                    {"encoding", "cdr"},
                    {"schemaName", channel.type.name},
                    {"schema", channel.type.definition},
                    {"schemaEncoding", "ros2msg"}});
  }
  return text_of({{"op", "advertise"}, {"channels", std::move(list)}});
}

std::string status(StatusLevel level, const std::string& message) {
  return text_of({{"op", "status"}, {"level", int(level)}, {"message", message}});
}

std::string message_head(std::uint32_t subscription, std::uint64_t nanoseconds) {
  std::string head{kMessageData};
  append_little_endian(head, subscription, 4);
  append_little_endian(head, nanoseconds, 8);
  return head;
}

ClientRequest parse_request(std::string_view text) {
  const Json request = Json::parse(text, nullptr, false);
  if (!request.is_object()) throw Error(kWhere, "is no object in JSON");
  const auto op = request.find("op");
  if (op == request.end() || !op->is_string()) throw Error(kWhere, "names no operation (op)");
  ClientRequest asked;
  if (*op == "subscribe") {
    for (const Json& entry : list_of(request, "subscriptions"))
      asked.subscribe.emplace_back(member(entry, "id"), member(entry, "channelId"));
  } else if (*op == "unsubscribe") {
    for (const Json& id : list_of(request, "subscriptionIds")) asked.unsubscribe.push_back(id_of(id, "a subscription"));
  } else {
    throw Error(kWhere, "asks for \"" + op->get<std::string>().substr(0, 40) + "\", which this server does not offer");
  }
  return asked;
}

}  // namespace tilth
