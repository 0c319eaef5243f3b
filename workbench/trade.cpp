// `trade`: what a deck's knobs cost in accuracy, and which to turn.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "core/base/text.hpp"
#include "workbench/office.hpp"
#include "workbench/report/report.hpp"
#include "workbench/terminal.hpp"
#include "workbench/trade/tried.hpp"
#include "workbench/verbs.hpp"

namespace beadwork {

namespace {

namespace fs = std::filesystem;
using trade::DeckKnob;
using trade::Tried;

struct TradeArguments {
  DeckArguments deck;
  std::string out;
  std::vector<std::string> quantities, knobs, left_alone, reference, seeds;
  Words words;
  Shares shares{1, 0};
};

constexpr Real targets[] = {0.01, 0.03, 0.1};

std::vector<DeckKnob> chosen_knobs(const TradeArguments& arguments, const Loaded& loaded) {
  std::vector<DeckKnob> knobs = trade::knobs_of(loaded);
  for (const std::string& text : arguments.knobs) {
    const DeckKnob own = trade::knob_of(text, loaded);
    std::erase_if(knobs, [&](const DeckKnob& knob) { return knob.parameter == own.parameter; });
    knobs.push_back(own);
  }
  std::vector<std::string> names;
  for (const DeckKnob& knob : knobs) names.push_back(knob.parameter);
  for (const std::string& name : arguments.left_alone)
    if (std::find(names.begin(), names.end(), name) == names.end())
      throw DeckFailure(
          fmt::format("error: --leave: no knob of this deck is called '{}'{}", name, did_you_mean(name, names)));
  std::erase_if(knobs, [&](const DeckKnob& knob) {
    return std::find(arguments.left_alone.begin(), arguments.left_alone.end(), knob.parameter) !=
           arguments.left_alone.end();
  });
  if (knobs.empty())
    refuse(loaded.deck->root->at,
           fmt::format("no parameter of this deck is a knob. Let a <parameter> set one of: {}; or name one: --knob "
                       "name=value,value",
                       join(trade::other_knobs(loaded))));
  return knobs;
}

std::string name_of(const std::vector<Override>& values) {
  std::vector<std::string> words;
  for (const Override& each : values) words.push_back(each.name + "=" + each.value);
  return join(words);
}

/// Runs settings of one deck and remembers what came of them.
class Trials {
 public:
  Trials(Runner& runner, const DeckRequest& deck, trade::Quantities quantities)
      : runner_(runner), deck_(deck), quantities_(std::move(quantities)) {}

  struct Setting {
    std::string name;
    std::vector<Override> values;
  };
  std::vector<Tried> run(const std::vector<Setting>& settings) {
    std::vector<Errand> errands;
    for (const Setting& setting : settings) {
      Errand errand{setting.name, fs::absolute(deck_.path), deck_.overrides};
      for (const Override& value : setting.values) {
        std::erase_if(errand.overrides, [&](const Override& other) { return other.name == value.name; });
        errand.overrides.push_back(value);
      }
      errands.push_back(std::move(errand));
    }
    const std::vector<Outcome> outcomes = runner_.run(errands);
    if (quantities_.empty() && outcomes.front().is_done()) quantities_ = trade::usual_quantities(outcomes.front());
    std::vector<Tried> all;
    for (std::size_t k = 0; k < settings.size(); ++k)
      all.push_back(trade::tried(settings[k].name, settings[k].values, outcomes[k], quantities_));
    return all;
  }
  const trade::Quantities& quantities() const { return quantities_; }

 private:
  Runner& runner_;
  const DeckRequest& deck_;
  trade::Quantities quantities_;
};

class Bargain {
 public:
  Bargain(const TradeArguments& arguments, const std::vector<DeckKnob>& knobs, Trials& trials, const Log& log)
      : arguments_(arguments), knobs_(knobs), trials_(trials), log_(log) {}

  void strike() {
    begin();
    one_at_a_time();
    for (const Real target : targets) combine(target);
  }

  const std::vector<Tried>& all() const { return all_; }
  const Tried& base() const { return all_[1]; }
  Real scatter() const { return trade::scatter_of(seeds_); }
  /// That are done.
  std::size_t seeds() const {
    return static_cast<std::size_t>(
        std::count_if(seeds_.begin(), seeds_.end(), [](const Tried& one) { return one.done; }));
  }

