#pragma once
// Cundall's damping: F -= alpha |F| sgn(v), component by component, where nothing prescribes the motion.

#include "core/domain/rows.hpp"
#include "core/dynamics/grips.hpp"
#include "core/dynamics/motion.hpp"
#include "core/mechanics/lane.hpp"

namespace beadwork {

template <class T>
struct Damped {
  Vec<T> load;
  T power;  ///< that the damping takes [W]
};

/// `half` times load times `inverse` is what the velocity still gains in this step: the power is that at full time.
template <class T>
[[gnu::always_inline]] inline Damped<T> damp_locally(const Vec<T>& load, const Vec<T>& rate, const T& inverse,
                                                     Real share, Real half, unsigned held = 0) {
  Damped<T> out{load, T(0)};
  for (int axis = 0; axis < 3; ++axis) {
    if (held >> axis & 1) continue;
    const T f = load[axis], v = rate[axis];
    const T size = select(f < T(0), -f, f);
    const T sense = select(v > T(0), T(1), select(v < T(0), T(-1), T(0)));
    const T d = (T(-share) * size) * sense;
    out.load[axis] = f + d;
    out.power = out.power - d * (v + T(half) * inverse * out.load[axis]);
  }
  return out;
}

/// Damps all loads; the power that it takes [W].
inline Real damp_locally(const Motion& all, const Grips& grips, Real share, Real half) {
  return rows::sum(all.count, [=, &grips]<class At>(const At& at) {
    using T = typename At::Number;
    const auto both = [&]<class Row>(const Row& row, unsigned held) {
      using N = typename Row::Number;
      const auto pushed = damp_locally<N>(row(all.force), row(all.velocity), N(1) / row(all.mass), share, half, held);
      row.set(all.force, pushed.load);
      if (!all.spin) return pushed.power;
      const auto turned =
          damp_locally<N>(row(all.torque), row(all.spin), N(1) / row(all.inertia), share, half, held >> 3);
      row.set(all.torque, turned.load);
      return N(pushed.power + turned.power);
    };
    if constexpr (At::count == 1) {
      return both(at, grips.held(at.row));
    } else {
      if (!grips.holds_any(at.row, At::count)) return both(at, 0);
      T power(0);
      for (int k = 0; k < At::count; ++k) power.v[k] = both(Rows<1>{at.row + k}, grips.held(at.row + k));
      return power;
    }
  });
}

}  // namespace beadwork
