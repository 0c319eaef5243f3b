#pragma once
// Arithmetic on quantities: ${0.3*length}, where="x < 13.5 mm and radius > 2 um".
//
// Numbers    may carry a unit: 13.5 mm, 0.5 N/mm. It holds no blanks and binds tighter than any operator.
// Operators  from loose to tight: or ||, and &&, not, == != < <= > >=, + -, * /, sign, ^ (2^3^2 is 2^9).
//            Both sides of + - and of a comparison need one dimension; a 0 without a unit has any.
// Functions  sqrt abs min max follow the dimension; sign atan2 forget it; plain numbers for sin cos tan
//            asin acos atan exp log (natural, = ln) log10 floor ceil round; if(condition, then, otherwise).
// Names      parameters, variables, pi. ${ } is a pair of brackets. Names may hold . and -: a - without
//            blanks belongs to the name if a parameter of that longer name exists (the longest wins).

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/complaints.hpp"
#include "core/base/units.hpp"

namespace beadwork {

struct Attribute;
class Scope;

/// A name that gets its value at each evaluation.
struct Variable {
  std::string name;
  Dimension dimension;
};

/// A checked expression. Compiled once; evaluating it is const, allocates little and may be done by several
/// threads.
class Expression {
 public:
  /// Nothing, and located errors, if it cannot be parsed or its dimensions do not fit together. Both sides of
  /// if() are checked.
  static std::optional<Expression> compile(std::string_view text, const Location& start, const Scope& scope,
                                           std::span<const Variable> variables, Complaints& complaints);
  /// The whole value of an attribute.
  static std::optional<Expression> compile(const Attribute& attribute, const Scope& scope,
                                           std::span<const Variable> variables, Complaints& complaints);

  const Dimension& dimension() const { return dimension_; }
  bool is_condition() const { return is_condition_; }  ///< a comparison, not a number
  /// Is it a number of this dimension? A 0 without a unit has any.
  bool has_dimension(const Dimension& wanted) const;
  bool uses(std::size_t variable) const;  ///< does its value depend on this one
  /// Of a condition whose parts are joined by "and": each of them, without its text; of another one itself.
  std::vector<Expression> parts() const;
  const std::string& text() const { return text_; }  ///< in SI, with every parameter replaced by its value

  /// In SI; a condition gives 1 or 0. `si_values` are in the order of the variables. The result may be NaN or
  /// infinite (a condition on a NaN is NaN): it is the caller who knows how to say so.
  double evaluate(std::span<const double> si_values = {}) const;
  struct Sloped {
    double value, slope;
    double
        noise;  ///< how far rounding of the steps, and of the variable, may take the value, over epsilon; first order
  };
  /// With the derivative by one variable, found by the rules of calculus. At a kink it is that of the side where the
  /// variable is larger for abs, and of the branch that is evaluated for if, min and max; a jump has none.
  Sloped evaluate_with_slope(std::span<const double> si_values, std::size_t variable) const;
  /// Where conditions, abs, sign, min and max of what is linear in this variable, alone, change: exact, ascending.
  std::vector<double> kinks(std::size_t variable) const;

  /// One step of the calculation: a function of earlier steps (see operations.hpp).
  struct Step {
    int operation = 0;
    int a = 0, b = 0, c = 0;
    double value = 0;
  };

 private:
  std::string text_;
  std::vector<Step> steps_;  ///< straight-line: the last one is the result
  Dimension dimension_;
  bool is_condition_ = false;
};

}  // namespace beadwork
