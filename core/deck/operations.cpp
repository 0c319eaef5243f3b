#include "core/deck/operations.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace beadwork {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

double truth(bool is_true, double a, double b) { return std::isnan(a) || std::isnan(b) ? nan : is_true; }

double sign_of(double a) { return std::isnan(a) ? nan : (a > 0) - (a < 0); }

}  // namespace

int operands(Operation operation) {
  using enum Operation;
  switch (operation) {
    case constant:
    case variable: return 0;
    case negate:
    case opposite:
    case square_root:
    case absolute:
    case sine:
    case cosine:
    case tangent:
    case arc_sine:
    case arc_cosine:
    case arc_tangent:
    case exponential:
    case logarithm:
    case logarithm_10:
    case Operation::floor:
    case ceiling:
    case Operation::round:
    case sign: return 1;
    case choose: return 3;
    default: return 2;
  }
}

double apply(Operation operation, double a, double b, double c) {
  switch (operation) {
    case Operation::constant:
    case Operation::variable: return a;
    case Operation::add: return a + b;
    case Operation::subtract: return a - b;
    case Operation::multiply: return a * b;
    case Operation::divide: return a / b;
    case Operation::power: return std::pow(a, b);
    case Operation::negate: return -a;
    case Operation::less: return truth(a < b, a, b);
    case Operation::less_equal: return truth(a <= b, a, b);
    case Operation::greater: return truth(a > b, a, b);
    case Operation::greater_equal: return truth(a >= b, a, b);
    case Operation::equal: return truth(a == b, a, b);
    case Operation::different: return truth(a != b, a, b);
    case Operation::both: return truth(a != 0 && b != 0, a, b);
    case Operation::either: return truth(a != 0 || b != 0, a, b);
    case Operation::opposite: return truth(a == 0, a, a);
    case Operation::choose: return std::isnan(a) ? nan : a != 0 ? b : c;
    case Operation::square_root: return std::sqrt(a);
    case Operation::absolute: return std::abs(a);
    case Operation::minimum: return std::isnan(a) || std::isnan(b) ? nan : std::min(a, b);
    case Operation::maximum: return std::isnan(a) || std::isnan(b) ? nan : std::max(a, b);
    case Operation::sine: return std::sin(a);
    case Operation::cosine: return std::cos(a);
    case Operation::tangent: return std::tan(a);
    case Operation::arc_sine: return std::asin(a);
    case Operation::arc_cosine: return std::acos(a);
    case Operation::arc_tangent: return std::atan(a);
    case Operation::arc_tangent_of_two: return std::atan2(a, b);
    case Operation::exponential: return std::exp(a);
    case Operation::logarithm: return std::log(a);
    case Operation::logarithm_10: return std::log10(a);
    case Operation::floor: return std::floor(a);
    case Operation::ceiling: return std::ceil(a);
    case Operation::round: return std::round(a);
    case Operation::sign: return sign_of(a);
  }
  return nan;
}

namespace {

// What does not change has no slope, even where the factor before it is infinite.
double times(double factor, double change) { return change == 0 ? 0 : factor * change; }

double slope_of_power(double a, double b, double da, double db) {
  const double by_base = times(b * std::pow(a, b - 1), da);
  return db == 0 ? by_base : by_base + std::pow(a, b) * std::log(a) * db;
}

}  // namespace

double slope(Operation operation, double a, double b, double, double da, double db, double dc) {
  switch (operation) {
    case Operation::add: return da + db;
    case Operation::subtract: return da - db;
    case Operation::multiply: return times(b, da) + times(a, db);
    case Operation::divide: return times(1 / b, da) - times(a / (b * b), db);
    case Operation::power: return slope_of_power(a, b, da, db);
    case Operation::negate: return -da;
    case Operation::choose: return std::isnan(a) ? nan : a != 0 ? db : dc;
    case Operation::square_root: return times(0.5 / std::sqrt(a), da);
    case Operation::absolute: return a == 0 ? std::abs(da) : a < 0 ? -da : da;
    case Operation::minimum: return b < a ? db : da;
    case Operation::maximum: return a < b ? db : da;
    case Operation::sine: return times(std::cos(a), da);
    case Operation::cosine: return times(-std::sin(a), da);
    case Operation::tangent: return times(1 + std::tan(a) * std::tan(a), da);
    case Operation::arc_sine: return times(1 / std::sqrt((1 - a) * (1 + a)), da);
    case Operation::arc_cosine: return times(-1 / std::sqrt((1 - a) * (1 + a)), da);
    case Operation::arc_tangent: return times(1 / (1 + a * a), da);
    case Operation::arc_tangent_of_two: return times(b / (a * a + b * b), da) - times(a / (a * a + b * b), db);
    case Operation::exponential: return times(std::exp(a), da);
    case Operation::logarithm: return times(1 / a, da);
    case Operation::logarithm_10: return times(1 / (a * std::numbers::ln10), da);
    default: return 0;  // constants; conditions and whole numbers, which jump
  }
}

std::span<const FunctionHelp> functions() {
  constexpr std::string_view plain = "of a plain number; a plain number";
  static constexpr std::array<FunctionHelp, 20> all{{
      {"sqrt", "a", "square root; the dimension follows: sqrt(4 mm^2) is 2 mm"},
      {"abs", "a", "absolute value, in the dimension of a"},
      {"min", "a, b, ...", "smallest, of quantities of one dimension"},
      {"max", "a, b, ...", "largest, of quantities of one dimension"},
      {"if", "condition, a, b", "a where the condition holds, else b; both of one dimension"},
      {"sign", "a", "-1, 0 or 1, of any quantity"},
      {"atan2", "y, x", "angle of the point (x, y) in radians, of two quantities of one dimension"},
      {"sin", "a", plain},
      {"cos", "a", plain},
      {"tan", "a", plain},
      {"asin", "a", plain},
      {"acos", "a", plain},
      {"atan", "a", plain},
      {"exp", "a", plain},
      {"log", "a", "natural logarithm of a plain number"},
      {"ln", "a", "the same as log"},
      {"log10", "a", "decimal logarithm of a plain number"},
      {"floor", "a", "next whole number below, of a plain number"},
      {"ceil", "a", "next whole number above, of a plain number"},
      {"round", "a", "nearest whole number, of a plain number"},
  }};
  return all;
}

bool is_function(std::string_view name) {
  return std::any_of(functions().begin(), functions().end(), [&](const FunctionHelp& f) { return f.name == name; });
}

}  // namespace beadwork
