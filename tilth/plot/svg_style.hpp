// The sheet of the plots that stand in files of their own: black on white, eight colours that colour-blind people tell
// apart (after Okabe and Ito, 2008).
#pragma once

#include <string_view>

namespace tilth {

std::string_view svg_style();

}  // namespace tilth
