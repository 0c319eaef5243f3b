#pragma once
// Takes the text of an expression apart: numbers with their units, names, operators. The grammar proper is
// muParser's.

#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/units.hpp"
#include "core/deck/expression.hpp"

namespace beadwork {

/// What is wrong with an expression, and at which character of its text.
struct ExpressionMistake : std::runtime_error {
  ExpressionMistake(std::size_t where, const std::string& what) : std::runtime_error(what), at(where) {}
  std::size_t at;
};

struct Token {
  enum class Kind { literal, parameter, variable, function, sign };
  Kind kind;
  std::string text;  ///< a sign as muParser shall read it: && for and, ( for ${
  std::size_t at, length;
  Quantity quantity{};       ///< of a literal
  std::size_t variable = 0;  ///< its number, of a variable
};

/// Throws ExpressionMistake, with a suggestion, for unknown names and units and for signs that mean nothing.
std::vector<Token> tokens_of(std::string_view text, const Scope& scope, std::span<const Variable> variables);

/// May a parameter have this name? Empty if so, else why not.
std::string why_no_name(std::string_view name);

}  // namespace beadwork
