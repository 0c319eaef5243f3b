// Whatever function of a plugin throws whatever: it is told which plugin of which line, and the run ends as one that
// failed.

#include <gtest/gtest.h>

#include "core/base/parallel.hpp"
#include "core/deck/read.hpp"
#include "core/domain/vocabulary.hpp"
#include "core/loop/run.hpp"
#include "core/plugin/elf.hpp"
#include "core/plugin/library.hpp"
#include "tests/support/scratch.hpp"

namespace beadwork {
namespace {

using testing::Scratch;

std::string trap;        // the function that throws
bool throws_42 = false;  // instead of an exception
std::string words;       // of the exception, where not the usual ones
std::string report;      // that the filler hands over
bool writes = false;     // the watcher, a row of its curve
int astray = -1;         // 0 1 2: the load's displacement, velocity, acceleration is not
Real missing = 0;        // but this

void trip(const std::string& function) {
  if (function != trap) return;
  if (throws_42) throw 42;
  if (words != "") throw std::runtime_error(words);
  throw std::runtime_error("the wire was touched");
}

/// What all kinds of plugins have.
template <class Kind>
class Wired : public Kind {
 public:
  explicit Wired(const std::string& name) : name_(name) { trip(name + " constructor"); }
  void check(Complaints&) const override { trip(name_ + " check"); }
  void choose() override { trip(name_ + " choose"); }
  void energy(EnergySink&) const override { trip(name_ + " energy"); }

 protected:
  void wire(const std::string& function) const { trip(name_ + " " + function); }

