#pragma once
// The loop over bonds, which every law shares. A law is a small value with
//
//   static constexpr bool turns;           // reads orientations and gives torques
//   template <Pass pass, class At, class T> Wrench<T> act(const At& at, const Ends<T>& ends) const;
//   template <class At, class T> T stored(const At& at, const Ends<T>& ends) const;      // recoverable energy [J]
//   template <class At> auto dissipated(const At& at) const;                              // if it takes any [J]
//
// `At` stands for the bonds at hand, one now and a pack of lanes later: at(column) loads their numbers, at.store(column,
// value) writes them, at.flag(mask) tells the loop that something changed for good. The law never branches on a T.

#include <variant>
#include <vector>

#include "core/mechanics/lane.hpp"
#include "core/mechanics/wrench.hpp"
#include "core/plugin/kinds.hpp"

namespace beadwork {

template <class T>
struct Ends {
  Vec<T> apart;          ///< x2 - x1 [m]
  Quaternion<T> q1, q2;  ///< identity where the law does not turn
};

struct Pass {
  bool settle = false;
  bool sections = false;
};

/// One bond.
struct One {
  using Number = Real;
  Index row = 0;
  bool* flagged = nullptr;

  Real operator()(const View<const Real>& column) const { return column[row]; }
  Vec3 operator()(const View<const Vec3>& column) const { return column[row]; }
  void store(const View<Real>& column, Real value) const { column[row] = value; }
  void store(const View<Vec3>& column, const Vec3& value) const { column.set(row, value); }
  void flag(bool mask) const { *flagged |= mask; }
};

/// The columns of the elements that the loop reads and adds to.
struct ElementViews {
  View<const Vec3> position;
  View<const Quat> orientation;
  View<Vec3> force, torque;

  static ElementViews of(Domain& domain) {
    const auto vec3 = [&](const char* name) {
      const Column* column = domain.elements().find(name);
      return column ? column->view<Vec3>() : View<Vec3>{};
    };
    ElementViews views;
    views.position = vec3("position");
    if (const Column* column = domain.elements().find("orientation")) views.orientation = column->view<Quat>();
    views.force = vec3("force");
    views.torque = vec3("torque");
    return views;
  }
};

template <bool turns>
Ends<Real> ends_of(const ElementViews& e, Index i, Index j) {
  Ends<Real> ends;
  ends.apart = e.position[j] - e.position[i];
  if constexpr (turns) {
    ends.q1 = e.orientation[i];
    ends.q2 = e.orientation[j];
  }
  return ends;
}

namespace bond_loop {

inline void clear_rows(const ElementViews& e, Index begin, Index end) {
  for (Index row = begin; row < end; ++row) {
    e.force.set(row, zero<Vec3>());
    if (e.torque) e.torque.set(row, zero<Vec3>());
  }
}

template <Pass pass, class Law>
bool run_chunk(const Law& law, const BondTable& table, const ElementViews& elements, const Chunk& chunk) {
  const auto first = table.first();
  const auto second = table.second();
  const auto target = table.target();
  const Law l = law;
  const ElementViews e = elements;
  bool flagged = false;
  for (Index b = chunk.begin; b < chunk.live_end; ++b) {
    const Index i = first[b];
    const Index k = target[b];
    const Wrench<Real> w = l.template act<pass>(One{b, &flagged}, ends_of<Law::turns>(e, i, second[b]));
    e.force.add(i, -w.force);
    e.force.add(k, w.force);
    if constexpr (Law::turns) {
      e.torque.add(i, w.torque1);
      e.torque.add(k, w.torque2);
    }
  }
  return flagged;
}

/// Runs the law over all live bonds; the chunks in which it flagged something, ascending.
template <Pass pass, class Law>
std::vector<Index> run(const Law& law, const BondTable& table, Domain& domain, bool clear) {
  const ElementViews e = ElementViews::of(domain);
  const auto chunks = static_cast<Index>(table.chunks().size());
  const Index length = block_length(domain.size());
  std::vector<char> flagged(static_cast<std::size_t>(chunks), 0);
#pragma omp parallel for schedule(static) if (chunks > 1)
  for (Index c = 0; c < chunks; ++c) {
    const Chunk& chunk = table.chunks()[static_cast<std::size_t>(c)];
    if (clear) clear_rows(e, c * length, std::min((c + 1) * length, domain.size()));
    clear_rows(e, chunk.halo_begin, chunk.halo_end);
    flagged[static_cast<std::size_t>(c)] = run_chunk<pass>(law, table, e, chunk);
  }
  std::vector<Index> list;
  for (Index c = 0; c < chunks; ++c)
    if (flagged[static_cast<std::size_t>(c)]) list.push_back(c);
  return list;
}

/// Sum of f(row) over the live bonds: each chunk in order, then the chunks in order.
template <class F>
Real sum(const BondTable& table, const F& f) {
  const auto chunks = static_cast<Index>(table.chunks().size());
  std::vector<Real> part(static_cast<std::size_t>(chunks), 0);
#pragma omp parallel for schedule(static) if (chunks > 1)
  for (Index c = 0; c < chunks; ++c) {
    const Chunk& chunk = table.chunks()[static_cast<std::size_t>(c)];
    Real total = 0;
    for (Index b = chunk.begin; b < chunk.live_end; ++b) total += f(b);
    part[static_cast<std::size_t>(c)] = total;
  }
  Real total = 0;
  for (const Real p : part) total += p;
  return total;
}

}  // namespace bond_loop

/// A bond law whose loop is the core's. The plugin builds the law as a value, with its columns, in `law()`; where the deck
/// chooses among several laws, each is a loop of its own.
template <class... Laws>
class BondLawOf : public BondLaw {
 public:
  using AnyLaw = std::variant<Laws...>;

