#include "core/mechanics/stability.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>

#include "core/base/sums.hpp"

namespace beadwork {

namespace {

constexpr std::size_t at(Index i) { return static_cast<std::size_t>(i); }
constexpr std::size_t lower_at(std::size_t row, std::size_t column) { return row * (row + 1) / 2 + column; }

/// Inverse masses of a bond's twelve motions.
using Mass12 = Eigen::Matrix<Real, 12, 1>;

/// A number in [-1, 1) that depends on nothing but its place: the start of every iteration, on every machine.
Real scattered(std::uint64_t place) {
  std::uint64_t z = (place + 1) * 0x9e3779b97f4a7c15u;  // splitmix64
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  z ^= z >> 31;
  return static_cast<Real>(z >> 11) * 0x1p-52 - 1;
}

}  // namespace

// ------------------------------------------------------------------------------------------------- the
// network

void ElasticNetwork::reserve(Index bonds) {
  ends_.reserve(at(bonds));
  blocks_.reserve(at(bonds));
}

void ElasticNetwork::add(Index first, Index second, const Matrix12& stiffness) {
  ends_.push_back({first, second});
  Block block;
  for (std::size_t r = 0; r < 9; ++r)
    for (std::size_t c = 0; c <= r; ++c)
      block.lower[lower_at(r, c)] =
          static_cast<float>(stiffness(static_cast<Index>(r) + 3, static_cast<Index>(c) + 3));
  blocks_.push_back(block);
  start_.clear();
}

Matrix12 ElasticNetwork::stiffness(Index bond) const {
  const Block& block = blocks_[at(bond)];
  Matrix12 k;
  for (Index r = 0; r < 9; ++r)
    for (Index c = 0; c <= r; ++c) k(r + 3, c + 3) = k(c + 3, r + 3) = block.lower[lower_at(at(r), at(c))];
  k.topRows<3>().rightCols<9>() = -k.middleRows<3>(6).rightCols<9>();  // a common displacement costs nothing
  k.leftCols<3>() = -k.middleCols<3>(6);
  return k;
}

void ElasticNetwork::link() const {
  start_.assign(at(elements_) + 1, 0);
  for (const Ends& ends : ends_) {
    ++start_[at(ends.first) + 1];
    ++start_[at(ends.second) + 1];
  }
  std::partial_sum(start_.begin(), start_.end(), start_.begin());
  links_.resize(2 * ends_.size());
  std::vector<std::int64_t> next(start_.begin(), start_.end() - 1);
  for (Index b = 0; b < bonds(); ++b) {
    links_[static_cast<std::size_t>(next[at(first(b))]++)] = b;
    links_[static_cast<std::size_t>(next[at(second(b))]++)] = b;
  }
}

void ElasticNetwork::multiply(std::span<const Real> x, std::span<Real> y) const {
  if (start_.empty()) link();
#pragma omp parallel for schedule(static) if (elements_ > 1024)
  for (Index i = 0; i < elements_; ++i) {
    std::array<Real, 6> sum{};
    for (std::int64_t k = start_[at(i)]; k < start_[at(i) + 1]; ++k) {
      const Index bond = links_[static_cast<std::size_t>(k)];
      const Ends ends = ends_[at(bond)];
      const Block& block = blocks_[at(bond)];
      const Real* x1 = &x[6 * at(ends.first)];
      const Real* x2 = &x[6 * at(ends.second)];
      const Real z[9] = {x1[3], x1[4], x1[5], x2[0] - x1[0], x2[1] - x1[1],
                         x2[2] - x1[2], x2[3], x2[4], x2[5]};
      const auto row = [&](std::size_t r) {
        Real total = 0;
        for (std::size_t c = 0; c < 9; ++c)
          total += block.lower[c <= r ? lower_at(r, c) : lower_at(c, r)] * z[c];
        return total;
      };
      const bool is_first = ends.first == i;
      for (std::size_t c = 0; c < 3; ++c) {
        const Real force = row(3 + c);
        sum[c] += is_first ? -force : force;
        sum[3 + c] += row(is_first ? c : 6 + c);
      }
    }
    std::copy(sum.begin(), sum.end(), y.begin() + 6 * static_cast<std::ptrdiff_t>(i));
  }
}

Mobility::Mobility(std::span<const Real> mass, std::span<const Real> inertia) : inverse_(6 * mass.size(), 0) {
  const auto invert = [](Real weight) { return weight > 0 && std::isfinite(weight) ? 1 / weight : 0; };
  for (std::size_t i = 0; i < mass.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) {
      inverse_[6 * i + c] = invert(mass[i]);
      inverse_[6 * i + 3 + c] = inertia.empty() ? 0 : invert(inertia[i]);
    }
}

// ---------------------------------------------------------------------------------------------- power
// iteration

namespace {

Real norm(const std::vector<Real>& u) {
  return std::sqrt(fixed_sum(static_cast<Index>(u.size() / 6), [&](Index i) {
    Real total = 0;
    for (std::size_t c = 6 * at(i); c < 6 * at(i) + 6; ++c) total += u[c] * u[c];
    return total;
  }));
}

/// u' = s M^-1/2 K M^-1/2 u
void apply(const StiffnessProduct& product, const std::vector<Real>& root, std::vector<Real>& u,
           std::vector<Real>& x, Real scale) {
  for (std::size_t i = 0; i < u.size(); ++i) x[i] = root[i] * u[i] * scale;
  product(x, u);
  for (std::size_t i = 0; i < u.size(); ++i) u[i] *= root[i];
}

/// Where most of the kinetic energy u^2 of a mode is.
void locate(const std::vector<Real>& u, HighestMode& mode) {
  Real largest = 0;
  const Real whole = norm(u);
  for (std::size_t part = 0; part < u.size() / 3; ++part) {
    const Real energy =
        u[3 * part] * u[3 * part] + u[3 * part + 1] * u[3 * part + 1] + u[3 * part + 2] * u[3 * part + 2];
    if (!(energy > largest)) continue;
    largest = energy;
    mode.element = static_cast<Index>(part / 2);
    mode.rotates = part % 2 == 1;
    mode.share = energy / (whole * whole);
  }
}

}  // namespace

HighestMode power_iteration(const StiffnessProduct& product, const Mobility& mobility, int rounds) {
  const std::size_t size = mobility.inverse().size();
  std::vector<Real> root(size), u(size), x(size);
  for (std::size_t i = 0; i < size; ++i) {
    root[i] = std::sqrt(mobility.inverse()[i]);
    u[i] = root[i] > 0 ? scattered(i) : 0;
  }
  HighestMode mode;
  Real length = norm(u);
  for (int round = 0; round < rounds && length > 0; ++round) {
    apply(product, root, u, x, 1 / length);
    length = norm(u);
    mode.lambda = length;
  }
  if (length > 0) locate(u, mode);
  return mode;
}

HighestMode power_iteration(const ElasticNetwork& network, const Mobility& mobility, int rounds) {
  return power_iteration([&](std::span<const Real> x, std::span<Real> y) { network.multiply(x, y); },
                         mobility, rounds);
}

// --------------------------------------------------------------------------------------------------- the
// bound

namespace {

Matrix12 weighted(const Matrix12& stiffness, const Mass12& inverse_mass) {
  const Mass12 root = inverse_mass.cwiseSqrt();
  return root.asDiagonal() * stiffness * root.asDiagonal();
}

/// Stiffness of each bond against displacement and against turning of each end; the measure by which masses
/// are shared.
struct Grips {
  std::array<Real, 4> of;  // x1, theta1, x2, theta2
};

Grips grips(const Matrix12& k) {
  Grips g;
  for (std::size_t part = 0; part < 4; ++part)
    g.of[part] = k.diagonal().segment<3>(3 * static_cast<Eigen::Index>(part)).sum();
  return g;
}

}  // namespace

Real bond_lambda(const Matrix12& stiffness, const Mass12& inverse_mass) {
  const Eigen::SelfAdjointEigenSolver<Matrix12> solver(weighted(stiffness, inverse_mass),
                                                       Eigen::EigenvaluesOnly);
  return std::max(Real(0), solver.eigenvalues()[11]);
}

HighestMode bond_bound(const ElasticNetwork& network, const Mobility& mobility) {
  std::vector<Real> total(2 * at(network.elements()),
                          0);  // for each element: against displacement, against turning
  for (Index b = 0; b < network.bonds(); ++b) {
    const Grips g = grips(network.stiffness(b));
    for (std::size_t part = 0; part < 4; ++part) {
      const Index end = part < 2 ? network.first(b) : network.second(b);
      total[2 * at(end) + part % 2] += g.of[part];
    }
  }

  const auto shared = [&](Index b, const Matrix12& k) {
    const Grips g = grips(k);
    Mass12 inverse_mass;
    for (int dof = 0; dof < 12; ++dof) {
      const Index end = dof < 6 ? network.first(b) : network.second(b);
      const std::size_t part = static_cast<std::size_t>(dof / 3);
      const Real mine = g.of[part];  // none: the row is empty, and the mass is not needed
      inverse_mass[dof] =
          mine > 0 ? mobility.inverse(end, dof % 6) * (total[2 * at(end) + part % 2] / mine) : 0;
    }
    return weighted(k, inverse_mass);
  };

  // The Frobenius norm is never below the eigenvalue: solve from the largest down, and stop when none can
  // beat the best.
  std::vector<Real> norms(at(network.bonds()));
#pragma omp parallel for schedule(static) if (network.bonds() > 1024)
  for (Index b = 0; b < network.bonds(); ++b) norms[at(b)] = shared(b, network.stiffness(b)).norm();
  std::vector<Index> order(norms.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return norms[at(a)] > norms[at(b)]; });

