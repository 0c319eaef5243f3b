#include "core/loop/free_motion.hpp"

#include <fmt/format.h>

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

/// What is known of each body while its supports are gathered.
struct Gathered {
  std::vector<Index> members;
  Vec3 centre = Vec3::Zero();
  Real length = 0;
  RigidMatrix held = RigidMatrix::Zero(), inertia = RigidMatrix::Zero();
};

std::map<Index, Gathered> members_of(const std::vector<Index>& body) {
  std::map<Index, Gathered> all;
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

// Each member by itself, or their mean: of order 1 for each body that the set is a part of.
void support(std::map<Index, Gathered>& all, const Domain& domain, const Constraint& c, const Set& set, const std::vector<Index>& body) {
  const auto x = domain.elements().column("position").view<Vec3>();
  struct Sum {
    Index count = 0;
    Rigid mean = Rigid::Zero();
    RigidMatrix squares = RigidMatrix::Zero();
  };
  std::map<Index, Sum> sums;
  for (const Index row : set) {
    const auto of = all.find(body[static_cast<std::size_t>(row)]);
    if (of == all.end()) continue;
    const Rigid r = felt(of->second, x[row], c.axis);
    Sum& sum = sums[of->first];
    ++sum.count;
    sum.mean += r;
    sum.squares += r * r.transpose();
  }
  for (const auto& [first, sum] : sums) {
    const Rigid mean = sum.mean / sum.count;
    all[first].held += c.grip == Grip::mean ? RigidMatrix(mean * mean.transpose()) : RigidMatrix(sum.squares / sum.count);
  }
}

std::vector<Index> outmost_of(const Gathered& body, const Domain& domain) {
  const auto x = domain.elements().column("position").view<Vec3>();
  std::vector<Index> rows;
  for (int axis = 0; axis < 3; ++axis) {
    const auto [low, high] = std::minmax_element(body.members.begin(), body.members.end(), [&](Index a, Index b) { return x[a][axis] < x[b][axis]; });
    rows.insert(rows.end(), {*low, *high});
  }
  std::sort(rows.begin(), rows.end());
  rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
  return rows;
}

}  // namespace

FreeMotions FreeMotions::find(const Domain& domain, std::span<const BondTable* const> tables, std::span<const Constraint> constraints, bool turning,
                              std::int64_t step) {
  FreeMotions found;
  const std::vector<Index> body = bodies(domain, tables, step);
  auto all = members_of(body);
  for (auto& entry : all) weigh(entry.second, domain, turning);
  for (const Constraint& c : constraints)
    if (c.axis < 3 || turning)
      support(all, domain, c, c.grip == Grip::mean ? without_debris(domain.set(c.set), body) : domain.set(c.set), body);
  std::vector<std::pair<const Gathered*, RigidModes>> free;
  for (const auto& entry : all)
    if (RigidModes modes = free_modes(entry.second.held, entry.second.inertia); modes.cols() > 0) free.emplace_back(&entry.second, std::move(modes));
  std::stable_sort(free.begin(), free.end(), [](const auto& a, const auto& b) { return a.first->members.size() > b.first->members.size(); });
  const auto x = domain.elements().column("position").view<Vec3>();
  for (const auto& [of, modes] : free) {
    if (found.bodies_.size() == most_named) break;
    Body& one = found.bodies_.emplace_back(Body{static_cast<Index>(of->members.size()), names_of(modes), modes, of->centre, of->length, outmost_of(*of, domain), {}});
    for (const Index row : one.outmost) one.start.push_back(x[row]);
  }
  found.others_ = free.size() - found.bodies_.size();
  return found;
}

std::vector<std::string> FreeMotions::words() const {
  std::vector<std::string> lines;
  for (const Body& body : bodies_)
    lines.push_back(fmt::format("a body of {} bonded elements is free {}: no load holds it so", body.elements,
                                body.motions.size() == 6 ? "to move and turn any way" : "to " + join(body.motions, ", to ")));
  if (others_ > 0) lines.push_back(fmt::format("so are {} smaller bodies, each in some way", others_));
  return lines;
}

