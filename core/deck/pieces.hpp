#pragma once
// Takes the text of a value apart: numbers, units, ${expressions}.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/deck/scope.hpp"

namespace beadwork {

/// A run of characters without blanks, or the inside of a ${}.
struct Piece {
  std::string_view text;
  std::size_t at;  ///< offset of its first character in the whole
  bool is_expression;
};

/// What is wrong with a text, at which character; an empty reason stands for "just not what is wanted".
struct ValueMistake {
  std::size_t at = 0;
  std::string reason;
};

/// Splits at blanks and around ${}. Nothing, and a mistake, if a ${ is not closed.
std::optional<std::vector<Piece>> pieces_of(std::string_view text, ValueMistake& mistake);

/// The values that a text holds. Nothing if it is none: then either `mistake` says why, or an error in an
/// expression has been complained about, which leaves `mistake` empty.
std::optional<std::vector<Value>> evaluate_pieces(std::string_view text, const Location& start, const Scope& scope,
                                                  Complaints& complaints, std::optional<ValueMistake>& mistake);

}  // namespace beadwork
