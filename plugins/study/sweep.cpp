#include <fmt/format.h>

#include <algorithm>

#include "core/plugin/batch_plan.hpp"
#include "core/plugin/kinds.hpp"
#include "plugins/study/sweep_values.hpp"

namespace beadwork {

/// Runs of decks with values of their parameters.   docs/batch.md
class Sweep final : public Study {
 public:
  static constexpr const char* about = "Runs decks with many values of their parameters; beadwork batch conducts it";
  Param<std::string> name{this, {.name = "name", .doc = "Of these runs, and of their folder"}};
  Param<std::vector<std::string>> decks{this, {.name = "decks", .doc = "Files", .role = Role::file}};
  Param<std::string> grid{
      this,
      {.name = "grid",
       .doc = "Parameters and their values, of which all combinations are run: \"ratio = 2, 0.5; young = 30 GPa to 50 "
              "GPa in 5\". A range may end in \"log\"",
       .optional = true}};
  Param<std::string> together{
      this,
      {.name = "together",
       .doc = "Parameters whose first values go together, whose second values do, and so on: \"count = 5000, 40000; "
              "end = 1 mm, 2 mm\"",
       .optional = true}};
  Param<std::string> sample{
      this,
      {.name = "sample",
       .doc = "Ranges of parameters of which points are taken: \"young = 30 GPa to 50 GPa; energy = 1 J/m^2 to 100 "
              "J/m^2 log\"",
       .optional = true}};
  Param<std::int64_t> points{
      this, {.name = "points", .range = {1, 1e6}, .doc = "Number of points of 'sample'", .optional = true}};
  Param<std::string> method{this,
                            {.name = "method",
                             .doc = "How points are spread over 'sample': by Sobol's sequence, or one in each slice of "
                                    "each range",
                             .fallback = "sobol",
                             .choices = {"sobol", "latin-hypercube"}}};
  Param<std::int64_t> sample_seed{
      this, {.name = "sample-seed", .range = {0}, .doc = "Of the Latin hypercube", .fallback = "1"}};
  Param<std::vector<std::string>> seeds{
      this,
      {.name = "seeds",
       .doc = "Values of the decks' parameter 'seed': \"1 2 5\", or \"1 to 5\" for all between. Means and scatter are "
              "taken over it, and over parameters whose names end in '-seed'",
       .optional = true}};
  Param<std::string> set{this,
                         {.name = "set",
                          .doc = "Parameters that are the same in all runs: \"v = 0.1 m/s; K = 1e7 N/mm^3\"",
                          .optional = true}};
  Param<std::string> from{
      this,
      {.name = "from",
       .doc =
           "Parameters that are the folder of another sweep's runs: \"packings = packings\". A run waits for those of "
           "that sweep that have the same values of the parameters that both vary",
       .optional = true}};
  Param<std::vector<std::string>> after{
      this, {.name = "after", .doc = "Sweeps whose runs are waited for likewise", .optional = true}};

  void check(Complaints& complaints) const override {
    if (!is_plain_name(*name))
      complaints.error(name.at(), fmt::format("'name' wants {}, got \"{}\"", plain_name, *name));
    if (sample.given() != points.given())
      complaints.error(sample.given() ? sample.at() : points.at(), "'sample' and 'points' are given together");
    if (decks->empty()) complaints.error(decks.at(), "'decks' names no deck");
    for (const ParamBase* text : {static_cast<const ParamBase*>(&grid), static_cast<const ParamBase*>(&together),
                                  static_cast<const ParamBase*>(&sample), static_cast<const ParamBase*>(&set),
                                  static_cast<const ParamBase*>(&from), static_cast<const ParamBase*>(&seeds)})
      if (text->given()) understand(*text, complaints);
    if (complaints.errors() > 0) return;
    const double runs = count() * static_cast<double>(decks->size());
    if (runs > most)
      return complaints.error(at(), fmt::format("this sweep has {:.0f} runs, and at most {:.0f} are understood: fewer "
                                                "values, or points of a 'sample'",
                                                runs, most));
    check_names(complaints);
  }

  bool is_of_batch() const override { return true; }
  void add_to(BatchPlan& plan) const override {
    const sweeps::Block block = all_rows();
    RunList list{*name, at(), *decks, block.names, block.rows, {}, {}, {}};
    if (set.given())
      for (const auto& [parameter, value] : sweeps::clauses(*set)) list.fixed.push_back({parameter, value});
    if (from.given())
      for (const auto& [parameter, sweep] : sweeps::clauses(*from)) list.from.emplace_back(parameter, sweep);
    if (after.given()) list.after = *after;
    plan.lists.push_back(std::move(list));
  }

