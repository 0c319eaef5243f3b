#pragma once
// Section <watch>: looks and records.

#include <span>
#include <string>
#include <vector>

#include "core/domain/constraint.hpp"
#include "core/domain/moment.hpp"
#include "core/plugin/curve.hpp"
#include "core/plugin/plugin.hpp"

namespace beadwork {

/// In the place of the name of a field: all that there are.
inline constexpr const char* every_field = "all";

struct FramePlan {
  std::vector<std::string> fields;
  bool picture = false;
  std::string view = {};  ///< axes along which the report looks at the frame, "z y"; empty: it chooses
};

/// What the loop shows to a watcher.
class Sight {
 public:
  virtual ~Sight() = default;
  virtual const Domain& domain() const = 0;
  virtual const Moment& moment() const = 0;
  virtual std::span<const Constraint> constraints() const = 0;
  /// Asks every plugin for its share of the energy balance.
  virtual void energies(EnergySink& sink) const = 0;
  /// Energy that was there without any work: when the run began, and what the start of a stage has brought [J].
  virtual Real initial_energy() const = 0;
  virtual void frame(const FramePlan& plan) = 0;
};

/// A number that a watcher tells at each look, for 'until' to wait for.
class Gauge {
 public:
  virtual ~Gauge() = default;
  virtual std::string unit(const Domain&) const = 0;  ///< once the columns are there, before any rows
  virtual Real last() const = 0;                      ///< as of the last look
};

class Watcher : public Plugin {
 public:
  static constexpr Kind its_kind = Kind::watch;
  Watcher() : Plugin(its_kind) {}
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
  /// Where it tells one number under its 'name': until="sensor NAME > 3 MPa" then waits for that.
  virtual const Gauge* gauge() const { return nullptr; }

  const std::vector<Curve*>& curves() const { return curves_; }

 private:
  friend class Curve;
  std::vector<Curve*> curves_;
};

}  // namespace beadwork
