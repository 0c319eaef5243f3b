#include <cmath>
#include <cstdlib>

#include "core/base/units.hpp"
#include "tests/fuzz/input.hpp"

using namespace beadwork;

// What is read as a unit or as an amount is written so that it reads back.
int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  if (const auto unit = find_unit(text))
    if (!find_unit(unit->dimension.name()) || !(unit->scale > 0)) std::abort();
  find_leading_unit(text);
  if (const auto amount = parse_amount(text)) {
    const auto again = parse_amount(amount->text());
    if (!again || again->value != amount->value || !(again->unit.dimension == amount->unit.dimension)) std::abort();
  } else {
    why_no_unit(text);
  }
  return 0;
}
