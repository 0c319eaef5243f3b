#include "core/deck/tokens.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>

#include "core/base/text.hpp"
#include "core/base/utf8.hpp"
#include "core/deck/operations.hpp"
#include "core/deck/scope.hpp"

namespace beadwork {

namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool starts_name(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool inside_name(char c) { return starts_name(c) || is_digit(c) || c == '.' || c == '-'; }

/// The word that stands for a sign, or "".
std::string_view sign_of_word(std::string_view word) {
  return word == "and" ? "&&" : word == "or" ? "||" : word == "not" ? "!" : "";
}

std::string quoted(std::string_view text) { return "'" + std::string(text) + "'"; }

class Lexer {
 public:
  Lexer(std::string_view text, const Scope& scope, std::span<const Variable> variables)
      : text_(text), scope_(scope), variables_(variables) {}

  std::vector<Token> run() {
    while (skip_blanks(), at_ < text_.size()) {
      if (is_digit(here()) || (here() == '.' && is_digit(peek(1))))
        number();
      else if (starts_name(here()))
        word();
      else
        sign();
    }
    if (!open_.empty()) throw ExpressionMistake(open_.back().at, "this bracket is not closed");
    return std::move(tokens_);
  }

 private:
  struct Bracket {
    std::size_t at;
    bool is_call;  // of a function: commas may stand inside
  };

  char peek(std::size_t ahead) const { return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0'; }
  char here() const { return peek(0); }
  std::string_view rest() const { return text_.substr(std::min(at_, text_.size())); }
  void skip_blanks() {
    while (at_ < text_.size() && is_blank(here())) ++at_;
  }

  void push(Token token) {
    at_ = token.at + token.length;
    tokens_.push_back(std::move(token));
  }

  // ---- 13.5 mm

  void number() {
    const std::size_t begin = at_;
    double value = 0;
    const auto [end, error] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), value);
    at_ = static_cast<std::size_t>(end - text_.data());
    if (error != std::errc() || !std::isfinite(value)) throw ExpressionMistake(begin, "this number is out of range");
    const Unit unit = unit_behind(begin);
    const std::string_view spelt = text_.substr(begin, at_ - begin);
    push({Token::Kind::literal, std::string(spelt), begin, spelt.size(), {unit.to_si(value), unit.dimension}});
  }

  /// The unit that follows a number, after blanks; one if none does.
  Unit unit_behind(std::size_t number_begin) {
    const std::size_t number_end = at_;
    skip_blanks();
    const std::string_view word = word_here();
    const bool is_unit = !word.empty() && (here() != '.') && sign_of_word(word).empty();
    if (!is_unit) {
      at_ = number_end;
      return {};
    }
    const auto found = find_leading_unit(rest());
    const std::string_view after = found ? rest().substr(found->length) : std::string_view();
    if (!found || (!after.empty() && (starts_name(after[0]) || is_digit(after[0]))))
      refuse_unit(number_begin, number_end, word);
    for (const std::string_view name : found->later_names)
      if (is_known(name))
        throw ExpressionMistake(at_, quoted(name) +
                                         " is both a unit and a name here: put blanks around the operator if you mean "
                                         "the name, or brackets around the number with its unit");
    if (after.size() > 1 && (after[0] == '/' || after[0] == '*') && starts_name(after[1]))
      check_later_unit(at_ + found->length + 1);
    if (after.starts_with('^'))
      throw ExpressionMistake(at_ + found->length,
                              "an exponent behind a unit is a number; for a power of the quantity write (" +
                                  std::string(text_.substr(number_begin, at_ + found->length - number_begin)) +
                                  ")^...");
    at_ += found->length;
    return found->unit;
  }

  /// What stands here up to a blank, bracket or comma: the way a unit is spelt.
  std::string_view word_here() const {
    if (!(starts_name(here()) || here() == '%' || static_cast<unsigned char>(here()) >= 0x80)) return {};
    const auto ends = [](char c) {
      return is_blank(c) || std::string_view("(){},<>=!&|+").find(c) != std::string_view::npos;
    };
    return rest().substr(0,
                         static_cast<std::size_t>(std::find_if(rest().begin(), rest().end(), ends) - rest().begin()));
  }

  [[noreturn]] void refuse_unit(std::size_t number_begin, std::size_t number_end, std::string_view word) const {
    const std::string name(longest_known(leading_run()));
    if (!name.empty())
      throw ExpressionMistake(at_, "an operator is missing between " +
                                       quoted(text_.substr(number_begin, number_end - number_begin)) + " and " +
                                       quoted(name));
    throw ExpressionMistake(at_, why_no_unit(word));
  }

  /// "3 N/mmm": what follows the / without a blank must be a unit or a name that exists.
  void check_later_unit(std::size_t begin) const {
    std::size_t length = 0;
    while (begin + length < text_.size() && inside_name(text_[begin + length])) ++length;
    const std::string_view run = text_.substr(begin, length);
    if (longest_known(run).empty()) throw ExpressionMistake(begin, why_no_unit(run));
  }

  // ---- Names

  std::string_view leading_run() const {
    std::size_t length = 0;
    while (length < rest().size() && inside_name(rest()[length])) ++length;
    return rest().substr(0, length);
  }

  const Variable* variable(std::string_view name) const {
    const auto found =
        std::find_if(variables_.begin(), variables_.end(), [&](const Variable& v) { return v.name == name; });
    return found == variables_.end() ? nullptr : &*found;
  }
  bool is_known(std::string_view name) const { return variable(name) || scope_.has(name); }

  /// "epoxy.radius-ratio" of "epoxy.radius-ratio-2": the longest name that exists, cut at a minus. May be
  /// empty.
  std::string_view longest_known(std::string_view run) const {
    while (!run.empty()) {
      if (is_known(run) || run == "pi" || is_function(run) || !sign_of_word(run).empty()) return run;
      const std::size_t minus = run.rfind('-');
      run = minus == std::string_view::npos ? std::string_view() : run.substr(0, minus);
    }
    return {};
  }

  void word() {
    const std::string_view run = leading_run(), name = longest_known(run);
    const std::size_t begin = at_;
    if (const std::string_view sign = sign_of_word(name); !sign.empty())
      return push({Token::Kind::sign, std::string(sign), begin, name.size()});
    if (is_function(name) && followed_by_bracket(name.size()))
      return push({Token::Kind::function, std::string(name), begin, name.size()});
    if (const Variable* found = variable(name)) {
      if (scope_.has(name))
        throw ExpressionMistake(
            begin,
            quoted(name) + " is a parameter of the deck, but a name with its own meaning here: rename the parameter");
      return push({Token::Kind::variable,
                   std::string(name),
                   begin,
                   name.size(),
                   {},
                   static_cast<std::size_t>(found - variables_.data())});
    }
    if (scope_.has(name)) return push({Token::Kind::parameter, std::string(name), begin, name.size()});
    if (name == "pi") return push({Token::Kind::literal, "pi", begin, name.size(), {std::numbers::pi, {}}});
    refuse_name(run, name);
  }

  bool followed_by_bracket(std::size_t from) const {
    while (is_blank(peek(from))) ++from;
    return peek(from) == '(';
  }

  [[noreturn]] void refuse_name(std::string_view run, std::string_view function) const {
    if (!function.empty())
      throw ExpressionMistake(at_, quoted(function) + " is a function: write " + std::string(function) + "(...)");
    const std::string_view first = run.substr(0, run.find('-'));
    if (followed_by_bracket(first.size())) throw ExpressionMistake(at_, "no function " + quoted(first));
    std::vector<std::string> names = scope_.names();
    for (const Variable& each : variables_) names.push_back(each.name);
    const bool whole_is_near = !closest(run, names).empty(), first_is_near = !closest(first, names).empty();
    const std::string_view meant = whole_is_near ? run : first;
    if (!whole_is_near && !first_is_near && find_unit(first))
      throw ExpressionMistake(
          at_, "no parameter " + quoted(first) + "; a unit needs a number before it: 1 " + std::string(first));
    throw ExpressionMistake(at_, "no parameter " + quoted(meant) + did_you_mean(meant, names));
  }

  // ---- Signs

  void sign() {
    for (const std::string_view two : {"${", "<=", ">=", "==", "!=", "&&", "||"})
      if (rest().starts_with(two)) {
        if (two == "${") open_.push_back({at_, false});
        return push({Token::Kind::sign, two == "${" ? "(" : std::string(two), at_, 2});
      }
    const char c = here();
    const bool is_call = !tokens_.empty() && tokens_.back().kind == Token::Kind::function;
    if (c == '(') open_.push_back({at_, is_call});
    if (c == ',' && (open_.empty() || !open_.back().is_call))
      throw ExpressionMistake(at_, "a comma cannot stand here; decimals have a point");
    if (c == ')' || c == '}') close(c);
    if (std::string_view("+-*/^<>(),}").find(c) == std::string_view::npos) refuse_sign(c);
    push({Token::Kind::sign, std::string(1, c == '}' ? ')' : c), at_, 1});
  }

  void close(char c) {
    if (open_.empty() || (text_[open_.back().at] == '$') != (c == '}'))
      throw ExpressionMistake(at_, std::string("no bracket is open that '") + c + "' could close");
    open_.pop_back();
  }

  [[noreturn]] void refuse_sign(char c) const {
    if (c == '=') throw ExpressionMistake(at_, "'=' means nothing here; for 'is equal' write ==");
    if (c == '?') throw ExpressionMistake(at_, "'?' means nothing here; write if(condition, then, otherwise)");
    if (c == '!') throw ExpressionMistake(at_, "'!' means nothing here; write not");
    throw ExpressionMistake(at_, named_character(rest()) + " means nothing in an expression");
  }

  std::string_view text_;
  const Scope& scope_;
  std::span<const Variable> variables_;
  std::size_t at_ = 0;
  std::vector<Bracket> open_;
  std::vector<Token> tokens_;
};

}  // namespace

std::vector<Token> tokens_of(std::string_view text, const Scope& scope, std::span<const Variable> variables) {
  return Lexer(text, scope, variables).run();
}

std::string why_no_name(std::string_view name) {
  if (name.empty()) return "is empty";
  if (!starts_name(name.front())) return "must begin with a letter";
  if (!std::all_of(name.begin(), name.end(), inside_name)) return "may hold letters, digits and . - _ only";
  if (name.back() == '-' || name.back() == '.') return "must not end with " + quoted(name.substr(name.size() - 1));
  if (name == "pi" || name == "if" || !sign_of_word(name).empty()) return "has a meaning of its own in expressions";
  return {};
}

}  // namespace beadwork
