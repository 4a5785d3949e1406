// How well the registration of a submap determines a pose: no better than patches that err alike allow, and not at all
// along directions that the surfaces leave open. O(patches).
#pragma once

#include <tilth/core/surface_patch.hpp>

namespace tilth {

/// What InformationOptions bound: see VerifyOptions, whose fields of the same names these are.
struct InformationOptions {
  double degeneracy_ratio = 0.0, noise = 0.0, variance_scale = 0.0;
};

struct SubmapInformation {
  Matrix6d information = Matrix6d::Zero();  ///< [1/rad^2, 1/m^2] in the frame of the source; none where degenerate
  int degenerate_directions = 0;
};

/// `information` of a registration of `source`, as it may be believed.
SubmapInformation weighed_information(const Matrix6d& information, const SurfacePatches& source,
                                      const InformationOptions& options);

/// The direction of translation that is determined least, in the frame of the source.
Eigen::Vector3d weakest_axis(const Matrix6d& information);

}  // namespace tilth
