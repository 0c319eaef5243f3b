#pragma once
// Numbers and small vectors. Columns store unaligned types, so that libraries built with other vector flags agree
// on the layout of what they share.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>

namespace beadwork {

using Real = double;
using Index = std::int32_t;  ///< row of a table; offsets in bytes are formed in std::size_t

template <class T>
using Vec = Eigen::Matrix<T, 3, 1, Eigen::DontAlign>;
template <class T>
using Mat = Eigen::Matrix<T, 3, 3, Eigen::DontAlign>;

using Vec3 = Vec<Real>;
using Mat3 = Mat<Real>;

/// Unit quaternion, scalar part first, taking body vectors to the world.
template <class T>
struct Quaternion {
  T w;
  Vec<T> v;
};
using Quat = Quaternion<Real>;

/// Symmetric tensor, by rows of its upper half.
template <class T>
struct Symmetric {
  T xx, xy, xz, yy, yz, zz;
};
using Sym3 = Symmetric<Real>;

/// Eigen leaves `Vec3{}` uninitialised; this is what zero means for every type a column can hold.
template <class T>
T zero() {
  if constexpr (requires { T::Zero(); })
    return T::Zero();
  else
    return T{};
}

template <class T = Real>
Quaternion<T> identity() {
  return {T(1), Vec<T>(T(0), T(0), T(0))};
}

}  // namespace beadwork
