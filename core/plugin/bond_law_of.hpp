#pragma once
// A bond law whose loop is the core's (core/bonds/loop.hpp). The plugin builds the law as a value, with its columns, in
// `law()`; where the deck chooses among several laws, each is a loop of its own.

#include <variant>
#include <vector>

#include "core/bonds/loop.hpp"
#include "core/bonds/slope.hpp"
#include "core/domain/vocabulary.hpp"
#include "core/plugin/kinds.hpp"

namespace beadwork {

/// A law that reads velocities says how they damp: a time step must be stable for it.
template <class Law>
concept SaysHowItDamps = !moves<Law>() || requires(const Law& law, const One& at, const EndsOf<Law, Real>& ends) {
  { law.damping(at, ends) } -> std::convertible_to<Matrix12>;
};

/// What it touches of the elements follows from the laws: position and force, and what laws that turn or move see.
template <class Base, class... Laws>
class PairLawOf : public Base {
  static_assert((SaysHowItDamps<Laws> && ...), "a law that moves says how it damps");

 public:
  using AnyLaw = std::variant<Laws...>;

  Reads<Vec3> position{this, field::position};
  Reads<Quat> orientation{this, field::orientation};
  Reads<Vec3> velocity{this, field::velocity};
  Reads<Vec3> spin{this, field::spin};
  Adds<Vec3> force{this, field::force};
  Adds<Vec3> torque{this, field::torque};
  Sums<Sym3> virial_sum{this, field::virial_sum};
  Sums<Real> virial_trace_sum{this, field::virial_trace_sum};

  PairLawOf() { want((Laws::turns || ...), (sees_rates<Laws>() || ...), ((Laws::turns && sees_rates<Laws>()) || ...)); }
  /// Of several laws that the deck chooses among, one is meant. A plugin that chooses more calls this too.
  void choose() override {
    const bool rates = std::visit([]<class Law>(const Law&) { return sees_rates<Law>(); }, law());
    want(turns(), rates, turns() && rates);
  }

  void act(Domain& domain, BondTable& table, const Evaluation& how) final {
    time_step_ = how.time_step;
    const auto flagged = std::visit(
        [&](const auto& value) {
          if (how.settle)
            return how.sections ? run<true, true>(value, table, domain.size(), how)
                                : run<true, false>(value, table, domain.size(), how);
          return how.sections ? run<false, true>(value, table, domain.size(), how)
                              : run<false, false>(value, table, domain.size(), how);
        },
        law());
    events_.clear();
    if (how.settle && !flagged.empty()) note_changes(table, flagged, events_);
  }
  std::span<const BondEvent> events() const final { return events_; }

  void withdraw(Domain&, const BondTable& table, Index row) final {
    std::visit(
        [&]<class Law>(const Law& value) {
          const ElementLines e = lines();
          const Index i = table.first()[row];
          const Index j = table.second()[row];
          bool ignored = false;
          e.add<Law::turns>(i, j, value.template act<Pass{}>(One{row, &ignored}, e.ends<Law>(i, j)), -1);
        },
        law());
  }

  void end(Domain&, BondTable& table, Index row) override {
    std::visit(
        [&]<class Law>(const Law& value) {
          if constexpr (requires { &Law::ended; }) {
            const ElementLines e = lines();
            const Index i = table.first()[row];
            const Index j = table.second()[row];
            e.add<Law::turns>(i, j, value.ended(One{row, nullptr}, e.ends<Law>(i, j)), -1);
          }
        },
        law());
  }

  Real stored_energy(const Domain&, const BondTable& table, Index row) const final {
    return std::visit([&](const auto& value) { return stored_by(value, lines(), table, row); }, law());
  }
  Real stored_energy(const Domain&, const BondTable& table) const final {
    return std::visit(
        [&](const auto& value) {
          const ElementLines e = lines();
          return bond_loop::sum(table, [&](Index row) { return stored_by(value, e, table, row); });
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
  bool moves() const final {
    return std::visit([]<class Law>(const Law&) { return beadwork::moves<Law>(); }, law());
  }
  Real power(const Domain&, const BondTable& table) const final {
    return std::visit([&](const auto& value) { return power_of(value, table); }, law());
  }
  Matrix12 tangent(const Domain&, const BondTable& table, Index row, Slope slope) const override {
    return std::visit(
        [&]<class Law>(const Law& value) -> Matrix12 {
          const One one{row, nullptr};
          const auto ends = lines().template ends<Law>(table.first()[row], table.second()[row]);
          return slope == Slope::consistent ? consistent_stiffness(value, one, ends)
                                            : value.stiffness(one, ends, slope);
        },
        law());
  }
  Matrix12 damping(const Domain&, const BondTable& table, Index row) const override {
    return std::visit(
        [&]<class Law>(const Law& value) -> Matrix12 {
          if constexpr (beadwork::moves<Law>())
            return value.damping(One{row, nullptr},
                                 lines().template ends<Law>(table.first()[row], table.second()[row]));
          else
            return Matrix12::Zero();
        },
        law());
  }
  bool can_be_single() const final {
    return std::visit([]<class Law>(const Law&) { return has_shift<Law>(); }, law());
  }

 protected:
  virtual AnyLaw law() const = 0;
  /// Of the step whose end is evaluated; 0 where none was made [s].
  Real time_step() const { return time_step_; }
  /// Looks through the flagged chunks for bonds that changed for good, sets their state, and says so.
  virtual void note_changes(BondTable&, std::span<const Index>, std::vector<BondEvent>&) {}

 private:
  void want(bool turns, bool rates, bool spins) {
    orientation.want(turns);
    torque.want(turns);
    velocity.want(rates);
    spin.want(spins);
  }
  ElementLines lines(Index elements = 0, bool with_sums = false) const {
    ElementViews of{
        position.view(), orientation.view(), velocity.view(), spin.view(), force.view(), torque.view(), {}, {},
        elements};
    if (with_sums) of.virial = virial_sum.view(), of.virial_trace = virial_trace_sum.view();
    return ElementLines(of);
  }
  template <bool settle, bool sections, class Law>
  std::vector<Index> run(const Law& value, const BondTable& table, Index elements, const Evaluation& how) const {
    if constexpr (has_shift<Law>())
      if (how.single)
        return bond_loop::run<Pass{settle, sections, true}>(value, table, lines(elements, how.sums), elements,
                                                            how.clear);
    return bond_loop::run<Pass{settle, sections, false}>(value, table, lines(elements, how.sums), elements, how.clear);
  }
  template <class Law>
  Real power_of(const Law& value, const BondTable& table) const {
    if constexpr (beadwork::moves<Law>()) {
      const ElementLines e = lines();
      return bond_loop::sum(table, [&](Index row) {
        bool ignored = false;
        return value.power(One{row, &ignored}, e.template ends<Law>(table.first()[row], table.second()[row]));
      });
    } else {
      return 0;
    }
  }
  template <class Law>
  static Real stored_by(const Law& value, const ElementLines& e, const BondTable& table, Index row) {
    bool ignored = false;
    return value.stored(One{row, &ignored}, e.template ends<Law>(table.first()[row], table.second()[row]));
  }
  std::vector<BondEvent> events_;
  Real time_step_ = 0;
};

/// A bond law; in a plugin: class Rope final : public BondLawOf<RopeLaw>.
template <class... Laws>
class BondLawOf : public PairLawOf<BondLaw, Laws...> {};
/// The same for contacts.
template <class... Laws>
class ContactLawOf : public PairLawOf<ContactLaw, Laws...> {};

}  // namespace beadwork
