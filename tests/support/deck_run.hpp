#pragma once
// A deck, given as text, run in this process: what came of it.

#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "core/deck/read.hpp"
#include "core/loop/run.hpp"
#include "tests/support/scratch.hpp"

namespace beadwork::testing {

/// Laws that are made for tests (tests/laws).
inline const std::filesystem::path laws = BEADWORK_BINARY_DIR "/lib/test-laws/test_laws.so";

struct DeckRun {
  nlohmann::json summary;
  std::vector<std::string> said, warned;
  std::string failure;                                                     ///< what ended it, empty if it is done
  std::map<std::string, std::vector<std::map<std::string, Real>>> curves;  ///< rows by column, units left out
  std::vector<Vec3> position, velocity;                                    ///< at the end, by row

  /// Largest and smallest of a curve's column.
  Real largest(const std::string& curve, const std::string& column) const {
    Real most = -std::numeric_limits<Real>::infinity();
    for (const auto& row : curves.at(curve)) most = std::max(most, row.at(column));
    return most;
  }
  Real smallest(const std::string& curve, const std::string& column) const {
    Real least = std::numeric_limits<Real>::infinity();
    for (const auto& row : curves.at(curve)) least = std::min(least, row.at(column));
    return least;
  }
  Real energy(const std::string& term) const { return summary.at("energy").at(term).get<Real>(); }
};

inline std::vector<std::map<std::string, Real>> read_curve(const std::filesystem::path& file) {
  const auto fields = [](const std::string& line) {
    std::vector<std::string> found;
    std::istringstream text(line);
    for (std::string field; std::getline(text, field, ',');) found.push_back(field);
    return found;
  };
  std::ifstream csv(file);
  std::string line;
  std::getline(csv, line);
  std::vector<std::string> names = fields(line);
  for (std::string& name : names) name = name.substr(0, name.find(" ["));
  std::vector<std::map<std::string, Real>> rows;
  while (std::getline(csv, line)) {
    auto& row = rows.emplace_back();
    const auto numbers = fields(line);
    for (std::size_t k = 0; k < names.size(); ++k) row[names[k]] = std::stod(numbers[k]);
  }
  return rows;
}

inline DeckRun run_deck(const std::string& text) {
  const Scratch scratch;
  write_text(scratch / "deck.xml", text);
  DeckRun done;
  Complaints complaints;
  const auto read = read_deck((scratch / "deck.xml").string(), {}, complaints);
  const Catalogue catalogue = Catalogue::open({laws});
  complaints.throw_if_any();
  const auto scene = Scene::assemble(*read, catalogue, complaints);
  complaints.throw_if_any();
  RunFolder folder = RunFolder::fresh(scratch / "out", false);
  RunOptions options;
  options.log = Log([&](const std::string& line) { done.said.push_back(line); },
                    [&](const std::string& line) { done.warned.push_back(line); });
  {
    Run run(*scene, catalogue, folder, options);
    try {
      run.all();
    } catch (const std::exception& failure) {
      done.failure = failure.what();
    }
  }
  std::ifstream summary(folder.summary());
  done.summary = nlohmann::json::parse(summary);
  for (const auto& entry : std::filesystem::directory_iterator(folder.curves()))
    if (entry.path().extension() == ".csv") done.curves[entry.path().stem()] = read_curve(entry.path());
  const Table& elements = scene->domain->elements();
  for (Index row = 0; row < scene->domain->size(); ++row) {
    done.position.push_back(elements.column("position").view<Vec3>()[row]);
    done.velocity.push_back(elements.column("velocity").view<Vec3>()[row]);
  }
  return done;
}

}  // namespace beadwork::testing
