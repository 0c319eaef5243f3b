#include "core/deck/read.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/text.hpp"
#include "core/deck/expression.hpp"
#include "core/deck/pieces.hpp"

namespace beadwork {

namespace {

constexpr std::size_t most_words = 10'000;

std::string quoted(std::string_view text) { return "\"" + std::string(text) + "\""; }

bool is_angle(std::string_view unit) { return unit == "rad" || unit == "deg" || unit == "degree"; }

Dimension dimension_of(std::string_view unit) {
  const auto found = find_unit(unit);
  if (!found) throw std::invalid_argument("a parameter is declared with an " + why_no_unit(unit));
  return found->dimension;
}

/// Says what an attribute wants and what it got instead.
class Refusal {
 public:
  Refusal(const Attribute& attribute, std::string wanted, const Scope& scope, Complaints& complaints)
      : attribute_(attribute), wanted_(std::move(wanted)), scope_(scope), complaints_(complaints) {}

  std::nullopt_t operator()(const std::string& behind = "", std::size_t at = 0) const {
    const bool of_the_text = behind.starts_with(":");  // how it is written, not what it gives
    const std::string got = trim(attribute_.value).empty()
                                ? "nothing"
                                : quoted(of_the_text ? attribute_.value : shown_value(attribute_, scope_));
    complaints_.error(attribute_.place(at), "'" + attribute_.name + "' wants " + wanted_ + ", got " + got + behind);
    return std::nullopt;
  }

 private:
  const Attribute& attribute_;
  std::string wanted_;
  const Scope& scope_;
  Complaints& complaints_;
};

/// What is wrong with a value where `unit` is wanted, as the end of a sentence; nothing if all is well.
std::optional<std::string> objection(const Value& value, std::string_view unit, bool is_one_of_many) {
  const bool has_no_unit = value.is_literal && value.is_bare;
  const Dimension& got = value.quantity.dimension;
  if (got == dimension_of(unit) && !(is_angle(unit) && has_no_unit)) return {};
  if (!has_no_unit) return " which is " + (got.is_plain() ? "a plain number" : got.name());
  if (is_one_of_many) return ": " + format_number(value.quantity.value) + " has no unit";
  const bool shows_an_example = wanted_by(unit).find("such as") != std::string::npos;
  return shows_an_example ? "" : " without a unit";
}

/// Values whose units are these in turn.
std::optional<std::vector<double>> read_values(const Attribute& attribute, const std::vector<std::string_view>& units,
                                               const Scope& scope, Complaints& complaints, const Refusal& refuse) {
  std::optional<ValueMistake> mistake;
  const auto values = evaluate_pieces(attribute.value, attribute.value_at, scope, complaints, mistake);
  if (mistake) return refuse(mistake->reason.empty() ? "" : ": " + mistake->reason, mistake->at);
  if (!values) return {};
  std::vector<double> result;
  for (const Value& each : *values) {
    const bool is_zero = each.quantity.value == 0 && each.quantity.dimension.is_plain();  // has any unit
    const auto why = is_zero ? std::nullopt : objection(each, units[result.size() % units.size()], values->size() > 1);
    if (why) return refuse(*why);
    if (!std::isfinite(each.quantity.value)) return refuse(": it is out of range");
    result.push_back(each.quantity.value);
  }
  return result;
}

}  // namespace

std::string shown_value(const Attribute& attribute, const Scope& scope) {
  Complaints ignored;
  const auto text = text_of(attribute.value, attribute.value_at, scope, ignored);
  return text ? *text : attribute.value;
}

std::string wanted_by(std::string_view unit) {
  struct Noun {
    const char *unit, *noun, *example;
  };
  constexpr Noun nouns[] = {{"m", "a length", "1 mm"},
                            {"s", "a time", "1 us"},
                            {"kg", "a mass", "1 g"},
                            {"m/s", "a velocity", "0.1 m/s"},
                            {"kg/m^3", "a density", "1200 kg/m^3"}};
  if (is_angle(unit)) return "an angle such as \"30 degree\"";
  const Dimension dimension = dimension_of(unit);
  if (dimension.is_plain()) return "a plain number";
  for (const Noun& each : nouns)
    if (dimension == dimension_of(each.unit)) return std::string(each.noun) + " such as " + quoted(each.example);
  return std::string(unit);
}

std::optional<double> read_quantity(const Attribute& attribute, std::string_view unit, const Scope& scope,
                                    Complaints& complaints) {
  const Refusal refuse(attribute, wanted_by(unit), scope, complaints);
  const auto values = read_values(attribute, {unit}, scope, complaints, refuse);
  if (!values) return {};
  if (values->size() != 1) return refuse(" which are " + std::to_string(values->size()) + " values");
  return values->front();
}

std::optional<Vec3> read_vector(const Attribute& attribute, std::string_view unit, const Scope& scope,
                                Complaints& complaints) {
  const std::string example = dimension_of(unit).is_plain() ? "1 0 0" : "1 0 0 " + std::string(unit);
  const Refusal refuse(attribute, "three values such as " + quoted(example), scope, complaints);
  const auto values = read_values(attribute, {unit}, scope, complaints, refuse);
  if (!values) return {};
  if (values->size() != 3)
    return refuse(values->size() == 1 ? " which is one value"
                                      : " which are " + std::to_string(values->size()) + " values");
  return Vec3((*values)[0], (*values)[1], (*values)[2]);
}

namespace {

/// Where the commas stand that are not inside of brackets.
std::vector<std::size_t> commas_of(std::string_view text) {
  std::vector<std::size_t> commas;
  int open = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '(' || text[i] == '{') ++open;
    if (text[i] == ')' || text[i] == '}') --open;
    if (text[i] == ',' && open == 0) commas.push_back(i);
  }
  return commas;
}

}  // namespace

