#include "core/io/frame_reader.hpp"
#include "core/io/packing_file.hpp"
#include "tests/fuzz/input.hpp"

using namespace beadwork;

// A run.h5, truncated or changed: by what reads pictures, and by what reads packings.
int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto file = fuzz::as_file(std::string(reinterpret_cast<const char*>(data), size), "run.h5");
  fuzz::refused_or_read([&] {
    const record::FrameReader reader(file);
    reader.meta();
    reader.sets();
    reader.pairs();
    reader.breaks();
    for (const record::FrameHead& head : reader.frames()) fuzz::refused_or_read([&] { reader.read(head); });
  });
  return fuzz::refused_or_read([&] { read_packing(file, {}); });
}
