#include "core/deck/pieces.hpp"

#include <charconv>
#include <cmath>

#include "core/base/text.hpp"
#include "core/base/utf8.hpp"
#include "core/deck/deck.hpp"
#include "core/deck/expression.hpp"

namespace beadwork {

namespace {

constexpr std::size_t longest_text = 1'000'000, most_values = 10'000;

/// The bracket that closes the "${" at the beginning of text; npos if none does.
std::size_t closing(std::string_view text) {
  int open = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '{') ++open;
    if (text[i] == '}' && --open == 0) return i;
  }
  return std::string_view::npos;
}

}  // namespace

std::optional<std::vector<Piece>> pieces_of(std::string_view text, ValueMistake& mistake) {
  std::vector<Piece> pieces;
  if (text.size() > longest_text) {
    mistake = {0, "a value of more than " + std::to_string(longest_text) + " characters: data belong into a file"};
    return {};
  }
  for (std::size_t at = 0; (at = text.find_first_not_of(blanks, at)) != std::string_view::npos;) {
    const std::string_view rest = text.substr(at);
    if (rest.starts_with("${")) {
      const std::size_t end = closing(rest);
      if (end == std::string_view::npos) {
        mistake = {at, "this ${ is not closed by }"};
        return {};
      }
      pieces.push_back({rest.substr(2, end - 2), at + 2, true});
      at += end + 1;
    } else {
      const std::string_view run = rest.substr(0, rest.find_first_of(blanks)), word = run.substr(0, run.find("${"));
      pieces.push_back({word, at, false});
      at += word.size();
    }
  }
  return pieces;
}

namespace {

class PieceReader {
 public:
  PieceReader(const Location& start, const Scope& scope, Complaints& complaints, std::optional<ValueMistake>& mistake)
      : start_(start), scope_(scope), complaints_(complaints), mistake_(mistake) {}

  /// Reads one piece; false if that failed.
  bool read(const Piece& piece) {
    if (values.size() > most_values)
      return fail(piece.at, "these are more than " + std::to_string(most_values) + " values");
    return piece.is_expression ? expression(piece) : word(piece);
  }

  std::vector<Value> values;

 private:
  bool fail(std::size_t at, std::string reason = "") {
    mistake_ = ValueMistake{at, std::move(reason)};
    return false;
  }

  bool expression(const Piece& piece) {
    const std::string_view name = trim(piece.text);
    const Location at = locate(start_, piece.at);
    if (scope_.has(name)) return parameter(name, at);
    const auto compiled = Expression::compile(piece.text, at, scope_, {}, complaints_);
    if (!compiled) return false;
    if (compiled->is_condition()) return fail(piece.at, "this is a condition");
    const double value = compiled->evaluate();
    if (!std::isfinite(value)) return fail(piece.at, "this gives " + format_number(value));
    values.push_back({{value, compiled->dimension()}, compiled->dimension().is_plain(), false});
    return true;
  }

  /// A parameter that stands alone may hold several values.
  bool parameter(std::string_view name, const Location& at) {
    const auto found = scope_.values(name, at, complaints_);
    if (!found) return false;
    for (Value value : *found) {
      value.is_literal = false;
      values.push_back(value);
    }
    return true;
  }

  bool word(const Piece& piece) {
    double number = 0;
    const std::size_t sign = piece.text.starts_with('+') && !piece.text.starts_with("+-") ? 1 : 0;
    const char *const begin = piece.text.data() + sign, *const text_end = piece.text.data() + piece.text.size();
    const auto [end, error] = std::from_chars(begin, text_end, number);
    const bool is_number = end != begin && error == std::errc() && std::isfinite(number) &&
                           piece.text.find_first_of("0123456789") != std::string_view::npos;
    const std::string_view rest =
        is_number ? std::string_view(end, static_cast<std::size_t>(text_end - end)) : piece.text;
    if (error == std::errc::result_out_of_range) return fail(piece.at, "this number is out of range");
    if (is_number && rest.empty()) {
      values.push_back({{number, {}}, true, true});
      return true;
    }
    if (find_unit(piece.text) && !values.empty()) return unit(piece.text, piece.at);  // "1/s" begins like a number
    if (!is_number) return unit(piece.text, piece.at);
    if (rest.size() > 1 && rest[0] == ',') return fail(piece.at, "decimals have a point, not a comma");
    values.push_back({{number, {}}, true, true});
    return unit(rest, piece.at + static_cast<std::size_t>(end - piece.text.data()));
  }

  /// Gives the last value its unit, and all bare values before it.
  bool unit(std::string_view text, std::size_t at) {
    if (std::string_view("+-*/^()").find(text.front()) != std::string_view::npos)
      return fail(at, "arithmetic stands inside ${ }");
    if (const auto odd = first_lookalike(text))
      return fail(at + *odd, named_character(text.substr(*odd)) + " means nothing here");
    const auto found = find_unit(text);
    if (!found) return fail(at, values.empty() ? "" : why_no_unit(text));
    if (values.empty()) return fail(at, "a number is missing before the unit");
    if (!values.back().is_bare) return fail(at, "what stands before \"" + std::string(text) + "\" has a unit already");
    for (auto value = values.rbegin(); value != values.rend(); ++value) {
      if (!value->is_bare) continue;
      *value = {{found->to_si(value->quantity.value), found->dimension}, false, value->is_literal};
    }
    return true;
  }

  const Location& start_;
  const Scope& scope_;
  Complaints& complaints_;
  std::optional<ValueMistake>& mistake_;
};

}  // namespace

std::optional<std::vector<Value>> evaluate_pieces(std::string_view text, const Location& start, const Scope& scope,
                                                  Complaints& complaints, std::optional<ValueMistake>& mistake) {
  mistake.reset();
  ValueMistake unclosed;
  const auto pieces = pieces_of(text, unclosed);
  if (!pieces) {
    mistake = unclosed;
    return {};
  }
  PieceReader reader(start, scope, complaints, mistake);
  for (const Piece& piece : *pieces)
    if (!reader.read(piece)) return {};
  if (!reader.values.empty()) return std::move(reader.values);
  mistake = ValueMistake{};
  return {};
}

}  // namespace beadwork
