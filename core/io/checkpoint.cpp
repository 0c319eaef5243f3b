#include "core/io/checkpoint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/io/check_sum.hpp"
#include "core/io/file.hpp"
#include "core/io/h5.hpp"

namespace beadwork {

namespace {

constexpr std::int64_t format_version = 5;

// ---- writing

void save_table(hid_t place, const std::string& name, const Table& table) {
  const h5::Handle group = h5::make_group(place, name);
  h5::set_attribute(group.id(), "rows", static_cast<std::int64_t>(table.size()));
  for (const Column* column : table.columns())
    if (column->kept()) h5::write_column(group.id(), *column, table.size());
}

void save_lists(hid_t place, const Domain& domain) {
  const h5::Handle group = h5::make_group(place, "lists");
  for (const auto& [name, list] : domain.lists()) save_table(group.id(), name, list);
}

// A scene without walls has no word of them.
void save_walls(hid_t place, const Walls& walls) {
  if (!walls.any()) return;
  save_table(place, "walls", walls.walls());
  save_table(place, "facets", walls.facet_rows());
}

void save_families(hid_t place, const Domain& domain) {
  const h5::Handle group = h5::make_group(place, "bonds");
  std::vector<std::string> names;
  for (const auto& family : domain.families()) {
    save_table(group.id(), family->name(), family->rows());
    names.push_back(family->name());
  }
  h5::write_texts(place, "families", names);
}

void save_sets(hid_t place, const Domain& domain) {
  const h5::Handle group = h5::make_group(place, "sets");
  for (const auto& [name, set] : domain.sets())
    h5::write_indices(group.id(), name, set, 1, {"1", "Rows of the elements of the set"});
}

void save_pairs(hid_t place, const Domain& domain) {
  const h5::Handle group = h5::make_group(place, "pairs");
  for (const auto& [name, pairs] : domain.pairs()) {
    std::vector<Index> rows;
    for (const auto& [first, second] : pairs) rows.insert(rows.end(), {first, second});
    h5::write_indices(group.id(), name, rows, 2, {"1", "Rows of elements that are neighbours"});
  }
}

void save_breaks(hid_t place, const BreakLog& log) {
  const h5::Handle group = h5::make_group(place, "breaks");
  std::vector<Real> reals;
  std::vector<Index> indices;
  std::vector<std::int64_t> steps;
  for (const Break& b : log.breaks) {
    reals.insert(reals.end(), {b.time, b.place[0], b.place[1], b.place[2], b.energy});
    indices.insert(indices.end(), {b.family, b.bond, b.mode, b.element});
    steps.push_back(b.step);
  }
  h5::write_texts(group.id(), "modes", log.modes);
  h5::write_reals(group.id(), "reals", reals, 5, {"SI", "Time, place (3), energy"});
  h5::write_indices(group.id(), "indices", indices, 4, {"1", "Family, bond, mode, element that failed or -1"});
  h5::write_integers(group.id(), "steps", steps, {"1", "Step"});
}

void save_moment(hid_t group, const Moment& moment) {
  h5::set_attribute(group, "stage", static_cast<std::int64_t>(moment.stage));
  h5::set_attribute(group, "time", moment.time);
  h5::set_attribute(group, "step", moment.step);
  h5::set_attribute(group, "time-step", moment.time_step);
  h5::set_attribute(group, "stage-start", moment.stage_start);
  h5::set_attribute(group, "stage-step", moment.stage_step);
}

void save_meta(hid_t place, const CheckpointMeta& meta) {
  const h5::Handle group = h5::make_group(place, "meta");
  h5::set_attribute(group.id(), "format", format_version);
  h5::set_attribute(group.id(), "version", meta.version);
  h5::set_attribute(group.id(), "deck_sha256", meta.deck_sha256);
  save_moment(group.id(), meta.moment);
  h5::set_attribute(group.id(), "seed", static_cast<std::int64_t>(meta.seed));
  h5::write_text(group.id(), "resolved", meta.resolved);
  std::vector<std::string> keys, values;
  for (const auto& [key, value] : meta.texts) {
    keys.push_back(key);
    values.push_back(value);
  }
  h5::write_texts(group.id(), "keys", keys);
  for (std::size_t i = 0; i < values.size(); ++i) h5::write_text(group.id(), fmt::format("value-{}", i), values[i]);
}

// ---- reading

Moment load_moment(hid_t group) {
  const std::int64_t stage = h5::integer_attribute(group, "stage");
  Moment m{h5::real_attribute(group, "time"),        h5::integer_attribute(group, "step"),
           h5::real_attribute(group, "time-step"),   static_cast<int>(stage),
           h5::real_attribute(group, "stage-start"), h5::integer_attribute(group, "stage-step")};
  const auto refuse_if = [](bool wrong, const std::string& what) {
    if (wrong) throw MachineFailure(what + ", which no run can have");
  };
  refuse_if(stage < 0 || stage > std::numeric_limits<int>::max(), fmt::format("its stage is {}", stage));
  refuse_if(m.step < 0 || !std::isfinite(m.time), fmt::format("it is of step {} at {} s", m.step, m.time));
  // statics step back in time where loads follow a snap-back
  refuse_if(!std::isfinite(m.time_step), fmt::format("its time step is {} s", m.time_step));
  refuse_if(!std::isfinite(m.stage_start) || m.stage_step < 0 || m.stage_step > m.step,
            fmt::format("its stage began at step {} of {}, at {} s", m.stage_step, m.step, m.stage_start));
  return m;
}

CheckpointMeta load_meta(hid_t place) {
  const h5::Handle group = h5::open_group(place, "meta");
  const std::int64_t format = h5::integer_attribute(group.id(), "format");
  if (format != format_version)
    throw MachineFailure(fmt::format("it has format {}, this program reads format {}", format, format_version));
  CheckpointMeta meta;
  meta.version = h5::text_attribute(group.id(), "version");
  meta.deck_sha256 = h5::text_attribute(group.id(), "deck_sha256");
  meta.moment = load_moment(group.id());
  meta.seed = static_cast<std::uint64_t>(h5::integer_attribute(group.id(), "seed"));
  meta.resolved = h5::read_text(group.id(), "resolved");
  const auto keys = h5::read_texts(group.id(), "keys");
  for (std::size_t i = 0; i < keys.size(); ++i)
    meta.texts[keys[i]] = h5::read_text(group.id(), fmt::format("value-{}", i));
  return meta;
}

std::string described(const Field& field) { return fmt::format("{} [{}]", type_name(field.type), field.unit); }

// A column of the file that the scene has not declared yet is one that a plugin will add later: keep it.
Column& column_for(Table& table, const Field& saved, const std::string& of) {
  if (const Column* there = table.find(saved.name))
    if (there->field().type != saved.type || there->field().unit != saved.unit)
      throw DeckFailure(fmt::format(
          "the checkpoint has column '{}' of {} as {}, this deck wants {}; resume with the deck that wrote it",
          saved.name, of, described(saved), described(there->field())));
  Column& column = table.add(saved);
  column.keep();
  return column;
}

void load_columns(hid_t place, const std::string& name, Table& table, On on, const std::string& of) {
  const h5::Handle group = h5::open_group(place, name);
  for (const Column* column : table.columns())
    if (column->kept() && !h5::has(group.id(), column->field().name))
      throw DeckFailure(fmt::format(
          "the checkpoint has no column '{}' of {}, which this deck keeps; resume with the deck that wrote it",
          column->field().name, of));
  for (const std::string& column : h5::names_in(group.id()))
    h5::read_column(group.id(), column_for(table, h5::read_field(group.id(), column, on), of), table.size());
}

// Rows of a table, which all its columns have. Checked before room is made for them.
Index saved_rows(hid_t place, const std::string& name, Index most = most_elements) {
  const h5::Handle group = h5::open_group(place, name);
  const std::int64_t rows = h5::integer_attribute(group.id(), "rows");
  const auto columns = h5::names_in(group.id());
  const bool fits = rows >= 0 && rows <= most && (rows <= 1 || !columns.empty()) &&
                    std::all_of(columns.begin(), columns.end(), [&](const std::string& column) {
                      const auto extent = h5::shape_of(group.id(), column).extent;
                      return !extent.empty() && extent[0] == static_cast<hsize_t>(rows);
                    });
  if (!fits) throw MachineFailure(fmt::format("'{}' does not have the {} rows that it says", name, rows));
  return static_cast<Index>(rows);
}

void require_range(View<const Index> numbers, Index rows, Index below, const std::string& what) {
  for (Index row = 0; row < rows; ++row)
    if (numbers[row] < 0 || numbers[row] >= below)
      throw MachineFailure(fmt::format("{} {} is not one of {}", what, numbers[row], below));
}

// Ids are those of 0 to below - 1, each at most once.
void require_ids(View<const Index> ids, Index rows, std::vector<bool>& taken, const std::string& of) {
  require_range(ids, rows, static_cast<Index>(taken.size()), "id of " + of);
  for (Index row = 0; row < rows; ++row) {
    if (taken[static_cast<std::size_t>(ids[row])])
      throw MachineFailure(fmt::format("two of the {} have id {}", of, ids[row]));
    taken[static_cast<std::size_t>(ids[row])] = true;
  }
}

// What the loop takes for granted when it follows a number to a row.
void require_whole(const Domain& domain) {
  const Index elements = domain.size();
  std::vector<bool> element_ids(static_cast<std::size_t>(elements)), bond_ids(static_cast<std::size_t>(domain.bonds()));
  require_ids(domain.elements().column("id").view<const Index>(), elements, element_ids, "elements");
  for (const auto& family : domain.families()) {
    require_range(family->first(), family->size(), elements, "first end of a bond of '" + family->name() + "':");
    require_range(family->second(), family->size(), elements, "second end of a bond of '" + family->name() + "':");
    if (!family->is_of_contacts()) require_ids(family->id(), family->size(), bond_ids, "bonds");
    if (family->is_of_walls())
      for (Index row = 0; row < family->size(); ++row)
        if (const Near pair = family->near(row); !domain.walls().has_facet(pair.second, pair.facet))
          throw MachineFailure(fmt::format("a contact of '{}' is with facet {} of element {}, which is none of a wall",
                                           family->name(), pair.facet, pair.second));
    for (Index row = 0; row < family->size(); ++row)
      if (family->state()[row] > State::broken)
        throw MachineFailure(fmt::format("a bond of '{}' is in no state that there is", family->name()));
  }
  for (const auto& [name, set] : domain.sets())
    for (const Index row : set)
      if (row < 0 || row >= elements)
        throw MachineFailure(fmt::format("set '{}' names element {} of {}", name, row, elements));
  for (const auto& [name, pairs] : domain.pairs())
    for (const auto& [first, second] : pairs)
      if (first < 0 || first >= second || second >= elements)
        throw MachineFailure(
            fmt::format("neighbours of '{}' are the elements {} and {} of {}", name, first, second, elements));
}

// What the scene lists follows from the deck: its rows are there already. A list that it has not made is one that a mover
// will ask for later.
void load_lists(hid_t place, Domain& domain) {
  constexpr Index most = std::numeric_limits<Index>::max();  // a stiffness has a hundred numbers of each element
  const h5::Handle group = h5::open_group(place, "lists");
  for (const auto& [name, list] : domain.lists())
    if (!h5::has(group.id(), name) || saved_rows(group.id(), name, most) != list.size())
      throw DeckFailure(
          fmt::format("the checkpoint does not list the {} {} that this deck has; resume with the deck that wrote it",
                      list.size(), name));
  for (const std::string& name : h5::names_in(group.id())) {
    const bool is_new = domain.lists().count(name) == 0;
    Table& list = domain.list(name);
    if (is_new) list.resize(saved_rows(group.id(), name, most));  // others stay where their views look
    load_columns(group.id(), name, list, On::scene, fmt::format("the scene's {}", name));
  }
}

void load_walls(hid_t place, Domain& domain) {
  Walls& walls = domain.walls();
  for (const auto& [name, table] :
       {std::pair<const char*, Table*>{"walls", &walls.walls()}, {"facets", &walls.facet_rows()}}) {
    table->resize(h5::has(place, name) ? saved_rows(place, name) : 0);
    if (table->size() > 0) load_columns(place, name, *table, On::scene, fmt::format("the {}", name));
  }
  if (!walls.is_whole(domain.elements().column("radius").view<const Real>(), domain.size()))
    throw MachineFailure("its walls name facets or elements that there are not");
}

// `families[k]` is the place in the domain of the file's family k.
std::vector<Index> load_families(hid_t place, Domain& domain) {
  const h5::Handle group = h5::open_group(place, "bonds");
  std::vector<Index> families;
  for (const std::string& name : h5::read_texts(place, "families")) {
    const auto& all = domain.families();
    const auto found = std::find_if(all.begin(), all.end(), [&](const auto& family) { return family->name() == name; });
    if (found == all.end())
      throw DeckFailure(fmt::format(
          "the checkpoint has bonds '{}', which this deck has not; resume with the deck that wrote it", name));
    BondTable& family = **found;
    family.rows().resize(saved_rows(group.id(), name));
    load_columns(group.id(), name, family.rows(), On::bonds, fmt::format("bonds '{}'", name));
    family.rebind();
    families.push_back(static_cast<Index>(found - all.begin()));
  }
  return families;
}

void load_sets(hid_t place, Domain& domain) {
  const h5::Handle group = h5::open_group(place, "sets");
  domain.sets().clear();
  for (const std::string& name : h5::names_in(group.id())) domain.sets()[name] = h5::read_indices(group.id(), name);
}

void load_pairs(hid_t place, Domain& domain) {
  domain.pairs().clear();
  const h5::Handle group = h5::open_group(place, "pairs");
  for (const std::string& name : h5::names_in(group.id())) {
    const std::vector<Index> rows = h5::read_indices(group.id(), name, 2);
    PairList& pairs = domain.pairs()[name];
    for (std::size_t k = 0; k + 1 < rows.size(); k += 2) pairs.emplace_back(rows[k], rows[k + 1]);
  }
}

BreakLog load_breaks(hid_t place, const std::vector<Index>& families, const Domain& domain) {
  const h5::Handle group = h5::open_group(place, "breaks");
  BreakLog log;
  log.modes = h5::read_texts(group.id(), "modes");
  const auto reals = h5::read_reals(group.id(), "reals", 5);
  const auto indices = h5::read_indices(group.id(), "indices", 4);
  const auto steps = h5::read_integers(group.id(), "steps");
  if (reals.size() != 5 * steps.size() || indices.size() != 4 * steps.size())
    throw MachineFailure("its log of breaks is not whole");
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const Real* r = &reals[5 * i];
    const Index* n = &indices[4 * i];
    const auto within = [](Index number, std::size_t count) {
      return number >= 0 && static_cast<std::size_t>(number) < count;
    };
    if (!within(n[0], families.size()) || !within(n[1], static_cast<std::size_t>(domain.bonds())) ||
        !within(n[2], log.modes.size()) || (n[3] != -1 && !within(n[3], static_cast<std::size_t>(domain.size()))))
      throw MachineFailure(fmt::format("break {} is of a family, a bond, a mode or an element that there is not", i));
    log.breaks.push_back(
        {r[0], steps[i], families[static_cast<std::size_t>(n[0])], n[1], n[2], Vec3(r[1], r[2], r[3]), r[4], n[3]});
  }
  return log;
}

// Everything that can be wrong with the file is said with its name; whose fault it is stays as it was.
template <class Read>
auto read_file(const std::filesystem::path& file, const Read& read) {
  const h5::Silence silence;
  verify_check_sum(file);
  try {
    return read(h5::open_file(file).id());
  } catch (const MachineFailure& failure) {
    throw MachineFailure(fmt::format("cannot read checkpoint '{}': {}", file.string(), failure.what()));
  }
}

}  // namespace

