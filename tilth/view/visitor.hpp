// Which web pages may look: a browser lets any page of the world open a WebSocket to this machine, and says which one
// it is (Origin; RFC 6455, 10.2).
#pragma once

#include <string_view>

namespace tilth {

/// `origin` and `host` as the headers have them. Welcome are programs (no origin, or one that is none of the web),
/// pages of this machine by name or loopback address, pages of the address that was asked itself, and the application
/// of foxglove.dev; no others, and none without a name ("null").
bool may_visit(std::string_view origin, std::string_view host);

}  // namespace tilth
