#include "core/io/h5.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cstring>

namespace beadwork::h5 {

namespace {

constexpr hsize_t chunk_rows = 65536;        // of packed datasets: enough to compress well, small enough to read apart
constexpr std::size_t growth = 1024 * 1024;  // of a file in memory

herr_t innermost(unsigned depth, const H5E_error2_t* error, void* out) {
  if (depth == 0 && error->desc) *static_cast<std::string*>(out) = error->desc;
  return 0;
}

Handle space_of(std::size_t rows, int width) {
  const hsize_t extent[2] = {rows, static_cast<hsize_t>(width)};
  return take(H5Screate_simple(width > 1 ? 2 : 1, extent, nullptr), H5Sclose, "describe a dataset");
}

// Only packed data need chunks; the rest lies in one piece, where any reader is fastest.
Handle layout_of(std::size_t rows, int width, Storage storage) {
  Handle layout = take(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "describe a dataset");
  if (storage.gzip <= 0 || rows == 0) return layout;
  const hsize_t chunk[2] = {std::min<hsize_t>(rows, chunk_rows), static_cast<hsize_t>(width)};
  check(H5Pset_chunk(layout.id(), width > 1 ? 2 : 1, chunk), "chunk a dataset");
  check(H5Pset_shuffle(layout.id()), "shuffle a dataset");
  check(H5Pset_deflate(layout.id(), static_cast<unsigned>(storage.gzip)), "pack a dataset");
  return layout;
}

struct Types {
  hid_t file, memory;
};

Types types_of(Type type, Storage storage) {
  if (type == Type::index) return {H5T_STD_I32LE, H5T_NATIVE_INT32};
  if (type == Type::state) return {H5T_STD_U8LE, H5T_NATIVE_UINT8};
  return {storage.single ? H5T_IEEE_F32LE : H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE};
}

Handle write_numbers(hid_t place, const std::string& name, Types types, const void* numbers, std::size_t rows, int width,
                     const Label& label, Storage storage) {
  const Handle space = space_of(rows, width);
  const Handle layout = layout_of(rows, width, storage);
  Handle dataset = take(H5Dcreate2(place, name.c_str(), types.file, space.id(), H5P_DEFAULT, layout.id(), H5P_DEFAULT),
                        H5Dclose, "make dataset '" + name + "'");
  if (rows > 0)
    check(H5Dwrite(dataset.id(), types.memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers), "write dataset '" + name + "'");
  set_attribute(dataset.id(), "unit", label.unit);
  set_attribute(dataset.id(), "long_name", label.long_name);
  return dataset;
}

Handle open_dataset(hid_t place, const std::string& name) {
  return take(H5Dopen2(place, name.c_str(), H5P_DEFAULT), H5Dclose, "open dataset '" + name + "'");
}

template <class T>
std::vector<T> read_numbers(hid_t place, const std::string& name, hid_t memory) {
  const Handle dataset = open_dataset(place, name);
  const Handle space = take(H5Dget_space(dataset.id()), H5Sclose, "read dataset '" + name + "'");
  std::vector<T> out(static_cast<std::size_t>(std::max<hssize_t>(0, H5Sget_simple_extent_npoints(space.id()))));
  if (!out.empty())
    check(H5Dread(dataset.id(), memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, out.data()), "read dataset '" + name + "'");
  return out;
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
  const Handle dataset = take(H5Dcreate2(place, name.c_str(), type.id(), space.id(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                              H5Dclose, "make dataset '" + name + "'");
  if (!texts.empty())
    check(H5Dwrite(dataset.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, packed.bytes.data()),
          "write dataset '" + name + "'");
}

void set_packed(hid_t object, const std::string& name, const std::vector<std::string>& texts, const Handle& space) {
  const Packed packed = pack(texts);
  const Handle type = text_type(packed.length);
  const Handle attribute = take(H5Acreate2(object, name.c_str(), type.id(), space.id(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
                                "make attribute '" + name + "'");
  check(H5Awrite(attribute.id(), type.id(), packed.bytes.data()), "write attribute '" + name + "'");
}

void set_number(hid_t object, const std::string& name, Types types, const void* value) {
  const Handle space = take(H5Screate(H5S_SCALAR), H5Sclose, "describe an attribute");
  const Handle attribute = take(H5Acreate2(object, name.c_str(), types.file, space.id(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
                                "make attribute '" + name + "'");
  check(H5Awrite(attribute.id(), types.memory, value), "write attribute '" + name + "'");
}

template <class T>
T number_attribute(hid_t object, const std::string& name, hid_t memory) {
  const Handle attribute = take(H5Aopen(object, name.c_str(), H5P_DEFAULT), H5Aclose, "open attribute '" + name + "'");
  T value{};
  check(H5Aread(attribute.id(), memory, &value), "read attribute '" + name + "'");
  return value;
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

template <class T>
void scatter(const std::vector<T>& numbers, Column& column, Index rows) {
  const int width = components(column.field().type);
  const T* from = numbers.data();
  for (Index row = 0; row < rows; ++row) {
    std::byte* to = column.base() + static_cast<std::size_t>(row) * column.stride();
    for (int c = 0; c < width; ++c, to += column.plane()) std::memcpy(to, from++, sizeof(T));
  }
}

template <class T>
void fill_column(hid_t place, Column& column, Index rows, hid_t memory) {
  const auto numbers = read_numbers<T>(place, column.field().name, memory);
  const auto wanted = static_cast<std::size_t>(rows) * static_cast<std::size_t>(components(column.field().type));
  if (numbers.size() != wanted)
    throw MachineFailure(fmt::format("dataset '{}' holds {} numbers, not {}", column.field().name, numbers.size(), wanted));
  scatter(numbers, column, rows);
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

MemoryFile::MemoryFile() {
  const Handle access = take(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "make a file in memory");
  check(H5Pset_fapl_core(access.id(), growth, false), "make a file in memory");
  static std::atomic<int> count{0};  // HDF5 tells files in memory apart by their names alone
  const std::string name = fmt::format("in memory {}", count++);
  file_ = take(H5Fcreate(name.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access.id()), H5Fclose, "make a file in memory");
}

std::span<const std::byte> MemoryFile::image() const {
  check(H5Fflush(file_.id(), H5F_SCOPE_LOCAL), "finish a file in memory");
  void* handle = nullptr;  // of this driver: the place of its pointer to the bytes
  check(H5Fget_vfd_handle(file_.id(), H5P_DEFAULT, &handle), "finish a file in memory");
  const ssize_t size = H5Fget_file_image(file_.id(), nullptr, 0);
  check(size < 0 ? -1 : 0, "finish a file in memory");
  return {*static_cast<const std::byte* const*>(handle), static_cast<std::size_t>(size)};
}

Handle open_file(const std::filesystem::path& file) {
  const Handle access = take(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "open a file");
  // Files are replaced, never changed: who reads one needs no lock, and some file systems have none.
  H5Pset_file_locking(access.id(), false, true);
  return take(H5Fopen(file.c_str(), H5F_ACC_RDONLY, access.id()), H5Fclose, "open '" + file.string() + "'");
}

Handle make_group(hid_t place, const std::string& name) {
  return take(H5Gcreate2(place, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose, "make group '" + name + "'");
}

Handle open_group(hid_t place, const std::string& name) {
  return take(H5Gopen2(place, name.c_str(), H5P_DEFAULT), H5Gclose, "open group '" + name + "'");
}

bool has(hid_t place, const std::string& name) { return H5Lexists(place, name.c_str(), H5P_DEFAULT) > 0; }

std::vector<std::string> names_in(hid_t group) {
  std::vector<std::string> names;
  const auto collect = [](hid_t, const char* name, const H5L_info_t*, void* out) -> herr_t {
    static_cast<std::vector<std::string>*>(out)->emplace_back(name);
    return 0;
  };
  check(H5Literate(group, H5_INDEX_NAME, H5_ITER_INC, nullptr, collect, &names), "list a group");
  return names;
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

std::string text_attribute(hid_t object, const std::string& name) {
  const Handle attribute = take(H5Aopen(object, name.c_str(), H5P_DEFAULT), H5Aclose, "open attribute '" + name + "'");
  const Handle type = take(H5Aget_type(attribute.id()), H5Tclose, "read attribute '" + name + "'");
  std::vector<char> bytes(H5Tget_size(type.id()));
  check(H5Aread(attribute.id(), type.id(), bytes.data()), "read attribute '" + name + "'");
  return {bytes.data(), strnlen(bytes.data(), bytes.size())};
}
Real real_attribute(hid_t object, const std::string& name) {
  return number_attribute<Real>(object, name, H5T_NATIVE_DOUBLE);
}
std::int64_t integer_attribute(hid_t object, const std::string& name) {
  return number_attribute<std::int64_t>(object, name, H5T_NATIVE_INT64);
}

void write_text(hid_t place, const std::string& name, const std::string& text) {
  write_packed(place, name, {text}, take(H5Screate(H5S_SCALAR), H5Sclose, "describe a dataset"));
}
void write_texts(hid_t place, const std::string& name, const std::vector<std::string>& texts) {
  write_packed(place, name, texts, space_of(texts.size(), 1));
}

std::vector<std::string> read_texts(hid_t place, const std::string& name) {
  const Handle dataset = open_dataset(place, name);
  const Handle type = take(H5Dget_type(dataset.id()), H5Tclose, "read dataset '" + name + "'");
  const Handle space = take(H5Dget_space(dataset.id()), H5Sclose, "read dataset '" + name + "'");
  const auto count = static_cast<std::size_t>(H5Sget_simple_extent_npoints(space.id()));
  const std::size_t length = H5Tget_size(type.id());
  std::vector<char> bytes(std::max<std::size_t>(1, count * length));
  if (count > 0)
    check(H5Dread(dataset.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data()), "read dataset '" + name + "'");
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < count; ++i)
    texts.emplace_back(bytes.data() + i * length, strnlen(bytes.data() + i * length, length));
  return texts;
}
std::string read_text(hid_t place, const std::string& name) {
  const auto texts = read_texts(place, name);
  return texts.empty() ? "" : texts.front();
}

Handle write_reals(hid_t place, const std::string& name, std::span<const Real> numbers, int width, const Label& label,
                   Storage storage) {
  return write_numbers(place, name, types_of(Type::real, storage), numbers.data(),
                       numbers.size() / static_cast<std::size_t>(width), width, label, storage);
}
Handle write_indices(hid_t place, const std::string& name, std::span<const Index> numbers, int width,
                     const Label& label, Storage storage) {
  return write_numbers(place, name, types_of(Type::index, storage), numbers.data(),
                       numbers.size() / static_cast<std::size_t>(width), width, label, storage);
}
Handle write_integers(hid_t place, const std::string& name, std::span<const std::int64_t> numbers, const Label& label) {
  return write_numbers(place, name, {H5T_STD_I64LE, H5T_NATIVE_INT64}, numbers.data(), numbers.size(), 1, label, {});
}

std::vector<Real> read_reals(hid_t place, const std::string& name) {
  return read_numbers<Real>(place, name, H5T_NATIVE_DOUBLE);
}
std::vector<Index> read_indices(hid_t place, const std::string& name) {
  return read_numbers<Index>(place, name, H5T_NATIVE_INT32);
}
std::vector<std::int64_t> read_integers(hid_t place, const std::string& name) {
  return read_numbers<std::int64_t>(place, name, H5T_NATIVE_INT64);
}

void write_column(hid_t place, const Column& column, Index rows, Storage storage) {
  const Field& field = column.field();
  const Types types = types_of(field.type, storage);
  const auto write = [&](const void* numbers) {
    return write_numbers(place, field.name, types, numbers, static_cast<std::size_t>(rows), components(field.type),
                         {field.unit, field.doc}, storage);
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

Field read_field(hid_t place, const std::string& name, On on) {
  const Handle dataset = open_dataset(place, name);
  Field field{name, on, Type::real, text_attribute(dataset.id(), "unit"), text_attribute(dataset.id(), "long_name"),
              text_attribute(dataset.id(), "line")};
  const std::string type = text_attribute(dataset.id(), "type");
  for (const Type known : {Type::real, Type::vec3, Type::quat, Type::index, Type::state})
    if (type == type_name(known)) {
      field.type = known;
      return field;
    }
  throw MachineFailure(fmt::format("dataset '{}' is of the unknown type '{}'", name, type));
}

void read_column(hid_t place, Column& column, Index rows) {
  switch (column.field().type) {
    case Type::index: return fill_column<Index>(place, column, rows, H5T_NATIVE_INT32);
    case Type::state: return fill_column<std::uint8_t>(place, column, rows, H5T_NATIVE_UINT8);
    default: return fill_column<Real>(place, column, rows, H5T_NATIVE_DOUBLE);
  }
}

Label label_of(hid_t place, const std::string& name) {
  const Handle dataset = open_dataset(place, name);
  const auto text = [&](const char* attribute) {
    return H5Aexists(dataset.id(), attribute) > 0 ? text_attribute(dataset.id(), attribute) : std::string();
  };
  return {text("unit"), text("long_name")};
}

Shape shape_of(hid_t place, const std::string& name) {
  const Handle dataset = open_dataset(place, name);
  const Handle space = take(H5Dget_space(dataset.id()), H5Sclose, "read dataset '" + name + "'");
  const Handle type = take(H5Dget_type(dataset.id()), H5Tclose, "read dataset '" + name + "'");
  Shape shape;
  shape.extent.resize(static_cast<std::size_t>(std::max(0, H5Sget_simple_extent_ndims(space.id()))));
  if (!shape.extent.empty()) H5Sget_simple_extent_dims(space.id(), shape.extent.data(), nullptr);
  shape.integer = H5Tget_class(type.id()) == H5T_INTEGER;
  shape.bytes = H5Tget_size(type.id());
  return shape;
}

}  // namespace beadwork::h5