  void act(Domain& domain, BondTable& table, const Evaluation& how) final {
    const auto flagged = std::visit(
        [&](const auto& value) {
          if (how.settle)
            return how.sections ? bond_loop::run<Pass{true, true}>(value, table, domain, how.clear)
                                : bond_loop::run<Pass{true, false}>(value, table, domain, how.clear);
          return how.sections ? bond_loop::run<Pass{false, true}>(value, table, domain, how.clear)
                              : bond_loop::run<Pass{false, false}>(value, table, domain, how.clear);
        },
        law());
    events_.clear();
    if (how.settle && !flagged.empty()) note_changes(table, flagged, events_);
  }
  std::span<const BondEvent> events() const final { return events_; }

  void withdraw(Domain& domain, const BondTable& table, Index row) final {
    std::visit(
        [&]<class Law>(const Law& value) {
          const auto e = ElementViews::of(domain);
          const Index i = table.first()[row];
          const Index j = table.second()[row];
          bool ignored = false;
          const Wrench<Real> w = value.template act<Pass{}>(One{row, &ignored}, ends_of<Law::turns>(e, i, j));
          e.force.add(i, w.force);
          e.force.add(j, -w.force);
          if constexpr (Law::turns) {
            e.torque.add(i, -w.torque1);
            e.torque.add(j, -w.torque2);
          }
        },
        law());
  }

  Real stored_energy(const Domain& domain, const BondTable& table, Index row) const final {
    return std::visit([&](const auto& value) { return stored_by(value, domain, table, row); }, law());
  }
  Real stored_energy(const Domain& domain, const BondTable& table) const final {
    return std::visit(
        [&](const auto& value) {
          return bond_loop::sum(table, [&](Index row) { return stored_by(value, domain, table, row); });
        },
        law());
  }
  Real dissipated_energy(const Domain&, const BondTable& table) const final {
    return std::visit(
        [&](const auto& value) -> Real {
          if constexpr (requires { value.dissipated(One{}); })
            return bond_loop::sum(table, [&](Index row) { return value.dissipated(One{row, nullptr}); });
          else
            return 0;
        },
        law());
  }
  bool turns() const override {
    return std::visit([]<class Law>(const Law&) { return Law::turns; }, law());
  }

 protected:
  virtual AnyLaw law() const = 0;
  /// Looks through the flagged chunks for bonds that changed for good, sets their state, and says so.
  virtual void note_changes(BondTable&, std::span<const Index>, std::vector<BondEvent>&) {}

 private:
  template <class Law>
  static Real stored_by(const Law& value, const Domain& domain, const BondTable& table, Index row) {
    bool ignored = false;
    const auto e = ElementViews::of(const_cast<Domain&>(domain));  // read only
    return value.stored(One{row, &ignored}, ends_of<Law::turns>(e, table.first()[row], table.second()[row]));
  }
  std::vector<BondEvent> events_;
};

}  // namespace beadwork
