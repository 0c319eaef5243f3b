#pragma once
// The kinds of plugins: in which section of a deck each stands, when it runs, and what it may change.

#include <algorithm>
#include <any>
#include <functional>
#include <limits>
#include <map>
#include <span>

#include "core/base/headway.hpp"
#include "core/base/log.hpp"
#include "core/base/parallel.hpp"
#include "core/domain/kept.hpp"
#include "core/domain/moment.hpp"
#include "core/mechanics/ramp.hpp"
#include "core/mechanics/stiffness.hpp"
#include "core/plugin/blame.hpp"
#include "core/plugin/plugin.hpp"

namespace beadwork {

// ---------------------------------------------------------------------------------------------------- fill

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
  std::map<std::string, std::any>* in_progress = nullptr;
};

/// Adds elements and sets; runs once, before all else, in the deck's order.
class Filler : public Plugin {
 public:
  static constexpr Kind kind = Kind::fill;
  virtual void fill(Domain& domain, const FillJob& job) = 0;
  /// Once all have made their elements: warns of what was begun and never finished.
  virtual void conclude(const FillJob&) {}
  /// True for what looks at the finished packing (sets by region): it runs behind all others, in the deck's order.
  virtual bool after_filling() const { return false; }
};

// ---------------------------------------------------------------------------------------------------- bond

/// One evaluation of the forces.
struct Evaluation {
  bool clear = false;     ///< the first family of the evaluation overwrites the sums instead of adding
  bool settle = false;    ///< the state is accepted: write what is kept
  bool sections = false;  ///< somebody reads what the law offers of each bond (axial force, moments, ...)
  bool single = false;    ///< forces in single precision, of laws that can
};

/// A bond that changed for good while settling.
struct BondEvent {
  Index row;
  std::string mode;  ///< under which its break is logged; "" of a change that is no break
  Real energy;       ///< [J]
};

class BondLaw : public Plugin {
 public:
  static constexpr Kind kind = Kind::bond;
  Param<std::string> name{this, {.name = "name", .doc = "Name of the family of bonds", .role = Role::makes_family}};
  Param<std::vector<std::string>> between{
      this,
      {.name = "between",
       .doc = "The two sets that are bonded; one and the same for bonds inside a set",
       .role = Role::set,
       .count = 2}};
  Param<Real> gap{
      this,
      {.name = "gap",
       .range = {0, 100},
       .doc = "Largest distance between the surfaces of two elements that are bonded, over the sum of their radii",
       .fallback = "1e-3"}};
  Param<std::string> neighbours{this,
                                {.name = "neighbours",
                                 .doc = "Which elements within 'gap' are bonded: all, or the next only, none over a "
                                        "third that lies between the two: for a row of elements that overlap",
                                 .fallback = "all",
                                 .choices = {"all", "next"}}};

  std::string family() const override { return *name; }

  /// Pairs that are to be bonded, at the start of the stage in which the family first stands.
  virtual bool accepts(const Domain&, Index, Index) const { return true; }
  /// Sets the rest state of the rows just made. Throws DeckFailure where that is impossible.
  virtual void connect(Domain& domain, BondTable& table) = 0;
  /// What the log says once of the bonds just made.
  virtual std::string remark() const { return ""; }
  /// What the log warns of once, at the bonds just made: that they will not do what the deck seems to want; "" for
  /// nothing.
  virtual std::string caution() const { return ""; }
  /// Adds the forces of all live bonds to the elements: a pure function of the state and the accepted history.
  virtual void act(Domain& domain, BondTable& table, const Evaluation& evaluation) = 0;
  /// Takes the forces of one bond off the sums again: it has just broken, at this configuration.
  virtual void withdraw(Domain& domain, const BondTable& table, Index row) = 0;
  /// Bonds whose state changed while settling in the last `act`; empty at nearly all steps.
  virtual std::span<const BondEvent> events() const { return {}; }
  /// After such an event, once the step is complete: takes off the sums what acted in this step and acts no more from
  /// here on. A force that ended within a step would take half a step's work from the balance.
  virtual void end(Domain&, BondTable&, Index /*row*/) {}
  /// Recoverable energy of one bond [J].
  virtual Real stored_energy(const Domain& domain, const BondTable& table, Index row) const = 0;
  /// Sum over the live bonds, in a fixed order [J].
  virtual Real stored_energy(const Domain& domain, const BondTable& table) const = 0;
  /// Energy that the law itself has taken for good [J].
  virtual Real dissipated_energy(const Domain&, const BondTable&) const { return 0; }
  /// Stiffness of one bond about the present state, rows and columns (x1, theta1, x2, theta2). Asked by several threads
  /// at once.
  virtual Matrix12 tangent(const Domain& domain, const BondTable& table, Index row) const = 0;
  /// True if the force depends on velocities, and on spins where it turns.
  virtual bool moves() const { return false; }
  /// How the force of such a law opposes velocities, beside the tangent: loads = -C rates, rates (v1, w1, v2, w2),
  /// symmetric. The largest that it can become: a time step must be stable for it. Asked by several threads at once.
  virtual Matrix12 damping(const Domain&, const BondTable&, Index) const { return Matrix12::Zero(); }
  /// Power that such forces take at the present velocities, over the live bonds [W].
  virtual Real power(const Domain&, const BondTable&) const { return 0; }
  /// True if the tangent has rotational parts.
  virtual bool turns() const { return true; }
  /// True if forces can be found in single precision.
  virtual bool can_be_single() const { return false; }
  /// True if broken bonds still act (a cohesive contact still resists closing): they stay among the live rows.
  virtual bool acts_when_broken() const { return false; }
};

