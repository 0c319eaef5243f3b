// What holds the elements of a scene: loads, and where nothing does, the mover itself.

#include <algorithm>

#include "core/domain/bodies.hpp"
#include "core/mechanics/rigid_turn.hpp"
#include "core/statics/scene_model.hpp"

namespace beadwork {

namespace {

// The unknown among these that feels most of the motions that are left; takes away of them what it feels.
int holding_most(const std::vector<int>& unknowns, Eigen::MatrixXd& felt_by_unknown, const auto& row_of) {
  int best = -1;
  Real most = -1;
  for (const int k : unknowns)
    if (const Real felt = felt_by_unknown.row(row_of(k)).squaredNorm(); felt > most * (1 + 1e-9)) most = felt, best = k;
  const Eigen::VectorXd motion = felt_by_unknown.row(row_of(best)).transpose();
  if (motion.squaredNorm() > 0)
    felt_by_unknown -= (felt_by_unknown * motion) * motion.transpose() / motion.squaredNorm();
  return best;
}

template <class F>
Real mean(const Set& set, const F& f) {
  Real sum = 0;
  for (const Index row : set) sum += f(row);
  return sum / static_cast<Real>(set.size());
}

}  // namespace

void SceneModel::begin_support(const std::vector<Index>& body) {
  supports_ = Supports();
  supports_.fixed.assign(static_cast<std::size_t>(per_element()) * static_cast<std::size_t>(count_), 0);
  sets_.clear();
  for (const Constraint& c : w_.constraints())
    sets_.push_back(c.grip == Grip::mean ? without_debris(w_.domain().set(c.set), body) : w_.domain().set(c.set));
  fix_prescribed();
  fix_loose();
}

std::vector<FreeBody> SceneModel::support(bool pin_free) {
  begin_support(bodies(w_.domain(), tables(), w_.moment().step));
  for (Index i = 0; i < count_; ++i) rows_.held[i] = 0;
  std::vector<FreeBody> free = free_bodies(w_.domain(), tables(), w_.constraints(), turning(), w_.moment().step);
  const std::vector<char> pressed = pressed_elements();
  std::erase_if(free, [&](const FreeBody& body) {
    return std::any_of(body.members.begin(), body.members.end(),
                       [&](Index row) { return pressed[static_cast<std::size_t>(row)] != 0; });
  });
  if (pin_free)
    for (const FreeBody& each : free) pin(each);
  fix_held();
  pin_means();
  return free;
}

// By contacts that resist at present: they hold a body as far as they go, and it is none of the free ones.
std::vector<char> SceneModel::pressed_elements() const {
  std::vector<char> pressed(static_cast<std::size_t>(count_), 0);
  for (const auto& [law, table] : w_.laws()) {
    if (!table->is_of_contacts()) continue;
    for (const Chunk& chunk : table->chunks())
      for (Index row = chunk.begin; row < chunk.live_end; ++row)
        if (!law->tangent(w_.domain(), *table, row, Slope::secant).isZero(0))
          for (const Index end : {table->first()[row], table->second()[row]})
            pressed[static_cast<std::size_t>(end)] = 1;
  }
  return pressed;
}

// What the mover itself keeps in its place should bear nothing.
SceneModel::Burden SceneModel::burden() const {
  Burden burden;
  Real all = 0;
  for (int u = 0; u < static_cast<int>(forces_.size()); ++u) {
    if (!supports_.is_fixed(u)) continue;
    all += forces_[u] * forces_[u];
    if (supports_.fixed[static_cast<std::size_t>(u)] != Supports::kept || std::abs(forces_[u]) <= burden.force)
      continue;
    burden.force = std::abs(forces_[u]);
    burden.unknown = u;
  }
  if (burden.force > 1e3 * noise_) burden.share = burden.force / std::sqrt(all);
  return burden;
}

void SceneModel::support_as_before() {
  begin_support(bodies(w_.domain(), tables(), w_.moment().step));
  fix_held();
  pin_means();
}

void SceneModel::fix_prescribed() {
  for (std::size_t n = 0; n < sets_.size(); ++n) {
    const Constraint& c = w_.constraints()[n];
    if (c.grip == Grip::mean) continue;
    for (int axis = 0; axis < per_element(); ++axis)
      if (c.prescribes() >> axis & 1)
        for (const Index row : sets_[n])
          supports_.fixed[static_cast<std::size_t>(unknown(row, axis))] = Supports::prescribed;
  }
}

void SceneModel::keep(int unknown) {
  char& fixed = supports_.fixed[static_cast<std::size_t>(unknown)];
  if (fixed == Supports::is_free) fixed = Supports::kept;
}

// Elements that no bond holds and no contact touches stay where they are.
void SceneModel::fix_loose() {
  std::vector<char> bound(static_cast<std::size_t>(count_), 0);
  for (const BondTable* table : tables())
    for (const Chunk& chunk : table->chunks())
      for (Index b = chunk.begin; b < chunk.live_end; ++b)
        for (const Index end : {table->first()[b], table->second()[b]}) bound[static_cast<std::size_t>(end)] = 1;
  loose_ = 0;
  for (Index i = 0; i < count_; ++i) {
    if (bound[static_cast<std::size_t>(i)]) continue;
    ++loose_;
    for (int axis = 0; axis < per_element(); ++axis) keep(unknown(i, axis));
  }
}

// As few unknowns as it has free motions, so that nothing pulls at them.
void SceneModel::pin(const FreeBody& body) {
  const int d = per_element();
  Eigen::MatrixXd felt(d * static_cast<Eigen::Index>(body.members.size()), body.modes.cols());
  std::vector<int> rows(static_cast<std::size_t>(felt.rows()));
  for (std::size_t m = 0; m < body.members.size(); ++m) {
    const auto at = d * static_cast<Eigen::Index>(m);
    felt.middleRows(at, 3) = rigid_at(rows_.place[body.members[m]] - body.centre, body.length) * body.modes;
    if (d == 6) felt.middleRows(at + 3, 3) = length_ / body.length * body.modes.bottomRows<3>();
    for (int axis = 0; axis < d; ++axis) rows[static_cast<std::size_t>(at + axis)] = static_cast<int>(at) + axis;
  }
  for (Eigen::Index k = 0; k < body.modes.cols(); ++k) {
    const int row = holding_most(rows, felt, [](int r) { return r; });
    Real& bits = rows_.held[body.members[static_cast<std::size_t>(row / d)]];
    bits = static_cast<Real>(static_cast<unsigned>(bits) | 1u << row % d);
  }
}

void SceneModel::fix_held() {
  for (Index i = 0; i < count_; ++i)
    for (int axis = 0; axis < per_element(); ++axis)
      if (static_cast<unsigned>(rows_.held[i]) >> axis & 1) keep(unknown(i, axis));
}

// A spring in each mean: the one that it had, or where it holds most of what no other support does. So that a run that is
// resumed has the same.
void SceneModel::pin_means() {
  std::vector<Constraint*> means;
  std::vector<std::vector<int>> choices;
  mean_number_.assign(sets_.size(), -1);
  bool chosen = true;
  for (std::size_t n = 0; n < sets_.size(); ++n) {
    Constraint& c = w_.constraints()[n];
    if (c.grip != Grip::mean || c.axis >= per_element()) continue;
    std::vector<int> all, free;
    for (const Index row : sets_[n]) all.push_back(unknown(row, c.axis));
    std::copy_if(all.begin(), all.end(), std::back_inserter(free), [&](int u) { return !supports_.is_fixed(u); });
    if (free.empty()) continue;
    const int had = c.pinned > 0 ? unknown(static_cast<Index>(c.pinned) - 1, c.axis) : -1;
    chosen &= std::binary_search(free.begin(), free.end(), had);
    mean_number_[n] = static_cast<int>(means.size());
    means.push_back(&c);
    choices.push_back(std::move(free));
    supports_.means.push_back({std::move(all), -1});
  }
  if (!chosen) choose_pins(means, choices);
  for (std::size_t k = 0; k < means.size(); ++k)
    supports_.means[k].pinned = unknown(static_cast<Index>(means[k]->pinned) - 1, means[k]->axis);
}

void SceneModel::choose_pins(const std::vector<Constraint*>& means, const std::vector<std::vector<int>>& choices) {
  std::vector<Constraint> others;
  for (const Constraint& c : w_.constraints())
    if (c.grip == Grip::each) others.push_back(c);
  const auto free = free_bodies(w_.domain(), tables(), others, turning(), w_.moment().step);
  Eigen::Index modes = 0;
  for (const FreeBody& body : free) modes += body.modes.cols();
  const int d = per_element();
  Eigen::MatrixXd felt = Eigen::MatrixXd::Zero(d * count_, std::max<Eigen::Index>(modes, 1));
  Eigen::Index column = 0;
  for (const FreeBody& body : free) {
    for (const Index row : body.members) {
      felt.block(unknown(row, 0), column, 3, body.modes.cols()) =
          rigid_at(rows_.place[row] - body.centre, body.length) * body.modes;
      if (d == 6)
        felt.block(unknown(row, 3), column, 3, body.modes.cols()) = length_ / body.length * body.modes.bottomRows<3>();
    }
    column += body.modes.cols();
  }
  for (std::size_t k = 0; k < means.size(); ++k)
    means[k]->pinned = holding_most(choices[k], felt, [](int u) { return u; }) / d + 1;
}

Lacking SceneModel::lacking() const {
  Lacking lack{Vector::Zero(per_element() * count_), Vector::Zero(static_cast<Eigen::Index>(supports_.means.size()))};
  for (std::size_t n = 0; n < sets_.size(); ++n) {
    const Constraint& c = w_.constraints()[n];
    if (c.body) {
      lacking_body(c, n, lack.fixed);
      continue;
    }
    if (c.axis >= per_element() || (c.grip == Grip::mean && mean_number_[n] < 0)) continue;
    const Real moved = c.at(w_.moment().time).displacement - c.at(accepted_time_).displacement;
    const auto left = [&](Index row) { return unit(c.axis) * (moved - gone(row, c.axis)); };
    if (c.grip == Grip::mean)
      lack.means[mean_number_[n]] = mean(sets_[n], left);
    else
      for (const Index row : sets_[n]) lack.fixed[unknown(row, c.axis)] = left(row);
  }
  return lack;
}

Lacking SceneModel::support_rates() const {
  Lacking rates{Vector::Zero(per_element() * count_), Vector::Zero(static_cast<Eigen::Index>(supports_.means.size()))};
  for (std::size_t n = 0; n < sets_.size(); ++n) {
    const Constraint& c = w_.constraints()[n];
    const Real rate = c.at(w_.moment().time).velocity;
    if (c.body) {
      const Circles circles(c.axis - 3, c.body->about);
      for (const Index row : sets_[n]) {
        const Vec3 velocity = circles.velocity(circles.arm(rows_.place[row]), rate);
        for (int axis = 0; axis < 3; ++axis)
          if (c.prescribes() >> axis & 1) rates.fixed[unknown(row, axis)] = velocity[axis];
        if (turning()) rates.fixed[unknown(row, 3 + circles.axis())] = length_ * rate;
      }
    } else if (c.axis < per_element()) {
      if (c.grip == Grip::each)
        for (const Index row : sets_[n]) rates.fixed[unknown(row, c.axis)] = unit(c.axis) * rate;
      else if (mean_number_[n] >= 0)
        rates.means[mean_number_[n]] = unit(c.axis) * rate;
    }
  }
  return rates;
}

// Places follow from where the turn began, turns from where the trial did.
void SceneModel::lacking_body(const Constraint& c, std::size_t number, Vector& lack) const {
  const Circles circles(c.axis - 3, c.body->about);
  const auto from = w_.domain().elements().column(c.body->from).view<Vec3>();
  const Real angle = c.at(w_.moment().time).displacement;
  const Turned by = turned(angle);
  const Vec3 turn = (angle - c.at(accepted_time_).displacement) * Vec3::Unit(circles.axis());
  for (const Index row : sets_[number]) {
    const Vec3 left = circles.place(from[row], by) - rows_.place[row];
    for (int axis = 0; axis < 3; ++axis)
      if (c.prescribes() >> axis & 1) lack[unknown(row, axis)] = left[axis];
    if (turning()) lack.segment<3>(unknown(row, 3)) = length_ * (turn - turned_[static_cast<std::size_t>(row)]);
  }
}

// What an element has gone or turned since the trial began.
Real SceneModel::gone(Index row, int axis) const {
  const auto at = static_cast<std::size_t>(row);
  return axis < 3 ? rows_.place.at(row, axis) - places_[at][axis] : turned_[at][axis - 3];
}

void SceneModel::react(bool works) {
  for (std::size_t n = 0; n < sets_.size(); ++n) react(w_.constraints()[n], sets_[n], works);
}

// The force that keeps it: what the others do to what it holds, the other way round. The work of a small step of
// equilibria is the trapezoid.
void SceneModel::react(Constraint& c, const Set& set, bool works) {
  if (c.axis >= 3 && !c.body && !turning()) return;
  const auto load = c.axis < 3 ? rows_.force : rows_.torque;
  Real reaction = 0;
  Vec3 sum = Vec3::Zero();
  for (const Index row : set) {
    if (!c.body) {
      reaction -= load.at(row, c.axis % 3);
      continue;
    }
    const Circles circles(c.axis - 3, c.body->about);
    Vec3 force = -rows_.force[row];
    for (int axis = 0; axis < 3; ++axis)
      if (!(c.prescribes() >> axis & 1)) force[axis] = 0;
    sum += force;
    reaction += circles.torque(circles.arm(rows_.place[row]), force);
    if (turning()) reaction -= rows_.torque.at(row, circles.axis());
  }
  if (works)
    c.work += 0.5 * (c.reaction + reaction) * (c.at(w_.moment().time).displacement - c.at(accepted_time_).displacement);
  c.reaction = reaction;
  if (c.body)
    for (std::size_t axis = 0; axis < 3; ++axis) c.body->forces[axis] = sum[static_cast<int>(axis)];
}

// A step is complete: what broke before it does its work no more.
void SceneModel::accept() {
  w_.evaluate(true);
  collect_forces();
  react(true);
  leave_unbalanced();
  note_accepted();
}

// What supports take is no force on an element any more, as with movers that have inertia.
void SceneModel::leave_unbalanced() {
  const Vector left = supports_.unbalanced(forces_);
  for (Index i = 0; i < count_; ++i) {
    rows_.force.set(i, left.segment<3>(unknown(i, 0)));
    if (turning()) rows_.torque.set(i, length_ * left.segment<3>(unknown(i, 3)));
  }
}

}  // namespace beadwork
