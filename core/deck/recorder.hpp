#pragma once
// Records the steps of an expression while muParser calls for them, checking the dimensions on the way.

#include <string>
#include <utility>
#include <vector>

#include "core/deck/operations.hpp"
#include "core/deck/tokens.hpp"

namespace beadwork {

/// A value of the calculation while it is recorded. Constants are folded at once.
struct Operand {
  Dimension dimension;
  bool is_condition = false, is_constant = false;
  double value = 0;                // of a constant
  std::size_t begin = 0, end = 0;  // the characters it came from

  bool is_zero() const { return is_constant && !is_condition && value == 0 && dimension.is_plain(); }
};

inline std::string kind_of(const Operand& operand) {
  if (operand.is_condition) return "a condition";
  return operand.dimension.is_plain() ? "a plain number" : "in " + operand.dimension.name();
}

class StepRecorder {
 public:
  explicit StepRecorder(const std::vector<Token>& tokens) : tokens_(tokens) {}

  int constant(const Quantity& quantity, const Token& token) {
    return push({quantity.dimension, false, true, quantity.value, token.at, token.at + token.length}, {});
  }

  int variable(const Dimension& dimension, const Token& token) {
    return push({dimension, false, false, 0, token.at, token.at + token.length},
                {static_cast<int>(Operation::variable), static_cast<int>(token.variable)});
  }

  int binary(Operation operation, int a, int b) {
    const Operand &left = operands_[a], &right = operands_[b];
    Operand result{{}, false, left.is_constant && right.is_constant, 0, left.begin, right.end};
    switch (operation) {
      case Operation::add:
      case Operation::subtract: result.dimension = common(left, right); break;
      case Operation::multiply: result.dimension = number(left).dimension * number(right).dimension; break;
      case Operation::divide: result.dimension = number(left).dimension / number(right).dimension; break;
      case Operation::power: result.dimension = powered(number(left), plain(right, "an exponent")); break;
      case Operation::both:
      case Operation::either: condition(left), condition(right), result.is_condition = true; break;
      default: common(left, right), result.is_condition = true;
    }
    return push(operation, result, a, b);
  }

  int minimum_or_maximum(Operation operation, const double* handles, int count) {
    int result = static_cast<int>(handles[0]);
    number(operands_[result]);
    for (int i = 1; i < count; ++i) {
      const int next = static_cast<int>(handles[i]);
      result = push(operation, joined(common(operands_[result], operands_[next]), result, next), result, next);
    }
    return result;
  }

  int arc_tangent(int a, int b) {
    common(operands_[a], operands_[b]);
    return push(Operation::arc_tangent_of_two, joined({}, a, b), a, b);
  }

  int unary(Operation operation, int a) {
    Operand result = operands_[a];
    if (operation == Operation::opposite)
      condition(result);
    else if (operation == Operation::square_root)
      result.dimension = power(number(result).dimension, 0.5);
    else if (operation == Operation::negate || operation == Operation::absolute || operation == Operation::sign)
      number(result);
    else
      plain(result, "this function");
    if (operation == Operation::sign) result.dimension = {};
    return push(operation, result, a);
  }

  /// A sign that changes nothing.
  int positive(int a) {
    number(operands_[a]);
    return a;
  }

  int choose(int test, int yes, int no) {
    condition(operands_[test]);
    Operand result = joined({}, test, no);
    if (operands_[yes].is_condition && operands_[no].is_condition)
      result.is_condition = true;
    else
      result.dimension = common(operands_[yes], operands_[no]);
    result.is_constant = result.is_constant && operands_[yes].is_constant;
    return push(Operation::choose, result, test, yes, no);
  }

  const Operand& at(int index) const { return operands_[index]; }
  std::vector<Expression::Step> steps() && { return std::move(steps_); }

 private:
  int push(const Operand& operand, const Expression::Step& step) {
    operands_.push_back(operand);
    steps_.push_back(step);
    steps_.back().value = operand.value;
    return static_cast<int>(operands_.size()) - 1;
  }

  int push(Operation operation, Operand operand, int a, int b = 0, int c = 0) {
    if (!operand.is_constant) return push(operand, {static_cast<int>(operation), a, b, c});
    operand.value = apply(operation, operands_[a].value, operands_[b].value, operands_[c].value);
    return push(operand, {});
  }

  Operand joined(const Dimension& dimension, int a, int b) const {
    return {dimension,          false,           operands_[a].is_constant && operands_[b].is_constant, 0,
            operands_[a].begin, operands_[b].end};
  }

  // ---- What an operand must be

  const Operand& number(const Operand& operand) const {
    if (operand.is_condition)
      throw ExpressionMistake(operand.begin, "a condition is no number; join conditions with and, or, not");
    return operand;
  }

  const Operand& plain(const Operand& operand, const std::string& who) const {
    if (!number(operand).dimension.is_plain())
      throw ExpressionMistake(operand.begin, who + " wants a plain number, this is " + kind_of(operand));
    return operand;
  }

  void condition(const Operand& operand) const {
    if (!operand.is_condition)
      throw ExpressionMistake(operand.begin,
                              "a condition such as x < 1 mm is wanted here, this is " + kind_of(operand));
  }

  /// A zero without a unit has any dimension.
  Dimension common(const Operand& left, const Operand& right) const {
    number(left), number(right);
    if (left.dimension == right.dimension || right.is_zero()) return left.dimension;
    if (left.is_zero()) return right.dimension;
    const Token& sign = sign_between(left, right);
    const std::string who = sign.text == "," ? "the arguments" : "the two sides of '" + sign.text + "'";
    throw ExpressionMistake(sign.at,
                            who + " differ: the left is " + kind_of(left) + ", the right is " + kind_of(right));
  }

  Dimension powered(const Operand& base, const Operand& exponent) const {
    if (base.dimension.is_plain()) return {};
    if (!exponent.is_constant)
      throw ExpressionMistake(exponent.begin, "the exponent of a quantity with a unit must be the same everywhere");
    return power(base.dimension, exponent.value);
  }

  /// The operator or comma between two operands: where a quarrel between them is shown.
  const Token& sign_between(const Operand& left, const Operand& right) const {
    const Token* found = &tokens_.front();
    for (const Token& token : tokens_)
      if (token.kind == Token::Kind::sign && token.at >= left.end && token.at < right.begin && token.text != ")" &&
          token.text != "(") {
        found = &token;
        break;
      }
    return *found;
  }

  const std::vector<Token>& tokens_;
  std::vector<Operand> operands_;
  std::vector<Expression::Step> steps_;
};

}  // namespace beadwork
