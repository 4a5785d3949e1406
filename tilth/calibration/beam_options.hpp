// How the errors of beams are estimated.
#pragma once

#include <tilth/core/options.hpp>

namespace tilth {

struct BeamCalibrationOptions {
  double sigma_range = 0.02;      ///< [m]
  double sigma_elevation = 0.15;  ///< [deg]
  double sigma_walk = 0.02;       ///< [m]
  double sigma_encoder = 0.03;    ///< [deg]
  double step = 0.4;              ///< [m]
  int window = 12;                ///< keyframes
  int returns = 8000;             ///< of a keyframe
  int most_windows = 120;
  int iterations = 5;
  double cell = 0.6;         ///< [m]
  double block = 2.5;        ///< [m]
  double flat = 0.05;        ///< [m]
  double noise = 0.03;       ///< [m]
  double floor = 0.005;      ///< [m]
  double kernel = 3.0;       ///< [-]
  double doubt = 0.25;       ///< [-]
  double model_error = 0.7;  ///< [-]
  double significance = 2;   ///< [-]
};

template <class V>
void visit(BeamCalibrationOptions& o, V&& v) {
  v("sigma_range", o.sigma_range, Bounds{1e-6, 1},
    "[m] standard deviation of a beam's range error, before anything is seen");
  v("sigma_elevation", o.sigma_elevation, Bounds{1e-6, 5}, "[deg] the same of its elevation");
  v("sigma_walk", o.sigma_walk, Bounds{1e-6, 1}, "[m] the same of what dim returns read long");
  v("sigma_encoder", o.sigma_encoder, Bounds{1e-6, 5}, "[deg] the same of each harmonic of the encoder");
  v("step", o.step, Bounds{0.01, 100}, "[m] of path from one keyframe to the next");
  v("window", o.window, Bounds{5, 200}, "[keyframes] that are adjusted together");
  v("returns", o.returns, Bounds{100, 1e6},
    "[means of successive returns] of a keyframe, of every ring the same share");
  v("most_windows", o.most_windows, Bounds{2, 1e6}, "[windows] that are used, evenly chosen of all");
  v("iterations", o.iterations, Bounds{1, 50}, "[-] of Gauss-Newton");
  v("cell", o.cell, Bounds{0.05, 10}, "[m] edge of the cells of surface", kAdvanced);
  v("block", o.block, Bounds{0.05, 100}, "[m] within which cells that face alike share their normal", kAdvanced);
  v("flat", o.flat, Bounds{0.001, 1}, "[m] deviation from its plane up to which a cell counts as flat", kAdvanced);
  v("noise", o.noise, Bounds{0.001, 1}, "[m] standard deviation of a range", kAdvanced);
  v("floor", o.floor, Bounds{1e-4, 1}, "[m] what a surface departs from its plane, however many points tell",
    kAdvanced);
  v("kernel", o.kernel, Bounds{0.5, 100}, "[-] deviations at which the Geman-McClure kernel turns down", kAdvanced);
  v("doubt", o.doubt, Bounds{0, 1}, "[-] sine of incidence below which a normal tells nothing of angles", kAdvanced);
  v("model_error", o.model_error, Bounds{0, 100},
    "[-] gradient of a window, in units of the prior, that surfaces feign which are not as flat as they are taken for",
    kAdvanced);
  v("significance", o.significance, Bounds{0, 10}, "[-] own deviations beyond which an error is believed");
}

}  // namespace tilth