 private:
  // The reference turns all knobs one step to the slow side.
  void begin() {
    std::vector<Override> accurate;
    for (const DeckKnob& knob : knobs_)
      if (!knob.slower.empty()) accurate.push_back({knob.parameter, knob.slower.front()});
    for (const std::string& text : arguments_.reference) {
      const Override own = setting_of(text, fmt::format("--reference wants name=value, got \"{}\"", text));
      std::erase_if(accurate, [&](const Override& other) { return other.name == own.name; });
      accurate.push_back(own);
    }
    std::vector<Trials::Setting> settings{{"reference", accurate}, {"as it stands", {}}};
    for (const std::string& seed : arguments_.seeds) settings.push_back({"seed=" + seed, {{"seed", seed}}});
    std::vector<Tried> first = trials_.run(settings);
    for (std::size_t k = 0; k < 2; ++k) {
      if (first[k].done) continue;
      const std::string why = fmt::format("the run '{}' has failed, and there is nothing to compare with: {}",
                                          first[k].name, first[k].reason);
      if (first[k].refused) throw DeckFailure(why);
      throw PhysicsFailure(why);
    }
    for (std::size_t k = 0; k < trials_.quantities().size(); ++k) {
      const std::string& name = trials_.quantities()[k];
      if (std::isnan(first[0].quantities[k]))
        throw DeckFailure(fmt::format("error: --quantity: the runs have no number '{}'{}", name,
                                      did_you_mean(name, first[0].numbers)));
      if (first[0].quantities[k] == 0)
        throw DeckFailure(
            fmt::format("error: --quantity: '{}' is 0 in the reference, and errors are told over it: "
                        "name another",
                        name));
    }
    if (trials_.quantities().empty())
      throw DeckFailure(
          "error: the runs have no curve of a force and find no parameters: name what is to be compared, --quantity "
          "NAME");
    seeds_.assign(first.begin() + 2, first.end());
    first.resize(2);
    take(std::move(first));
  }

  void one_at_a_time() {
    std::vector<Trials::Setting> settings;
    for (const DeckKnob& knob : knobs_)
      for (const std::string& value : knob.values())
        settings.push_back({knob.parameter + "=" + value, {{knob.parameter, value}}});
    take(trials_.run(settings));
  }

  // Each knob at its fastest value that alone is accurate enough; where all together are not, the worst goes one step
  // back.
  void combine(Real target) {
    std::map<std::string, std::vector<const Tried*>> ladder;  // of each knob, the fastest first
    const std::vector<Tried> single = all_;
    for (const DeckKnob& knob : knobs_)
      for (const std::string& value : knob.faster)
        for (const Tried& one : single)
          if (one.name == knob.parameter + "=" + value && one.error <= target && one.seconds < base().seconds)
            ladder[knob.parameter].push_back(&one);
    for (auto& [name, steps] : ladder)
      std::sort(steps.begin(), steps.end(), [](const Tried* a, const Tried* b) { return a->seconds < b->seconds; });
    constexpr int patience = 6;
    for (int k = 0; k < patience; ++k) {
      std::vector<Override> values;
      for (const auto& [name, steps] : ladder)
        if (!steps.empty()) values.push_back(steps.front()->values.front());
      if (values.size() < 2) return;
      const std::string name = name_of(values);
      if (std::none_of(all_.begin(), all_.end(), [&](const Tried& one) { return one.name == name; }))
        take(trials_.run({{name, values}}));
      const auto here = std::find_if(all_.begin(), all_.end(), [&](const Tried& one) { return one.name == name; });
      if (here->error <= target) return;
      auto worst = ladder.end();
      for (auto it = ladder.begin(); it != ladder.end(); ++it)
        if (!it->second.empty() && (worst == ladder.end() || it->second.front()->error > worst->second.front()->error))
          worst = it;
      worst->second.erase(worst->second.begin());
    }
  }

  void take(std::vector<Tried> more) {
    for (Tried& one : more) {
      all_.push_back(std::move(one));
      all_.back().error = trade::error_of(all_.back(), all_.front());
      Tried& last = all_.back();
      if (last.done && trade::ends_elsewhere(last, all_.front()))
        last.reason = "it ended at another displacement or time than the reference, which is hard to compare";
      log_.say(last.done ? fmt::format("{:<40} {:>9.3g} s  error {:.3g} %{}{}", last.name, last.seconds,
                                       100 * last.error, last.reason.empty() ? "" : "  ", last.reason)
                         : fmt::format("{:<40} failed: {}", last.name, last.reason));
    }
  }

