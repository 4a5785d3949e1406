// The page of a live view: one file that needs nothing from elsewhere, and asks for nothing but its own WebSocket.
#pragma once

#include <string>

namespace tilth {

std::string view_page();         ///< HTML
std::string view_page_policy();  ///< its Content-Security-Policy: only its own script, only its own server

}  // namespace tilth
