#pragma once
// The parameters of a deck. A value may use other parameters, earlier or later; it is worked out when first
// asked for.

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/complaints.hpp"
#include "core/base/units.hpp"

namespace beadwork {

struct Parameter {
  std::string name, text;     ///< text: as in the deck, "${}" and all
  Location at, text_at;       ///< of the name; of the first character of the text
  bool from_library = false;  ///< it stands in an included file: may stay unused
};

class Scope {
 public:
  /// A second parameter of one name is an error at the second, naming the place of the first.
  void add(Parameter parameter, Complaints& complaints);

  /// `--set`: gives a parameter another value. Unknown: an error with a suggestion.
  void set(std::string_view name, std::string_view value, Complaints& complaints);

  /// The parameter, which counts as used from now on; or null.
  const Parameter* use(std::string_view name) const;
  bool has(std::string_view name) const { return find(name) != nullptr; }
  std::vector<std::string> names() const;  ///< in the order of the deck

  /// The value of a parameter as a quantity. Nothing if it is unknown, no quantity, or depends on itself;
  /// then there is an error at the parameter (unknown: at `asked_at`).
  std::optional<Quantity> quantity(std::string_view name, const Location& asked_at,
                                   Complaints& complaints) const;

  /// The value of a parameter as text, with every ${} in it replaced.
  std::optional<std::string> text(std::string_view name, const Location& asked_at,
                                  Complaints& complaints) const;

  /// One error for each parameter of the deck file itself that nothing has used. Call it when everything is
  /// read.
  void complain_about_unused(Complaints& complaints) const;

 private:
  enum class State { fresh, running, known, failed };
  struct Entry {
    Parameter parameter;
    mutable bool used = false;
    mutable State state = State::fresh;
    mutable std::optional<Quantity> quantity;
  };

  const Entry* find(std::string_view name) const;
  const Entry* enter(std::string_view name, const Location& asked_at, Complaints& complaints) const;
  void complain_about_circle(const Entry& entry, Complaints& complaints) const;

  std::vector<Entry> entries_;
  mutable std::vector<const Entry*> running_;  ///< those being worked out: finds circles
};

}  // namespace beadwork