std::optional<std::vector<std::vector<double>>> read_rows(const Attribute& attribute,
                                                          const std::vector<std::string>& units, const Scope& scope,
                                                          Complaints& complaints) {
  std::vector<std::string> example;
  for (const std::string& unit : units) example.push_back("1 " + unit);
  const std::vector<std::string_view> in_turn(units.begin(), units.end());
  std::vector<std::size_t> ends = commas_of(attribute.value);
  ends.push_back(attribute.value.size());
  std::vector<std::vector<double>> rows;
  bool all_right = true;
  Location here = attribute.value_at;  // from row to row: a table may be long
  for (std::size_t begin = 0, passed = 0; const std::size_t end : ends) {
    const std::string text = attribute.value.substr(begin, end - begin);
    const std::size_t first = std::min(text.find_first_not_of(" \t\r\n"), text.size());
    here = locate(here, begin + first - passed);
    passed = begin + first;
    const Attribute row{attribute.name, std::string(trim(text)), attribute.name_at, here};
    const Refusal refuse(row, "rows such as " + quoted(join(example, " ")), scope, complaints);
    auto values = read_values(row, in_turn, scope, complaints, refuse);
    const bool fits = values && values->size() == units.size();
    if (values && !fits)
      refuse(values->size() == 1 ? " which is one value" : " which are " + std::to_string(values->size()) + " values");
    all_right = all_right && fits;
    if (fits) rows.push_back(std::move(*values));
    begin = end + 1;
  }
  if (!all_right) return {};
  return rows;
}

std::optional<std::int64_t> read_integer(const Attribute& attribute, const Scope& scope, Complaints& complaints) {
  constexpr double largest = 9007199254740992.0;  // 2^53: up to here a double holds every whole number
  const Refusal refuse(attribute, "a whole number", scope, complaints);
  const auto values = read_values(attribute, {"1"}, scope, complaints, refuse);
  if (!values) return {};
  if (values->size() != 1) return refuse(" which are " + std::to_string(values->size()) + " values");
  const double value = values->front();
  if (value != std::floor(value) || std::abs(value) > largest) return refuse();
  return static_cast<std::int64_t>(value);
}

std::optional<std::string> read_text(const Attribute& attribute, const Scope& scope, Complaints& complaints) {
  const auto text = text_of(attribute.value, attribute.value_at, scope, complaints);
  if (!text) return {};
  if (!trim(*text).empty()) return std::string(trim(*text));
  complaints.error(attribute.value_at, "'" + attribute.name + "' is empty");
  return {};
}