// ---------------------------------------------------------------------------------------------------- load

enum class Grip {
  each,  ///< every element of the set moves alike
  mean,  ///< the mean over the set does; each element is free otherwise
};

/// Rows (element, axis, coefficient) = value(t).
struct Constraint {
  std::string by;     ///< id of the load
  std::string place;  ///< of the load in the deck; set by the loop
  std::string set;
  int axis = 0;  ///< 0 x, 1 y, 2 z; 3 4 5 the turns about them, which can be held only
  Grip grip = Grip::each;
  bool driven = false;                           ///< it moves (pull), as against holding still
  std::function<PrescribedMotion(Real)> motion;  ///< displacement, velocity, acceleration by the time since it began
  Real reach = std::numeric_limits<Real>::infinity();  ///< farthest that it ever gets from where it has been [m]
  Real began = 0;                                      ///< start of the first stage in which the load stands [s]
  Kept reaction;  ///< sum of the forces that keep it, at the last accepted step [N]
  Kept work;      ///< of these forces so far [J]

  /// Throws PhysicsFailure, with the load's place in the deck, if the motion fails or is no number.
  PrescribedMotion at(Real time) const;
};

class Load : public Plugin {
 public:
  static constexpr Kind kind = Kind::load;
  /// Before the first `start` of the stage: clears what the starts of several loads add up.
  virtual void clear(Domain&) {}
  /// Once, at the start of its stage: initial velocities and the like.
  virtual void start(Domain&) {}
  virtual std::vector<Constraint> constraints() const { return {}; }
  /// Adds forces, at every evaluation.
  virtual void push(Domain&, const Moment&) {}
  /// After every accepted step: accumulates the work of `push`. Velocities and spins stand for the end of the step
  /// where the load declares that it `Reads` them (`Keeps` does not count), or a derived field that is found from them.
  virtual void account(const Domain&, const Moment&) {}
};

// ---------------------------------------------------------------------------------------------------- move

/// What the loop lends to a mover.
class Workings {
 public:
  virtual ~Workings() = default;
  virtual Domain& domain() = 0;
  virtual Moment& moment() = 0;
  virtual std::vector<Constraint>& constraints() = 0;
  /// Sums of all forces and torques into the fields `force` and `torque`.
  virtual void evaluate(bool settle) = 0;
  /// The laws that act in this stage, each with its table.
  virtual std::span<const std::pair<BondLaw*, BondTable*>> laws() const = 0;
  virtual Log& log() = 0;
};

class Mover : public Plugin {
 public:
  static constexpr Kind kind = Kind::move;
  Param<std::string> until{
      this,
      {.name = "until",
       .doc = "When the stage ends: a time (1 ms), a number of steps (5000), a displacement of what is pulled (0.8 "
              "mm), or a condition such as \"force of right < 2 percent of its maximum\"; several are joined by 'or'",
       .optional = true}};

  /// Told before anything is allocated: whether some plugin reads orientations or adds torques.
  virtual void choose_rotations(bool wanted) = 0;
  /// Complains of a stage that it cannot advance; `any_law`: bonds act in it.
  virtual void check_stage(const std::string& /*stage*/, bool /*any_law*/, Complaints&) const {}
  /// Before the first step of the stage: forces at the present state, time step. After a restart (`resumed`) both are
  /// what was kept.
  virtual void prepare(Workings& workings, bool resumed) = 0;
  /// One accepted step. Velocities and spins may be left behind, until somebody wants to see them.
  virtual void step(Workings& workings) = 0;
  /// Brings velocities and spins to the end of the step.
  virtual void complete(Workings&) {}
  /// Whether bonds act in single precision, where their law can.
  virtual bool in_single() const { return false; }
  /// Energy by which the balance swings at the present state although nothing is wrong: what the scheme keeps is not
  /// the energy itself but the energy less this [J].
  virtual Real swing() const { return 0; }
  /// The part of it that follows from the present forces alone, and so jumps where something breaks [J].
  virtual Real shadow_energy() const { return 0; }
  /// What is probably wrong where the balance has an excess of energy that no work accounts for.
  virtual std::string suspect() const { return "a law's force is probably not the slope of its stored energy"; }
  /// For `plan`: the time step [s] and what limits it.
  virtual Real time_step() const = 0;
  virtual std::string limited_by() const { return ""; }
};

// ---------------------------------------------------------------------------------------------------- fail

/// What a criterion finds among the bonds of its family.
struct Verdict {
  std::vector<Index> fallen;  ///< rows of the bonds that break, ascending
  Real largest = 0;           ///< utilisation: what the criterion finds over its threshold
  Index row = -1;             ///< of the bond that has it; -1 where none has any
};

