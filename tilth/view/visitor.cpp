#include <algorithm>

#include <tilth/view/visitor.hpp>

namespace tilth {
namespace {

/// "127.0.0.1" of "127.0.0.1:8765", "[::1]" of "[::1]:8765".
std::string_view without_port(std::string_view host) {
  if (host.starts_with('[')) return host.substr(0, host.find(']') + 1);
  return host.substr(0, host.find(':'));
}

/// A name may be turned to any address by whoever owns it; an address may not.
bool is_address(std::string_view host) {
  if (host.starts_with('[')) return true;
  return !host.empty() &&
         std::all_of(host.begin(), host.end(), [](char c) { return c == '.' || (c >= '0' && c <= '9'); });
}

}  // namespace

bool may_visit(std::string_view origin, std::string_view host) {
  if (origin.empty()) return true;
  const std::size_t colon = origin.find("://");
  if (colon == std::string_view::npos) return false;
  const std::string_view scheme = origin.substr(0, colon), page = without_port(origin.substr(colon + 3));
  if (scheme != "http" && scheme != "https") return true;
  if (page == "localhost" || page == "127.0.0.1" || page == "[::1]") return true;
  if (scheme == "https" && (page == "foxglove.dev" || page.ends_with(".foxglove.dev"))) return true;
  return is_address(page) && page == without_port(host);
}

}  // namespace tilth
