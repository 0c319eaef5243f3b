#pragma once
// The parts of a run, each to be tried alone: a deck, given as text, filled and begun, and no loop.

#include <limits>
#include <string>
#include <vector>

#include "core/deck/read.hpp"
#include "core/loop/breaking.hpp"
#include "core/loop/contacts.hpp"
#include "core/loop/filling.hpp"
#include "core/loop/stage_start.hpp"
#include "tests/support/scratch.hpp"

namespace beadwork::testing {

class Parts : private Workings {
  Scratch scratch_;
  Catalogue catalogue_;

 public:
  explicit Parts(const std::string& text, const std::vector<PluginEntry>& entries = {},
                 const std::vector<std::filesystem::path>& libraries = {})
      : scene(assemble(text, entries, libraries)),
        state(*scene),
        offered(*scene),
        forces(state, offered),
        fresh(state, offered, forces, *this),
        balance(state, fresh, options.log),
        breaking(state, offered, fresh, balance),
        contacts(state, options.log) {
    scene->bind();
  }

  /// What comes before the first step.
  void begin() {
    std::vector<std::string> reports;
    fill(state, options, reports);
    begin_stage(0);
  }
  void begin_stage(int number) {
    state.moment.stage = number;
    state.moment.stage_start = state.moment.time;
    state.moment.stage_step = state.moment.step;
    create_families(state, options);
    let_laws_act(state);
    fresh.begin_stage();
    connect(state, options.log);
    contacts.begin_stage();
    begin_constraints(state);
    breaking.begin_stage();
    state.mover().prepare(*this, false);
    balance.begin_stage();
  }
  /// The same where a checkpoint has been loaded.
  void resume_stage() {
    let_laws_act(state);
    fresh.begin_stage();
    contacts.resume_stage();
    begin_constraints(state);
    breaking.begin_stage();
    state.mover().prepare(*this, true);
  }
  void step() {
    fresh.begin_step();
    contacts.follow();
    state.mover().step(*this);
  }

  const Catalogue& catalogue() const { return catalogue_; }

  std::vector<std::string> said, warned;
  RunOptions options = listened_to();
  std::unique_ptr<Scene> scene;
  RunState state;
  Offered offered;
  Forces forces;
  Fresh fresh;
  Balance balance;
  Breaking breaking;
  Contacts contacts;

 private:
  RunOptions listened_to() {
    RunOptions o;
    o.log = Log([this](const std::string& line) { said.push_back(line); },
                [this](const std::string& line) { warned.push_back(line); });
    return o;
  }
  std::unique_ptr<Scene> assemble(const std::string& text, const std::vector<PluginEntry>& entries,
                                  const std::vector<std::filesystem::path>& libraries) {
    write_text(scratch_ / "deck.xml", text);
    Complaints complaints;
    const auto deck = read_deck((scratch_ / "deck.xml").string(), {}, complaints);
    complaints.throw_if_any();
    catalogue_ = Catalogue::open(libraries);
    if (!entries.empty()) catalogue_.add({"no library", "", entries});
    auto made = Scene::assemble(*deck, catalogue_, complaints);
    complaints.throw_if_any();
    return made;
  }

  Domain& domain() override { return state.domain(); }
  Moment& moment() override { return state.moment; }
  std::vector<Constraint>& constraints() override { return state.held(); }
  void evaluate(bool settle) override { forces.evaluate(settle, false); }
  Real utilisation() override { return 0; }
  Real next_moment(Real until) const override { return until; }
  void pause() override {}
  Real reach() const override { return std::numeric_limits<Real>::infinity(); }
  std::span<const ActingLaw> laws() const override { return state.laws; }
  Log& log() override { return options.log; }
};

}  // namespace beadwork::testing
