#include "core/plugin/param.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "core/base/text.hpp"
#include "core/deck/pieces.hpp"
#include "core/deck/read.hpp"
#include "core/plugin/plugin.hpp"

namespace beadwork {

namespace {

std::string in_unit(Real value, const std::string& unit) {
  return unit == "1" ? format_number(value) : format_quantity(value, unit);
}

// In the unit that the parameter is declared with (N.m, where J would be as long), as far as that is one of SI.
std::string si_unit(const std::string& unit) {
  const auto found = find_unit(unit);
  if (unit == "1" || found->scale == 1) return unit;
  return unit == "deg" || unit == "degree" ? "rad" : found->dimension.name();
}

std::string si(Real value, const std::string& unit) {
  const std::string name = si_unit(unit);
  return name == "1" ? format_number(value) : format_number(value) + " " + name;
}

std::string absolute(const std::string& path) { return std::filesystem::absolute(path).lexically_normal().string(); }

bool in_range(Real value, const ParamInfo& info, const Attribute& attribute, const Scope& scope,
              Complaints& complaints) {
  if (info.range.holds(value)) return true;
  complaints.error(attribute.value_at, fmt::format("'{}' must be {}, got \"{}\"", info.name, info.range.text(info.unit),
                                                   shown_value(attribute, scope)));
  return false;
}

template <class T, class R>
bool keep_if(std::optional<R> read, T& value) {
  if (!read) return false;
  value = std::move(*read);
  return true;
}

bool take_value(const ParamInfo& info, const Attribute& a, const Scope& scope, Complaints& c, Real& value) {
  return keep_if(read_quantity(a, info.unit, scope, c), value) && in_range(value, info, a, scope, c);
}

bool take_value(const ParamInfo& info, const Attribute& a, const Scope& scope, Complaints& c, Vec3& value) {
  if (!keep_if(read_vector(a, info.unit, scope, c), value)) return false;
  for (int axis = 0; axis < 3; ++axis)
    if (!in_range(value[axis], info, a, scope, c)) return false;
  return true;
}

bool take_value(const ParamInfo& info, const Attribute& a, const Scope& scope, Complaints& c, std::int64_t& value) {
  return keep_if(read_integer(a, scope, c), value) && in_range(static_cast<Real>(value), info, a, scope, c);
}

bool take_value(const ParamInfo&, const Attribute& a, const Scope& scope, Complaints& c, bool& value) {
  return keep_if(read_boolean(a, scope, c), value);
}

bool take_value(const ParamInfo& info, const Attribute& a, const Scope& scope, Complaints& c, std::string& value) {
  if (!info.choices.empty()) return keep_if(read_choice(a, info.choices, scope, c), value);
  if (!keep_if(read_text(a, scope, c), value)) return false;
  if (info.role == Role::file) value = path_beside(a.value_at, value);
  return true;
}

bool take_value(const ParamInfo& info, const Attribute& a, const Scope& scope, Complaints& c,
                std::vector<std::string>& value) {
  if (!keep_if(info.role == Role::file ? read_paths(a, scope, c) : read_words(a, scope, c), value)) return false;
  if (info.count > 0 && static_cast<int>(value.size()) != info.count) {
    c.error(a.value_at, fmt::format("'{}' wants {} words, got {} in \"{}\"", info.name, info.count, value.size(),
                                    shown_value(a, scope)));
    return false;
  }
  if (info.choices.empty()) return true;
  for (const std::string& word : value)
    if (std::find(info.choices.begin(), info.choices.end(), word) == info.choices.end()) {
      c.error(a.value_at, fmt::format("'{}' knows no \"{}\"{}", info.name, word, did_you_mean(word, info.choices)));
      return false;
    }
  return true;
}

bool take_value(const ParamInfo& info, const Attribute& a, const Scope& scope, Complaints& c, QuantityRows& value) {
  return keep_if(read_rows(a, info.columns, scope, c), value);
}

// A quantity as it may stand for any parameter, "${2*n} mm", is more than an expression knows.
// As an expression reads it, in which a unit does not begin with a number.
std::string as_expression(Real value, const std::string& unit) {
  return unit.starts_with("1/") ? fmt::format("{}/(1 {})", format_number(value), unit.substr(2)) : si(value, unit);
}

bool take_constant(const ParamInfo& info, const Attribute& a, const Scope& scope, Complaints& c, Formula& value) {
  const auto quantity = read_quantity(a, info.unit, scope, c);
  if (quantity) value.expression = Expression::compile(as_expression(*quantity, info.unit), a.value_at, scope, {}, c);
  return value.expression.has_value();
}

bool take_expression(const ParamInfo& info, const Attribute& a, const Scope& scope, Complaints& c, Formula& value) {
  value.expression = Expression::compile(a, scope, info.variables, c);
  if (!value.expression) return false;
  const bool condition = value.expression->is_condition();
  if (info.unit.empty()) {
    if (condition) return true;
    c.error(a.value_at,
            fmt::format("'{}' wants a condition such as \"x < 1 mm\", got \"{}\"", info.name, shown_value(a, scope)));
    return false;
  }
  if (value.expression->has_dimension(find_unit(info.unit)->dimension)) return true;
  c.error(a.value_at,
          fmt::format("'{}' wants {}, got \"{}\" which is {}", info.name, wanted_by(info.unit), shown_value(a, scope),
                      condition ? "a condition" : value.expression->dimension().name()));
  return false;
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

// "13.5", "-1e-3", "5mm": no operator behind the number.
bool looks_like_number(std::string_view piece) {
  if (!piece.empty() && (piece[0] == '-' || piece[0] == '+')) piece.remove_prefix(1);
  if (piece.empty() || !(is_digit(piece[0]) || piece[0] == '.')) return false;
  for (std::size_t k = 1; k < piece.size(); ++k) {
    const bool is_sign = piece[k] == '+' || piece[k] == '-';
    if (is_sign ? (piece[k - 1] != 'e' && piece[k - 1] != 'E')
                : std::string_view("(*/<>=^").find(piece[k]) != std::string_view::npos)
      return false;
  }
  return true;
}

bool looks_like_unit(std::string_view piece, const std::vector<Variable>& variables) {
  if (piece.find_first_of("(*<>=") != piece.npos || std::string_view("+-/^").find(piece[0]) != piece.npos) return false;
  return piece != "and" && piece != "or" &&
         std::none_of(variables.begin(), variables.end(), [&](const Variable& v) { return v.name == piece; });
}

// A number or ${...}, and a unit behind it or none, or nothing: it is read, and complained of, like any quantity.
bool looks_like_quantity(const std::string& text, const std::vector<Variable>& variables) {
  ValueMistake ignored;
  const auto pieces = pieces_of(text, ignored);
  if (!pieces || pieces->size() > 2) return false;
  if (pieces->empty()) return true;
  const Piece &first = pieces->front(), &last = pieces->back();
  if (!first.is_expression && !looks_like_number(first.text)) return false;
  return pieces->size() == 1 || (!last.is_expression && looks_like_unit(last.text, variables));
}

bool take_value(const ParamInfo& info, const Attribute& a, const Scope& scope, Complaints& c, Formula& value) {
  value.text = a.value;
  const bool is_quantity = !info.unit.empty() && looks_like_quantity(a.value, info.variables);
  return is_quantity ? take_constant(info, a, scope, c, value) : take_expression(info, a, scope, c, value);
}

std::string words_of(const Real*, const ParamInfo& info) { return info.unit == "1" ? "number" : "quantity"; }
std::string words_of(const Vec3*, const ParamInfo&) { return "three numbers"; }
std::string words_of(const std::int64_t*, const ParamInfo&) { return "integer"; }
std::string words_of(const bool*, const ParamInfo&) { return "yes or no"; }
std::string words_of(const std::string*, const ParamInfo& info) {
  return info.choices.empty() ? "text" : "one of " + join(info.choices);
}
std::string words_of(const std::vector<std::string>*, const ParamInfo& info) {
  return info.count > 0 ? fmt::format("{} words", info.count) : "words";
}
std::string words_of(const QuantityRows*, const ParamInfo& info) { return "rows of " + join(info.columns, " and "); }
std::string words_of(const Formula*, const ParamInfo& info) { return info.unit.empty() ? "condition" : "formula"; }

std::string text_of_value(const Real& v, const ParamInfo& info) { return si(v, info.unit); }
std::string text_of_value(const Vec3& v, const ParamInfo& info) {
  return format_number(v[0]) + " " + format_number(v[1]) + " " + si(v[2], info.unit);
}
std::string text_of_value(const std::int64_t& v, const ParamInfo&) { return std::to_string(v); }
std::string text_of_value(const bool& v, const ParamInfo&) { return v ? "yes" : "no"; }
std::string text_of_value(const std::string& v, const ParamInfo& info) {
  return info.role == Role::file ? absolute(v) : v;
}
std::string text_of_value(const std::vector<std::string>& v, const ParamInfo& info) {
  if (info.role != Role::file) return join(v, " ");
  std::vector<std::string> paths;
  for (const std::string& path : v) paths.push_back(absolute(path));
  return text_of_paths(paths);
}
std::string text_of_value(const QuantityRows& v, const ParamInfo& info) {
  std::vector<std::string> rows;
  for (const auto& row : v) {
    std::vector<std::string> words;
    for (std::size_t k = 0; k < row.size(); ++k) words.push_back(si(row[k], info.columns[k]));
    rows.push_back(join(words, " "));
  }
  return join(rows, ", ");
}
std::string text_of_value(const Formula& v, const ParamInfo&) { return v.expression->text(); }

}  // namespace

std::string Range::text(const std::string& unit) const {
  const bool has_low = std::isfinite(low);
  const bool has_high = std::isfinite(high);
  const auto bound = [&](Real value) { return in_unit(value, unit); };
  if (has_low && has_high)
    return fmt::format("in {}{}, {}{}", without_low ? "(" : "[", bound(low), bound(high), without_high ? ")" : "]");
  if (has_low) return fmt::format("{} {}", without_low ? ">" : ">=", bound(low));
  if (has_high) return fmt::format("{} {}", without_high ? "<" : "<=", bound(high));
  return "any";
}

ParamBase::ParamBase(Plugin* owner, ParamInfo info) : info_(std::move(info)) { owner->params_.push_back(this); }

void ParamBase::read(const Attribute& attribute, const Scope& scope, Complaints& complaints) {
  at_ = attribute.value_at;
  written_ = attribute.value;
  in_deck_ = true;
  given_ = take(attribute, scope, complaints);
}

Location ParamBase::at(const std::string& word) const {
  const auto is_border = [&](std::size_t k) { return k >= written_.size() || is_blank(written_[k]); };
  for (std::size_t k = written_.find(word); !word.empty() && k != std::string::npos; k = written_.find(word, k + 1))
    if ((k == 0 || is_border(k - 1)) && is_border(k + word.size())) return locate(at_, k);
  return at_;
}

void ParamBase::read_fallback(const Location& at, const Scope& scope, Complaints& complaints) {
  at_ = at;
  if (!info_.fallback) return;
  Attribute silent;
  silent.name = info_.name;
  silent.value = *info_.fallback;
  silent.name_at = silent.value_at = at;
  given_ = take(silent, scope, complaints);
}

template <class T>
std::string Param<T>::type() const {
  return words_of(&value_, info());
}

template <class T>
std::string Param<T>::text() const {
  return text_of_value(value_, info());
}

template <class T>
std::vector<std::string> Param<T>::names() const {
  if (info().role == Role::plain || !given()) return {};
  if constexpr (std::is_same_v<T, std::string>)
    return {value_};
  else if constexpr (std::is_same_v<T, std::vector<std::string>>)
    return value_;
  else
    return {};
}

template <class T>
bool Param<T>::take(const Attribute& attribute, const Scope& scope, Complaints& complaints) {
  return take_value(info(), attribute, scope, complaints, value_);
}

template class Param<Real>;
template class Param<Vec3>;
template class Param<std::int64_t>;
template class Param<bool>;
template class Param<std::string>;
template class Param<std::vector<std::string>>;
template class Param<QuantityRows>;
template class Param<Formula>;

}  // namespace beadwork
