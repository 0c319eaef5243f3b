#include "core/domain/free_bodies.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/domain/bodies.hpp"

namespace beadwork {

namespace {

/// What is known of each body while its supports are gathered.
struct Gathered {
  std::vector<Index> members;
  Vec3 centre = Vec3::Zero();
  Real length = 0;
  RigidMatrix held = RigidMatrix::Zero(), inertia = RigidMatrix::Zero();
  std::map<Index, Rigid> shared;  // its part of the supports that hold several bodies by one mean, by their number
};
using All = std::map<Index, Gathered>;

All members_of(const std::vector<Index>& body) {
  All all;
  for (std::size_t row = 0; row < body.size(); ++row) all[body[row]].members.push_back(static_cast<Index>(row));
  std::erase_if(all, [](const auto& entry) { return entry.second.members.size() < 2; });
  return all;
}

void weigh(Gathered& body, const Domain& domain, bool turning) {
  const auto x = domain.elements().column("position").view<Vec3>();
  const auto mass = domain.elements().column("mass").view<Real>();
  Real whole = 0;
  for (const Index row : body.members) {
    whole += mass[row];
    body.centre += mass[row] * x[row];
  }
  body.centre /= whole;
  Real square = 0;
  for (const Index row : body.members) square += mass[row] / whole * (x[row] - body.centre).squaredNorm();
  body.length = std::sqrt(square);
  if (!(body.length > 0)) body.length = domain.elements().column("radius").view<Real>()[body.members.front()];
  const auto inertia = turning ? domain.elements().column("inertia").view<Real>() : View<Real>{};
  for (const Index row : body.members) {
    const auto at = rigid_at(x[row] - body.centre, body.length);
    body.inertia += mass[row] / whole * (at.transpose() * at);
    if (turning) body.inertia.bottomRightCorner<3, 3>() += inertia[row] / (whole * square) * Mat3::Identity();
  }
}

/// What a constraint on one degree of freedom of an element feels of the motions of its body.
Rigid felt(const Gathered& body, const Vec3& place, int axis) {
  if (axis < 3) return rigid_at(place - body.centre, body.length).row(axis);
  return Rigid::Unit(axis);
}

// Each member by itself along an axis: of order 1 for each body that the set is a part of.
void support_each(All& all, const Domain& domain, const Set& set, int axis, const std::vector<Index>& body) {
  const auto x = domain.elements().column("position").view<Vec3>();
  struct Sum {
    Index count = 0;
    RigidMatrix squares = RigidMatrix::Zero();
  };
  std::map<Index, Sum> sums;
  for (const Index row : set) {
    const auto of = all.find(body[static_cast<std::size_t>(row)]);
    if (of == all.end()) continue;
    const Rigid r = felt(of->second, x[row], axis);
    Sum& sum = sums[of->first];
    ++sum.count;
    sum.squares += r * r.transpose();
  }
  for (const auto& [first, sum] : sums) all[first].held += sum.squares / sum.count;
}

// The mean of all members is one number, of however many bodies: each alone may do what the others make up for.
void support_mean(All& all, const Domain& domain, const Constraint& c, const std::vector<Index>& body, Index number) {
  const auto x = domain.elements().column("position").view<Vec3>();
  const Set set = without_debris(domain.set(c.set), body);
  std::map<Index, Rigid> parts;
  for (const Index row : set) {
    const auto of = all.find(body[static_cast<std::size_t>(row)]);
    if (of != all.end())
      parts.try_emplace(of->first, Rigid::Zero()).first->second +=
          felt(of->second, x[row], c.axis) / static_cast<Real>(set.size());
  }
  if (parts.size() == 1) {
    all[parts.begin()->first].held += parts.begin()->second * parts.begin()->second.transpose();
    return;
  }
  for (const auto& [first, part] : parts) all[first].shared[number] = part;
}

using Rows = Eigen::MatrixXd;

// Its rows of the shared supports, `count` of them, of order 1.
Rows shared_rows(const Gathered& body, Index count) {
  Rows rows = Rows::Zero(count, 6);
  Real largest = 0;
  for (const auto& [number, part] : body.shared) {
    rows.row(number) = part.transpose();
    largest = std::max(largest, part.norm());
  }
  return largest > 0 ? Rows(rows / largest) : rows;
}

// A shared support holds a body so far as no other can make up for it: where its motion is felt in a way in which that
// of no other is.
void hold_by_shared(All& all, Index count) {
  if (count == 0) return;
  std::map<Index, Rows> could;  // what each could make the supports feel, by what its own leave free
  Rows sum = Rows::Zero(count, count);
  for (const auto& [first, body] : all) {
    if (body.shared.empty()) continue;
    const Rows rows = shared_rows(body, count) * free_modes(body.held, body.inertia);
    sum += rows * rows.transpose();
    could[first] = rows;
  }
  for (const auto& [first, rows] : could) {
    constexpr Real none = 1e-9;  // as of free_modes
    const Eigen::SelfAdjointEigenSolver<Rows> others(sum - rows * rows.transpose());
    Gathered& body = all[first];
    const Rows seen = others.eigenvectors().transpose() * shared_rows(body, count);
    for (Eigen::Index k = 0; k < count; ++k)
      if (others.eigenvalues()[k] < none) body.held += seen.row(k).transpose() * seen.row(k);
  }
}

}  // namespace

std::vector<FreeBody> free_bodies(const Domain& domain, std::span<const BondTable* const> tables,
                                  std::span<const Constraint> constraints, bool turning, std::int64_t step) {
  const std::vector<Index> body = bodies(domain, tables, step);
  All all = members_of(body);
  for (auto& entry : all) weigh(entry.second, domain, turning);
  Index means = 0;
  for (const Constraint& c : constraints) {
    if (c.grip == Grip::mean) {
      if (!c.turns() || turning) support_mean(all, domain, c, body, means++);
      continue;
    }
    for (int axis = 0; axis < (turning ? 6 : 3); ++axis)
      if (c.prescribes() >> axis & 1) support_each(all, domain, domain.set(c.set), axis, body);
  }
  hold_by_shared(all, means);
  std::vector<FreeBody> free;
  for (auto& [first, of] : all)
    if (RigidModes modes = free_modes(of.held, of.inertia); modes.cols() > 0)
      free.push_back({std::move(of.members), of.centre, of.length, std::move(modes)});
  std::stable_sort(free.begin(), free.end(),
                   [](const FreeBody& a, const FreeBody& b) { return a.members.size() > b.members.size(); });
  return free;
}

}  // namespace beadwork
