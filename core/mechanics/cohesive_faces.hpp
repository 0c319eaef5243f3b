#pragma once
// How the two faces of a contact stand to one another, and the forces that follow from a pull and a drag between them.
// Each element carries the contact point along: c_i = x_i + q_i a_i, u = c_2 - c_1. What the normal n is makes two
// kinds:
//
//   PairFaces     n along the line of centres, u_n = l - l0: Eqs (3), (4) of the paper
//   CarriedFaces  n given when bonded (a plane's, a fibre's radius) and carried by both elements, n ~ q_1 n_1 + q_2 n_2, u_n = u.n
//
// Both are minus the gradient of U(u_n, |u_s|), u_s = u - n (u.n), whose derivatives are the pull and minus the drag.
// docs/theory/cohesive-contact.md

#include <numbers>

#include "core/mechanics/rotation.hpp"
#include "core/mechanics/wrench.hpp"

namespace beadwork {

/// The contact point as each element carries it along: body vectors from the centres, equal places when bonded.
template <class T>
struct ContactArms {
  Vec<T> arm1, arm2;  ///< [m]
};

/// Both arms to the point on the line of centres that divides d = x2 - x1 as the radii do.
inline ContactArms<Real> contact_arms(const Vec3& d, Real radius1, Real radius2, const Quat& q1, const Quat& q2) {
  const Vec3 to_point = d * (radius1 / (radius1 + radius2));
  return {rotate_back(q1, to_point), rotate_back(q2, to_point - d)};
}

/// One number for each mode: an opening, its history, a share.
template <class T>
struct Openings {
  T normal, shear;
};

// ------------------------------------------------------------------------------------------------- pair

template <class T>
struct PairFaces {
  static constexpr bool part = false;  ///< contact, as long as the centres are near

  Vec<T> normal;        ///< n = d/l, from 1 to 2
  T length;             ///< l [m]
  Vec<T> arm1, arm2;    ///< c_i - x_i, world [m]
  Vec<T> slip;          ///< u_s = u - n (u.n) [m]
  T along;              ///< u.n [m]
  Openings<T> opening;  ///< l - l0 and |u_s| [m]
};

template <class T>
[[gnu::always_inline]] inline PairFaces<T> pair_faces(Same<T> rest_length, const ContactArms<T>& arms,
                                                      const Same<Vec<T>>& d, const Quaternion<T>& q1,
                                                      const Quaternion<T>& q2) {
  const T l = sqrt(dot(d, d));
  const Vec<T> n = (T(1) / l) * d;
  const Vec<T> arm1 = rotate(q1, arms.arm1);
  const Vec<T> arm2 = rotate(q2, arms.arm2);
  const Vec<T> u = d + arm2 - arm1;
  const T along = dot(u, n);
  const Vec<T> slip = u - along * n;
  return {copy(n), l, copy(arm1), copy(arm2), copy(slip), along, {l - rest_length, sqrt(dot(slip, slip))}};
}

/// `pull` draws the faces together along n, `drag` acts on the second one against u_s. The factor 1 - u.n/l comes from
/// n, which turns with the centres; both ends' forces lie on one line, so that angular momentum is kept to
/// round-off.   (C3)
template <class T>
[[gnu::always_inline]] inline Wrench<T> wrench_of(const PairFaces<T>& at, const T& pull, const Vec<T>& drag) {
  return {(T(1) - at.along / at.length) * drag - pull * at.normal, cross(drag, at.arm1), cross(at.arm2, drag)};
}

// ---------------------------------------------------------------------------------------------- carried

/// The normal as each element carries it: unit body vectors, one direction from 1 to 2 when bonded.
template <class T>
struct CarriedNormals {
  Vec<T> normal1, normal2;
};

inline CarriedNormals<Real> carried_normals(const Vec3& normal, const Quat& q1, const Quat& q2) {
  return {rotate_back(q1, normal), rotate_back(q2, normal)};
}

template <class T>
struct CarriedFaces {
  static constexpr bool part = true;  ///< once they have slid past one another, nothing else would end their contact

  Vec<T> normal;            ///< n = (n1 + n2)/|n1 + n2|
  Vec<T> normal1, normal2;  ///< n_i, world
  T length;                 ///< |n1 + n2|: 2 when both elements have turned alike
  Vec<T> arm1, arm2;        ///< c_i - x_i, world [m]
  Vec<T> slip;              ///< u_s = u - n (u.n) [m]
  Openings<T> opening;      ///< u.n and |u_s| [m]
};

template <class T>
[[gnu::always_inline]] inline CarriedFaces<T> carried_faces(const ContactArms<T>& arms,
                                                            const CarriedNormals<T>& normals, const Same<Vec<T>>& d,
                                                            const Quaternion<T>& q1, const Quaternion<T>& q2) {
  const Vec<T> n1 = rotate(q1, normals.normal1);
  const Vec<T> n2 = rotate(q2, normals.normal2);
  const Vec<T> both = n1 + n2;
  const T length = max(sqrt(dot(both, both)), T(1e-9));  // turned upside down: parted, but still to be computed
  const Vec<T> n = (T(1) / length) * both;
  const Vec<T> arm1 = rotate(q1, arms.arm1);
  const Vec<T> arm2 = rotate(q2, arms.arm2);
  const Vec<T> u = d + arm2 - arm1;
  const T along = dot(u, n);
  const Vec<T> slip = u - along * n;
  return {copy(n), copy(n1), copy(n2), length, copy(arm1), copy(arm2), copy(slip), {along, sqrt(dot(slip, slip))}};
}

/// With t = pull n - drag between the faces:  F2 = -t,  T1 = a1 x t - n1 x g,  T2 = t x a2 - n2 x g.  The couple of
/// g = (pull u_s + u_n drag)/|n1 + n2| is the work of turning n; it makes the sum of all moments vanish.   (C4)
template <class T>
[[gnu::always_inline]] inline Wrench<T> wrench_of(const CarriedFaces<T>& at, const T& pull, const Vec<T>& drag) {
  const Vec<T> traction = pull * at.normal - drag;
  const Vec<T> g = (T(1) / at.length) * (pull * at.slip + at.opening.normal * drag);
  return {-traction, cross(at.arm1, traction) - cross(at.normal1, g), cross(traction, at.arm2) - cross(at.normal2, g)};
}

/// Whether two faces of this area [m^2] have slid by more than their diameter, and by more than `reach` [m]. A mask.
template <class T>
[[gnu::always_inline]] inline auto have_slid_past(const CarriedFaces<T>& at, Same<T> area, Same<T> reach) {
  return at.opening.shear * at.opening.shear > max(T(4 / std::numbers::pi) * area, reach * reach);
}

/// Whether one has turned by a right angle against the other. A mask.
template <class T>
[[gnu::always_inline]] inline auto have_turned_over(const CarriedFaces<T>& at) {
  return at.length * at.length < T(2);
}

}  // namespace beadwork
