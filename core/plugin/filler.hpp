#pragma once
// Section <fill>: adds elements and sets.

#include <functional>
#include <map>
#include <memory>

#include "core/base/headway.hpp"
#include "core/base/log.hpp"
#include "core/domain/constraint.hpp"
#include "core/plugin/plugin.hpp"

namespace beadwork {

/// A packing between two steps of its filling: only those know what it is.
struct PackingInProgress;

/// What a filling plugin is told and may say.
struct FillJob {
  std::uint64_t seed;
  const Log& log;
  std::function<void(const std::string& json)> report;  ///< a packing report, a JSON object
  /// To be called now and then in long work: throws Interrupted if the user wants to stop.
  std::function<void()> pause = [] {};
  /// To be called now and then in long work: how far it has come.
  TellHeadway progress = [](const Headway&) {};
  /// What the steps of one filling hand on to one another, by the name of the set that is filled.
  std::map<std::string, std::shared_ptr<PackingInProgress>>* in_progress = nullptr;
};

/// Adds elements and sets; runs once, before all else, in the deck's order.
class Filler : public Plugin {
 public:
  static constexpr Kind its_kind = Kind::fill;
  Filler() : Plugin(its_kind) {}
  virtual void fill(Domain& domain, const FillJob& job) = 0;
  /// Once all have made their elements: warns of what was begun and never finished.
  virtual void conclude(const FillJob&) {}
  /// True for what looks at the finished packing (sets by region): it runs behind all others, in the deck's order.
  virtual bool after_filling() const { return false; }
  /// True for what makes sets of rigid walls, and no elements that have a size.
  virtual bool makes_walls() const { return false; }
  /// How it holds what it makes by itself, along axes along which no load of a stage does.
  virtual std::vector<Constraint> constraints() const { return {}; }
};

}  // namespace beadwork
