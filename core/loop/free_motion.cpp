#include "core/loop/free_motion.hpp"

#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "core/base/text.hpp"
#include "core/domain/free_bodies.hpp"

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

void require(bool whole) {
  if (!whole) throw std::runtime_error("what is known of free bodies is not whole");
}

}  // namespace

FreeMotions FreeMotions::find(Domain& domain, std::span<const BondTable* const> tables,
                              std::span<const Constraint> constraints, bool turning, std::int64_t step) {
  FreeMotions found;
  const std::vector<FreeBody> free = free_bodies(domain, tables, constraints, turning, step);
  std::vector<std::vector<Index>> members;
  for (const FreeBody& of : free) {
    if (found.bodies_.size() == most_named) break;
    found.bodies_.push_back(
        {static_cast<Index>(of.members.size()), names_of(of.modes), of.modes, of.centre, of.length});
    members.push_back(of.members);
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
