// The options of `tilth calibrate` beside those of its pipeline: calibration.KEY.
#pragma once

#include <tilth/calibration/beam_options.hpp>

namespace tilth::app {

struct CalibrationOptions {
  BeamCalibrationOptions calibration;
};

template <class V>
void visit(CalibrationOptions& o, V&& v) {
  v("calibration", o.calibration, "[-] errors of the beams");
}

/// Those of `values`, which are taken out of it. Throws Error on a key that is not known or a value out of bounds.
inline CalibrationOptions take_calibration_options(OptionValues& values) {
  OptionValues own;
  for (auto it = values.begin(); it != values.end();) {
    const auto here = it++;
    if (here->first.starts_with("calibration.")) own.insert(values.extract(here));
  }
  return with<CalibrationOptions>(std::move(own));
}

}  // namespace tilth::app
