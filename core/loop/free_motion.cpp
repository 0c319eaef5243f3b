#include "core/loop/free_motion.hpp"

#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "core/base/text.hpp"
#include "core/domain/bodies.hpp"

namespace beadwork {

namespace {

using Json = nlohmann::ordered_json;
constexpr std::size_t most_named = 4;
const Field start_field{"free-start",
                        On::elements,
                        Type::vec3,
                        "m",
                        "Where the element of a body that is free in some way stood when the stage began",
                        ""};
const Field body_field{
    "free-body", On::elements, Type::index, "1", "Which of the free bodies it belongs to, from 1 on; 0: none", ""};

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

void require(bool whole) {
  if (!whole) throw std::runtime_error("what is known of free bodies is not whole");
}

}  // namespace

FreeMotions FreeMotions::find(Domain& domain, std::span<const BondTable* const> tables,
                              std::span<const Constraint> constraints, bool turning, std::int64_t step) {
  FreeMotions found;
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
  std::vector<std::pair<const Gathered*, RigidModes>> free;
  for (const auto& entry : all)
    if (RigidModes modes = free_modes(entry.second.held, entry.second.inertia); modes.cols() > 0)
      free.emplace_back(&entry.second, std::move(modes));
  std::stable_sort(free.begin(), free.end(),
                   [](const auto& a, const auto& b) { return a.first->members.size() > b.first->members.size(); });
  std::vector<std::vector<Index>> members;
  for (const auto& [of, modes] : free) {
    if (found.bodies_.size() == most_named) break;
    found.bodies_.push_back({static_cast<Index>(of->members.size()), names_of(modes), modes, of->centre, of->length});
    members.push_back(of->members);
  }
  found.others_ = free.size() - found.bodies_.size();
  if (found.any()) found.follow(domain, members);
  return found;
}

// In columns, for they are as many numbers as elements; a scene in which nothing is free has none.
void FreeMotions::follow(Domain& domain, const std::vector<std::vector<Index>>& members) const {
  Table& elements = domain.elements();
  for (const Field* field : {&start_field, &body_field}) elements.add(*field).keep();
  const auto x = elements.column("position").view<Vec3>(), start = elements.column(start_field.name).view<Vec3>();
  const auto body = elements.column(body_field.name).view<Index>();
  for (Index row = 0; row < domain.size(); ++row) start.set(row, x[row]), body[row] = 0;
  for (std::size_t k = 0; k < members.size(); ++k)
    for (const Index row : members[k]) body[row] = static_cast<Index>(k + 1);
}

std::vector<std::string> FreeMotions::words() const {
  std::vector<std::string> lines;
  for (const Body& body : bodies_)
    lines.push_back(
        fmt::format("a body of {} bonded elements is free {}: no load holds it so", body.elements,
                    body.motions.size() == 6 ? "to move and turn any way" : "to " + join(body.motions, ", to ")));
  if (others_ > 0) lines.push_back(fmt::format("so are {} smaller bodies, each in some way", others_));
  return lines;
}

// Of each body the free part of the rigid motion that fits best, by mass, what its members have moved: what it
// stretches or swells is none.
std::vector<Rigid> FreeMotions::motions(const Domain& domain) const {
  const auto x = domain.elements().column("position").view<Vec3>(),
             start = domain.elements().column(start_field.name).view<Vec3>();
  const auto mass = domain.elements().column("mass").view<Real>();
  const auto which = domain.elements().column(body_field.name).view<Index>();
  std::vector<RigidMatrix> square(bodies_.size(), RigidMatrix::Zero());
  std::vector<Rigid> motion(bodies_.size(), Rigid::Zero());
  for (Index row = 0; row < domain.size(); ++row) {
    if (which[row] == 0) continue;
    const auto k = static_cast<std::size_t>(which[row] - 1);
    const auto at = rigid_at(start[row] - bodies_[k].centre, bodies_[k].length);
    square[k] += mass[row] * at.transpose() * at;
    motion[k] += mass[row] * at.transpose() * (x[row] - start[row]);
  }
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    Eigen::CompleteOrthogonalDecomposition<RigidMatrix> fit;  // a straight row of elements does not turn about itself
    fit.setThreshold(1e-9);
    fit.compute(square[k]);
    const Rigid whole = fit.solve(motion[k]);
    motion[k] = bodies_[k].modes * (bodies_[k].modes.transpose() * whole);
  }
  return motion;
}

Real FreeMotions::moved(const Domain& domain) const {
  if (!any()) return 0;
  const auto start = domain.elements().column(start_field.name).view<Vec3>();
  const auto which = domain.elements().column(body_field.name).view<Index>();
  const std::vector<Rigid> motion = motions(domain);
  Real farthest = 0;
  for (Index row = 0; row < domain.size(); ++row) {
    if (which[row] == 0) continue;
    const auto k = static_cast<std::size_t>(which[row] - 1);
    farthest =
        std::max(farthest, (rigid_at(start[row] - bodies_[k].centre, bodies_[k].length) * motion[k]).squaredNorm());
  }
  return std::sqrt(farthest);
}

Json FreeMotions::json() const {
  Json all = Json::array();
  for (const Body& body : bodies_) all.push_back({{"elements", body.elements}, {"free_to", body.motions}});
  return all;
}

Json FreeMotions::saved() const {
  Json all = Json::array();
  for (const Body& body : bodies_) {
    Json modes = Json::array();
    for (Eigen::Index k = 0; k < body.modes.cols(); ++k)
      modes.push_back(std::vector<Real>(body.modes.col(k).begin(), body.modes.col(k).end()));
    all.push_back({{"elements", body.elements},
                   {"motions", body.motions},
                   {"modes", modes},
                   {"centre", {body.centre[0], body.centre[1], body.centre[2]}},
                   {"length", body.length}});
  }
  return {{"bodies", all}, {"others", others_}};
}

std::optional<FreeMotions> FreeMotions::restored(const Json& saved, const Domain& domain) try {
  FreeMotions found;
  for (const Json& one : saved.at("bodies")) found.bodies_.push_back(body_of(one));
  found.others_ = saved.at("others").get<std::size_t>();
  if (!found.any()) return found;
  domain.elements().column(start_field.name).view<Vec3>();
  const auto which = domain.elements().column(body_field.name).view<Index>();
  for (Index row = 0; row < domain.size(); ++row)
    require(which[row] >= 0 && which[row] <= static_cast<Index>(found.bodies_.size()));
  return found;
} catch (const std::exception&) {
  return std::nullopt;
}

FreeMotions::Body FreeMotions::body_of(const Json& saved) {
  Body body;
  body.elements = saved.at("elements").get<Index>();
  body.motions = saved.at("motions").get<std::vector<std::string>>();
  require(saved.at("modes").size() <= 6);
  body.modes.resize(6, static_cast<Eigen::Index>(saved.at("modes").size()));
  for (Eigen::Index k = 0; k < body.modes.cols(); ++k)
    for (Eigen::Index r = 0; r < 6; ++r)
      body.modes(r, k) = saved.at("modes").at(static_cast<std::size_t>(k)).at(static_cast<std::size_t>(r)).get<Real>();
  for (int axis = 0; axis < 3; ++axis)
    body.centre[axis] = saved.at("centre").at(static_cast<std::size_t>(axis)).get<Real>();
  body.length = saved.at("length").get<Real>();
  require(body.length > 0);
  return body;
}

}  // namespace beadwork