void save_checkpoint(const std::filesystem::path& file, const Domain& domain, const CheckpointMeta& meta) {
  const h5::Silence silence;
  h5::MemoryFile out;
  save_meta(out.id(), meta);
  save_table(out.id(), "elements", domain.elements());
  save_table(out.id(), "scene", domain.scene());
  save_lists(out.id(), domain);
  save_walls(out.id(), domain.walls());
  save_families(out.id(), domain);
  save_sets(out.id(), domain);
  save_pairs(out.id(), domain);
  save_breaks(out.id(), domain.breaks());
  const auto image = out.image();
  const std::string trailer = check_sum_trailer(image);
  write_atomically(file, {image, std::as_bytes(std::span(trailer.data(), trailer.size()))});
}

CheckpointMeta read_checkpoint_meta(const std::filesystem::path& file) {
  return read_file(file, [](hid_t place) { return load_meta(place); });
}

void load_checkpoint(const std::filesystem::path& file, Domain& domain) {
  read_file(file, [&](hid_t place) {
    domain.elements().resize(0);
    domain.add_elements(saved_rows(place, "elements"));
    load_columns(place, "elements", domain.elements(), On::elements, "elements");
    load_columns(place, "scene", domain.scene(), On::scene, "the scene");
    load_lists(place, domain);
    load_walls(place, domain);
    const auto families = load_families(place, domain);
    load_sets(place, domain);
    load_pairs(place, domain);
    domain.breaks() = load_breaks(place, families, domain);
    require_whole(domain);
  });
}

}  // namespace beadwork
