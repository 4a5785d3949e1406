// Symmetric 3 x 3 matrices, second moments and covariances, as six numbers.
#pragma once

#include <Eigen/Core>

namespace tilth {

template <class Scalar>
struct Symmetric3 {
  using Matrix = Eigen::Matrix<Scalar, 3, 3>;
  using Vector = Eigen::Matrix<Scalar, 3, 1>;
  using Entries = Eigen::Matrix<Scalar, 6, 1>;

  Entries entries = Entries::Zero();  ///< xx, yy, zz, xy, yz, xz

  /// Of which only the upper half is read.
  static Symmetric3 of(const Matrix& m) { return {{m(0, 0), m(1, 1), m(2, 2), m(0, 1), m(1, 2), m(0, 2)}}; }

  /// a b^T of parallel vectors.
  static Symmetric3 product(const Vector& a, const Vector& b) {
    return {{a.x() * b.x(), a.y() * b.y(), a.z() * b.z(), a.x() * b.y(), a.y() * b.z(), a.x() * b.z()}};
  }

  Matrix matrix() const {
    const Entries& e = entries;
    Matrix m;
    m << e[0], e[3], e[5], e[3], e[1], e[4], e[5], e[4], e[2];
    return m;
  }

  /// n^T * this * n: the variance along a unit vector.
  Scalar along(const Vector& n) const {
    const Entries& e = entries;
    return e[0] * n.x() * n.x() + e[1] * n.y() * n.y() + e[2] * n.z() * n.z() +
           2 * (e[3] * n.x() * n.y() + e[4] * n.y() * n.z() + e[5] * n.z() * n.x());
  }

  Symmetric3& operator+=(const Symmetric3& other) {
    entries += other.entries;
    return *this;
  }
  friend Symmetric3 operator+(const Symmetric3& a, const Symmetric3& b) { return {a.entries + b.entries}; }
  friend Symmetric3 operator-(const Symmetric3& a, const Symmetric3& b) { return {a.entries - b.entries}; }
  friend Symmetric3 operator*(Scalar factor, const Symmetric3& m) { return {factor * m.entries}; }
  friend Symmetric3 operator/(const Symmetric3& m, Scalar divisor) { return {m.entries / divisor}; }
};

using Symmetric3d = Symmetric3<double>;
using Symmetric3f = Symmetric3<float>;

/// R C R^T of a symmetric matrix: 45 products instead of 54, and symmetric to the last bit.
inline Symmetric3d rotated(const Eigen::Matrix3d& R, const Eigen::Matrix3d& C) {
  const Eigen::Matrix3d RC = R * C;
  const auto entry = [&](int i, int j) { return RC(i, 0) * R(j, 0) + RC(i, 1) * R(j, 1) + RC(i, 2) * R(j, 2); };
  return {{entry(0, 0), entry(1, 1), entry(2, 2), entry(0, 1), entry(1, 2), entry(0, 2)}};
}

}  // namespace tilth
