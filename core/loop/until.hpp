#pragma once
// When a stage ends.

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/loop/mark.hpp"

namespace beadwork {

/// The largest that a stage has seen of a driven set.
struct Peak {
  std::string set;
  Kept force;         ///< [N]
  Kept displacement;  ///< since the stage began [m]
};
std::vector<Peak> peaks_of(std::span<const Constraint> constraints);
void raise(std::vector<Peak>& peaks, const Moment& moment, std::span<const Constraint> constraints);

/// The number that the watcher of this name told at its last look in the stage; nothing before the first.
using Told = std::function<std::optional<Real>(const std::string& name)>;

/// Conditions joined by "or", each one of
///   1 ms            a time since the stage began
///   5000            a number of steps
///   0.8 mm          a displacement of what is pulled
///   force of right < 2 percent of its maximum      (also: displacement, > >= <=, or a value: < 3 N); what is to fall
///                   below a value must have been above it
///   sensor tip > 3 MPa    the number that a watcher told at its last look in this stage
///   time > 1 ms and displacement > 0.1 mm          a condition on time, step and displacement
class Until {
 public:
  static std::optional<Until> compile(const std::string& text, const Location& at, const Scope& scope,
                                      Complaints& complaints);

  const std::string& text() const { return text_; }
  std::string si() const;  ///< as any deck may give it
  /// A condition, and why it can never come under the constraints of a stage ("" if it can).
  struct Prospect {
    Location at;
    std::string why_never;
  };
  /// `why_untold(name)`: why the watcher of this name tells no number in the stage ("" if it does).
  std::vector<Prospect> prospects(std::span<const Constraint> constraints,
                                  const std::function<std::string(const std::string& name)>& why_untold) const;
  /// True if the stage is over.
  bool reached(const Moment& moment, std::span<const Constraint> constraints, std::span<const Peak> peaks,
               const Told& told) const;
  /// What it waits for of a watcher.
  struct Awaited {
    std::string name;
    Location at;  ///< of the name
    Dimension dimension;
    std::string value;  ///< as the deck gives it
    Location value_at;
    bool is_zero = false;  ///< without a unit: it has any
  };
  std::vector<Awaited> awaited() const;
  /// The condition that was met last, in words.
  std::string met() const { return met_; }
  /// Time [s] and number of steps after which the stage ends for certain, where that can be told beforehand.
  std::optional<Real> time() const;
  std::optional<std::int64_t> steps() const;
  std::optional<Real> displacement() const;
  /// Whether these alone end the stage, and no condition can end it sooner.
  bool is_foreseeable() const;

 private:
  enum class What { mark, watched, sensor, condition };
  struct Clause {
    What what;
    std::string text;
    Location at;
    std::string words() const;
    std::string si() const;
    std::string why_never(std::span<const Constraint> constraints) const;
    Real value = 0;  ///< of what is watched
    Mark mark;
    bool watches_force = false;
    std::string set;
    std::string comparison;
    bool of_maximum = false;
    std::optional<Expression> condition;
    Awaited awaited;
  };
  static std::optional<Clause> clause(const std::string& text, const Location& at, const Scope& scope,
                                      Complaints& complaints);
  static std::optional<Clause> watched(const std::vector<std::string>& words, const std::string& text,
                                       const Location& at, const Scope& scope, Complaints& complaints);
  static std::optional<Clause> sensed(const std::vector<std::string>& words, const std::string& text,
                                      const Location& at, const Scope& scope, Complaints& complaints);
  std::optional<Real> first(Mark::What what) const;
  static bool holds(const Clause& clause, const Moment& moment, std::span<const Constraint> constraints,
                    std::span<const Peak> peaks, const Told& told);

  std::string text_;
  std::vector<Clause> clauses_;
  mutable std::string met_;
};

}  // namespace beadwork
