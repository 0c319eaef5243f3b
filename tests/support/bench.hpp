#pragma once
// What a mover's parts work on, made by hand: a few balls, bonds of given stiffness, prescribed motions; and no loop.

#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/deck/deck.hpp"
#include "core/domain/vocabulary.hpp"
#include "core/dynamics/motion.hpp"
#include "core/plugin/kinds.hpp"

namespace beadwork::testing {

/// A bond law that is just its matrices: stiffness and damping of a bond of unit vector n from the first to the second.
class MatrixLaw final : public BondLaw {
 public:
  /// Along the bond, across it, against bending and against twist.
  struct Rates {
    Real along = 0, across = 0, bending = 0, twisting = 0;
  };
  Rates stiff, viscous;
  bool softens = false;  // broken bonds still act
  Real longest = std::numeric_limits<Real>::infinity();

  MatrixLaw() {
    Node node;
    node.tag = "matrix";
    node.attributes = {{"name", "bonds", {}, {}}, {"between", "balls balls", {}, {}}};
    Complaints complaints;
    configure(node, "bond.matrix", Scope(), complaints);
    complaints.throw_if_any();
  }

  void connect(Domain&, BondTable&) override {}
  void act(Domain&, BondTable&, const Evaluation&) override {}
  void withdraw(Domain&, const BondTable&, Index) override {}
  Real stored_energy(const Domain&, const BondTable&, Index) const override { return 0; }
  Real stored_energy(const Domain&, const BondTable&) const override { return 0; }
  Matrix12 tangent(const Domain& domain, const BondTable& table, Index row, Slope) const override {
    return matrix(domain, table, row, stiff);
  }
  bool moves() const override { return viscous.along > 0; }
  bool acts_when_broken() const override { return softens; }
  Real longest_step(const Domain&) const override { return longest; }
  Matrix12 damping(const Domain& domain, const BondTable& table, Index row) const override {
    return matrix(domain, table, row, viscous);
  }
  Real power(const Domain& domain, const BondTable& table) const override {
    Real sum = 0;
    for (Index b = 0; b < table.size(); ++b) {
      Eigen::Vector<Real, 12> rates = Eigen::Vector<Real, 12>::Zero();
      const Index ends[] = {table.first()[b], table.second()[b]};
      for (int end = 0; end < 2; ++end) {
        rates.segment<3>(6 * end) = domain.elements().column("velocity").view<Vec3>()[ends[end]];
        if (const Column* spin = domain.elements().find("spin"))
          rates.segment<3>(6 * end + 3) = spin->view<Vec3>()[ends[end]];
      }
      sum += rates.dot(matrix(domain, table, b, viscous) * rates);
    }
    return sum;
  }

 private:
  static Matrix12 matrix(const Domain& domain, const BondTable& table, Index row, const Rates& r) {
    const auto x = domain.elements().column("position").view<Vec3>();
    const Vec3 n = (x[table.second()[row]] - x[table.first()[row]]).normalized();
    const Mat3 along = n * n.transpose(), across = Mat3::Identity() - along;
    Matrix12 all = Matrix12::Zero();
    for (int i = 0; i < 2; ++i)
      for (int k = 0; k < 2; ++k) {
        const Real sign = i == k ? 1 : -1;
        all.block<3, 3>(6 * i, 6 * k) = sign * (r.along * along + r.across * across);
        all.block<3, 3>(6 * i + 3, 6 * k + 3) = sign * (r.twisting * along + r.bending * across);
      }
    return all;
  }
};

struct Ball {
  Vec3 place;
  Real mass;
  Real radius = 1;
  Real inertia = 1;
};

class Bench final : public Workings {
 public:
  explicit Bench(const std::vector<Ball>& balls, const std::vector<std::pair<Index, Index>>& bonds = {},
                 bool turning = true) {
    Table& elements = domain_.elements();
    if (turning) elements.add(field::orientation);
    elements.add(field::velocity);
    if (turning) elements.add(field::spin);
    elements.add(field::force);
    if (turning) elements.add(field::torque);
    elements.add(field::mass);
    if (turning) elements.add(field::inertia);
    BondTable& table = domain_.add_family("bonds");
    domain_.add_elements(static_cast<Index>(balls.size()));
    for (Index row = 0; row < domain_.size(); ++row) {
      const Ball& ball = balls[static_cast<std::size_t>(row)];
      elements.column("position").view<Vec3>().set(row, ball.place);
      elements.column("radius").view<Real>()[row] = ball.radius;
      elements.column("mass").view<Real>()[row] = ball.mass;
      if (turning) elements.column("inertia").view<Real>()[row] = ball.inertia;
    }
    table.create(bonds, 0);
    domain_.cut_families();
    laws_.emplace_back(&law, &table);
    moment_.time_step = 0.1;
  }

  Motion motion() {
    const auto vector = [&](const char* name) {
      Column* column = domain_.elements().find(name);
      return column ? column->view<Vec3>() : View<Vec3>{};
    };
    const auto number = [&](const char* name) {
      const Column* column = std::as_const(domain_).elements().find(name);
      return column ? column->view<Real>() : View<const Real>{};
    };
    Column* orientation = domain_.elements().find("orientation");
    return {domain_.size(),
            vector("position"),
            vector("velocity"),
            vector("force"),
            orientation ? orientation->view<Quat>() : View<Quat>{},
            vector("spin"),
            vector("torque"),
            number("mass"),
            number("inertia"),
            number("radius")};
  }

  /// Prescribes displacement, velocity and acceleration of a set along an axis.
  Constraint& prescribe(const Set& set, int axis, Grip grip, std::function<PrescribedMotion(Real)> motion) {
    Constraint& c = constraints_.emplace_back();
    c.set = "set " + std::to_string(constraints_.size());
    domain_.sets()[c.set] = set;
    c.axis = axis;
    c.grip = grip;
    c.motion = std::move(motion);
    return c;
  }
  void break_bond(Index bond) {
    Break b;
    b.step = moment_.step;
    b.bond = bond;
    domain_.breaks().breaks.push_back(b);
    BondTable& table = *domain_.find_family(domain_.families().front()->name());
    for (Index row = 0; row < table.size(); ++row)
      if (table.id()[row] == bond) table.state()[row] = State::broken;
  }

  Domain& domain() override { return domain_; }
  Moment& moment() override { return moment_; }
  std::vector<Constraint>& constraints() override { return constraints_; }
  void evaluate(bool) override {}
  Real utilisation() override { return 0; }
  Real next_moment(Real until) const override { return until; }
  void pause() override {}
  Real reach() const override { return std::numeric_limits<Real>::infinity(); }
  std::span<const std::pair<PairLaw*, BondTable*>> laws() const override { return laws_; }
  Log& log() override { return log_; }
  BondTable& table() { return *laws_.front().second; }

  MatrixLaw law;
  std::vector<std::string> said;

 private:
  Domain domain_;
  Moment moment_;
  std::vector<Constraint> constraints_;
  std::vector<std::pair<PairLaw*, BondTable*>> laws_;
  Log log_{[this](const std::string& line) { said.push_back(line); }, [](const std::string&) {}};
};

inline PrescribedMotion at_rest(Real) { return {0, 0, 0}; }

}  // namespace beadwork::testing
