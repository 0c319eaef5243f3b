#pragma once
// Single datasets of a record, read as others read them: by HDF5 alone, which follows the links to the frames, and not
// by the reader that the program has.

#include <stdexcept>
#include <string>
#include <vector>

#include "core/io/h5_handle.hpp"

namespace beadwork::testing {

struct Dataset {
  std::vector<std::size_t> extent;
  std::vector<double> numbers;  ///< row by row
  std::string unit, long_name;  ///< empty where the file says nothing
};

inline h5::Handle there(hid_t id, h5::Handle::Close close, const std::string& name) {
  if (id < 0) throw std::runtime_error("there is no '" + name + "' in the file");
  return {id, close};
}

/// A text of fixed length, filled up with zeros, that `read(type, bytes)` reads.
template <class Read>
std::string fixed_text(const h5::Handle& type, const Read& read) {
  std::string text(H5Tget_size(type.id()), '\0');
  if (H5Tget_class(type.id()) != H5T_STRING || read(type.id(), text.data()) < 0)
    throw std::runtime_error("there is no text of fixed length where one should be");
  return text.substr(0, text.find('\0'));
}

inline std::string attribute_text(const h5::Handle& object, const std::string& name) {
  if (H5Aexists(object.id(), name.c_str()) <= 0) return "";
  const auto attribute = there(H5Aopen(object.id(), name.c_str(), H5P_DEFAULT), H5Aclose, name);
  return fixed_text(there(H5Aget_type(attribute.id()), H5Tclose, name),
                    [&](hid_t type, void* bytes) { return H5Aread(attribute.id(), type, bytes); });
}

/// Gives `use` the dataset of that path. Throws std::runtime_error where there is none.
template <class Use>
auto with_dataset(const std::string& file, const std::string& path, const Use& use) {
  const h5::Silence silence;
  const auto opened = there(H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose, file);
  return use(there(H5Dopen2(opened.id(), path.c_str(), H5P_DEFAULT), H5Dclose, path));
}

inline Dataset read_dataset(const std::string& file, const std::string& path) {
  return with_dataset(file, path, [&](const h5::Handle& dataset) {
    const auto space = there(H5Dget_space(dataset.id()), H5Sclose, path);
    std::vector<hsize_t> extent(static_cast<std::size_t>(H5Sget_simple_extent_ndims(space.id())));
    H5Sget_simple_extent_dims(space.id(), extent.data(), nullptr);
    Dataset out{{extent.begin(), extent.end()},
                std::vector<double>(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space.id()))),
                attribute_text(dataset, "unit"),
                attribute_text(dataset, "long_name")};
    if (!out.numbers.empty() &&
        H5Dread(dataset.id(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, out.numbers.data()) < 0)
      throw std::runtime_error("'" + path + "' holds no numbers");
    return out;
  });
}

/// As above, of a scalar dataset of text, or of a list of one.
inline std::string read_dataset_text(const std::string& file, const std::string& path) {
  return with_dataset(file, path, [&](const h5::Handle& dataset) {
    return fixed_text(there(H5Dget_type(dataset.id()), H5Tclose, path), [&](hid_t type, void* bytes) {
      return H5Dread(dataset.id(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes);
    });
  });
}

}  // namespace beadwork::testing
