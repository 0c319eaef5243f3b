#include "core/io/h5.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cstring>

namespace beadwork::h5 {

namespace {

constexpr std::size_t growth = 1024 * 1024;  // of a file in memory

herr_t innermost(unsigned depth, const H5E_error2_t* error, void* out) {
  if (depth == 0 && error->desc) *static_cast<std::string*>(out) = error->desc;
  return 0;
}

Handle space_of(std::size_t rows, int width) {
  const hsize_t extent[2] = {rows, static_cast<hsize_t>(width)};
  return take(H5Screate_simple(width > 1 ? 2 : 1, extent, nullptr), H5Sclose, "describe a dataset");
}

struct Types {
  hid_t file, memory;
};

Types types_of(Type type) {
  if (type == Type::index) return {H5T_STD_I32LE, H5T_NATIVE_INT32};
  if (type == Type::state) return {H5T_STD_U8LE, H5T_NATIVE_UINT8};
  return {H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE};
}

// In one piece and not packed, where any reader is fastest.   docs/decisions/run-h5.md
Handle write_numbers(hid_t place, const std::string& name, Types types, const void* numbers, std::size_t rows,
                     int width, const Label& label) {
  const Handle space = space_of(rows, width);
  Handle dataset = take(H5Dcreate2(place, name.c_str(), types.file, space.id(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                        H5Dclose, "make dataset '" + name + "'");
  if (rows > 0)
    check(H5Dwrite(dataset.id(), types.memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers), "write dataset '" + name + "'");
  set_attribute(dataset.id(), "unit", label.unit);
  set_attribute(dataset.id(), "long_name", label.long_name);
  return dataset;
}

// Text of one length for all, so that it lies in the dataset itself.
Handle text_type(std::size_t length) {
  Handle type = take(H5Tcopy(H5T_C_S1), H5Tclose, "describe text");
  check(H5Tset_size(type.id(), std::max<std::size_t>(1, length)), "describe text");
  check(H5Tset_cset(type.id(), H5T_CSET_UTF8), "describe text");
  check(H5Tset_strpad(type.id(), H5T_STR_NULLPAD), "describe text");
  return type;
}

struct Packed {
  std::size_t length = 1;
  std::vector<char> bytes;
};

Packed pack(const std::vector<std::string>& texts) {
  Packed packed;
  for (const std::string& text : texts) packed.length = std::max(packed.length, text.size());
  packed.bytes.assign(std::max<std::size_t>(1, packed.length * texts.size()), '\0');
  for (std::size_t i = 0; i < texts.size(); ++i)
    std::copy(texts[i].begin(), texts[i].end(), packed.bytes.begin() + static_cast<std::ptrdiff_t>(i * packed.length));
  return packed;
}

void write_packed(hid_t place, const std::string& name, const std::vector<std::string>& texts, const Handle& space) {
  const Packed packed = pack(texts);
  const Handle type = text_type(packed.length);
  const Handle dataset =
      take(H5Dcreate2(place, name.c_str(), type.id(), space.id(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Dclose,
           "make dataset '" + name + "'");
  if (!texts.empty())
    check(H5Dwrite(dataset.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, packed.bytes.data()),
          "write dataset '" + name + "'");
}

void set_packed(hid_t object, const std::string& name, const std::vector<std::string>& texts, const Handle& space) {
  const Packed packed = pack(texts);
  const Handle type = text_type(packed.length);
  const Handle attribute = take(H5Acreate2(object, name.c_str(), type.id(), space.id(), H5P_DEFAULT, H5P_DEFAULT),
                                H5Aclose, "make attribute '" + name + "'");
  check(H5Awrite(attribute.id(), type.id(), packed.bytes.data()), "write attribute '" + name + "'");
}

void set_number(hid_t object, const std::string& name, Types types, const void* value) {
  const Handle space = take(H5Screate(H5S_SCALAR), H5Sclose, "describe an attribute");
  const Handle attribute = take(H5Acreate2(object, name.c_str(), types.file, space.id(), H5P_DEFAULT, H5P_DEFAULT),
                                H5Aclose, "make attribute '" + name + "'");
  check(H5Awrite(attribute.id(), types.memory, value), "write attribute '" + name + "'");
}

// Rows of a column side by side; `T` is one component.
template <class T>
std::vector<T> gathered(const Column& column, Index rows) {
  const int width = components(column.field().type);
  std::vector<T> out(static_cast<std::size_t>(rows) * static_cast<std::size_t>(width));
  T* to = out.data();
  for (Index row = 0; row < rows; ++row) {
    const std::byte* from = column.base() + static_cast<std::size_t>(row) * column.stride();
    for (int c = 0; c < width; ++c, from += column.plane()) std::memcpy(to++, from, sizeof(T));
  }
  return out;
}

}  // namespace

std::string reason() {
  std::string words = "no reason given";
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, innermost, &words);
  const std::string mark = "error message = '";
  const auto begin = words.find(mark);
  if (begin == std::string::npos) return words;
  const auto from = begin + mark.size();
  return words.substr(from, words.find('\'', from) - from);
}

Handle take(hid_t id, Handle::Close close, const std::string& doing) {
  if (id < 0) throw MachineFailure(fmt::format("HDF5 cannot {}: {}", doing, reason()));
  return {id, close};
}

void check(herr_t status, const std::string& doing) {
  if (status < 0) throw MachineFailure(fmt::format("HDF5 cannot {}: {}", doing, reason()));
}

namespace {

// Links and attributes stay in the header of their group, which has a check sum: the heap into which the library would
// put many has none.
void keep_in_header(hid_t creation) {
  constexpr unsigned most = 65535;
  check(H5Pset_link_phase_change(creation, most, 0), "make a group");
  check(H5Pset_attr_phase_change(creation, most, 0), "make a group");
}

}  // namespace

Handle make_file(const std::string& name, hid_t access) {
  check(H5Pset_libver_bounds(access, H5F_LIBVER_V18, H5F_LIBVER_V18), "make a file");
  const Handle how = take(H5Pcreate(H5P_FILE_CREATE), H5Pclose, "make a file");
  keep_in_header(how.id());
  return take(H5Fcreate(name.c_str(), H5F_ACC_TRUNC, how.id(), access), H5Fclose, "make file '" + name + "'");
}

MemoryFile::MemoryFile() {
  const Handle access = take(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "make a file in memory");
  check(H5Pset_fapl_core(access.id(), growth, false), "make a file in memory");
  static std::atomic<int> count{0};  // HDF5 tells files in memory apart by their names alone
  const std::string name = fmt::format("in memory {}", count++);
  file_ = make_file(name, access.id());
}

std::span<const std::byte> MemoryFile::image() const {
  check(H5Fflush(file_.id(), H5F_SCOPE_LOCAL), "finish a file in memory");
  void* handle = nullptr;  // of this driver: the place of its pointer to the bytes
  check(H5Fget_vfd_handle(file_.id(), H5P_DEFAULT, &handle), "finish a file in memory");
  const ssize_t size = H5Fget_file_image(file_.id(), nullptr, 0);
  check(size < 0 ? -1 : 0, "finish a file in memory");
  return {*static_cast<const std::byte* const*>(handle), static_cast<std::size_t>(size)};
}

Handle make_group(hid_t place, const std::string& name) {
  const Handle how = take(H5Pcreate(H5P_GROUP_CREATE), H5Pclose, "make a group");
  keep_in_header(how.id());
  return take(H5Gcreate2(place, name.c_str(), H5P_DEFAULT, how.id(), H5P_DEFAULT), H5Gclose,
              "make group '" + name + "'");
}

void set_attribute(hid_t object, const std::string& name, const std::string& text) {
  set_packed(object, name, {text}, take(H5Screate(H5S_SCALAR), H5Sclose, "describe an attribute"));
}
void set_attribute(hid_t object, const std::string& name, Real value) {
  set_number(object, name, {H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE}, &value);
}
void set_attribute(hid_t object, const std::string& name, std::int64_t value) {
  set_number(object, name, {H5T_STD_I64LE, H5T_NATIVE_INT64}, &value);
}
void set_texts_attribute(hid_t object, const std::string& name, const std::vector<std::string>& texts) {
  if (!texts.empty()) set_packed(object, name, texts, space_of(texts.size(), 1));
}

void write_text(hid_t place, const std::string& name, const std::string& text) {
  write_packed(place, name, {text}, take(H5Screate(H5S_SCALAR), H5Sclose, "describe a dataset"));
}
void write_texts(hid_t place, const std::string& name, const std::vector<std::string>& texts) {
  write_packed(place, name, texts, space_of(texts.size(), 1));
}

Handle write_reals(hid_t place, const std::string& name, std::span<const Real> numbers, int width, const Label& label) {
  return write_numbers(place, name, types_of(Type::real), numbers.data(),
                       numbers.size() / static_cast<std::size_t>(width), width, label);
}
Handle write_indices(hid_t place, const std::string& name, std::span<const Index> numbers, int width,
                     const Label& label) {
  return write_numbers(place, name, types_of(Type::index), numbers.data(),
                       numbers.size() / static_cast<std::size_t>(width), width, label);
}
Handle write_integers(hid_t place, const std::string& name, std::span<const std::int64_t> numbers, const Label& label) {
  return write_numbers(place, name, {H5T_STD_I64LE, H5T_NATIVE_INT64}, numbers.data(), numbers.size(), 1, label);
}

void write_column(hid_t place, const Column& column, Index rows) {
  const Field& field = column.field();
  const Types types = types_of(field.type);
  const auto write = [&](const void* numbers) {
    return write_numbers(place, field.name, types, numbers, static_cast<std::size_t>(rows), components(field.type),
                         {field.unit, field.doc});
  };
  const Handle dataset = [&] {
    if (bytes(field.type) == column.stride() && components(field.type) == 1) return write(column.base());
    if (field.type == Type::index) return write(gathered<Index>(column, rows).data());
    if (field.type == Type::state) return write(gathered<State>(column, rows).data());
    return write(gathered<Real>(column, rows).data());
  }();
  set_attribute(dataset.id(), "type", std::string(type_name(field.type)));
  set_attribute(dataset.id(), "line", field.line);
}

}  // namespace beadwork::h5
