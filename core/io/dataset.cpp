#include "core/io/dataset.hpp"

#include <fmt/format.h>

#include "core/io/h5.hpp"

namespace beadwork {

namespace {

template <class Read>
auto read_file(const std::filesystem::path& file, const Read& read) {
  const h5::Silence silence;
  try {
    return read(h5::open_file(file).id());
  } catch (const MachineFailure& failure) {
    throw MachineFailure(fmt::format("cannot read '{}': {}", file.string(), failure.what()));
  }
}

}  // namespace

Dataset read_dataset(const std::filesystem::path& file, const std::string& name) {
  return read_file(file, [&](hid_t place) {
    Dataset out;
    for (const hsize_t extent : h5::shape_of(place, name).extent)
      out.extent.push_back(static_cast<std::size_t>(extent));
    out.numbers = h5::read_all_reals(place, name);
    out.unit = h5::label_of(place, name).unit;
    out.long_name = h5::label_of(place, name).long_name;
    return out;
  });
}

std::string read_dataset_text(const std::filesystem::path& file, const std::string& name) {
  return read_file(file, [&](hid_t place) { return h5::read_text(place, name); });
}

}  // namespace beadwork