class Failure : public Plugin {
 public:
  static constexpr Kind kind = Kind::fail;
  Param<std::string> of{this, {.name = "of", .doc = "The family of bonds that may break", .role = Role::family}};
  Param<std::int64_t> every{
      this, {.name = "every", .range = {1}, .doc = "Steps from one check to the next", .fallback = "1"}};
  Writes<Real> utilisation{this, field_utilisation()};

  std::string family() const override { return *of; }
  /// All bonds are judged on one configuration, so that no order matters. Also called at other steps than those of
  /// `every`, for those who want to see utilisations; then nothing breaks.
  virtual Verdict judge(const Domain& domain, const BondTable& table) = 0;
  /// Name of the way in which bonds break, for the log.
  virtual std::string mode() const = 0;

 protected:
  /// The pass over the live bonds, which the threads share: f(row) is the utilisation of a bond, which breaks from 1
  /// on. Written where somebody reads it; of several criteria for one family the largest.
  template <class F>
  Verdict judge_each(const BondTable& table, const F& f) const {
    std::vector<Verdict> parts(table.chunks().size());
    each_shared(static_cast<Index>(parts.size()), [&](Index c) {
      const Chunk& chunk = table.chunks()[static_cast<std::size_t>(c)];
      Verdict part;
      for (Index b = chunk.begin; b < chunk.live_end; ++b) {
        const Real use = f(b);
        if (utilisation) utilisation[b] = std::max(utilisation[b], use);
        if (use > part.largest) part.largest = use, part.row = b;
        if (use >= 1) part.fallen.push_back(b);
      }
      parts[static_cast<std::size_t>(c)] = std::move(part);
    });
    Verdict all;
    for (const Verdict& part : parts) {
      all.fallen.insert(all.fallen.end(), part.fallen.begin(), part.fallen.end());
      if (part.largest > all.largest) all.largest = part.largest, all.row = part.row;
    }
    return all;
  }

 private:
  static const Field& field_utilisation();
};

// -------------------------------------------------------------------------------------------------- derive

/// Provides a field that somebody reads, in just the steps in which it is read.
class Derived : public Plugin {
 public:
  static constexpr Kind kind = Kind::derive;
  virtual void derive(Domain& domain) = 0;
};

// --------------------------------------------------------------------------------------------------- watch

/// A table that grows by a row now and then and ends up as a CSV file.
class CurveSink {
 public:
  virtual ~CurveSink() = default;
  virtual void row(std::span<const Real> values) = 0;
};

/// What the columns of a curve are, and how it is drawn.
struct CurvePlan {
  std::string name;
  std::vector<std::pair<std::string, std::string>> columns;  ///< (name, unit), behind step and time
  std::string title;
  std::string x;  ///< column on the abscissa; empty is time
  std::vector<std::string> y;
  std::vector<std::string> references;  ///< files of reference data, from the deck's folder
  std::string kind;                     ///< "ledger" for an energy balance
};

/// In the place of the name of a field: all that there are.
inline constexpr const char* every_field = "all";

struct FramePlan {
  std::vector<std::string> fields;
  bool picture = false;
  std::string view = {};  ///< axis along which the report looks at the frame: x, y, z; empty: it chooses
};

/// What the loop shows to a watcher.
class Sight {
 public:
  virtual ~Sight() = default;
  virtual const Domain& domain() const = 0;
  virtual const Moment& moment() const = 0;
  virtual std::span<const Constraint> constraints() const = 0;
  virtual const BondLaw* law(const std::string& family) const = 0;
  /// Asks every plugin for its share of the energy balance.
  virtual void energies(EnergySink& sink) const = 0;
  /// Energy that was there without any work: when the run began, and what the start of a stage has brought [J].
  virtual Real initial_energy() const = 0;
  virtual CurveSink& curve(const CurvePlan& plan) = 0;
  virtual void frame(const FramePlan& plan) = 0;
};

class Watcher : public Plugin {
 public:
  static constexpr Kind kind = Kind::watch;
  Param<std::int64_t> every{
      this,
      {.name = "every", .range = {1}, .doc = "Steps from one record to the next", .fallback = "100", .instead = "at"}};
  Param<std::string> moments{
      this,
      {.name = "at",
       .doc = "Single moments to record, separated by commas: times (1 ms), numbers of steps (5000) or displacements "
              "of what is pulled (0.3 mm), counted from the start of the stage as in 'until'; 'end' is the end of the "
              "stage, which is always recorded; beside 'every' or instead of it",
       .optional = true}};
  /// True if the watcher looks at this step for its cadence; the loop sees to the moments of 'at' and to the end of the
  /// stage, and brings up to date what the watcher reads.
  virtual bool wants(const Moment& moment) const { return every.given() && moment.step % *every == 0; }
  /// Complains of what it would look for in vain: `constraints` are those of all stages in which it stands.
  virtual void check_stages(std::span<const Constraint> /*constraints*/, Complaints&) const {}
  virtual void look(Sight& sight) = 0;
};

}  // namespace beadwork
