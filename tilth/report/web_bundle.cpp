#include <tilth/report/web_bundle.hpp>

// The assembler takes the files in as they are; the build names them.
#define TILTH_EMBED(name, file)                                                                                     \
  asm(".pushsection .rodata\n.hidden tilth_web_" #name "\n.global tilth_web_" #name "\ntilth_web_" #name            \
      ":\n.incbin \"" file "\"\n.hidden tilth_web_" #name "_end\n.global tilth_web_" #name "_end\ntilth_web_" #name \
      "_end:\n.byte 0\n.popsection\n");                                                                             \
  extern "C" {                                                                                                      \
  [[gnu::visibility("hidden")]] extern const char tilth_web_##name[];                                               \
  [[gnu::visibility("hidden")]] extern const char tilth_web_##name##_end[];                                         \
  }

TILTH_EMBED(style, TILTH_WEB_SOURCE "/report.css")
TILTH_EMBED(script, TILTH_WEB_BUILD "/report.js")
TILTH_EMBED(script_style, TILTH_WEB_BUILD "/report.css")
TILTH_EMBED(script_digest, TILTH_WEB_BUILD "/report.sha256")
TILTH_EMBED(view_script, TILTH_WEB_BUILD "/view.js")
TILTH_EMBED(view_style, TILTH_WEB_BUILD "/view.css")
TILTH_EMBED(view_digest, TILTH_WEB_BUILD "/view.sha256")

namespace tilth {

WebBundle web_bundle() {
  return {{tilth_web_style, tilth_web_style_end},
          {tilth_web_script, tilth_web_script_end},
          {tilth_web_script_style, tilth_web_script_style_end},
          {tilth_web_script_digest, tilth_web_script_digest_end}};
}

WebBundle view_bundle() {
  return {{tilth_web_style, tilth_web_style_end},
          {tilth_web_view_script, tilth_web_view_script_end},
          {tilth_web_view_style, tilth_web_view_style_end},
          {tilth_web_view_digest, tilth_web_view_digest_end}};
}

}  // namespace tilth
