#include "core/loop/summary.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <regex>

#include "core/base/failure.hpp"
#include "core/base/text.hpp"
#include "core/version.hpp"

namespace beadwork {

namespace {

using Json = nlohmann::ordered_json;

// Energies by term, in the order in which they were first named; equal names add up.
class Terms final : public EnergySink {
 public:
  void work(const std::string& by, Real joule) override { sums_.work(by, joule), add("work: " + by, joule); }
  void stored(const std::string& in, Real joule) override { sums_.stored(in, joule), add("stored: " + in, joule); }
  void kinetic(Real joule) override { sums_.kinetic(joule), add("kinetic", joule); }
  void dissipated(const std::string& by, Real joule) override { sums_.dissipated(by, joule), add("dissipated: " + by, joule); }

  Json json(Real initial) const {
    Json all = terms_;
    all["initial"] = initial;
    all["work"] = sums_.worked;
    all["stored"] = sums_.in_bonds;
    all["dissipated"] = sums_.taken;
    all["residual"] = initial - sums_.beyond_work();
    return all;
  }

 private:
  void add(const std::string& name, Real joule) { terms_[name] = terms_.value(name, 0.0) + joule; }
  Json terms_ = Json::object();
  EnergySums sums_;
};

}  // namespace

std::string summary_json(const Scene& scene, const RunFigures& figures, const FreeMotions& free, const Moment& moment, int threads, const Sight& sight) {
  const Domain& domain = sight.domain();
  Json json;
  json["name"] = scene.name;
  json["status"] = figures.status;
  json["exit_reason"] = figures.exit_reason;
  json["deck_sha256"] = scene.deck_sha256;
  json["version"] = version;
  json["threads"] = threads;
  json["seed"] = scene.seed;
  json["elements"] = domain.size();
  json["bonds"] = Json::object();
  for (const auto& family : domain.families()) json["bonds"][family->name()] = family->size();
  json["steps"] = moment.step;
  json["time"] = moment.time;
  json["time_step"] = moment.time_step;
  json["wall_seconds"] = figures.wall_seconds;
  json["loop_seconds"] = figures.loop_seconds;
  json["bond_updates"] = figures.bond_updates;
  json["bond_updates_per_second"] = figures.loop_seconds > 0 ? figures.bond_updates / figures.loop_seconds : 0;
  Terms terms;
  sight.energies(terms);
  json["energy"] = terms.json(sight.initial_energy());
  json["quality"] = quality_json(figures.quality);
  json["quality"]["free_bodies"] = free.json();
  json["breaks"] = Json::object();
  const BreakLog& log = domain.breaks();
  for (const std::string& mode : log.modes) json["breaks"][mode] = 0;
  for (const Break& b : log.breaks) json["breaks"][log.modes[static_cast<std::size_t>(b.mode)]] = json["breaks"][log.modes[static_cast<std::size_t>(b.mode)]].get<int>() + 1;
  json["packing"] = Json::array();
  for (const std::string& report : figures.packing_reports) json["packing"].push_back(Json::parse(report));
  return json.dump(2) + "\n";
}

std::string curve_json(const CurvePlan& plan) {
  Json json;
  json["title"] = plan.title;
  if (!plan.x.empty()) json["x"] = plan.x;
  if (!plan.y.empty()) json["y"] = plan.y;
  if (!plan.kind.empty()) json["kind"] = plan.kind;
  if (!plan.references.empty()) json["references"] = plan.references;
  return json.dump(2) + "\n";
}

void refuse_other_deck(const std::string& saved, const std::string& now) {
  static const std::regex free(R"re(( (until|every)="[^"]*")|(<scene name="[^"]*"))re");
  const auto lines = [](const std::string& text) {
    std::vector<std::string> kept;
    for (const std::string& line : split(text, '\n')) kept.push_back(std::regex_replace(line, free, ""));
    return kept;
  };
  const auto odd = odd_lines(lines(saved), lines(now));
  if (odd.empty()) return;
  std::string differences;
  const auto before = split(saved, '\n'), after = split(now, '\n');
  for (const OddLine& line : odd)
    differences += line.in_second ? "\n  deck:       " + std::string(trim(after[line.number])) : "\n  checkpoint: " + std::string(trim(before[line.number]));
  throw DeckFailure("error: the deck is not the one that began this run; only 'until', 'every' and threads may differ:" + differences);
}

}  // namespace beadwork
