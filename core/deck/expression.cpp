#include "core/deck/expression.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/text.hpp"
#include "core/deck/deck.hpp"
#include "core/deck/grammar.hpp"
#include "core/deck/recorder.hpp"
#include "core/deck/scope.hpp"
#include "core/deck/spell.hpp"

namespace beadwork {

namespace {

constexpr std::size_t longest_text = 100000;
constexpr std::size_t most_tokens = 4000;

}  // namespace

std::optional<Expression> Expression::compile(std::string_view text, const Location& start, const Scope& scope,
                                              std::span<const Variable> variables, Complaints& complaints) {
  try {
    if (text.size() > longest_text)
      throw ExpressionMistake(0, "this expression is longer than " + std::to_string(longest_text) + " characters");
    const std::vector<Token> tokens = tokens_of(text, scope, variables);
    if (tokens.empty()) throw ExpressionMistake(0, "an expression is wanted here");
    if (tokens.size() > most_tokens)
      throw ExpressionMistake(
          0, "this expression is longer than " + std::to_string(most_tokens) + " numbers, names and signs");
    StepRecorder recorder(tokens);
    std::vector<int> handles(tokens.size(), -1);
    std::vector<Quantity> values(tokens.size());
    for (std::size_t i = 0; i < tokens.size(); ++i) {
      const Token& token = tokens[i];
      if (token.kind == Token::Kind::literal) handles[i] = recorder.constant(values[i] = token.quantity, token);
      if (token.kind == Token::Kind::variable)
        handles[i] = recorder.variable(variables[token.variable].dimension, token);
      if (token.kind != Token::Kind::parameter) continue;
      const auto quantity = scope.quantity(token.text, locate(start, token.at), complaints);
      if (!quantity) return {};
      handles[i] = recorder.constant(values[i] = *quantity, token);
    }
    const int result = record(tokens, handles, text.size(), recorder);
    const Operand& whole = recorder.at(result);
    if (whole.is_condition && std::isnan(whole.value))
      throw ExpressionMistake(whole.begin, "this condition compares what is no number");
    Expression expression;
    expression.text_ = spelt_in_si(tokens, values);
    expression.dimension_ = whole.dimension;
    expression.is_condition_ = whole.is_condition;
    expression.steps_ = std::move(recorder).steps();
    expression.steps_.resize(static_cast<std::size_t>(result) + 1);
    return expression;
  } catch (const ExpressionMistake& mistake) {
    complaints.error(locate(start, mistake.at), mistake.what());
    return {};
  }
}

std::optional<Expression> Expression::compile(const Attribute& attribute, const Scope& scope,
                                              std::span<const Variable> variables, Complaints& complaints) {
  return compile(attribute.value, attribute.value_at, scope, variables, complaints);
}

bool Expression::has_dimension(const Dimension& wanted) const {
  if (is_condition_) return false;
  const Step& last = steps_.back();
  const bool is_zero =
      dimension_.is_plain() && static_cast<Operation>(last.operation) == Operation::constant && last.value == 0;
  return is_zero || dimension_ == wanted;
}

bool Expression::uses(std::size_t variable) const {
  std::vector<int> open{static_cast<int>(steps_.size()) - 1};  // a part of a condition holds steps of the others, too
  while (!open.empty()) {
    const Step& step = steps_[static_cast<std::size_t>(open.back())];
    open.pop_back();
    const auto operation = static_cast<Operation>(step.operation);
    if (operation == Operation::variable && step.a == static_cast<int>(variable)) return true;
    const int from[] = {step.a, step.b, step.c};
    open.insert(open.end(), from, from + operands(operation));
  }
  return false;
}

std::vector<Expression> Expression::parts() const {
  const Step& last = steps_.back();
  if (static_cast<Operation>(last.operation) != Operation::both) return {*this};
  std::vector<Expression> all;
  for (const int end : {last.a, last.b}) {
    Expression part = *this;
    part.text_.clear();
    part.steps_.resize(static_cast<std::size_t>(end) + 1);
    for (Expression& each : part.parts()) all.push_back(std::move(each));
  }
  return all;
}

double Expression::evaluate(std::span<const double> si_values) const {
  constexpr std::size_t few = 64;  // steps of an everyday expression: no allocation
  std::array<double, few> on_stack;
  std::vector<double> on_heap(steps_.size() > few ? steps_.size() : 0);
  double* const values = on_heap.empty() ? on_stack.data() : on_heap.data();
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    const Step& step = steps_[i];
    const auto operation = static_cast<Operation>(step.operation);
    if (operation == Operation::constant)
      values[i] = step.value;
    else if (operation == Operation::variable)
      values[i] = si_values[static_cast<std::size_t>(step.a)];
    else
      values[i] = apply(operation, values[step.a], values[step.b], values[step.c]);
  }
  return values[steps_.size() - 1];
}

