// What a symmetric 6x6 matrix, such as the information of a pose, says along its own directions.
#pragma once

#include <tilth/core/se3.hpp>

namespace tilth {

struct Eigen6d {
  Vector6d values;   ///< ascending
  Matrix6d vectors;  ///< a column each, of length 1
};

/// Of the matrix's lower half.
Eigen6d eigen_of(const Matrix6d& symmetric);

}  // namespace tilth
