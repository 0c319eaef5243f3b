#include "core/io/frame_reader.hpp"

#include <algorithm>
#include <cstring>

#include "core/io/h5_handle.hpp"

namespace beadwork::record {

struct FrameReader::File {
  h5::Handle handle;
};

namespace {

using h5::Handle;

bool has(hid_t place, const std::string& name) { return H5Lexists(place, name.c_str(), H5P_DEFAULT) > 0; }

std::vector<std::string> names_in(hid_t group) {
  std::vector<std::string> names;
  const auto collect = [](hid_t, const char* name, const H5L_info_t*, void* out) -> herr_t {
    static_cast<std::vector<std::string>*>(out)->emplace_back(name);
    return 0;
  };
  H5Literate(group, H5_INDEX_NAME, H5_ITER_INC, nullptr, collect, &names);
  return names;
}

Handle open_group(hid_t place, const std::string& name) {
  return h5::own(H5Gopen2(place, name.c_str(), H5P_DEFAULT), H5Gclose, "open group '" + name + "'");
}

Handle open_dataset(hid_t place, const std::string& name) {
  return h5::own(H5Dopen2(place, name.c_str(), H5P_DEFAULT), H5Dclose, "open dataset '" + name + "'");
}

std::vector<hsize_t> shape_of(hid_t dataset) {
  const Handle space(H5Dget_space(dataset), H5Sclose);
  const int rank = H5Sget_simple_extent_ndims(space.id());
  std::vector<hsize_t> shape(static_cast<std::size_t>(std::max(rank, 0)));
  if (rank > 0) H5Sget_simple_extent_dims(space.id(), shape.data(), nullptr);
  return shape;
}

/// All numbers of a dataset whose rows hold `width` of them.
template <class T>
std::vector<T> numbers(hid_t place, const std::string& name, hid_t type, hsize_t width) {
  const Handle dataset = open_dataset(place, name);
  const std::vector<hsize_t> shape = shape_of(dataset.id());
  const hsize_t found = shape.size() == 2 ? shape[1] : 1;
  if (shape.empty() || shape.size() > 2 || found != width)
    throw MachineFailure("dataset '" + name + "' does not have " + std::to_string(width) + " numbers a row");
  std::vector<T> out(static_cast<std::size_t>(shape[0] * width));
  if (!out.empty() && H5Dread(dataset.id(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, out.data()) < 0)
    throw MachineFailure("HDF5 cannot read dataset '" + name + "'");
  return out;
}

std::vector<Real> reals(hid_t place, const std::string& name) {
  return numbers<Real>(place, name, H5T_NATIVE_DOUBLE, 1);
}

std::vector<std::int64_t> integers(hid_t place, const std::string& name) {
  return numbers<std::int64_t>(place, name, H5T_NATIVE_INT64, 1);
}

std::vector<Vec3> vectors(hid_t place, const std::string& name) {
  const auto flat = numbers<Real>(place, name, H5T_NATIVE_DOUBLE, 3);
  std::vector<Vec3> out(flat.size() / 3);
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = Vec3(flat[3 * i], flat[3 * i + 1], flat[3 * i + 2]);
  return out;
}

/// Reads text of fixed or variable length through `read(memory_type, buffer)`.
template <class Read>
std::vector<std::string> texts_through(hid_t file_type, hid_t space, std::size_t count, const Read& read) {
  std::vector<std::string> out;
  if (H5Tis_variable_str(file_type) > 0) {
    std::vector<char*> raw(count, nullptr);
    if (count > 0 && read(file_type, raw.data()) < 0) return out;
    for (const char* text : raw) out.emplace_back(text ? text : "");
    H5Dvlen_reclaim(file_type, space, H5P_DEFAULT, raw.data());
    return out;
  }
  const std::size_t length = H5Tget_size(file_type);
  std::vector<char> raw(count * length);
  if (count > 0 && read(file_type, raw.data()) < 0) return out;
  for (std::size_t i = 0; i < count; ++i) {
    const char* text = raw.data() + i * length;
    out.emplace_back(text, strnlen(text, length));
  }
  return out;
}

std::vector<std::string> text_attribute(hid_t object, const std::string& name) {
  if (H5Aexists(object, name.c_str()) <= 0) return {};
  const Handle attribute(H5Aopen(object, name.c_str(), H5P_DEFAULT), H5Aclose);
  const Handle type(H5Aget_type(attribute.id()), H5Tclose);
  if (!attribute || H5Tget_class(type.id()) != H5T_STRING) return {};
  const Handle space(H5Aget_space(attribute.id()), H5Sclose);
  const auto count = static_cast<std::size_t>(H5Sget_simple_extent_npoints(space.id()));
  return texts_through(type.id(), space.id(), count,
                       [&](hid_t memory, void* out) { return H5Aread(attribute.id(), memory, out); });
}

/// A dataset of words: text, an enumeration, or numbers with their names in the attribute "names".
std::vector<std::string> words(hid_t place, const std::string& name) {
  const Handle dataset = open_dataset(place, name);
  const Handle type(H5Dget_type(dataset.id()), H5Tclose);
  const Handle space(H5Dget_space(dataset.id()), H5Sclose);
  if (H5Tget_class(type.id()) == H5T_STRING) {
    const auto count = static_cast<std::size_t>(H5Sget_simple_extent_npoints(space.id()));
    return texts_through(type.id(), space.id(), count, [&](hid_t memory, void* out) {
      return H5Dread(dataset.id(), memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, out);
    });
  }
  const std::vector<std::string> known = text_attribute(dataset.id(), "names");
  std::map<std::int64_t, std::string> members;
  if (H5Tget_class(type.id()) == H5T_ENUM) {
    const Handle stored(H5Tget_super(type.id()), H5Tclose);
    for (unsigned i = 0; i < static_cast<unsigned>(H5Tget_nmembers(type.id())); ++i) {
      std::int64_t value = 0;
      H5Tget_member_value(type.id(), i, &value);
      H5Tconvert(stored.id(), H5T_NATIVE_INT64, 1, &value, nullptr, H5P_DEFAULT);
      char* member = H5Tget_member_name(type.id(), i);
      members[value] = member ? member : "";
      H5free_memory(member);
    }
  }
  std::vector<std::string> out;
  for (const std::int64_t value : integers(place, name)) {
    const bool named = value >= 0 && value < static_cast<std::int64_t>(known.size());
    const auto member = members.find(value);
    out.push_back(named                     ? known[static_cast<std::size_t>(value)]
                  : member != members.end() ? member->second
                                            : std::to_string(value));
  }
  return out;
}

template <class T>
T number_attribute(hid_t object, const char* name, hid_t type, T otherwise) {
  if (H5Aexists(object, name) <= 0) return otherwise;
  const Handle attribute(H5Aopen(object, name, H5P_DEFAULT), H5Aclose);
  T value = otherwise;
  if (!attribute || H5Aread(attribute.id(), type, &value) < 0) return otherwise;
  return value;
}

FrameHead head_of(hid_t group, const std::string& name) {
  FrameHead head;
  head.name = name;
  head.time = number_attribute<Real>(group, "time", H5T_NATIVE_DOUBLE, 0);
  head.step = number_attribute<std::int64_t>(group, "step", H5T_NATIVE_INT64, 0);
  head.picture = number_attribute<int>(group, "picture", H5T_NATIVE_INT, 0) != 0;
  if (const auto view = text_attribute(group, "view"); !view.empty()) head.view = view.front();
  return head;
}

/// Columns of numbers and of vectors besides the `usual` ones; what has another shape or length is no column.
std::vector<FieldValues> read_fields(hid_t group, std::initializer_list<const char*> usual, std::size_t rows) {
  std::vector<FieldValues> fields;
  for (const std::string& name : names_in(group)) {
    if (std::find(usual.begin(), usual.end(), name) != usual.end()) continue;
    const Handle dataset(H5Dopen2(group, name.c_str(), H5P_DEFAULT), H5Dclose);
    if (!dataset) continue;
    const std::vector<hsize_t> shape = shape_of(dataset.id());
    const bool vector = shape.size() == 2 && shape[1] == 3;
    if (shape.empty() || shape[0] != rows || (shape.size() > 1 && !vector)) continue;
    FieldValues field;
    field.name = name;
    field.is_length = vector;
    if (const auto unit = text_attribute(dataset.id(), "unit"); !unit.empty()) field.unit = unit.front();
    if (vector)
      for (const Vec3& v : vectors(group, name)) field.values.push_back(v.norm());
    else
      field.values = reals(group, name);
    fields.push_back(std::move(field));
  }
  return fields;
}

Bonds read_bonds(hid_t group, const std::string& family, std::size_t elements) {
  Bonds bonds;
  bonds.family = family;
  const auto law = text_attribute(group, "law");
  if (!law.empty()) bonds.law = law.front();
  const auto flat = numbers<Index>(group, "ends", H5T_NATIVE_INT32, 2);
  for (std::size_t b = 0; 2 * b < flat.size(); ++b) bonds.ends.push_back({flat[2 * b], flat[2 * b + 1]});
  for (const auto& [i, j] : bonds.ends)
    if (i < 0 || j < 0 || std::max<std::size_t>(i, j) >= elements)
      throw MachineFailure("bond family '" + family + "' names an element that its frame does not hold");
  bonds.state.assign(bonds.ends.size(), State::intact);
  if (has(group, "state")) {
    const auto state = integers(group, "state");
    for (std::size_t b = 0; b < std::min(state.size(), bonds.state.size()); ++b)
      bonds.state[b] = static_cast<State>(std::clamp<std::int64_t>(state[b], 0, 2));
  }
  bonds.has_damage = has(group, "damage");
  bonds.fields = read_fields(group, {"ends", "id", "state"}, bonds.ends.size());
  return bonds;
}

}  // namespace

FrameReader::FrameReader(const std::filesystem::path& file) : file_(std::make_unique<File>()) {
  const h5::Silence silence;
  // A run that is still going on holds a lock; whoever only looks need not wait for it.
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_file_locking(access.id(), false, true);
  file_->handle = h5::own(H5Fopen(file.c_str(), H5F_ACC_RDONLY, access.id()), H5Fclose,
                          "open '" + file.string() + "': not an HDF5 file, or not whole");
  if (!has(file_->handle.id(), "frames")) return;
  const Handle group = open_group(file_->handle.id(), "frames");
  for (const std::string& name : names_in(group.id())) {
    const Handle frame(H5Gopen2(group.id(), name.c_str(), H5P_DEFAULT), H5Gclose);
    if (frame)
      frames_.push_back(head_of(frame.id(), name));
    else
      ++unreadable_;
  }
  std::stable_sort(frames_.begin(), frames_.end(),
                   [](const FrameHead& a, const FrameHead& b) { return a.step < b.step; });
}

FrameReader::~FrameReader() = default;

Frame FrameReader::read(const FrameHead& head) const {
  const h5::Silence silence;
  const Handle group = open_group(file_->handle.id(), "frames/" + head.name);
  const Handle elements = open_group(group.id(), "elements");
  Frame frame;
  frame.head = head;
  frame.position = vectors(elements.id(), "position");
  const std::size_t count = frame.position.size();
  if (has(elements.id(), "radius")) frame.radius = reals(elements.id(), "radius");
  if (has(elements.id(), "id")) frame.id = integers(elements.id(), "id");
  if (has(elements.id(), "displacement")) frame.displacement = vectors(elements.id(), "displacement");
  for (std::size_t i = frame.id.size(); i < count; ++i) frame.id.push_back(static_cast<std::int64_t>(i));
  if (frame.radius.size() != count || frame.id.size() != count ||
      (!frame.displacement.empty() && frame.displacement.size() != count))
    throw MachineFailure("the columns of frame " + head.name + " have different lengths");
  frame.fields = read_fields(elements.id(), {"id", "position", "radius"}, count);
  if (!has(group.id(), "bonds")) return frame;
  const Handle bonds = open_group(group.id(), "bonds");
  for (const std::string& family : names_in(bonds.id()))
    frame.bonds.push_back(read_bonds(open_group(bonds.id(), family).id(), family, count));
  return frame;
}

Breaks FrameReader::breaks() const {
  const h5::Silence silence;
  Breaks log;
  if (!has(file_->handle.id(), "breaks")) return log;
  const Handle group = open_group(file_->handle.id(), "breaks");
  if (!has(group.id(), "time")) return log;
  log.time = reals(group.id(), "time");
  if (has(group.id(), "family")) log.family = words(group.id(), "family");
  if (has(group.id(), "mode")) log.mode = words(group.id(), "mode");
  if (has(group.id(), "place")) log.place = vectors(group.id(), "place");
  if (has(group.id(), "energy")) log.energy = reals(group.id(), "energy");
  // A run that was killed may have left columns of different lengths; the rows that are whole count.
  std::size_t rows = log.time.size();
  if (!log.mode.empty()) rows = std::min(rows, log.mode.size());
  log.time.resize(rows);
  log.family.resize(rows);
  log.mode.resize(rows, "broken");
  log.place.resize(std::min(rows, log.place.size()));
  log.energy.resize(std::min(rows, log.energy.size()));
  return log;
}

std::map<std::string, std::string> FrameReader::meta() const {
  const h5::Silence silence;
  std::map<std::string, std::string> out;
  if (!has(file_->handle.id(), "meta")) return out;
  const Handle group = open_group(file_->handle.id(), "meta");
  for (const std::string& name : names_in(group.id())) {
    const Handle dataset(H5Dopen2(group.id(), name.c_str(), H5P_DEFAULT), H5Dclose);
    const Handle type(dataset ? H5Dget_type(dataset.id()) : -1, H5Tclose);
    if (!type || H5Tget_class(type.id()) != H5T_STRING) continue;
    const auto lines = words(group.id(), name);
    if (lines.size() == 1) out[name] = lines.front();
  }
  return out;
}

std::map<std::string, std::vector<std::int64_t>> FrameReader::sets() const {
  const h5::Silence silence;
  std::map<std::string, std::vector<std::int64_t>> out;
  if (!has(file_->handle.id(), "sets")) return out;
  const Handle group = open_group(file_->handle.id(), "sets");
  for (const std::string& name : names_in(group.id())) out[name] = integers(group.id(), name);
  return out;
}

}  // namespace beadwork::record