Real FreeMotions::moved(const Domain& domain) const {
  Real farthest = 0;
  for (const Body& body : bodies_) farthest = std::max(farthest, moved(domain, body));
  return farthest;
}

// The rigid motion that fits best what the outmost members have moved, and of it the part that is free.
Real FreeMotions::moved(const Domain& domain, const Body& body) const {
  const auto x = domain.elements().column("position").view<Vec3>();
  const auto count = static_cast<Eigen::Index>(body.outmost.size());
  Eigen::Matrix<Real, Eigen::Dynamic, 6> motions(3 * count, 6);
  Eigen::VectorXd shifts(3 * count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const auto n = static_cast<std::size_t>(k);
    motions.middleRows<3>(3 * k) = rigid_at(body.start[n] - body.centre, body.length);
    shifts.segment<3>(3 * k) = x[body.outmost[n]] - body.start[n];
  }
  const Eigen::JacobiSVD<Eigen::MatrixXd> fit(motions, Eigen::ComputeThinU | Eigen::ComputeThinV);
  const Rigid motion = fit.solve(shifts);
  const Eigen::VectorXd free = motions * (body.modes * (body.modes.transpose() * motion));
  Real farthest = 0;
  for (Eigen::Index k = 0; k < count; ++k) farthest = std::max(farthest, free.segment<3>(3 * k).norm());
  return farthest;
}

Json FreeMotions::json() const {
  Json all = Json::array();
  for (const Body& body : bodies_) all.push_back({{"elements", body.elements}, {"free_to", body.motions}});
  return all;
}

Json FreeMotions::saved() const {
  const auto vector = [](const Vec3& v) { return Json{v[0], v[1], v[2]}; };
  Json all = Json::array();
  for (const Body& body : bodies_) {
    Json start = Json::array(), modes = Json::array();
    for (const Vec3& place : body.start) start.push_back(vector(place));
    for (Eigen::Index k = 0; k < body.modes.cols(); ++k) modes.push_back(std::vector<Real>(body.modes.col(k).begin(), body.modes.col(k).end()));
    all.push_back({{"elements", body.elements}, {"motions", body.motions}, {"modes", modes}, {"centre", vector(body.centre)}, {"length", body.length},
                   {"outmost", body.outmost}, {"start", start}});
  }
  return {{"bodies", all}, {"others", others_}};
}

std::optional<FreeMotions> FreeMotions::restored(const Json& saved, Index elements) try {
  FreeMotions found;
  for (const Json& one : saved.at("bodies")) found.bodies_.push_back(body_of(one, elements));
  found.others_ = saved.at("others").get<std::size_t>();
  return found;
} catch (const std::exception&) {
  return std::nullopt;
}

FreeMotions::Body FreeMotions::body_of(const Json& saved, Index elements) {
  const auto require = [](bool whole) {
    if (!whole) throw std::runtime_error("a free body that is not whole");
  };
  const auto vector = [](const Json& v) { return Vec3(v.at(0).get<Real>(), v.at(1).get<Real>(), v.at(2).get<Real>()); };
  Body body;
  body.elements = saved.at("elements").get<Index>();
  body.motions = saved.at("motions").get<std::vector<std::string>>();
  require(saved.at("modes").size() <= 6);
  body.modes.resize(6, static_cast<Eigen::Index>(saved.at("modes").size()));
  for (Eigen::Index k = 0; k < body.modes.cols(); ++k)
    for (Eigen::Index r = 0; r < 6; ++r) body.modes(r, k) = saved.at("modes").at(static_cast<std::size_t>(k)).at(static_cast<std::size_t>(r)).get<Real>();
  body.centre = vector(saved.at("centre"));
  body.length = saved.at("length").get<Real>();
  body.outmost = saved.at("outmost").get<std::vector<Index>>();
  for (const Json& place : saved.at("start")) body.start.push_back(vector(place));
  require(body.length > 0 && !body.outmost.empty() && body.outmost.size() == body.start.size());
  require(std::all_of(body.outmost.begin(), body.outmost.end(), [&](Index row) { return row >= 0 && row < elements; }));
  return body;
}

}  // namespace beadwork
