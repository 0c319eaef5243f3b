#pragma once
// Random states of two bonded elements, and derivatives by central differences.

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>

#include "core/base/random.hpp"
#include "core/mechanics/rotation.hpp"
#include "core/mechanics/stability.hpp"

namespace beadwork::test {

inline Vec3 random_vector(Random& random, Real deviation) {
  const Real x = random.normal(), y = random.normal(),
             z = random.normal();  // compilers order arguments differently
  return Vec3(x, y, z) * deviation;
}

inline Quat random_rotation(Random& random) {
  return normalise(Quat{random.normal(), random_vector(random, 1)});  // braces: from left to right
}

/// Two elements in space.
struct Pair {
  Vec3 x1, x2;
  Quat q1, q2;
  Vec3 d() const { return x2 - x1; }
};

/// The pair after a small change of the twelve coordinates (x1, theta1, x2, theta2), turns seen from the
/// world.
using Vector12 = Eigen::Matrix<Real, 12, 1>;
inline Pair moved(const Pair& p, const Vector12& by) {
  return {p.x1 + Vec3(by.segment<3>(0)), p.x2 + Vec3(by.segment<3>(6)), exp_map(by.segment<3>(3)) * p.q1,
          exp_map(by.segment<3>(9)) * p.q2};
}

/// The pair after a rigid motion.
inline Pair moved_rigidly(const Pair& p, const Quat& turn, const Vec3& shift) {
  return {rotate(turn, p.x1) + shift, rotate(turn, p.x2) + shift, turn * p.q1, turn * p.q2};
}

/// d(f)/d(twelve coordinates), of fourth order.
template <class F>
Vector12 gradient(const F& f, const Pair& p, Real step = 1e-3) {
  Vector12 g;
  for (int i = 0; i < 12; ++i) {
    const auto at = [&](Real k) { return f(moved(p, Vector12::Unit(i) * (k * step))); };
    g[i] = (8 * (at(1) - at(-1)) - (at(2) - at(-2))) / (12 * step);
  }
  return g;
}

/// d(g)/d(twelve coordinates) of twelve functions.
template <class G>
Eigen::Matrix<Real, 12, 12> jacobian(const G& g, const Pair& p, Real step = 1e-3) {
  Eigen::Matrix<Real, 12, 12> j;
  for (int i = 0; i < 12; ++i) {
    const auto at = [&](Real k) -> Vector12 { return g(moved(p, Vector12::Unit(i) * (k * step))); };
    j.col(i) = (8 * (at(1) - at(-1)) - (at(2) - at(-2))) / (12 * step);
  }
  return j;
}

/// Forces and torques of a wrench in the order of the coordinates.
template <class W>
Vector12 generalised(const W& w) {
  Vector12 f;
  f << -w.force, w.torque1, w.force, w.torque2;
  return f;
}

inline void add_bond(ElasticNetwork& network, Index first, Index second, const Matrix12& stiffness) {
  network.resize(network.bonds() + 1);
  network.set(network.bonds() - 1, first, second, stiffness);
}

/// The largest eigenvalue of one bond alone, with the given inverse masses of its twelve motions.
inline Real bond_lambda(const Matrix12& stiffness, const Vector12& inverse_mass) {
  const Vector12 root = inverse_mass.cwiseSqrt();
  const Eigen::SelfAdjointEigenSolver<Matrix12> solver(root.asDiagonal() * stiffness * root.asDiagonal(),
                                                       Eigen::EigenvaluesOnly);
  return std::max(Real(0), solver.eigenvalues()[11]);
}

/// The full matrix of a rotation in the twelve coordinates.
inline Eigen::Matrix<Real, 12, 12> in_blocks(const Quat& turn) {
  Eigen::Matrix<Real, 12, 12> r = Eigen::Matrix<Real, 12, 12>::Zero();
  for (int b = 0; b < 4; ++b) r.block<3, 3>(3 * b, 3 * b) = rotation_matrix(turn);
  return r;
}

}  // namespace beadwork::test
