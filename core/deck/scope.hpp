#pragma once
// The parameters of a deck. A value may use other parameters, earlier or later; it is worked out when first
// asked for.

#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/complaints.hpp"
#include "core/base/units.hpp"

namespace beadwork {

struct Node;

struct Parameter {
  std::string name, text;     ///< text: as in the deck, "${}" and all
  Location at, text_at;       ///< of the name; of the first character of the text
  bool from_library = false;  ///< it stands in an included file: may stay unused
};

/// One of the values that a text such as "1 2 3 mm" or "${side}" holds.
struct Value {
  Quantity quantity;
  bool is_bare = false;     ///< a plain number to which a unit behind it may still apply
  bool is_literal = false;  ///< a number of the deck, not the result of ${}
};

class Scope {
 public:
  /// A second parameter of one name is an error at the second, naming the place of the first.
  void add(Parameter parameter, Complaints& complaints);

  /// `--set`: gives a parameter another value. Unknown: an error with a suggestion; no text in UTF-8: an error.
  void set(std::string_view name, std::string_view text, Complaints& complaints);

  bool has(std::string_view name) const { return find(name) != nullptr; }
  std::vector<std::string> names() const;  ///< in the order of the deck

  // What a parameter holds; it counts as used from then on. Nothing if it is unknown (an error at
  // `asked_at`), not what is wanted, or depends on itself (an error at the parameter).
  std::optional<Quantity> quantity(std::string_view name, const Location& asked_at, Complaints& complaints) const;
  std::optional<std::vector<Value>> values(std::string_view name, const Location& asked_at,
                                           Complaints& complaints) const;
  std::optional<std::string> text(std::string_view name, const Location& asked_at,
                                  Complaints& complaints) const;  ///< every ${} replaced

  /// One error for each parameter of the deck file itself that nothing has used. Call it when everything is read. Where
  /// there are errors already, one that is named somewhere below `root` or in a parameter may only not have been
  /// reached.
  void complain_about_unused(const Node& root, Complaints& complaints) const;

 private:
  struct Entry {
    Parameter parameter;
    mutable bool used = false;
    mutable std::optional<std::optional<std::vector<Value>>> values;  ///< once worked out
    mutable std::optional<std::optional<std::string>> text;           ///< likewise, every ${} replaced
  };

  const Entry* find(std::string_view name) const;
  std::set<std::string, std::less<>> mentioned_names(const Node& root) const;
  const Entry* start(std::string_view name, const Location& asked_at, Complaints& complaints) const;

  std::vector<Entry> entries_;                             // in the order of the deck
  std::map<std::string, std::size_t, std::less<>> index_;  // of a name in entries_
  mutable std::vector<const Entry*> running_;              ///< those being worked out, outermost first: finds circles
};

}  // namespace beadwork
