#include <tilth/plot/svg_style.hpp>

namespace tilth {

std::string_view svg_style() {
  return R"(
.paper { fill: #fff }
text { font: 12px Helvetica, Arial, sans-serif; fill: #333 }
.title { font-size: 14px; font-weight: bold; fill: #111 }
.middle { text-anchor: middle } .end { text-anchor: end }
.grid { stroke: #e4e4e4; stroke-width: 1 }
.frame { fill: none; stroke: #888; stroke-width: 1 }
.curve { fill: none; stroke-width: 1.5; stroke-linejoin: round }
.shaded { stroke-width: 4; stroke-linecap: round }
.s0 { stroke: #0072b2; fill: #0072b2 } .s1 { stroke: #d55e00; fill: #d55e00 } .s2 { stroke: #009e73; fill: #009e73 }
.s3 { stroke: #cc79a7; fill: #cc79a7 } .s4 { stroke: #e69f00; fill: #e69f00 } .s5 { stroke: #56b4e9; fill: #56b4e9 }
.s6 { stroke: #7a6a4f; fill: #7a6a4f } .s7 { stroke: #666; fill: #666 }
.curve.s0, .curve.s1, .curve.s2, .curve.s3, .curve.s4, .curve.s5, .curve.s6, .curve.s7 { fill: none }
.truth { stroke: #b4b0a6; stroke-width: 3.5 }
.band { fill: #0072b2; fill-opacity: 0.12 } .bandline { stroke: #0072b2; stroke-opacity: 0.3; stroke-width: 9 }
.alarm { fill: #d32f2f; fill-opacity: 0.16 } .alarmline { stroke: #d32f2f; stroke-opacity: 0.35; stroke-width: 9 }
.mark { stroke-width: 1.2 } .m0 { stroke: #d55e00 } .m1 { stroke: #009e73; stroke-dasharray: 6 3 }
.m2 { stroke: #333; stroke-dasharray: 2 3 } .m3 { stroke: #cc79a7; stroke-dasharray: 8 3 2 3 }
.box { fill-opacity: 0.35; stroke-width: 1 } .bar { fill-opacity: 0.75; stroke-width: 0.5 }
.whisker { stroke: #444; stroke-width: 1 } .median { stroke: #111; stroke-width: 2 }
.cell { stroke: #fff } .value { fill: #222 } .light { fill: #fff }
.link { stroke: #c2185b; stroke-width: 1.2 } .landmark { fill: #333 }
.landmarks { stroke: #333; stroke-width: 4; stroke-linecap: round; stroke-dasharray: 0.1 6.5 }
.mean { fill: #fff; stroke: #111; stroke-width: 1 } .start { fill: #111 }
)";
}

}  // namespace tilth
