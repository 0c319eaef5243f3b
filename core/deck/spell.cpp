#include "core/deck/spell.hpp"

#include <cmath>

#include "core/base/text.hpp"

namespace beadwork {

namespace {

/// A unit that may stand behind a number inside of an expression, where it cannot begin with "1/".
std::string unit_of(const Dimension& dimension) {
  const std::string name = dimension.name();
  if (!name.starts_with("1/")) return name;
  std::vector<std::string> factors;
  for (const std::string& below : split(std::string_view(name).substr(2), '/')) {
    const std::size_t hat = below.find('^');
    factors.push_back(hat == std::string::npos ? below + "^-1" : below.substr(0, hat) + "^-" + below.substr(hat + 1));
  }
  return join(factors, ".");
}

class Speller {
 public:
  Speller(std::span<const Token> tokens, std::span<const Quantity> values) : tokens_(tokens), values_(values) {}

  std::string text() const {
    std::string all;
    for (std::size_t i = 0; i < tokens_.size(); ++i) {
      if (i > 0 && !sticks(i - 1, i)) all += ' ';
      all += word(i);
    }
    return all;
  }

 private:
  bool is(std::size_t i, std::string_view sign) const {
    return i < tokens_.size() && tokens_[i].kind == Token::Kind::sign && tokens_[i].text == sign;
  }

  /// A - or + that has no left side.
  bool is_prefix(std::size_t i) const {
    if (!is(i, "-") && !is(i, "+")) return false;
    return i == 0 || (tokens_[i - 1].kind == Token::Kind::sign && !is(i - 1, ")"));
  }

  /// No blank stands between these neighbours.
  bool sticks(std::size_t left, std::size_t right) const {
    if (is(right, ")") || is(right, ",")) return true;
    return is(left, "(") || is_prefix(left) || tokens_[left].kind == Token::Kind::function;
  }

  std::string word(std::size_t i) const {
    const Token& token = tokens_[i];
    if (token.kind == Token::Kind::parameter) return quantity(i, true);
    if (token.kind == Token::Kind::literal) return token.text == "pi" ? token.text : quantity(i, false);
    if (is(i, "&&")) return "and";
    if (is(i, "||")) return "or";
    if (is(i, "!")) return "not";
    return token.text;
  }

  // The value of a parameter binds like a name: a sign before it, or a power behind it, must not take a part of it.
  std::string quantity(std::size_t i, bool was_name) const {
    const Quantity& q = values_[i];
    const std::string unit = unit_of(q.dimension);
    const std::string text = format_number(q.value) + (unit == "1" ? "" : " " + unit);
    return was_name && (std::signbit(q.value) || (unit != "1" && is(i + 1, "^"))) ? "(" + text + ")" : text;
  }

  std::span<const Token> tokens_;
  std::span<const Quantity> values_;
};

}  // namespace

std::string spelt_in_si(std::span<const Token> tokens, std::span<const Quantity> values) {
  return Speller(tokens, values).text();
}

}  // namespace beadwork