Expression::Sloped Expression::evaluate_with_slope(std::span<const double> si_values, std::size_t variable) const {
  std::vector<Sloped> all(steps_.size());
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    const Step& step = steps_[i];
    const auto operation = static_cast<Operation>(step.operation);
    if (operation == Operation::constant) {
      all[i] = {step.value, 0, 0};
    } else if (operation == Operation::variable) {
      const double value = si_values[static_cast<std::size_t>(step.a)];
      all[i] = {value, step.a == static_cast<int>(variable) ? 1.0 : 0.0, std::abs(value)};
    } else {
      const Sloped &a = all[step.a], &b = all[step.b], &c = all[step.c];
      const auto by = [&](double da, double db, double dc) {
        return slope(operation, a.value, b.value, c.value, da, db, dc);
      };
      const double value = apply(operation, a.value, b.value, c.value);
      const auto share = [](double noise) { return std::isfinite(noise) ? std::abs(noise) : 0; };
      all[i] = {value, by(a.slope, b.slope, c.slope),
                std::abs(value) + share(by(a.noise, 0, 0)) + share(by(0, b.noise, 0)) + share(by(0, 0, c.noise))};
    }
  }
  return all.back();
}

namespace {

/// A step as a straight line over one variable, where it is one.
struct Line {
  double at_zero = 0, slope = 0;
  bool is_straight = false;
  bool is_level() const { return is_straight && slope == 0; }
};

Line line_of(Operation operation, const Line& a, const Line& b, const Line& c) {
  const Line difference{a.at_zero - b.at_zero, a.slope - b.slope, a.is_straight && b.is_straight};
  switch (operation) {
    case Operation::add: return {a.at_zero + b.at_zero, a.slope + b.slope, difference.is_straight};
    case Operation::subtract: return difference;
    case Operation::negate: return {-a.at_zero, -a.slope, a.is_straight};
    case Operation::multiply:
      if (a.is_level() && b.is_straight) return {a.at_zero * b.at_zero, a.at_zero * b.slope, true};
      return {a.at_zero * b.at_zero, a.slope * b.at_zero, a.is_straight && b.is_level()};
    case Operation::divide: return {a.at_zero / b.at_zero, a.slope / b.at_zero, a.is_straight && b.is_level()};
    default: {
      const int count = operands(operation);
      const bool level = (count < 1 || a.is_level()) && (count < 2 || b.is_level()) && (count < 3 || c.is_level());
      return {level ? apply(operation, a.at_zero, b.at_zero, c.at_zero) : 0, 0, level};
    }
  }
}

/// Where this step changes from one branch to another: where the line crosses zero. It is level where there is no such
/// line.
Line switch_of(Operation operation, const Line& a, const Line& b) {
  switch (operation) {
    case Operation::absolute:
    case Operation::sign: return a.is_straight ? a : Line{};
    case Operation::less:
    case Operation::less_equal:
    case Operation::greater:
    case Operation::greater_equal:
    case Operation::equal:
    case Operation::different:
    case Operation::minimum:
    case Operation::maximum: return a.is_straight && b.is_straight ? line_of(Operation::subtract, a, b, {}) : Line{};
    default: return {};
  }
}

}  // namespace

std::vector<double> Expression::kinks(std::size_t variable) const {
  std::vector<Line> lines(steps_.size());
  std::vector<double> all;
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    const Step& step = steps_[i];
    const auto operation = static_cast<Operation>(step.operation);
    if (operation == Operation::constant) {
      lines[i] = {step.value, 0, true};
    } else if (operation == Operation::variable) {
      lines[i] = {0, 1, step.a == static_cast<int>(variable)};
    } else {
      const Line &a = lines[step.a], &b = lines[step.b], &c = lines[step.c];
      lines[i] = line_of(operation, a, b, c);
      const Line turn = switch_of(operation, a, b);
      if (const double at = -turn.at_zero / turn.slope; turn.slope != 0 && std::isfinite(at)) all.push_back(at);
    }
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

}  // namespace beadwork
