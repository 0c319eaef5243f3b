#include "core/statics/scene_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/mechanics/rotation.hpp"

namespace beadwork {

namespace {

// A turn of any length: the series is good for 2 rad.
Quat turn_by(const Vec3& turn) {
  if (!(turn.squaredNorm() > 1)) return increment<Real>(turn);
  const Quat half = turn_by(0.5 * turn);
  return half * half;
}

}  // namespace

SceneModel::SceneModel(Workings& workings, const StaticRows& rows)
    : w_(workings), rows_(rows), count_(workings.domain().size()), accepted_time_(workings.moment().time) {
  Index spheres = 0;
  Real sum = 0;
  for (Index i = 0; i < count_; ++i) {
    extent_ = std::max(extent_, rows_.place[i].cwiseAbs().maxCoeff());
    sum += rows_.radius[i];
    spheres += rows_.radius[i] > 0 ? 1 : 0;
  }
  if (spheres > 0) length_ = sum / spheres;
  for (const Constraint& c : w_.constraints()) sets_.push_back(w_.domain().set(c.set));
  note_accepted();
}

void SceneModel::note_accepted() {
  places_.resize(static_cast<std::size_t>(count_));
  for (Index i = 0; i < count_; ++i) places_[static_cast<std::size_t>(i)] = rows_.place[i];
  accepted_time_ = w_.moment().time;
  if (!turning()) return;
  orientations_.resize(static_cast<std::size_t>(count_));
  for (Index i = 0; i < count_; ++i) orientations_[static_cast<std::size_t>(i)] = rows_.orientation[i];
  turned_.assign(static_cast<std::size_t>(count_), Vec3::Zero());
}

void SceneModel::stand_still() {
  for (Index i = 0; i < count_; ++i) {
    rows_.velocity.set(i, Vec3::Zero());
    if (rows_.spin) rows_.spin.set(i, Vec3::Zero());
  }
}

void SceneModel::begin_trial(Real time) { w_.moment().time = time; }

void SceneModel::give_up() {
  w_.moment().time = accepted_time_;
  for (Index i = 0; i < count_; ++i) rows_.place.set(i, places_[static_cast<std::size_t>(i)]);
  if (!turning()) return;
  for (Index i = 0; i < count_; ++i) rows_.orientation.set(i, orientations_[static_cast<std::size_t>(i)]);
  turned_.assign(static_cast<std::size_t>(count_), Vec3::Zero());
}

void SceneModel::move(const Vector& by) {
  const int d = per_element();
  const Real dt = w_.moment().time - accepted_time_;
  each_shared(
      count_,
      [&](Index i) {
        const auto at = static_cast<std::size_t>(i);
        rows_.place.add(i, by.segment<3>(d * i));
        if (dt != 0) rows_.velocity.set(i, (rows_.place[i] - places_[at]) / dt);
        if (d == 3) return;
        const Vec3 turn = by.segment<3>(d * i + 3) / length_;
        turned_[at] += turn;
        rows_.orientation.set(i, renormalise<Real>(turn_by(turn) * rows_.orientation[i]));
        if (dt != 0) rows_.spin.set(i, turned_[at] / dt);
      },
      1024);
}

const Vector& SceneModel::forces() {
  w_.evaluate(false);
  collect_forces();
  return forces_;
}

void SceneModel::collect_forces() {
  forces_.resize(per_element() * count_);
  for (Index i = 0; i < count_; ++i) {
    forces_.segment<3>(unknown(i, 0)) = rows_.force[i];
    if (turning()) forces_.segment<3>(unknown(i, 3)) = rows_.torque[i] / length_;
  }
}

// Loads alone change with the time, where nothing moves.
Vector SceneModel::force_rates() {
  const Real now = w_.moment().time, step = std::max(std::abs(w_.moment().time_step), 1e-9 * std::abs(now));
  const Vector here = forces();
  w_.moment().time = now + 1e-3 * step;
  const Vector later = forces();
  w_.moment().time = now;
  return (later - here) / (1e-3 * step);
}

Vector SceneModel::moved() const {
  Vector all(per_element() * count_);
  for (Index i = 0; i < count_; ++i) {
    all.segment<3>(unknown(i, 0)) = rows_.place[i] - places_[static_cast<std::size_t>(i)];
    if (turning()) all.segment<3>(unknown(i, 3)) = length_ * turned_[static_cast<std::size_t>(i)];
  }
  return all;
}

Real SceneModel::farthest() const {
  Real most = 0;
  for (Index i = 0; i < count_; ++i)
    most = std::max(most, (rows_.place[i] - places_[static_cast<std::size_t>(i)]).norm());
  return most;
}

// Simpson's rule along the chord, places in straight lines and turns about fixed axes: a path that stretches nothing more
// than both ends do, where the way of an iteration may lead anywhere.
Real SceneModel::work_on_the_way() {
  constexpr int pieces = 8;
  const Real now = w_.moment().time;
  const Vector whole = moved();
  std::vector<Vec3> places(places_.size());
  std::vector<Quat> orientations(orientations_.size());
  for (Index i = 0; i < count_; ++i) {
    places[static_cast<std::size_t>(i)] = rows_.place[i];
    if (turning()) orientations[static_cast<std::size_t>(i)] = rows_.orientation[i];
  }
  const std::vector<Vec3> turned = turned_;
  Real work = 0;
  for (int k = 0; k <= pieces; ++k) {
    give_up();
    w_.moment().time = now;
    move(whole * (static_cast<Real>(k) / pieces));
    work += (k == 0 || k == pieces ? 1 : k % 2 == 1 ? 4 : 2) * supports_.unbalanced(forces()).dot(whole) / (3 * pieces);
  }
  for (Index i = 0; i < count_; ++i) {
    rows_.place.set(i, places[static_cast<std::size_t>(i)]);
    if (turning()) rows_.orientation.set(i, orientations[static_cast<std::size_t>(i)]);
  }
  turned_ = turned;
  return work;
}

std::optional<Vector> SceneModel::opening(const std::string& family, bool softening_only) const {
  Vector gradient = Vector::Zero(per_element() * count_);
  Real sum = 0;
  for (const auto& [law, table] : w_.laws()) {
    if (law->family() != family) continue;
    for (const Chunk& chunk : table->chunks())
      for (Index b = chunk.begin; b < chunk.live_end; ++b)
        if (!softening_only || table->state()[b] == State::softening)
          sum += add_opening(table->first()[b], table->second()[b], gradient);
  }
  if (!(sum > 0)) return std::nullopt;
  return gradient / sum;
}

// What two elements have moved against each other, where they touch, in the last step; closing does not count.
Real SceneModel::add_opening(Index i, Index j, Vector& gradient) const {
  const Real last = w_.moment().time_step;  // 0 where the last equilibrium was sought at one load: it has no rates
  const Vec3 apart = rows_.place[j] - rows_.place[i], n = apart / apart.norm();
  const Real sizes = rows_.radius[i] + rows_.radius[j];
  const Vec3 arm1 = (sizes > 0 ? rows_.radius[i] / sizes : 0.5) * apart, arm2 = arm1 - apart;
  Vec3 moved = last * (rows_.velocity[j] - rows_.velocity[i]);
  if (turning()) moved += last * (rows_.spin[j].cross(arm2) - rows_.spin[i].cross(arm1));
  moved -= std::min<Real>(0, n.dot(moved)) * n;
  gradient.segment<3>(unknown(j, 0)) += moved;
  gradient.segment<3>(unknown(i, 0)) -= moved;
  if (turning()) {
    gradient.segment<3>(unknown(j, 3)) += arm2.cross(moved) / length_;
    gradient.segment<3>(unknown(i, 3)) -= arm1.cross(moved) / length_;
  }
  return moved.norm();
}

// Places are known to the last digit of the largest of them, and so are elongations; energies of turns are small
// differences of cosines.
SceneModel::Noise SceneModel::noise_here() {
  constexpr Real epsilon = std::numeric_limits<Real>::epsilon();
  const SymmetricMatrix& k = stiffness(Slope::secant);
  Real sum = 0, square = 0;
  for (int u = 0; u < k.size(); ++u) {
    sum += std::abs(k.diagonal(u));
    square += k.diagonal(u) * k.diagonal(u);
  }
  return {epsilon * std::max(extent_, length_) * std::sqrt(square), 4 * epsilon * length_ * length_ * sum};
}

const SymmetricMatrix& SceneModel::stiffness(Slope slope) {
  constexpr Index batch = 1024;  // of bonds, whose stiffness the threads find before it is added in their order
  std::vector<Matrix12> found(batch);
  stiffness_.clear();
  const Domain& domain = w_.domain();
  for (const auto& [law, table] : w_.laws())
    for (const Chunk& chunk : table->chunks())
      for (Index begin = chunk.begin; begin < chunk.live_end; begin += batch) {
        const Index count = std::min(batch, chunk.live_end - begin);
        each_shared(
            count,
            [&, law = law, table = table](Index k) {
              found[static_cast<std::size_t>(k)] = law->tangent(domain, *table, begin + k, slope);
            },
            64);
        for (Index k = 0; k < count; ++k)
          stiffness_.add(table->first()[begin + k], table->second()[begin + k], found[static_cast<std::size_t>(k)]);
      }
  stiffness_.hold_idle();
  return stiffness_.matrix();
}

std::vector<const BondTable*> SceneModel::tables() const {
  std::vector<const BondTable*> tables;
  for (const auto& [law, table] : w_.laws()) tables.push_back(table);
  return tables;
}

// All that there are, broken or not, in an order of their own: so that the order of elimination does not depend on what has
// broken when.
std::vector<std::pair<Index, Index>> SceneModel::pairs() const {
  std::vector<std::pair<Index, Index>> all;
  for (const BondTable* table : tables())
    for (Index b = 0; b < table->size(); ++b) all.emplace_back(std::minmax(table->first()[b], table->second()[b]));
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

bool SceneModel::has_other_pairs() const {
  if (std::none_of(w_.laws().begin(), w_.laws().end(), [](const auto& l) { return l.second->is_of_contacts(); }))
    return false;
  return pairs() != pairs_;
}

const SymmetricMatrix& SceneModel::take_pairs() {
  pairs_ = pairs();
  stiffness_ = StiffnessMatrix(count_, pairs_, turning() ? length_ : 0);
  return stiffness_.matrix();
}

std::string SceneModel::axis_of(int unknown) const {
  const int axis = unknown % per_element();
  return fmt::format("{} {}", axis < 3 ? "along" : "about", "xyz"[axis % 3]);
}

}  // namespace beadwork
