#include <cstdlib>

#include "core/plugin/reading.hpp"
#include "tests/fuzz/input.hpp"

using namespace beadwork;

// The first line is a phrase, the rest a curve.
int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  const std::size_t line = text.find('\n');
  const auto reading = parse_reading(text.substr(0, line));
  const CurveTable curve = parse_table(line == std::string::npos ? "" : text.substr(line + 1));
  for (const CurveValues& column : curve.columns)
    if (column.values.size() != curve.rows()) std::abort();
  if (reading) read_from(curve, *reading);
  return 0;
}
