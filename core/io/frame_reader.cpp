#include "core/io/frame_reader.hpp"

#include <algorithm>

#include "core/io/h5.hpp"

namespace beadwork::record {

struct FrameReader::File {
  h5::Handle handle;
  std::filesystem::path folder;

  h5::Handle frame(const std::string& name) const;
};

namespace {

using h5::Handle;
using h5::has;

std::vector<Vec3> vectors(hid_t place, const std::string& name) {
  const auto flat = h5::read_reals(place, name, 3);
  std::vector<Vec3> out(flat.size() / 3);
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = Vec3(flat[3 * i], flat[3 * i + 1], flat[3 * i + 2]);
  return out;
}

/// A dataset of words: text, or numbers with their names in the attribute "names".
std::vector<std::string> words(hid_t place, const std::string& name) {
  if (h5::shape_of(place, name).text) return h5::read_texts(place, name);
  const auto known = h5::names_of(place, name);
  std::vector<std::string> out;
  for (const std::int64_t value : h5::read_integers(place, name)) {
    const bool named = value >= 0 && value < static_cast<std::int64_t>(known.size());
    out.push_back(named ? known[static_cast<std::size_t>(value)] : std::to_string(value));
  }
  return out;
}

FrameHead head_of(hid_t group, const std::string& name) {
  FrameHead head;
  head.name = name;
  if (h5::has_attribute(group, "time")) head.time = h5::real_attribute(group, "time");
  if (h5::has_attribute(group, "step")) head.step = h5::integer_attribute(group, "step");
  if (h5::has_attribute(group, "picture")) head.picture = h5::integer_attribute(group, "picture") != 0;
  if (h5::has_attribute(group, "view")) head.view = h5::text_attribute(group, "view");
  return head;
}

/// Columns besides the `usual` ones; what has another shape or length is no column.
std::vector<FieldValues> read_fields(hid_t group, std::initializer_list<const char*> usual, std::size_t rows,
                                     Columns columns) {
  std::vector<FieldValues> fields;
  for (const std::string& name : h5::names_in(group)) {
    if (std::find(usual.begin(), usual.end(), name) != usual.end()) continue;
    const std::vector<hsize_t> shape = h5::shape_of(group, name).extent;
    if (shape.empty() || shape[0] != rows || shape.size() > 2) continue;
    const hsize_t width = shape.size() == 2 ? shape[1] : 1;
    const bool is_known = width == 1 || width == 3 || width == 4 || width == 6;
    if (!is_known || (columns == Columns::drawable && width > 3)) continue;
    FieldValues field;
    field.name = name;
    field.is_length = columns == Columns::drawable && width == 3;
    field.unit = h5::unit_of(group, name);
    if (field.is_length) {
      for (const Vec3& v : vectors(group, name)) field.values.push_back(v.norm());
    } else {
      field.width = static_cast<int>(width);
      field.values = h5::read_reals(group, name, field.width);
    }
    fields.push_back(std::move(field));
  }
  return fields;
}

Bonds read_bonds(hid_t group, const std::string& family, std::size_t elements, Columns columns) {
  Bonds bonds;
  bonds.family = family;
  if (h5::has_attribute(group, "law")) bonds.law = h5::text_attribute(group, "law");
  const auto flat = h5::read_indices(group, "ends", 2);
  for (std::size_t b = 0; 2 * b < flat.size(); ++b) bonds.ends.push_back({flat[2 * b], flat[2 * b + 1]});
  for (const auto& [i, j] : bonds.ends)
    if (i < 0 || j < 0 || std::max<std::size_t>(i, j) >= elements)
      throw MachineFailure("bond family '" + family + "' names an element that its frame does not hold");
  if (has(group, "id")) bonds.id = h5::read_integers(group, "id");
  for (std::size_t b = bonds.id.size(); b < bonds.ends.size(); ++b) bonds.id.push_back(static_cast<std::int64_t>(b));
  bonds.id.resize(bonds.ends.size());
  bonds.state.assign(bonds.ends.size(), State::intact);
  if (has(group, "state")) {
    const auto state = h5::read_integers(group, "state");
    for (std::size_t b = 0; b < std::min(state.size(), bonds.state.size()); ++b)
      bonds.state[b] = static_cast<State>(std::clamp<std::int64_t>(state[b], 0, 2));
  }
  bonds.has_damage = has(group, "damage");
  bonds.fields = read_fields(group, {"ends", "id", "state"}, bonds.ends.size(), columns);
  return bonds;
}

}  // namespace

// A frame stands in the file itself, or, while the run goes on, in a file of its own, frames/<name>.h5 beside it.
h5::Handle FrameReader::File::frame(const std::string& name) const {
  const Handle frames = h5::open_group(handle.id(), "frames");
  const auto elsewhere = h5::leads_elsewhere(frames.id(), name);
  if (!elsewhere) return h5::open_group(frames.id(), name);
  const std::filesystem::path file = elsewhere->file;
  if (file.parent_path() != "frames" || file.filename() == "..")
    throw MachineFailure("frame '" + name + "' leads to '" + file.string() + "', which is no frame of this run");
  std::error_code error;
  if (std::filesystem::is_symlink(folder / "frames", error))
    throw MachineFailure("'" + (folder / "frames").string() + "' is a link, which is not followed");
  return h5::open_group(h5::open_file(folder / file).id(), elsewhere->group);
}

FrameReader::FrameReader(const std::filesystem::path& file, SymbolicLinks links) : file_(std::make_unique<File>()) {
  const h5::Silence silence;
  file_->handle = h5::open_file(file, links);
  std::error_code error;  // of a path that leads nowhere: then it could not be opened
  file_->folder =
      (links == SymbolicLinks::follow ? std::filesystem::weakly_canonical(file, error) : file).parent_path();
  if (!has(file_->handle.id(), "frames")) return;
  for (const std::string& name : h5::names_in(h5::open_group(file_->handle.id(), "frames").id())) {
    try {
      frames_.push_back(head_of(file_->frame(name).id(), name));
    } catch (const MachineFailure&) {
      ++unreadable_;
    }
  }
  std::stable_sort(frames_.begin(), frames_.end(),
                   [](const FrameHead& a, const FrameHead& b) { return a.step < b.step; });
}

FrameReader::~FrameReader() = default;

Frame FrameReader::read(const FrameHead& head, Columns columns) const {
  const h5::Silence silence;
  const Handle group = file_->frame(head.name);
  const Handle elements = h5::open_group(group.id(), "elements");
  Frame frame;
  frame.head = head;
  frame.position = vectors(elements.id(), "position");
  const std::size_t count = frame.position.size();
  if (has(elements.id(), "radius")) frame.radius = h5::read_reals(elements.id(), "radius");
  if (has(elements.id(), "id")) frame.id = h5::read_integers(elements.id(), "id");
  if (has(elements.id(), "displacement")) frame.displacement = vectors(elements.id(), "displacement");
  for (std::size_t i = frame.id.size(); i < count; ++i) frame.id.push_back(static_cast<std::int64_t>(i));
  if (frame.radius.size() != count || frame.id.size() != count ||
      (!frame.displacement.empty() && frame.displacement.size() != count))
    throw MachineFailure("the columns of frame " + head.name + " have different lengths");
  frame.fields = read_fields(elements.id(), {"id", "position", "radius"}, count, columns);
  if (has(group.id(), "walls")) {
    const std::vector<Real> numbers = h5::read_reals(group.id(), "walls", 6);
    for (std::size_t k = 0; k + 6 <= numbers.size(); k += 6)
      frame.walls.push_back(
          {Vec3(numbers[k], numbers[k + 1], numbers[k + 2]), Vec3(numbers[k + 3], numbers[k + 4], numbers[k + 5])});
  }
  if (!has(group.id(), "bonds")) return frame;
  const Handle bonds = h5::open_group(group.id(), "bonds");
  for (const std::string& family : h5::names_in(bonds.id()))
    frame.bonds.push_back(read_bonds(h5::open_group(bonds.id(), family).id(), family, count, columns));
  return frame;
}

Breaks FrameReader::breaks() const {
  const h5::Silence silence;
  Breaks log;
  if (!has(file_->handle.id(), "breaks")) return log;
  const Handle handle = h5::open_group(file_->handle.id(), "breaks");
  const hid_t group = handle.id();
  if (!has(group, "time")) return log;
  log.time = h5::read_reals(group, "time");
  if (has(group, "mode")) log.mode = words(group, "mode");
  if (has(group, "energy")) log.energy = h5::read_reals(group, "energy");
  if (has(group, "family")) log.family = words(group, "family");
  if (has(group, "step")) log.step = h5::read_integers(group, "step");
  if (has(group, "bond")) log.bond = h5::read_integers(group, "bond");
  if (has(group, "element")) log.element = h5::read_integers(group, "element");
  if (has(group, "place")) log.place = vectors(group, "place");
  // A run that was killed may have left columns of different lengths; the rows that are whole count.
  std::size_t rows = log.time.size();
  if (!log.mode.empty()) rows = std::min(rows, log.mode.size());
  const auto cut = [rows](auto& column) { column.resize(std::min(rows, column.size())); };
  cut(log.time), cut(log.energy), cut(log.family), cut(log.step), cut(log.bond), cut(log.element), cut(log.place);
  log.mode.resize(rows, "broken");
  return log;
}

std::map<std::string, std::string> FrameReader::meta() const {
  const h5::Silence silence;
  std::map<std::string, std::string> out;
  if (!has(file_->handle.id(), "meta")) return out;
  const Handle group = h5::open_group(file_->handle.id(), "meta");
  for (const std::string& name : h5::names_in(group.id())) {
    try {
      const auto lines = h5::read_texts(group.id(), name);
      if (lines.size() == 1) out[name] = lines.front();
    } catch (const MachineFailure&) {  // no text
    }
  }
  return out;
}

std::map<std::string, std::vector<std::int64_t>> FrameReader::sets() const { return ids_in("sets", 1); }
std::map<std::string, std::vector<std::int64_t>> FrameReader::pairs() const { return ids_in("pairs", 2); }

std::map<std::string, std::vector<std::int64_t>> FrameReader::ids_in(const char* name_of_group, int width) const {
  const h5::Silence silence;
  std::map<std::string, std::vector<std::int64_t>> out;
  if (!has(file_->handle.id(), name_of_group)) return out;
  const Handle group = h5::open_group(file_->handle.id(), name_of_group);
  for (const std::string& name : h5::names_in(group.id())) {
    const std::vector<Index> ids = h5::read_indices(group.id(), name, width);
    out[name].assign(ids.begin(), ids.end());
  }
  return out;
}

}  // namespace beadwork::record
