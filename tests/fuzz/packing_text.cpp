#include <cmath>
#include <cstdlib>

#include "core/io/packing_text.hpp"
#include "tests/fuzz/input.hpp"

using namespace beadwork;

// The first byte says which form the deck gives it.
int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string text(reinterpret_cast<const char*>(data + 1), size - 1);
  TextForm form;
  if (data[0] & 1) form.unit = "mm";
  if (data[0] & 2) form.columns = {"x", "y", "z", "diameter"};
  return fuzz::refused_or_read([&] {
    const StoredPacking packing = read_packing_text(fuzz::as_file(text, "packing.csv"), form, never_paused);
    for (const Real radius : packing.radius)
      if (!(radius > 0) || !std::isfinite(radius)) std::abort();
  });
}
