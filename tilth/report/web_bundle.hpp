// The parts of our pages, the report's and the view's, that are built from web/ and stand inside the program.
#pragma once

#include <string_view>

namespace tilth {

struct WebBundle {
  std::string_view style;          ///< web/src/report.css
  std::string_view script;         ///< empty where the program was built without the libraries from npm
  std::string_view script_style;   ///< of those libraries, or of the page itself
  std::string_view script_digest;  ///< base64 of the SHA-256 of `script`, by which a browser knows it
};

WebBundle web_bundle();   ///< of report.html
WebBundle view_bundle();  ///< of the page of a live view

}  // namespace tilth
