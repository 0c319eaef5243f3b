#pragma once
// Which elements may touch: looked for when a stage begins, when something has moved by half a skin, and when a bond has
// broken, always between two steps.

#include <map>

#include "core/loop/run_state.hpp"

namespace beadwork {

class Contacts {
 public:
  Contacts(RunState& state, const Log& log) : state_(state), log_(log) {}

  /// The pairs of the contact laws of the stage, anew; after a restart those that were kept.
  void begin_stage();
  void resume_stage();
  /// Before a step: pairs are found anew where they may be too old for it. Throws PhysicsFailure if an element moves
  /// by more than half a skin in a step.
  void follow();
  /// How far an element may move in a step for that [m]; infinite in a stage without contacts.
  Real reach() const { return narrowest_ / longer; }

 private:
  void search();
  Real ahead(Real speed) const;
  bool are_old() const;
  bool have_walls_turned() const;
  std::vector<std::pair<Index, Index>> held_pairs() const;
  bool are_of_one_chain(const Near& pair) const;
  std::map<std::pair<Index, Index>, Real> broken_pairs() const;
  void warn_of_two_laws() const;
  void warn_of_deep_starts(const std::map<const ContactLaw*, std::vector<std::pair<Index, Index>>>& before) const;
  std::vector<std::pair<Index, Index>> released_pairs() const;
  std::string fastest() const;
  void meet_and_part(ContactLaw& law, BondTable& table, const std::vector<std::pair<Index, Index>>& bonded);
  Real skin(const ContactLaw& law) const;

  static constexpr Real longer = 1.5;  ///< the step to come is as long as the last one, or half again
  RunState& state_;
  const Log& log_;
  std::vector<Index> chain_;  ///< of each element that is part of a fibre, else -1; empty where there are none
  bool begins_ = false;       ///< the search at the start of a stage is on
  Real narrowest_ = 0;        ///< half of the narrowest skin of the stage [m]
};

}  // namespace beadwork
