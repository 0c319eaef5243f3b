#include <array>

#include "core/deck/expression.hpp"
#include "core/deck/scope.hpp"
#include "tests/fuzz/input.hpp"

using namespace beadwork;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  Complaints complaints;
  Scope scope;
  scope.add({"side", "28 um", {}, {}, true}, complaints);
  scope.add({"a-b", "${side/2}", {}, {}, true}, complaints);
  scope.add({"loop", "${loop + 1}", {}, {}, true}, complaints);
  const std::array<Variable, 2> variables{{{"x", find_unit("m")->dimension}, {"k", {}}}};
  if (const auto expression = Expression::compile(text, {}, scope, variables, complaints))
    expression->evaluate(std::array<double, 2>{0.25, 3});
  else if (complaints.errors() == 0)
    std::abort();  // refused without a word
  complaints.text();
  return 0;
}
