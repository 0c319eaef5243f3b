#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "core/base/failure.hpp"
#include "core/base/text.hpp"
#include "core/base/units.hpp"
#include "core/io/packing_file.hpp"
#include "core/packing/packing.hpp"
#include "plugins/fill/packing_report.hpp"
#include "plugins/fill/spheres.hpp"

namespace beadwork {

/// Elements from a packing that was stored before: a run.h5, or a table of text.   docs/theory/packing.md
class ReadPacking final : public ElementMaker {
 public:
  static constexpr const char* about =
      "Elements from a stored packing: the first frame of a run.h5, or a table of text with a line for each element";
  Param<std::string> file{this,
                          {.name = "file",
                           .doc = "The file, .h5 or a text: its path from the folder of the file that names it",
                           .role = Role::file}};
  Param<std::string> unit{this,
                          {.name = "unit",
                           .doc = "Unit of the lengths in a text; where absent that of its headings, m where these "
                                  "have none. A run.h5 states its own",
                           .optional = true}};
  Param<std::vector<std::string>> columns{
      this,
      {.name = "columns",
       .doc = "What the columns of a text hold, in their order: x, y, z, radius (r) or diameter (d), set, id, and - "
              "for one that is passed over; where absent its first line says it, or they are x y z radius",
       .optional = true}};
  Param<std::string> of{this,
                        {.name = "of", .doc = "Only the elements that form this set in the file", .optional = true}};
  Param<std::vector<std::string>> sets{this,
                                       {.name = "sets",
                                        .doc = "Sets of the file that are made here too, under their names",
                                        .optional = true,
                                        .role = Role::makes_set}};

  void check(Complaints& complaints) const override {
    if (unit.in_deck()) {
      const auto found = find_unit(*unit);
      if (!found || !(found->dimension == find_unit("m")->dimension))
        complaints.error(unit.at(), fmt::format("'unit' wants a unit of length such as \"mm\", got \"{}\"", *unit));
      if (states_its_unit(*file))
        complaints.error(unit.at(), "'unit' belongs to a text; the lengths in a run.h5 state their own: leave it out");
    }
    if (columns.in_deck()) {
      if (const std::string why = why_no_columns(*columns); !why.empty()) complaints.error(columns.at(), why);
      if (states_its_unit(*file))
        complaints.error(columns.at(), "'columns' belongs to a text; a run.h5 says itself what it holds: leave it out");
    }
  }

  void fill(Domain& domain, const FillJob& job) override {
    const auto start = std::chrono::steady_clock::now();
    const StoredPacking packing = stored(*file, job.pause);
    for (const std::string& warning : packing.warnings) job.log.warn(warning);
    const Index first = add_spheres(domain, packing.position, packing.radius);
    keep_sets(domain, packing, first, job);
    keep_pairs(domain, packing, first, job);
    warn_of_those_there(domain, first, job);
    packing::Packing whole = packing::packing_of(around(packing), spread_of(packing), packing.position, packing.radius);
    whole.pause = job.pause;
    whole.seconds = std::chrono::duration<Real>(std::chrono::steady_clock::now() - start).count();
    tell(whole, job);
  }

 private:
  static constexpr Real deep = 0.05;  // overlap over the sum of the radii, beyond what relaxation leaves

  StoredPacking stored(const std::string& path, const Pause& pause) const {
    TextForm form;
    if (unit.given()) form.unit = *unit;
    if (columns.given()) form.columns = *columns;
    try {
      StoredPacking packing = read_packing(path, form, pause);
      return of.given() ? part_of(packing, *of, path) : packing;
    } catch (const MachineFailure& failure) {
      refuse(file.at(), failure.what());  // it is there, but cannot be opened, or is no HDF5
    } catch (const NoSuchSet& failure) {
      refuse(of.at(), failure.what());
    }
  }

  void keep_sets(Domain& domain, const StoredPacking& packing, Index first, const FillJob& job) {
    std::vector<std::string> left;
    for (const auto& each : packing.sets)
      if (std::find(sets->begin(), sets->end(), each.first) == sets->end() && !(of.given() && each.first == *of) &&
          each.first != *set)
        left.push_back(each.first);
    if (!left.empty())
      job.log.say(fmt::format("{}: sets of {} that are not made here: {}; sets=\"...\" makes those that it names",
                              tag(), *file, join(left)));
    for (const std::string& name : *sets) {
      if (name == *set)
        refuse(sets.at(name),
               fmt::format("set '{}' holds all that are read: leave it out here, or give 'set' another name", name));
      Set& members = domain.sets()[name];
      for (const std::size_t k : recorded(packing, name)) members.push_back(first + static_cast<Index>(k));
    }
  }

  /// Neighbours along fibres, under the names that their sets have here.
  void keep_pairs(Domain& domain, const StoredPacking& packing, Index first, const FillJob& job) {
    for (const auto& [name, list] : packing.pairs) {
      const bool all = of.given() && name == *of;
      if (!all && std::find(sets->begin(), sets->end(), name) == sets->end()) continue;
      job.log.warn(
          fmt::format("{}: elements of the fibres '{}' are read as spheres, with the mass of such; read what is "
                      "packed around them alone, and make fibres by <fibre-row> or <fibres>, where that matters",
                      file.at().where(), name));
      PairList& pairs = domain.pairs()[all ? *set : name];
      for (const auto& [one, other] : list)
        pairs.emplace_back(first + static_cast<Index>(one), first + static_cast<Index>(other));
      std::sort(pairs.begin(), pairs.end());
    }
  }

  void warn_of_those_there(const Domain& domain, Index first, const FillJob& job) const {
    if (const Real into = deepest_into_others(domain, first, {}, job.pause); into > deep)
      job.log.warn(
          fmt::format("{}: elements of {} overlap some that are there already, by up to {:.2g} of the sum of "
                      "their radii: they were not packed around these",
                      file.at().where(), *file, into));
  }

  const std::vector<std::size_t>& recorded(const StoredPacking& packing, const std::string& name) const {
    try {
      return members_of(packing, name, *file);
    } catch (const NoSuchSet& failure) {
      refuse(sets.at(name), failure.what());
    }
  }

  // Walls are not stored: those that hold the packing as closely as a box can.
  static packing::Box around(const StoredPacking& packing) {
    packing::Box box{packing.position[0], packing.position[0]};
    for (std::size_t k = 0; k < packing.position.size(); ++k) {
      const Vec3 r = Vec3::Constant(packing.radius[k]);
      box.low = box.low.cwiseMin(packing.position[k] - r);
      box.high = box.high.cwiseMax(packing.position[k] + r);
    }
    return box;
  }

  static packing::Dispersion spread_of(const StoredPacking& packing) {
    const auto [low, high] = std::minmax_element(packing.radius.begin(), packing.radius.end());
    return {.spread = (*high - *low) / (*high + *low)};
  }

  void tell(const packing::Packing& packing, const FillJob& job) const {
    const auto report = packing::report(packing);
    job.report(packing_json(*set, tag(), report, PackingSource::file));
    job.log.say(fmt::format("{}: {} elements from {}, {}", tag(), report.count, *file, packing_words(report)));
    if (report.max_overlap > deep)
      job.log.warn(
          fmt::format("{}: elements overlap by up to {:.2g} of the sum of their radii; if that is not meant, look "
                      "whether the sizes in {} are radii or diameters, and in which unit",
                      file.at().where(), report.max_overlap, *file));
  }
};

}  // namespace beadwork
