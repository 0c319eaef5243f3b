// Means over seeds, and how much one run scatters about them.

#include <algorithm>
#include <cmath>

#include "core/base/text.hpp"
#include "workbench/batch.hpp"

namespace beadwork {

namespace {

using Values = std::vector<std::pair<std::string, std::string>>;

struct Group {
  std::string list;  ///< of runs that stand in a folder of their own
  Values values;     ///< of all but seeds
  std::vector<const BatchRun*> runs;
};

std::vector<Group> groups_of(const std::vector<BatchRun>& runs) {
  std::vector<Group> groups;
  std::map<std::string, std::size_t> known;
  for (const BatchRun& run : runs) {
    if (!run.done) continue;
    Group group{run.sweep, {}, {}};
    std::string key = group.list + "/";
    for (const auto& each : run.values)
      if (!is_seed(each.first)) group.values.push_back(each), key += each.first + "=" + each.second + "\n";
    const auto [place, is_new] = known.emplace(key, groups.size());
    if (is_new) groups.push_back(std::move(group));
    groups[place->second].runs.push_back(&run);
  }
  std::erase_if(groups, [](const Group& group) { return group.runs.size() < 2; });
  return groups;
}

std::vector<double> numbers_of(const Group& group, const std::string& column) {
  std::vector<double> numbers;
  for (const BatchRun* run : group.runs)
    for (const auto& [name, value] : run->results)
      if (name == column)
        if (const auto number = parse_number(value)) numbers.push_back(*number);
  return numbers;
}

struct MeanAndScatter {
  std::string mean, scatter;  ///< empty where not all runs of the group have a number
};

MeanAndScatter over(const std::vector<double>& numbers, std::size_t runs) {
  if (numbers.size() != runs) return {};
  double mean = 0, square = 0;
  for (const double x : numbers) mean += x / static_cast<double>(runs);
  for (const double x : numbers) square += (x - mean) * (x - mean);
  return {format_number(mean), format_number(std::sqrt(square / static_cast<double>(runs - 1)))};
}

std::vector<std::string> columns_of(const std::vector<Group>& groups) {
  std::vector<std::string> columns;
  for (const Group& group : groups)
    for (const BatchRun* run : group.runs)
      for (const auto& [name, value] : run->results)
        if (parse_number(value) && std::find(columns.begin(), columns.end(), name) == columns.end())
          columns.push_back(name);
  return columns;
}

std::vector<std::string> row_of(const Group& group, const std::vector<std::string>& parameters,
                                const std::vector<std::string>& columns) {
  std::vector<std::string> row{group.list};
  for (const std::string& name : parameters) {
    const auto found =
        std::find_if(group.values.begin(), group.values.end(), [&](const auto& each) { return each.first == name; });
    row.push_back(found == group.values.end() ? "" : found->second);
  }
  row.push_back(std::to_string(group.runs.size()));
  for (const std::string& column : columns) {
    const MeanAndScatter both = over(numbers_of(group, column), group.runs.size());
    row.insert(row.end(), {both.mean, both.scatter});
  }
  return row;
}

}  // namespace

bool is_seed(const std::string& parameter) { return parameter == "seed" || parameter.ends_with("-seed"); }

ResultTable batch_means(const std::vector<BatchRun>& runs) {
  const std::vector<Group> groups = groups_of(runs);
  std::vector<std::string> parameters = parameters_of(runs);
  std::erase_if(parameters, is_seed);
  const std::vector<std::string> columns = columns_of(groups);
  ResultTable table{{"sweep"}, {}};
  table.head.insert(table.head.end(), parameters.begin(), parameters.end());
  table.head.emplace_back("runs");
  for (const std::string& name : columns)
    table.head.insert(table.head.end(), {"mean of " + name, "scatter of " + name});
  for (const Group& group : groups) table.rows.push_back(row_of(group, parameters, columns));
  return table;
}

}  // namespace beadwork