  const TradeArguments& arguments_;
  const std::vector<DeckKnob>& knobs_;
  Trials& trials_;
  const Log& log_;
  std::vector<Tried> all_;  // the reference, the deck as it stands, then the others
  std::vector<Tried> seeds_;
};

std::string settings_text(const Tried& chosen, const TradeArguments& arguments, Real target) {
  std::string text =
      fmt::format("# {}: within {:g} % of its reference, {:.3g} % off, {:.3g} s in the loop\n",
                  fs::path(arguments.deck.path).filename().string(), 100 * target, 100 * chosen.error, chosen.seconds);
  for (const Override& each : arguments.deck.request().overrides)
    if (std::none_of(chosen.values.begin(), chosen.values.end(),
                     [&](const Override& own) { return own.name == each.name; }))
      text += each.name + "=" + each.value + "\n";
  for (const Override& each : chosen.values) text += each.name + "=" + each.value + "\n";
  return text;
}

Office::Json advice(const Bargain& bargain, Office& office, const TradeArguments& arguments) {
  Office::Json result;
  result["scatter_percent"] = 100 * bargain.scatter();
  result["seeds"] = bargain.seeds();
  for (const Real target : targets) {
    const std::string name = fmt::format("within-{:g}-percent", 100 * target);
    const Tried* best = trade::fastest_within(bargain.all(), target);
    if (!best) {
      std::error_code error;  // what a former one has found, with other quantities, is no answer
      fs::remove(office.root() / (name + ".set"), error);
      result[name] = "nothing that was tried is";
      say("within {:g} %: nothing that was tried is\n", 100 * target);
      continue;
    }
    office.write(name + ".set", settings_text(*best, arguments, target));
    const Real gain = bargain.base().seconds / best->seconds;
    result[name] = {{"setting", best->name}, {"error_percent", 100 * best->error}, {"times_as_fast", gain}};
    say("within {:g} %: {} ({:.3g} % off, {:.3g} times as fast as the deck stands)\n", 100 * target, best->name,
        100 * best->error, gain);
  }
  if (bargain.seeds() > 1)
    say("packings scatter by {:.3g} %: no accuracy below that is worth paying for\n", 100 * bargain.scatter());
  return result;
}

void put_curves(const Bargain& bargain, Office& office) {
  std::vector<std::vector<Real>> front;
  for (const Tried* one : trade::front_of(bargain.all())) front.push_back({one->seconds, 100 * one->error});
  office.curve(
      "front",
      {{{"time in the loop", "s"}, {"error", "percent"}}, "Fastest for each error", "time in the loop", {"error"}, ""},
      front);
}

int trade_off(const TradeArguments& arguments) {
  heed_signals();
  const Loaded loaded = load_checked(arguments.deck.request());
  if (!loaded.scene->studies.empty() && loaded.scene->studies.front()->is_of_batch())
    refuse_study(loaded, arguments.deck.path);
  const std::vector<DeckKnob> knobs = chosen_knobs(arguments, loaded);
  Office office(arguments.out, *loaded.scene, "trade");
  Progress progress([](const std::string& line) { say("{}\n", line), std::fflush(stdout); });
  const Log log = log_beside(progress);
  for (const DeckKnob& knob : knobs)
    log.say(fmt::format("knob {} = {} ({}): {}", knob.parameter, knob.now, knob.of, join(knob.values())));
  if (const auto others = trade::other_knobs(loaded); !others.empty())
    log.say("no parameter of the deck sets: " + join(others));
  SceneRunner runner(runs_of(arguments, progress, log), loaded.catalogue);
  const DeckRequest request = arguments.deck.request();
  Trials trials(runner, request, arguments.quantities);
  Bargain bargain(arguments, knobs, trials, log);
  try {
    bargain.strike();
  } catch (const Fault& fault) {
    progress.hide();
    office.close(fault.code() == ExitCode::interrupted ? "interrupted" : "failed", fault.code(), fault.what(), runner);
    throw;
  }
  progress.hide();
  office.write("trade.csv", csv_of(trade::table_of(bargain.all(), trials.quantities(), bargain.base())));
  put_curves(bargain, office);
  office.take_result(advice(bargain, office, arguments));
  office.close("done", ExitCode::done, "done", runner);
  say("{} scenes run, {} known already\n{}\n", runner.runs(), runner.known(), write_study_report(office.root()));
  return 0;
}

}  // namespace

void add_trade(CLI::App& app, Chosen& chosen, const Words& words) {
  CLI::App* verb =
      app.add_subcommand("trade", "Measures what the knobs of a deck cost in accuracy, and says which to turn");
  verb->footer(
      "Example: beadwork trade xml-cases/dcb/quick.xml --out out/trade --seeds 1,2,3\n"
      "Knobs are parameters of the deck that set what plugins have declared one (time step, rate, damping, cadence "
      "...). "
      "Each is turned alone, then together; all is held against a run with every knob one step to the slow side. "
      "within-1-percent.set and so on are for: beadwork run DECK --settings FILE");
  auto arguments = std::make_shared<TradeArguments>();
  arguments->words = words;
  arguments->deck.add_to(*verb);
  verb->add_option("--out", arguments->out, "Folder for the results, and for the runs that they come of")->required();
  verb->add_option("--quantity", arguments->quantities,
                   "What is compared, as the columns of a batch's table are called: 'force: largest force [N]'; the "
                   "largest force of each curve where absent, of a calibration the parameters that it finds")
      ->allow_extra_args(false);
  verb->add_option("--knob", arguments->knobs, "Values of a parameter, declared a knob or not: name=value,value")
      ->allow_extra_args(false);
  verb->add_option("--leave", arguments->left_alone, "A knob that is not to be turned")->allow_extra_args(false);
  verb->add_option("--reference", arguments->reference, "A value of the run that all is held against: name=value")
      ->allow_extra_args(false);
  verb->add_option("--seeds", arguments->seeds, "Values of the deck's parameter 'seed', for the scatter: 1,2,3")
      ->delimiter(',');
  add_shares(*verb, arguments->shares, "1, as time is what is measured");
  verb->callback([&chosen, arguments] { chosen = [arguments] { return trade_off(*arguments); }; });
}

}  // namespace beadwork