std::optional<std::vector<std::string>> read_words(const Attribute& attribute, const Scope& scope,
                                                   Complaints& complaints) {
  const auto text = read_text(attribute, scope, complaints);
  if (!text) return {};
  std::vector<std::string> words = split_words(*text);
  if (words.size() <= most_words) return words;
  complaints.error(attribute.value_at, "'" + attribute.name + "' holds more than " + std::to_string(most_words) +
                                           " words: data belong into a file");
  return {};
}

std::optional<std::vector<std::string>> read_paths(const Attribute& attribute, const Scope& scope,
                                                   Complaints& complaints) {
  const auto text = read_text(attribute, scope, complaints);
  if (!text) return {};
  std::vector<std::string> paths;
  for (std::string_view rest = trim(*text); !rest.empty(); rest = trim(rest)) {
    const bool quotes = rest.front() == '\'' || rest.front() == '"';
    const std::size_t end = quotes ? rest.find(rest.front(), 1) : std::min(rest.find_first_of(blanks), rest.size());
    if (end == std::string_view::npos) {
      complaints.error(attribute.value_at,
                       "'" + attribute.name + "' has a quote that is not closed, got " + quoted(*text));
      return {};
    }
    paths.push_back(path_beside(attribute.value_at, std::string(rest.substr(quotes ? 1 : 0, quotes ? end - 1 : end))));
    rest.remove_prefix(quotes ? end + 1 : end);
  }
  return paths;
}

std::string text_of_paths(const std::vector<std::string>& paths) {
  std::vector<std::string> words;
  for (const std::string& path : paths) {
    const bool plain = path.find_first_of(std::string(blanks) + "'\"") == std::string::npos;
    const char quote = path.find('\'') == std::string::npos ? '\'' : '"';
    words.push_back(plain ? path : quote + path + quote);
  }
  return join(words, " ");
}

std::optional<std::string> read_choice(const Attribute& attribute, const std::vector<std::string>& allowed,
                                       const Scope& scope, Complaints& complaints) {
  const auto text = read_text(attribute, scope, complaints);
  if (!text) return {};
  for (const std::string& each : allowed)
    if (each == *text) return each;
  const std::string near = closest(*text, allowed);
  return Refusal(attribute, join(allowed, " or "), scope,
                 complaints)(near.empty() ? "" : ". Did you mean '" + near + "'?");
}

std::optional<bool> read_boolean(const Attribute& attribute, const Scope& scope, Complaints& complaints) {
  const auto text = read_text(attribute, scope, complaints);
  if (!text) return {};
  if (*text == "yes" || *text == "true") return true;
  if (*text == "no" || *text == "false") return false;
  return Refusal(attribute, "yes or no", scope, complaints)();
}

namespace {

/// The text of a parameter, or the value of an expression.
std::optional<std::string> substituted(std::string_view inside, const Location& at, const Scope& scope,
                                       Complaints& complaints) {
  const std::string_view name = trim(inside);
  if (scope.has(name)) return scope.text(name, at, complaints);
  const auto compiled = Expression::compile(inside, at, scope, {}, complaints);
  if (!compiled) return {};
  return format_quantity(Quantity{compiled->evaluate(), compiled->dimension()});
}

}  // namespace

std::optional<std::string> text_of(std::string_view text, const Location& start, const Scope& scope,
                                   Complaints& complaints) {
  constexpr std::size_t longest = 100000;
  std::string result;
  ValueMistake mistake;
  const auto pieces = pieces_of(text, mistake);
  if (!pieces) {
    complaints.error(locate(start, mistake.at), mistake.reason);
    return {};
  }
  std::size_t copied = 0;
  for (const Piece& piece : *pieces) {
    if (!piece.is_expression) continue;
    const auto value = substituted(piece.text, locate(start, piece.at), scope, complaints);
    if (!value) return {};
    result += std::string(text.substr(copied, piece.at - 2 - copied)) + *value;
    copied = piece.at + piece.text.size() + 1;
    if (result.size() <= longest) continue;
    complaints.error(start, "this text becomes longer than " + std::to_string(longest) + " characters");
    return {};
  }
  return result + std::string(text.substr(copied));
}

}  // namespace beadwork
