#include <tilth/report/web_bundle.hpp>
#include <tilth/view/view_page.hpp>

namespace tilth {
namespace {

constexpr const char* kMissing =
    "<p class=\"missing\">This program was built without the libraries of its page (scripts/setup). Foxglove shows the "
    "run: "
    "open a connection to the WebSocket at this address.</p>";

}  // namespace

std::string view_page() {
  const WebBundle bundle = view_bundle();
  std::string page =
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<title>Tilth, live</title>\n";
  page += "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n";
  page += "<link rel=\"icon\" href=\"data:,\">\n";
  page.append("<style>").append(bundle.style).append(bundle.script_style).append("</style>\n</head>\n<body>\n");
  if (bundle.script.empty()) return page + kMissing + "\n</body>\n</html>\n";
  page += "<noscript><p class=\"missing\">The live view needs JavaScript.</p></noscript>\n";
  page.append("<script>").append(bundle.script).append("</script>\n</body>\n</html>\n");
  return page;
}

std::string view_page_policy() {
  const WebBundle bundle = view_bundle();
  const std::string scripts = bundle.script.empty() ? "'none'" : "'sha256-" + std::string(bundle.script_digest) + "'";
  return "default-src 'none'; script-src " + scripts +
         "; style-src 'unsafe-inline'; img-src data:; connect-src 'self'; base-uri 'none'; form-action 'none'; "
         "frame-ancestors 'none'";
}

}  // namespace tilth
