#pragma once
// How two that may touch lie to one another: spheres, or a sphere and a facet of a rigid wall.   docs/theory/contact.md

#include "core/bonds/ends.hpp"
#include "core/domain/nearest.hpp"
#include "core/mechanics/dual.hpp"

namespace beadwork {

struct MeetingColumns {
  View<const Real> length, share;  ///< distance below which they touch; radius of the first over the sum of both
  View<const Real> facet;          ///< of a wall
  FacetViews facets;
};

/// The contact divides the line of centres as the radii do.
struct OfSpheres {
  static constexpr bool turns = false;  // by itself: only friction sees it

  template <class T>
  struct Touch {
    Vec<T> n;             ///< from the first to the second
    T delta, arm1, arm2;  ///< overlap; from the centres to the contact [m]

    /// Of the second past the first [m/s].
    template <class Ends>
    [[gnu::always_inline]] Vec<T> rate(const Ends& ends, Real /*half_step*/) const {
      return ends.v2 - ends.v1;
    }
    /// Of the rate, what slides at the contact [m/s].
    template <class Ends>
    [[gnu::always_inline]] Vec<T> slide(const Ends& ends, const Vec<T>& rate, const T& v_n) const {
      const Vec<T> across = rate - v_n * n;
      return across - cross(arm1 * ends.w1 + arm2 * ends.w2, n);
    }
    /// Of a push along n and what drags across it.
    [[gnu::always_inline]] Wrench<T> wrench(const Vec<T>& force, const Vec<T>& drag) const {
      const Vec<T> moment = cross(drag, n);
      return {copy(force), arm1 * moment, arm2 * moment};
    }
    [[gnu::always_inline]] Wrench<T> wrench(const Vec<T>& force) const {
      const Vec<T> none = zero<Vec<T>>();
      return {copy(force), none, none};
    }
    /// From the centres to the contact.
    std::array<Vec3, 2> arms() const requires std::is_same_v<T, Real> { return {arm1 * n, -arm2 * n}; }
  };

  template <class At, class Ends>
  [[gnu::always_inline]] static auto find(const MeetingColumns& c, const At& at, const Ends& ends) {
    using T = typename At::Number;
    const T l = sqrt(dot(ends.apart, ends.apart)), arm1 = l * at(c.share);
    return Touch<T>{(T(1) / l) * ends.apart, max(T(0), at(c.length) - l), arm1, l - arm1};
  }
  template <class At, class Ends>
  [[gnu::always_inline]] static auto overlap(const MeetingColumns& c, const At& at, const Ends& ends) {
    using T = typename At::Number;
    return max(T(0), at(c.length) - sqrt(dot(ends.apart, ends.apart)));
  }
  /// Distance of two centres that touch, both as small as the smaller [m].
  static Real shortest(const MeetingColumns& c, const One& at) {
    return 2 * at(c.length) * min(at(c.share), 1 - at(c.share));
  }
};

/// The second is a wall, which does not give: the contact lies on it. `turning`: the wall may turn, and feels torques.
template <bool turning>
struct WithWall {
  static constexpr bool turns = turning;

  template <class T>
  struct Touch {
    Vec<T> n;           ///< from the sphere to the wall
    T delta;            ///< overlap [m]
    Vec<T> arm1, arm2;  ///< from the centre of the sphere, and from the place of the wall, to the contact [m]

    /// Velocities are those of half a step ago [s]: so is the arm by which the wall turns, lest what rides on it creeps
    /// inwards.
    template <class Ends>
    Vec<T> rate(const Ends& ends, Real half_step) const {
      if constexpr (requires { ends.w2; })
        return ends.v2 + cross(ends.w2, Vec<T>(arm2 - T(half_step) * cross(ends.w2, arm2))) - ends.v1;
      else
        return ends.v2 - ends.v1;
    }
    template <class Ends>
    Vec<T> slide(const Ends& ends, const Vec<T>& rate, const T& v_n) const {
      return rate - v_n * n - cross(ends.w1, arm1);
    }
    /// What drags is in the force already, and acts at the contact as the push does.
    Wrench<T> wrench(const Vec<T>& force, const Vec<T>& /*drag*/ = zero<Vec<T>>()) const {
      return {copy(force), copy(Vec<T>(cross(force, arm1))), copy(Vec<T>(cross(arm2, force)))};
    }
    std::array<Vec3, 2> arms() const requires std::is_same_v<T, Real> { return {arm1, arm2}; }
  };

  template <class At, class Ends>
  static auto find(const MeetingColumns& c, const At& at, const Ends& ends) {
    using T = typename At::Number;
    Vec<T> place = -ends.apart;
    if constexpr (requires { ends.q2; }) place = rotate_back(ends.q2, place);
    const Seen<T> seen = see<T>(c, at(c.facet), at(c.length), place);
    Vec<T> out = seen.normal;
    if constexpr (requires { ends.q2; }) out = rotate(ends.q2, out);
    const Vec<T> arm1 = -seen.distance * out;
    return Touch<T>{Vec<T>(-out), seen.overlap, copy(arm1), Vec<T>(arm1 - ends.apart)};
  }
  template <class At, class Ends>
  static auto overlap(const MeetingColumns& c, const At& at, const Ends& ends) {
    return find(c, at, ends).delta;
  }
  static Real shortest(const MeetingColumns& c, const One& at) { return at(c.length); }

 private:
  template <class T>
  struct Seen {
    Vec<T> normal;
    T distance, overlap;
  };
  static Index number(Real facet) { return static_cast<Index>(facet); }
  template <int N>
  static Index number(const Dual<N>& facet) {
    return number(facet.value);
  }

  // Lane by lane: which part of a wall is near decides what is to be computed. What touches walls is the skin of a
  // packing, not its inside.
  template <class T>
  static Seen<T> see(const MeetingColumns& c, const T& facet, const T& length, const Vec<T>& place) {
    if constexpr (requires { T::width; }) {
      Seen<T> all;
      for (int k = 0; k < T::width; ++k) {
        const Seen<Real> one = see<Real>(c, facet.v[k], length.v[k], {place[0].v[k], place[1].v[k], place[2].v[k]});
        for (int a = 0; a < 3; ++a) all.normal[a].v[k] = one.normal[a];
        all.distance.v[k] = one.distance;
        all.overlap.v[k] = one.overlap;
      }
      return all;
    } else {
      const Nearest<T> found = nearest<T>(c.facets, number(facet), place);
      return {found.normal, found.distance, found.meets ? max(T(0), length - found.distance) : T(0)};
    }
  }
};

}  // namespace beadwork
