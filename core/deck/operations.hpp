#pragma once
// The steps that a compiled expression is made of.

#include <span>
#include <string_view>

namespace beadwork {

enum class Operation {
  constant,
  variable,
  add,
  subtract,
  multiply,
  divide,
  power,
  negate,
  less,
  less_equal,
  greater,
  greater_equal,
  equal,
  different,
  both,
  either,
  opposite,
  choose,
  square_root,
  absolute,
  minimum,
  maximum,
  sine,
  cosine,
  tangent,
  arc_sine,
  arc_cosine,
  arc_tangent,
  arc_tangent_of_two,
  exponential,
  logarithm,
  logarithm_10,
  floor,
  ceiling,
  round,
  sign
};

/// How many of the three numbers of a step it takes.
int operands(Operation operation);

/// One step on plain numbers; conditions are 1 and 0. A NaN makes every result NaN, comparisons too.
double apply(Operation operation, double a, double b, double c);

/// The derivative of a step, of its numbers and theirs.
double slope(Operation operation, double a, double b, double c, double da, double db, double dc);

/// A function that expressions know, as the manual tells it.
struct FunctionHelp {
  std::string_view name, arguments, doc;
};
std::span<const FunctionHelp> functions();
/// Is this the name of a function in expressions?
bool is_function(std::string_view name);

}  // namespace beadwork
