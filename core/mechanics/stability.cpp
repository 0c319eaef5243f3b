#include "core/mechanics/stability.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>

#include "core/base/parallel.hpp"
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

void ElasticNetwork::resize(Index bonds) {
  ends_.resize(at(bonds));
  blocks_.resize(at(bonds));
  start_.clear();
}

void ElasticNetwork::set(Index bond, Index first, Index second, const Matrix12& stiffness) {
  ends_[at(bond)] = {first, second};
  Block& block = blocks_[at(bond)];
  for (std::size_t r = 0; r < 9; ++r)
    for (std::size_t c = 0; c <= r; ++c)
      block.lower[lower_at(r, c)] = static_cast<float>(stiffness(static_cast<Index>(r) + 3, static_cast<Index>(c) + 3));
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

template <class Visit>
void ElasticNetwork::visit_bonds(Index element, const Visit& visit) const {
  for (std::int64_t k = start_[at(element)]; k < start_[at(element) + 1]; ++k)
    visit(links_[static_cast<std::size_t>(k)]);
}

std::array<Real, 4> ElasticNetwork::grips(Index bond) const {
  const Block& block = blocks_[at(bond)];
  const auto of = [&](std::size_t first) {  // a common displacement costs nothing: x1 grips as x2 does
    const auto entry = [&](std::size_t r) { return Real(block.lower[lower_at(r, r)]); };
    return entry(first) + (entry(first + 1) + entry(first + 2));
  };
  return {of(3), of(0), of(3), of(6)};
}

std::vector<std::array<Real, 2>> ElasticNetwork::total_grips() const {
  if (start_.empty()) link();
  std::vector<std::array<Real, 2>> total(at(elements_));
  each_shared(
      elements_,
      [&](Index i) {
        std::array<Real, 2> sum{};
        visit_bonds(i, [&](Index bond) {
          const auto of = grips(bond);
          const std::size_t end = first(bond) == i ? 0 : 2;
          sum[0] += of[end];
          sum[1] += of[end + 1];
        });
        total[at(i)] = sum;
      },
      1025);
  return total;
}

namespace {

/// Rows r, r + 1, r + 2 of a symmetric matrix times z.
template <std::size_t r>
std::array<Real, 3> three_rows(const float* lower, const std::array<Real, 9>& z) {
  std::array<Real, 3> product{};
#pragma GCC unroll 9
  for (std::size_t c = 0; c < 9; ++c)
#pragma GCC unroll 3
    for (std::size_t k = 0; k < 3; ++k)
      product[k] += lower[c <= r + k ? lower_at(r + k, c) : lower_at(c, r + k)] * z[c];
  return product;
}

}  // namespace

void ElasticNetwork::multiply(std::span<const Real> x, std::span<Real> y) const {
  if (start_.empty()) link();
  each_shared(
      elements_,
      [&](Index i) {
        std::array<Real, 6> sum{};
        visit_bonds(i, [&](Index bond) {
          const Ends ends = ends_[at(bond)];
          const float* lower = blocks_[at(bond)].lower;
          const Real* x1 = &x[6 * at(ends.first)];
          const Real* x2 = &x[6 * at(ends.second)];
          const std::array<Real, 9> z{x1[3],         x1[4], x1[5], x2[0] - x1[0], x2[1] - x1[1],
                                      x2[2] - x1[2], x2[3], x2[4], x2[5]};
          const bool is_first = ends.first == i;
          const auto force = three_rows<3>(lower, z);
          const auto torque = is_first ? three_rows<0>(lower, z) : three_rows<6>(lower, z);
          for (std::size_t c = 0; c < 3; ++c) {
            sum[c] += is_first ? -force[c] : force[c];
            sum[3 + c] += torque[c];
          }
        });
        std::copy(sum.begin(), sum.end(), y.begin() + 6 * static_cast<std::ptrdiff_t>(i));
      },
      1025);
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
void apply(const StiffnessProduct& product, const std::vector<Real>& root, std::vector<Real>& u, std::vector<Real>& x,
           Real scale) {
  each_shared(
      u.size(), [&](std::size_t i) { x[i] = root[i] * u[i] * scale; }, 6 * 1024 + 1);
  product(x, u);
  each_shared(
      u.size(), [&](std::size_t i) { u[i] *= root[i]; }, 6 * 1024 + 1);
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
  return power_iteration([&](std::span<const Real> x, std::span<Real> y) { network.multiply(x, y); }, mobility, rounds);
}

// --------------------------------------------------------------------------------------------------- the
// bound

namespace {

Matrix12 weighted(const Matrix12& stiffness, const Mass12& inverse_mass) {
  const Mass12 root = inverse_mass.cwiseSqrt();
  return root.asDiagonal() * stiffness * root.asDiagonal();
}

/// Whether every eigenvalue lies below `most`: only then has the difference a Cholesky factor.
bool all_below(Real most, const Matrix12& symmetric) {
  const Eigen::LLT<Matrix12> factor(most * Matrix12::Identity() - symmetric);
  return factor.info() == Eigen::Success;
}

/// The bonds, each alone, its masses shared: M^-1/2 K M^-1/2.
class BondsAlone {
 public:
  BondsAlone(const ElasticNetwork& network, const Mobility& mobility)
      : network_(network), mobility_(mobility), total_(network.total_grips()) {}

  Matrix12 matrix(Index b) const {
    const auto grips = network_.grips(b);
    Mass12 inverse_mass;
    for (int dof = 0; dof < 12; ++dof) {
      const Index end = dof < 6 ? network_.first(b) : network_.second(b);
      const auto part = static_cast<std::size_t>(dof / 3);
      const Real mine = grips[part];  // none: the row is empty, and the mass is not needed
      inverse_mass[dof] = mine > 0 ? mobility_.inverse(end, dof % 6) * (total_[at(end)][part % 2] / mine) : 0;
    }
    return weighted(network_.stiffness(b), inverse_mass);
  }

  /// Takes the bond's highest mode where it is higher than the best so far.
  void improve(HighestMode& best, Index b) const {
    const Eigen::SelfAdjointEigenSolver<Matrix12> solver(matrix(b));
    if (!(solver.eigenvalues()[11] > best.lambda)) return;
    best = {.lambda = solver.eigenvalues()[11], .bond = b};
    const Mass12 energy = solver.eigenvectors().col(11).cwiseAbs2();
    for (int part = 0; part < 4; ++part) {
      const Real share = energy.segment<3>(3 * part).sum();
      if (part > 0 && share <= best.share) continue;
      best.share = share;
      best.element = part < 2 ? network_.first(b) : network_.second(b);
      best.rotates = part % 2 == 1;
    }
  }

 private:
  const ElasticNetwork& network_;
  const Mobility& mobility_;
  std::vector<std::array<Real, 2>> total_;
};

}  // namespace

HighestMode bond_bound(const ElasticNetwork& network, const Mobility& mobility) {
  HighestMode best;
  if (network.bonds() == 0) return best;
  const BondsAlone alone(network, mobility);
  std::vector<Real> norms(at(network.bonds()));
  each_shared(
      network.bonds(), [&](Index b) { norms[at(b)] = alone.matrix(b).norm(); }, 1025);
  alone.improve(best, static_cast<Index>(std::max_element(norms.begin(), norms.end()) - norms.begin()));

  // The Frobenius norm is never below the eigenvalue. In a lattice all bonds are alike, and no norm tells which could
  // beat the best: then a Cholesky factor does, for a tenth of what the eigenvalues cost.
  constexpr Real rounding = 1e-12;
  std::vector<char> higher(norms.size(), 0);
  const auto could_beat = [&](Index b) {
    return norms[at(b)] > best.lambda && !all_below((1 + rounding) * best.lambda, alone.matrix(b));
  };
  each_shared(
      network.bonds(), [&](Index b) { higher[at(b)] = could_beat(b); }, 1025);
  std::vector<Index> order;
  for (Index b = 0; b < network.bonds(); ++b)
    if (higher[at(b)]) order.push_back(b);
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return norms[at(a)] > norms[at(b)]; });
  for (const Index b : order) {
    if (norms[at(b)] <= best.lambda) break;
    alone.improve(best, b);
  }
  best.lambda *= 1 + 1e-6;  // the blocks are kept in single precision
  return best;
}

// ----------------------------------------------------------------------------------------------------- the
// step

Real critical_step(Real lambda) { return lambda > 0 ? 2 / std::sqrt(lambda) : std::numeric_limits<Real>::infinity(); }

StableStep stable_step(const ElasticNetwork& network, const Mobility& mobility, Real safety) {
  StableStep result;
  result.mode = power_iteration(network, mobility);
  result.bound = bond_bound(network, mobility);
  result.lambda = std::min(1.05 * result.mode.lambda, result.bound.lambda);
  result.dt = safety * critical_step(result.lambda);
  return result;
}

}  // namespace beadwork