  HighestMode best;
  for (const Index b : order) {
    if (norms[at(b)] <= best.lambda) break;
    const Eigen::SelfAdjointEigenSolver<Matrix12> solver(shared(b, network.stiffness(b)));
    if (!(solver.eigenvalues()[11] > best.lambda)) continue;
    best.lambda = solver.eigenvalues()[11];
    best.bond = b;
    const Mass12 energy = solver.eigenvectors().col(11).cwiseAbs2();
    for (int part = 0; part < 4; ++part) {
      const Real share = energy.segment<3>(3 * part).sum();
      if (part > 0 && share <= best.share) continue;
      best.share = share;
      best.element = part < 2 ? network.first(b) : network.second(b);
      best.rotates = part % 2 == 1;
    }
  }
  best.lambda *= 1 + 1e-6;  // the blocks are kept in single precision
  return best;
}

// ----------------------------------------------------------------------------------------------------- the
// step

Real critical_step(Real lambda) {
  return lambda > 0 ? 2 / std::sqrt(lambda) : std::numeric_limits<Real>::infinity();
}

Real damped_critical_step(Real lambda, Real zeta) {
  return critical_step(lambda) * (std::sqrt(1 + zeta * zeta) - zeta);
}

StableStep stable_step(const ElasticNetwork& network, const Mobility& mobility, Real safety) {
  StableStep result;
  result.mode = power_iteration(network, mobility);
  result.bound = bond_bound(network, mobility);
  result.lambda = std::min(1.05 * result.mode.lambda, result.bound.lambda);
  result.dt = safety * critical_step(result.lambda);
  return result;
}

}  // namespace beadwork
