#include "core/packing/equations.hpp"

#include "core/packing/blocks.hpp"

namespace beadwork::packing {
ContactEquations::ContactEquations(std::size_t moving, const std::vector<Contact>& contacts,
                                   const std::vector<Real>& compliance)
    : moving_(moving), contact_(contacts), compliance_(compliance), change_(moving) {
  list_terms();
}

void ContactEquations::list_terms() {
  first_.assign(moving_ + 1, 0);
  for (const Contact& c : contact_) {
    ++first_[std::size_t(c.i) + 1];
    if (moves(c.j)) ++first_[std::size_t(c.j) + 1];
  }
  for (std::size_t i = 0; i < moving_; ++i) first_[i + 1] += first_[i];
  term_.resize(first_.back());
  std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
  for (std::size_t e = 0; e < contact_.size(); ++e) {
    const auto term = static_cast<std::int32_t>(e);
    term_[next[std::size_t(contact_[e].i)]++] = term;
    if (moves(contact_[e].j)) term_[next[std::size_t(contact_[e].j)]++] = -1 - term;
  }
}

Real ContactEquations::row_times_change(std::size_t e) const {
  const Contact& c = contact_[e];
  const Change& a = change_[std::size_t(c.i)];
  const Real from_i = -c.n.dot(a.u) - a.r;
  if (!moves(c.j)) return from_i;
  const Change& b = change_[std::size_t(c.j)];
  return from_i + c.n.dot(b.u) - b.r;
}

/// change = A^T lambda.
template <class Multiplier>
void ContactEquations::scatter(const Multiplier& lambda) {
  for_each(moving_, [&](std::size_t i) {
    Vec3 u = zero<Vec3>();
    Real r = 0;
    for (std::size_t k = first_[i]; k < first_[i + 1]; ++k) {
      const bool as_i = term_[k] >= 0;
      const auto e = std::size_t(as_i ? term_[k] : -1 - term_[k]);
      const Real l = lambda(e);
      u += (as_i ? -l : l) * contact_[e].n;
      r -= l;
    }
    change_[i] = {u, compliance_[i] * r};
  });
}

std::vector<Real> ContactEquations::remaining() const {
  std::vector<Real> gap(contact_.size());
  for_each(contact_.size(), [&](std::size_t e) { gap[e] = contact_[e].gap + row_times_change(e); });
  return gap;
}

/// Each iteration is three passes, so that threads wait for each other three times only: the new direction is
/// formed twice, once where the elements gather it and once where it is stored.
void ContactEquations::solve(const Damping& damping, Real reduction, int most, const Pause& pause) {
  const std::size_t n = contact_.size();
  std::vector<Real> lambda(n, 0), residual(n), scaled(n), direction(n, 0), image(n), inverse(n), extra(n);
  const auto sum = [n](const auto& term) {
    return sum_in_blocks<Real>(n, [&](std::size_t begin, std::size_t end, Real& s) {
      for (std::size_t e = begin; e < end; ++e) s += term(e);
    });
  };
  Real rho = sum([&](std::size_t e) {
    const Contact& c = contact_[e];
    const Real diagonal = 1 + compliance_[std::size_t(c.i)] + (moves(c.j) ? 1 + compliance_[std::size_t(c.j)] : 0);
    extra[e] = (c.gap > 0 ? damping.open : damping.overlapping) * diagonal;
    inverse[e] = 1 / (diagonal + extra[e]);
    residual[e] = -c.gap;
    scaled[e] = inverse[e] * residual[e];
    return residual[e] * scaled[e];
  });
  const Real goal = rho * reduction * reduction;
  Real turn = 0;
  for (int k = 0; k < most && rho > goal; ++k) {
    pause();
    scatter([&](std::size_t e) { return scaled[e] + turn * direction[e]; });
    const Real curvature = sum([&](std::size_t e) {
      direction[e] = scaled[e] + turn * direction[e];
      image[e] = row_times_change(e) + extra[e] * direction[e];
      return direction[e] * image[e];
    });
    const Real step = rho / curvature;
    const Real before = rho;
    rho = sum([&](std::size_t e) {
      lambda[e] += step * direction[e];
      residual[e] -= step * image[e];
      scaled[e] = inverse[e] * residual[e];
      return residual[e] * scaled[e];
    });
    turn = rho / before;
  }
  scatter([&](std::size_t e) { return lambda[e]; });
}

}  // namespace beadwork::packing