 private:
  static constexpr double most = 1e6;

  void understand(const ParamBase& text, Complaints& complaints) const {
    try {
      if (&text == &grid) block_of_grid();
      if (&text == &together) block_together();
      if (&text == &sample) ranges();
      if (&text == &set) sweeps::clauses(*set);
      if (&text == &from) sweeps::clauses(*from);
      if (&text == &seeds) sweeps::seeds_of(*seeds);
    } catch (const sweeps::Wrong& wrong) {
      complaints.error(text.at(), fmt::format("'{}' {}", text.info().name, wrong.what()));
    }
  }

  // The blocks of the grid, one for each of its parameters: they are not multiplied before it is known how many there are.
  std::vector<sweeps::Block> block_of_grid() const {
    std::vector<sweeps::Block> blocks;
    if (!grid.given()) return blocks;
    for (const sweeps::Clause& clause : sweeps::clauses(*grid)) {
      sweeps::Block block{{clause.name}, {}};
      for (const std::string& value : sweeps::values_of(clause)) block.rows.push_back({value});
      blocks.push_back(std::move(block));
    }
    return blocks;
  }

  sweeps::Block block_together() const {
    sweeps::Block block;
    for (const sweeps::Clause& clause : sweeps::clauses(*together)) {
      const auto values = sweeps::values_of(clause);
      if (!block.names.empty() && values.size() != block.rows.size())
        throw sweeps::Wrong(fmt::format("has {} values of '{}' and {} of '{}'", block.rows.size(), block.names.front(),
                                        values.size(), clause.name));
      block.names.push_back(clause.name);
      block.rows.resize(values.size());
      for (std::size_t k = 0; k < values.size(); ++k) block.rows[k].push_back(values[k]);
    }
    return block;
  }

  std::vector<sweeps::Range> ranges() const {
    std::vector<sweeps::Range> all;
    for (const sweeps::Clause& clause : sweeps::clauses(*sample)) {
      const auto range = sweeps::range_of(clause.name, clause.what);
      if (!range)
        throw sweeps::Wrong(
            fmt::format("wants a range of '{}', such as \"1 mm to 2 mm\", got \"{}\"", clause.name, clause.what));
      all.push_back(*range);
    }
    return all;
  }

  sweeps::Block block_of_sample() const {
    const std::vector<sweeps::Range> all = ranges();
    const auto number = static_cast<std::size_t>(*points);
    const auto shares = *method == "sobol"
                            ? sweeps::sobol(number, all.size())
                            : sweeps::latin_hypercube(number, all, static_cast<std::uint64_t>(*sample_seed));
    sweeps::Block block;
    for (const sweeps::Range& range : all) block.names.push_back(range.name);
    for (const auto& row : shares) {
      std::vector<std::string> values;
      for (std::size_t d = 0; d < all.size(); ++d) values.push_back(all[d].text(all[d].at(row[d])));
      block.rows.push_back(std::move(values));
    }
    return block;
  }

  double count() const {
    double runs = 1;
    for (const sweeps::Block& block : block_of_grid()) runs *= static_cast<double>(block.rows.size());
    if (together.given()) runs *= static_cast<double>(block_together().rows.size());
    if (sample.given()) runs *= static_cast<double>(*points);
    if (seeds.given()) runs *= static_cast<double>(sweeps::seeds_of(*seeds).size());
    return runs;
  }

  sweeps::Block all_rows() const {
    sweeps::Block all{{}, {{}}};
    for (const sweeps::Block& block : block_of_grid()) all = times(all, block);
    if (together.given()) all = times(all, block_together());
    if (sample.given()) all = times(all, block_of_sample());
    if (seeds.given()) {
      sweeps::Block block{{"seed"}, {}};
      for (const std::string& seed : sweeps::seeds_of(*seeds)) block.rows.push_back({seed});
      all = times(all, block);
    }
    return all;
  }

  // Each parameter has its value from one place.
  void check_names(Complaints& complaints) const {
    std::vector<std::string> names = all_rows().names;
    if (set.given())
      for (const auto& clause : sweeps::clauses(*set)) names.push_back(clause.name);
    if (from.given())
      for (const auto& clause : sweeps::clauses(*from)) names.push_back(clause.name);
    std::sort(names.begin(), names.end());
    for (std::size_t k = 0; k + 1 < names.size(); ++k)
      if (names[k] == names[k + 1])
        complaints.error(at(), fmt::format("parameter '{}' gets its values from two places of this sweep", names[k]));
  }
};

}  // namespace beadwork
