// The one reader of HDF5 files.

#include <fcntl.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>

#include "core/base/text.hpp"
#include "core/io/h5.hpp"

namespace beadwork::h5 {

namespace {

enum class Kind { text, integer, real };  // a real number may be stored as an integer

constexpr hsize_t most_inflation = 1100;  // deflate makes at most 1032 bytes of one
constexpr std::size_t longest_attribute = 65536;
constexpr std::size_t longest_target = 4096;

MachineFailure unfit(const std::string& what, const std::string& why) {
  return MachineFailure(fmt::format("{} {}", what, why));
}

bool is_plain_integer(hid_t type) {
  const std::size_t size = H5Tget_size(type);
  return (size == 1 || size == 2 || size == 4 || size == 8) && H5Tget_precision(type) == 8 * size &&
         H5Tget_offset(type) == 0;
}

bool is_plain_real(hid_t type) {
  const std::array<hid_t, 4> known{H5T_IEEE_F64LE, H5T_IEEE_F32LE, H5T_IEEE_F64BE, H5T_IEEE_F32BE};
  return std::any_of(known.begin(), known.end(), [&](hid_t plain) { return H5Tequal(type, plain) > 0; });
}

void require_type(hid_t type, Kind kind, const std::string& what) {
  const H5T_class_t found = H5Tget_class(type);
  if (kind == Kind::text) {
    if (found != H5T_STRING || H5Tis_variable_str(type) != 0 || H5Tget_size(type) == 0)
      throw unfit(what, "is no text of fixed length");
  } else if (found == H5T_INTEGER ? !is_plain_integer(type)
                                  : kind == Kind::integer || found != H5T_FLOAT || !is_plain_real(type)) {
    throw unfit(what, kind == Kind::integer ? "holds no whole numbers" : "holds no numbers");
  }
}

std::size_t points_of(const Handle& space, const std::string& what) {
  const H5S_class_t kind = H5Sget_simple_extent_type(space.id());
  const hssize_t points = H5Sget_simple_extent_npoints(space.id());
  if ((kind != H5S_SIMPLE && kind != H5S_SCALAR) || points < 0) throw unfit(what, "has no shape");
  return static_cast<std::size_t>(points);
}

// ---- attributes

struct Attribute {
  Handle handle, type;
  std::size_t points;
  std::string what;
};

Attribute open_attribute(hid_t object, const std::string& name, Kind kind) {
  const std::string what = "attribute '" + name + "'";
  Handle handle = take(H5Aopen(object, name.c_str(), H5P_DEFAULT), H5Aclose, "open " + what);
  Handle type = take(H5Aget_type(handle.id()), H5Tclose, "read " + what);
  require_type(type.id(), kind, what);
  const std::size_t points = points_of(take(H5Aget_space(handle.id()), H5Sclose, "read " + what), what);
  if (points > longest_attribute / H5Tget_size(type.id())) throw unfit(what, "is too long");
  return {std::move(handle), std::move(type), points, what};
}

template <class T>
T number_attribute(hid_t object, const std::string& name, Kind kind, hid_t memory) {
  const Attribute attribute = open_attribute(object, name, kind);
  if (attribute.points != 1) throw unfit(attribute.what, fmt::format("holds {} numbers, not one", attribute.points));
  T value{};
  check(H5Aread(attribute.handle.id(), memory, &value), "read " + attribute.what);
  return value;
}

// Texts of one length each, filled up with zeros.
std::vector<std::string> unpacked(const std::vector<char>& bytes, std::size_t count, std::size_t length) {
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < count; ++i)
    texts.emplace_back(bytes.data() + i * length, strnlen(bytes.data() + i * length, length));
  return texts;
}

// ---- datasets

void require_hard_link(hid_t place, const std::string& name) {
  H5L_info_t info;
  check(H5Lget_info(place, name.c_str(), &info, H5P_DEFAULT), "find '" + name + "'");
  if (info.type != H5L_TYPE_HARD) throw unfit("'" + name + "'", "is a link, which is not followed");
}

Handle open_dataset(hid_t place, const std::string& name) {
  require_hard_link(place, name);
  return take(H5Dopen2(place, name.c_str(), H5P_DEFAULT), H5Dclose, "open dataset '" + name + "'");
}

hsize_t file_size_of(hid_t object, const std::string& what) {
  const Handle file = take(H5Iget_file_id(object), H5Fclose, "read " + what);
  hsize_t size = 0;
  check(H5Fget_filesize(file.id(), &size), "read " + what);
  return size;
}

// The most bytes that the dataset can give, by what it takes in the file.
hsize_t room_of(hid_t dataset, const std::string& what) {
  const Handle made = take(H5Dget_create_plist(dataset), H5Pclose, "read " + what);
  const H5D_layout_t layout = H5Pget_layout(made.id());
  if (layout != H5D_CONTIGUOUS && layout != H5D_CHUNKED && layout != H5D_COMPACT)
    throw unfit(what, "lies in other files");
  if (H5Pget_external_count(made.id()) != 0) throw unfit(what, "lies in other files");
  const hsize_t stored = H5Dget_storage_size(dataset);
  if (stored > file_size_of(dataset, what)) throw unfit(what, "is larger than its file");
  if (layout != H5D_CHUNKED) return stored;
  std::array<hsize_t, H5S_MAX_RANK> chunk{};
  const int rank = H5Pget_chunk(made.id(), H5S_MAX_RANK, chunk.data());
  const Handle type = take(H5Dget_type(dataset), H5Tclose, "read " + what);
  hsize_t bytes = H5Tget_size(type.id());
  for (int k = 0; k < rank; ++k) {
    const hsize_t length = chunk[static_cast<std::size_t>(k)];
    if (length == 0 || bytes > most_inflation * stored / length) throw unfit(what, "has pieces larger than the whole");
    bytes *= length;
  }
  return most_inflation * stored;
}

struct Dataset {
  Handle handle, type;
  std::vector<hsize_t> extent;
  std::size_t points;
  std::string what;
};

Dataset open_to_read(hid_t place, const std::string& name, Kind kind) {
  const std::string what = "dataset '" + name + "'";
  Handle handle = open_dataset(place, name);
  Handle type = take(H5Dget_type(handle.id()), H5Tclose, "read " + what);
  require_type(type.id(), kind, what);
  const Handle space = take(H5Dget_space(handle.id()), H5Sclose, "read " + what);
  const std::size_t points = points_of(space, what);
  if (points > 0 && points > room_of(handle.id(), what) / H5Tget_size(type.id()))
    throw unfit(what, "says that it holds more than is there");
  std::vector<hsize_t> extent(static_cast<std::size_t>(std::max(0, H5Sget_simple_extent_ndims(space.id()))));
  if (!extent.empty()) check(H5Sget_simple_extent_dims(space.id(), extent.data(), nullptr), "read " + what);
  return {std::move(handle), std::move(type), std::move(extent), points, what};
}

template <class T>
std::vector<T> numbers_of(const Dataset& dataset, hid_t memory) {
  std::vector<T> out(dataset.points);
  if (!out.empty())
    check(H5Dread(dataset.handle.id(), memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, out.data()), "read " + dataset.what);
  return out;
}

void require_width(const Dataset& dataset, int width) {
  const bool fits = width == 1 ? dataset.extent.size() == 1
                               : dataset.extent.size() == 2 && dataset.extent[1] == static_cast<hsize_t>(width);
  if (!fits) throw unfit(dataset.what, fmt::format("does not have {} number{} a row", width, width == 1 ? "" : "s"));
}

template <class T>
std::vector<T> read_numbers(hid_t place, const std::string& name, int width, Kind kind, hid_t memory) {
  const Dataset dataset = open_to_read(place, name, kind);
  require_width(dataset, width);
  return numbers_of<T>(dataset, memory);
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
void fill_column(hid_t place, Column& column, Index rows, Kind kind, hid_t memory) {
  const Dataset dataset = open_to_read(place, column.field().name, kind);
  require_width(dataset, components(column.field().type));
  if (dataset.extent[0] != static_cast<hsize_t>(rows))
    throw unfit(dataset.what, fmt::format("has {} rows, not {}", dataset.extent[0], rows));
  scatter(numbers_of<T>(dataset, memory), column, rows);
}

}  // namespace

Handle open_file(const std::filesystem::path& file, SymbolicLinks links) {
  open_regular(file, O_RDONLY, "open", links);  // HDF5 would wait for a pipe
  const Handle access = take(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "open a file");
  // Files are replaced, never changed: who reads one needs no lock, and some file systems have none.
  H5Pset_file_locking(access.id(), false, true);
  Handle handle(H5Fopen(file.c_str(), H5F_ACC_RDONLY, access.id()), H5Fclose);
  if (!handle)
    throw MachineFailure(fmt::format("HDF5 cannot open '{}': not an HDF5 file, or not whole", file.string()));
  return handle;
}

Handle open_group(hid_t place, const std::string& path) {
  Handle group = take(H5Gopen2(place, path.starts_with('/') ? "/" : ".", H5P_DEFAULT), H5Gclose, "open a group");
  for (const std::string& name : split(path, '/')) {
    if (name.empty()) continue;
    require_hard_link(group.id(), name);
    group = take(H5Gopen2(group.id(), name.c_str(), H5P_DEFAULT), H5Gclose, "open group '" + name + "'");
  }
  return group;
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

std::optional<Elsewhere> leads_elsewhere(hid_t place, const std::string& name) {
  H5L_info_t info;
  check(H5Lget_info(place, name.c_str(), &info, H5P_DEFAULT), "find '" + name + "'");
  if (info.type != H5L_TYPE_EXTERNAL) return std::nullopt;
  if (info.u.val_size == 0 || info.u.val_size > longest_target) throw unfit("link '" + name + "'", "leads nowhere");
  std::vector<char> packed(info.u.val_size);
  check(H5Lget_val(place, name.c_str(), packed.data(), packed.size(), H5P_DEFAULT), "read link '" + name + "'");
  unsigned flags = 0;
  const char *file = nullptr, *group = nullptr;
  check(H5Lunpack_elink_val(packed.data(), packed.size(), &flags, &file, &group), "read link '" + name + "'");
  return Elsewhere{file, group};
}

Shape shape_of(hid_t place, const std::string& name) {
  const std::string what = "dataset '" + name + "'";
  const Handle dataset = open_dataset(place, name);
  const Handle space = take(H5Dget_space(dataset.id()), H5Sclose, "read " + what);
  const Handle type = take(H5Dget_type(dataset.id()), H5Tclose, "read " + what);
  points_of(space, what);
  Shape shape;
  shape.extent.resize(static_cast<std::size_t>(std::max(0, H5Sget_simple_extent_ndims(space.id()))));
  if (!shape.extent.empty()) check(H5Sget_simple_extent_dims(space.id(), shape.extent.data(), nullptr), "read " + what);
  shape.integer = H5Tget_class(type.id()) == H5T_INTEGER;
  shape.text = H5Tget_class(type.id()) == H5T_STRING;
  shape.bytes = H5Tget_size(type.id());
  return shape;
}

std::string unit_of(hid_t place, const std::string& name) {
  const Handle dataset = open_dataset(place, name);
  return has_attribute(dataset.id(), "unit") ? text_attribute(dataset.id(), "unit") : "";
}

bool has_attribute(hid_t object, const std::string& name) { return H5Aexists(object, name.c_str()) > 0; }

std::vector<std::string> texts_attribute(hid_t object, const std::string& name) {
  const Attribute attribute = open_attribute(object, name, Kind::text);
  const std::size_t length = H5Tget_size(attribute.type.id());
  std::vector<char> bytes(std::max<std::size_t>(1, attribute.points * length));
  if (attribute.points > 0)
    check(H5Aread(attribute.handle.id(), attribute.type.id(), bytes.data()), "read " + attribute.what);
  return unpacked(bytes, attribute.points, length);
}

std::string text_attribute(hid_t object, const std::string& name) {
  const auto texts = texts_attribute(object, name);
  if (texts.size() != 1) throw unfit("attribute '" + name + "'", fmt::format("holds {} texts, not one", texts.size()));
  return texts.front();
}

Real real_attribute(hid_t object, const std::string& name) {
  return number_attribute<Real>(object, name, Kind::real, H5T_NATIVE_DOUBLE);
}

std::int64_t integer_attribute(hid_t object, const std::string& name) {
  return number_attribute<std::int64_t>(object, name, Kind::integer, H5T_NATIVE_INT64);
}

std::vector<std::string> names_of(hid_t place, const std::string& name) {
  const Handle dataset = open_dataset(place, name);
  return has_attribute(dataset.id(), "names") ? texts_attribute(dataset.id(), "names") : std::vector<std::string>{};
}

std::vector<std::string> read_texts(hid_t place, const std::string& name) {
  const Dataset dataset = open_to_read(place, name, Kind::text);
  const std::size_t length = H5Tget_size(dataset.type.id());
  std::vector<char> bytes(std::max<std::size_t>(1, dataset.points * length));
  if (dataset.points > 0)
    check(H5Dread(dataset.handle.id(), dataset.type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data()),
          "read " + dataset.what);
  return unpacked(bytes, dataset.points, length);
}

std::string read_text(hid_t place, const std::string& name) {
  const auto texts = read_texts(place, name);
  return texts.empty() ? "" : texts.front();
}

std::vector<Real> read_reals(hid_t place, const std::string& name, int width) {
  return read_numbers<Real>(place, name, width, Kind::real, H5T_NATIVE_DOUBLE);
}

std::vector<Index> read_indices(hid_t place, const std::string& name, int width) {
  return read_numbers<Index>(place, name, width, Kind::integer, H5T_NATIVE_INT32);
}

std::vector<std::int64_t> read_integers(hid_t place, const std::string& name) {
  return read_numbers<std::int64_t>(place, name, 1, Kind::integer, H5T_NATIVE_INT64);
}

Field read_field(hid_t place, const std::string& name, On on) {
  const Handle dataset = open_dataset(place, name);
  Field field{name,
              on,
              Type::real,
              text_attribute(dataset.id(), "unit"),
              text_attribute(dataset.id(), "long_name"),
              text_attribute(dataset.id(), "line")};
  const std::string type = text_attribute(dataset.id(), "type");
  for (const Type known : {Type::real, Type::vec3, Type::quat, Type::index, Type::state, Type::sym3})
    if (type == type_name(known)) {
      field.type = known;
      return field;
    }
  throw MachineFailure(fmt::format("dataset '{}' is of the unknown type '{}'", name, type));
}

void read_column(hid_t place, Column& column, Index rows) {
  switch (column.field().type) {
    case Type::index: return fill_column<Index>(place, column, rows, Kind::integer, H5T_NATIVE_INT32);
    case Type::state: return fill_column<std::uint8_t>(place, column, rows, Kind::integer, H5T_NATIVE_UINT8);
    default: return fill_column<Real>(place, column, rows, Kind::real, H5T_NATIVE_DOUBLE);
  }
}

}  // namespace beadwork::h5
