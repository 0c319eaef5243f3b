#pragma once
// What breaks: criteria judge one configuration, then their bonds fall; laws tell what has opened by itself. Each is
// logged with its mode, and its energy booked.

#include <map>

#include "core/domain/links.hpp"
#include "core/loop/balance.hpp"

namespace beadwork {

class Breaking {
 public:
  Breaking(RunState& state, Offered& offered, Fresh& fresh, Balance& balance)
      : state_(state), offered_(offered), fresh_(fresh), balance_(balance) {}

  void begin_stage() { count_live(); }
  /// Of the families that are made in this stage, what is broken from the start. Nothing has pulled at it: no energy is
  /// released, and there is no force to be taken off.
  void break_flaws(const Log& log);
  /// Whether a criterion judges at this step.
  bool is_due() const;
  /// Changes that a law itself has made while settling, such as a contact that opened. What it carried was part of the
  /// step.
  void heed_events();
  /// All criteria that are due see one configuration; only then do bonds break, each once, in the order of the deck's
  /// criteria.
  void judge();
  /// The highest utilisation at the present state, whose sections laws have told; nothing breaks.
  Real highest();
  /// Bonds that act.
  Real live() const { return live_; }

 private:
  /// What a criterion lets fall.
  using Fallen = std::pair<Failure*, std::vector<Judged>>;
  void break_flaws_of(BondTable& table, Failure& failure, const Log& log);
  void end(PairLaw& law, BondTable& table, std::span<const BondEvent> events);
  void leave(PairLaw& law, BondTable& table, const BondEvent& event);
  std::vector<Fallen> fallen();
  static void keep_highest(std::vector<Fallen>& all, const Breaks& breaks);
  void fell(const Fallen& fallen);
  void fell_bond(Failure& failure, BondTable& table, Index row, Index element);
  void fell_element(Failure& failure, Index row);
  void note(BondTable& table, Index row, const std::string& mode, Real energy, Index element = -1);
  void note_distance(BondTable& table, Index row);
  void count_live();

  RunState& state_;
  Offered& offered_;
  Fresh& fresh_;
  Balance& balance_;
  Real live_ = 0;
  std::map<const BondTable*, Links> links_;  ///< of families of which an element falls in this step
};

}  // namespace beadwork
