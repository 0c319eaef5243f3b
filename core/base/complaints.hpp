#pragma once
// All complaints about a deck are gathered and shown together, so that one run of the program finds all
// mistakes.

#include <set>
#include <string>
#include <vector>

#include "core/base/location.hpp"

namespace beadwork {

class Complaints {
 public:
  void error(const Location& at, std::string message) { add(at, true, std::move(message)); }
  void warning(const Location& at, std::string message) { add(at, false, std::move(message)); }

  int errors() const { return errors_; }
  int warnings() const { return warnings_; }

  /// In the format of a compiler, with the source line and a caret below each, and the number of errors at
  /// the end. Order: by file as they first appeared, then by place; what stands nowhere comes last.
  std::string text() const;

  /// Each as it stands in text(), with its line of the deck, in the same order; all of them.
  std::vector<std::string> each() const;

  /// Throws DeckFailure(text()) if there is an error; warnings alone do not throw.
  void throw_if_any() const;

 private:
  struct Complaint {
    Location at;
    bool is_error;
    std::string message;
  };

  void add(const Location& at, bool is_error, std::string message);
  std::vector<Complaint> in_order() const;

  std::vector<Complaint> list_;
  std::set<std::string> seen_;  // the same mistake met twice is told once
  int errors_ = 0, warnings_ = 0;
};

/// Throws DeckFailure with this one complaint, place and source line shown as always: for what only a run finds out.
[[noreturn]] void refuse(const Location& at, std::string message);

}  // namespace beadwork