 private:
  std::string name_;
};

class WiredFill final : public Wired<Filler> {
 public:
  static constexpr const char* about = "Makes two elements and a set";
  Param<std::string> set{this, {.name = "set", .doc = "Set", .role = Role::makes_set}};
  WiredFill() : Wired("fill") {}
  void fill(Domain& domain, const FillJob& job) override {
    wire("fill");
    if (!report.empty()) job.report(report);
    const Index first = domain.add_elements(2);
    for (Index k = first; k < first + 2; ++k) {
      domain.elements().column("position").view<Vec3>().set(k, Vec3(2. * k, 0, 0));
      domain.elements().column("radius").view<Real>()[k] = 1;
      domain.sets()[*set].push_back(k);
    }
  }
  void conclude(const FillJob&) override { wire("conclude"); }
};

class WiredLaw final : public Wired<BondLaw> {
 public:
  static constexpr const char* about = "Does nothing";
  Adds<Vec3> force{this, field::force};
  WiredLaw() : Wired("bond") {}
  bool accepts(const Domain&, Index, Index) const override { return wire("accepts"), true; }
  void connect(Domain&, BondTable&) override { wire("connect"); }
  std::string remark() const override { return wire("remark"), ""; }
  std::string caution() const override { return wire("caution"), ""; }
  void act(Domain& domain, BondTable&, const Evaluation&) override {
    each_shared(100, [&](int k) {
      if (k == 70) wire("act");
    });
    domain.clear_loads();
  }
  void withdraw(Domain&, const BondTable&, Index) override { wire("withdraw"); }
  std::span<const BondEvent> events() const override { return wire("events"), std::span<const BondEvent>{}; }
  Real stored_energy(const Domain&, const BondTable&, Index) const override { return wire("stored_energy of one"), 0; }
  Real stored_energy(const Domain&, const BondTable&) const override { return wire("stored_energy"), 0; }
  Real dissipated_energy(const Domain&, const BondTable&) const override { return wire("dissipated_energy"), 0; }
  Matrix12 tangent(const Domain&, const BondTable&, Index, Slope) const override { return Matrix12::Zero(); }
};

class WiredLoad final : public Wired<Load> {
 public:
  static constexpr const char* about = "Pulls";
  Param<std::string> set{this, {.name = "set", .doc = "Set", .role = Role::set}};
  WiredLoad() : Wired("load") {}
  void clear(Domain&) override { wire("clear"); }
  void start(Domain&) override { wire("start"); }
  std::vector<Constraint> constraints() const override {
    wire("constraints");
    Constraint c;
    c.by = id(), c.set = *set, c.driven = true;
    c.motion = [this](Real) {
      return wire("motion"),
             PrescribedMotion{astray == 0 ? missing : 0, astray == 1 ? missing : 0, astray == 2 ? missing : 0};
    };
    return {c};
  }
  void push(Domain&, const Moment&) override { wire("push"); }
  void account(const Domain&, const Moment&) override { wire("account"); }
};

class WiredMove final : public Wired<Mover> {
 public:
  static constexpr const char* about = "Lets time pass";
  WiredMove() : Wired("move") {}
  void choose_rotations(bool) override { wire("choose_rotations"); }
  void check_stage(const std::string&, bool, Complaints&) const override { wire("check_stage"); }
  void prepare(Workings& w, bool) override {
    wire("prepare");
    w.moment().time_step = 1;
    w.evaluate(true);
  }
  void step(Workings& w) override {
    wire("step");
    for (const Constraint& c : w.constraints()) c.at(w.moment().time);
    w.moment().time += 1, ++w.moment().step;
    w.evaluate(true);
  }
  void complete(Workings&) override { wire("complete"); }
};

class WiredFail final : public Wired<Failure> {
 public:
  static constexpr const char* about = "Breaks all";
  WiredFail() : Wired("fail") {}
  void begin(const Domain&, std::uint64_t) override { wire("begin"); }
  void judge(const Domain& domain) override {
    wire("judge");
    judge_bonds(domain, [](Index row) { return row == 0 ? 1 : 0; });
  }
  std::string mode() const override { return wire("mode"), "broken"; }
};

class WiredDerive final : public Wired<Derived> {
 public:
  static constexpr const char* about = "Derives a field";
  Writes<Real> field{this, {.name = "wired", .on = On::elements, .type = Type::real, .unit = "1", .doc = "A field"}};
  WiredDerive() : Wired("derive") {}
  void derive(const Domain&) override { wire("derive"); }
};

class WiredWatch final : public Wired<Watcher> {
 public:
  static constexpr const char* about = "Watches";
  Reads<Real> field{this, {.name = "wired", .on = On::elements, .type = Type::real, .unit = "1", .doc = "A field"}};
  Param<std::string> name{this, {.name = "name", .doc = "Name of the curve", .optional = true}};
  Curve curve{this, name, {}};
  WiredWatch() : Wired("watch") {}
  bool wants(const Moment& moment) const override { return wire("wants"), Watcher::wants(moment); }
  void check_stages(std::span<const Constraint>, Complaints&) const override { wire("check_stages"); }
  void look(Sight& sight) override {
    wire("look");
    EnergySums sums;
    sight.energies(sums);
    if (writes) curve.row({});
  }
};

Catalogue wired() {
  Catalogue catalogue;
  catalogue.add(
      {"wired.so",
       "1",
       {entry<WiredFill>("wired"), entry<WiredLaw>("wired"), entry<WiredLoad>("wired"), entry<WiredMove>("wired"),
        entry<WiredFail>("wired"), entry<WiredDerive>("wired"), entry<WiredWatch>("wired")}});
  return catalogue;
}

constexpr const char* deck = R"(<scene>
  <fill><wired set="all"/></fill>
  <bond><wired name="bonds" between="all all"/></bond>
  <load><wired set="all"/></load>
  <move><wired until="5"/></move>
  <fail><wired of="bonds" every="3"/></fail>
  <watch><wired every="2"/></watch>
</scene>)";

void run_deck(const Scratch& scratch) {
  testing::write_text(scratch / "deck.xml", deck);
  const Catalogue catalogue = wired();
  Complaints complaints;
  const auto read = read_deck((scratch / "deck.xml").string(), {}, complaints);
  const auto scene = Scene::assemble(*read, catalogue, complaints);
  complaints.throw_if_any();
  RunFolder folder = RunFolder::fresh(scratch / "out", false);
  RunOptions options;
  options.threads = 2;
  Run(*scene, catalogue, folder, options).all();
}

TEST(PluginFailures, name_plugin_and_place_whatever_throws_what) {
  for (const std::string function : {"fill constructor",
                                     "fill check",
                                     "fill choose",
                                     "fill energy",
                                     "fill fill",
                                     "fill conclude",
                                     "bond constructor",
                                     "bond check",
                                     "bond choose",
                                     "bond accepts",
                                     "bond connect",
                                     "bond remark",
                                     "bond caution",
                                     "bond act",
                                     "bond withdraw",
                                     "bond events",
                                     "bond stored_energy of one",
                                     "bond stored_energy",
                                     "bond dissipated_energy",
                                     "bond energy",
                                     "load constructor",
                                     "load check",
                                     "load choose",
                                     "load clear",
                                     "load start",
                                     "load constraints",
                                     "load motion",
                                     "load push",
                                     "load account",
                                     "load energy",
                                     "move constructor",
                                     "move check",
                                     "move choose",
                                     "move choose_rotations",
                                     "move check_stage",
                                     "move prepare",
                                     "move step",
                                     "move complete",
                                     "move energy",
                                     "fail constructor",
                                     "fail check",
                                     "fail choose",
                                     "fail begin",
                                     "fail judge",
                                     "fail mode",
                                     "fail energy",
                                     "derive constructor",
                                     "derive derive",
                                     "derive energy",
                                     "watch constructor",
                                     "watch check",
                                     "watch choose",
                                     "watch wants",
                                     "watch check_stages",
                                     "watch look",
                                     "watch energy"})
    for (const bool bare : {false, true}) {
      const Scratch scratch;
      trap = function, throws_42 = bare;
      std::string said;
      try {
        run_deck(scratch);
      } catch (const PhysicsFailure& failure) {
        said = failure.what();
      } catch (const std::exception& bare_one) {
        ADD_FAILURE() << function << " is not told of by its plugin: " << bare_one.what();
        continue;
      }
      const std::string plugin = function.substr(0, function.find(' ')) + ".wired";
      EXPECT_NE(said.find("plugin " + plugin), std::string::npos) << function << ": " << said;
      EXPECT_NE(said.find(bare ? "no std::exception" : "the wire was touched"), std::string::npos)
          << function << ": " << said;
      EXPECT_NE(said.find("deck.xml"), std::string::npos) << function << ": " << said;
      const std::string summary = testing::text_of(scratch / "out/summary.json");
      if (function == "fail mode" || function == "move step")
        EXPECT_NE(summary, "") << function << " leaves no summary";
      if (!summary.empty())
        EXPECT_NE(summary.find("\"status\": \"failed\""), std::string::npos) << function << ": " << summary;
    }
  trap.clear();
  const Scratch scratch;
  EXPECT_NO_THROW(run_deck(scratch));
}

TEST(PluginFailures, a_motion_that_is_no_number_is_told_with_its_load_and_place) {
  for (astray = 0; astray < 3; ++astray)
    for (const Real value : {std::numeric_limits<Real>::quiet_NaN(), std::numeric_limits<Real>::infinity()}) {
      missing = value;
      const Scratch scratch;
      const std::string said = testing::message_of<PhysicsFailure>([&] { run_deck(scratch); });
      EXPECT_NE(said.find("deck.xml:4:10: error: plugin load.wired prescribes at 0 s"), std::string::npos) << said;
    }
  astray = -1;
}

TEST(PluginFailures, a_curve_without_a_name_is_the_failure_of_its_watcher) {
  const Scratch scratch;
  writes = true;
  const std::string said = testing::message_of<PhysicsFailure>([&] { run_deck(scratch); });
  EXPECT_NE(said.find("deck.xml:7:11: error: "), std::string::npos) << said;
  EXPECT_NE(said.find("plugin watch.wired failed: a curve wants a name without"), std::string::npos) << said;
  writes = false;
}

TEST(PluginFailures, in_words_that_are_no_text_do_not_hide_the_failure) {
  const Scratch scratch;
  trap = "move step", throws_42 = false, words = "a \xFF wire";
  EXPECT_NE(testing::message_of<PhysicsFailure>([&] { run_deck(scratch); }).find("plugin move.wired"),
            std::string::npos);
  EXPECT_NE(testing::text_of(scratch / "out/summary.json").find("a \uFFFD wire"), std::string::npos);
  trap.clear(), words.clear();
}

TEST(PluginFailures, of_a_filler_whose_report_is_no_json_are_its_own) {
  for (const std::string wrong : {"{\"x\": nan}", "{\"x\": \"\xFF\"}", "[1]", ""}) {
    const Scratch scratch;
    report = wrong.empty() ? std::string(5000, '[') : wrong;
    EXPECT_NE(testing::message_of<PhysicsFailure>([&] { run_deck(scratch); }).find("plugin fill.wired failed"),
              std::string::npos)
        << wrong;
  }
  report = "{\"x\": 1}";
  const Scratch scratch;
  EXPECT_NO_THROW(run_deck(scratch));
  report.clear();
}

// The system's loader would die of most of these.
TEST(PluginLibrary, that_is_cut_off_or_damaged_is_refused_before_it_is_opened) {
  const Scratch scratch;
  const std::string whole = testing::text_of(std::filesystem::path(BEADWORK_BINARY_DIR) / "lib/libbeadwork.so");
  ASSERT_GT(whole.size(), 100000u);
  const auto library = scratch / "library.so";
  testing::write_text(library, whole);
  EXPECT_EQ(why_no_shared_library(library), "");
  for (std::size_t piece = 0; piece < 200; ++piece) {
    testing::write_text(library, whole.substr(0, piece * whole.size() / 200));
    EXPECT_NE(why_no_shared_library(library), "") << piece;
    EXPECT_EQ(testing::message_of<LibraryFailure>([&] { open_library(library); }).find("cannot open plugin library"),
              0u)
        << piece;
  }
  testing::write_text(library, whole.substr(0, whole.size() - 1));
  EXPECT_NE(why_no_shared_library(library).find("cut off"), std::string::npos);
  for (const auto& [at, byte] :
       std::vector<std::pair<std::size_t, char>>{{4, 1}, {5, 2}, {16, 2}, {18, 40}, {36, 77}, {54, 1}, {56, 0}}) {
    std::string odd = whole;
    odd[at] = byte;
    testing::write_text(library, odd);
    EXPECT_NE(why_no_shared_library(library), "") << at;
  }
  for (const std::size_t from :
       {std::size_t{65536}, whole.size() / 2}) {  // a write that was lost: its tables are whole
    std::string holed = whole;
    std::fill(holed.begin() + static_cast<std::ptrdiff_t>(from), holed.end() - 65536, '\0');
    testing::write_text(library, holed);
    EXPECT_EQ(testing::message_of<LibraryFailure>([&] { open_library(library); }).find("cannot open plugin library"),
              0u)
        << from;
  }
  EXPECT_NE(why_no_shared_library(scratch.path()), "");
  EXPECT_EQ(why_no_shared_library(scratch / "nowhere.so"), "there is no such file");
}

}  // namespace
}  // namespace beadwork
