#include "core/loop/summary.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/base/failure.hpp"
#include "core/base/memory.hpp"
#include "core/base/text.hpp"
#include "core/domain/flaws.hpp"
#include "core/loop/json_text.hpp"
#include "core/plugin/blame.hpp"
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
  void dissipated(const std::string& by, Real joule) override {
    sums_.dissipated(by, joule), add("dissipated: " + by, joule);
  }

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

// Of a plugin that has failed it need not be known.
std::string mode_of(const Failure& criterion, const RunFigures& figures) {
  try {
    return blaming(criterion, "mode", [&] { return criterion.mode(); });
  } catch (const PhysicsFailure&) {
    if (figures.status != "failed") throw;
    return "";
  }
}

// How near to breaking the run came, by criterion.
Json utilisation(const RunState& state, const RunFigures& figures) {
  Json all = Json::object();
  for (const auto& [criterion, use] : state.uses) {
    Json& one = all[criterion->id()];
    one = {
        {"of", join(criterion->families(), " ")}, {"mode", mode_of(*criterion, figures)}, {"largest", Real(use.value)}};
    if (!use.is_there()) continue;
    one["step"] = std::llround(use.step);
    one["time"] = Real(use.time);
    if (criterion->judges_elements()) {
      one["element"] = std::llround(use.element);
    } else {
      one["bond"] = std::llround(use.bond);
      one["elements"] = {std::llround(use.first), std::llround(use.second)};
    }
    one["place"] = {Real(use.x), Real(use.y), Real(use.z)};
  }
  return all;
}

// Bonds that were broken from the start, by family.
Json defects(const Domain& domain) {
  Json all = Json::object();
  for (const BondTable* family : domain.families())
    if (const Index count = family->is_of_contacts() ? 0 : flaws(domain, *family); count > 0)
      all[family->name()] = count;
  return all;
}

// Of each family the bond that broke first, and how.
Json first_breaks(const Domain& domain) {
  Json all = Json::object();
  const BreakLog& log = domain.breaks();
  for (const Break& b : log.breaks) {
    const std::string& mode = log.modes[static_cast<std::size_t>(b.mode)];
    const std::string& family = domain.families()[static_cast<std::size_t>(b.family)]->name();
    if (all.contains(family)) continue;
    all[family] = {{"mode", mode},
                   {"step", b.step},
                   {"time", b.time},
                   {"bond", b.bond},
                   {"place", {b.place[0], b.place[1], b.place[2]}}};
    if (b.element >= 0) all[family]["element"] = b.element;
  }
  return all;
}

}  // namespace

std::string summary_json(const RunState& state, const Balance& balance, const FileSums& files,
                         const RunFigures& figures, int threads) {
  const Scene& scene = state.scene;
  const Moment& moment = state.moment;
  const Domain& domain = state.domain();
  Json json;
  json["name"] = scene.name;
  json["status"] = figures.status;
  json["exit_reason"] = figures.exit_reason;
  if (figures.exit_code) json["exit_code"] = static_cast<int>(*figures.exit_code);
  json["deck_sha256"] = scene.deck_sha256;
  json["overrides"] = Json::object();
  for (const Override& each : scene.overrides) json["overrides"][each.name] = each.value;
  json["files"] = Json::object();
  for (const auto& [path, sum] : files) json["files"][path] = sum;
  json["version"] = version;
  json["threads"] = threads;
  json["seed"] = scene.seed;
  json["elements"] = domain.size() - domain.walls().size();
  if (domain.walls().any()) json["walls"] = domain.walls().size();
  json["bonds"] = Json::object();
  for (const BondTable* family : domain.families())
    json[family->is_of_contacts() ? "contacts" : "bonds"][family->name()] = family->size();
  if (scene.has_contacts()) json["searches"] = std::llround(state.searches);
  json["steps"] = moment.step;
  json["time"] = moment.time;
  json["time_step"] = moment.time_step;
  json["wall_seconds"] = figures.wall_seconds;
  json["loop_seconds"] = figures.loop_seconds;
  json["peak_memory_bytes"] = peak_memory();
  json["bond_updates"] = figures.bond_updates;
  json["bond_updates_per_second"] = figures.loop_seconds > 0 ? figures.bond_updates / figures.loop_seconds : 0;
  for (const MoverFigure& figure : state.mover().figures()) json["mover"][figure.name] = figure.value;
  Terms terms;
  try {
    balance.energies(terms);
    json["energy"] = terms.json(state.initial_energy);
  } catch (const PhysicsFailure&) {
    if (figures.status != "failed") throw;  // of a plugin that failed the energies need not be known
  }
  json["quality"] = quality_json(figures.quality);
  json["quality"]["free_bodies"] = balance.free_motions().json();
  json["breaks"] = Json::object();
  const BreakLog& log = domain.breaks();
  for (const std::string& mode : log.modes) json["breaks"][mode] = 0;
  for (const Break& b : log.breaks)
    json["breaks"][log.modes[static_cast<std::size_t>(b.mode)]] =
        json["breaks"][log.modes[static_cast<std::size_t>(b.mode)]].get<int>() + 1;
  if (Json found = defects(domain); !found.empty()) json["defects"] = std::move(found);
  if (!log.breaks.empty()) json["first_breaks"] = first_breaks(domain);
  json["utilisation"] = utilisation(state, figures);
  json["packing"] = Json::array();
  for (const std::string& report : figures.packing_reports) json["packing"].push_back(Json::parse(report));
  if (!figures.notes.empty()) json["notes"] = figures.notes;
  return json_text(json, 2) + "\n";
}

std::string curve_json(const CurvePlan& plan) {
  Json json;
  json["title"] = plan.title;
  if (!plan.x.empty()) json["x"] = plan.x;
  if (!plan.y.empty()) json["y"] = plan.y;
  if (!plan.kind.empty()) json["kind"] = plan.kind;
  return json_text(json, 2) + "\n";
}

}  // namespace beadwork
