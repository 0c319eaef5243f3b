// Reads damaged folders of runs by all ways by which the program reads one back: for a report, to go on, as a packing.
// Built with the sanitizers of addresses and undefined behaviour; corpus.py makes the folders.
//   damaged make FOLDER       a whole run of a small bar, and beside it one that still goes on
//   damaged read FOLDER...    ends with 1 if anything but a Fault comes of it, or a "refuse-..." is taken for whole
#include <cstdio>
#include <functional>

#include "core/io/checkpoint.hpp"
#include "core/io/curve_file.hpp"
#include "core/io/packing_file.hpp"
#include "core/io/recorder.hpp"
#include "tests/support/bonded_bar.hpp"
#include "workbench/report/report.hpp"
#include "workbench/report/sections.hpp"
#include "workbench/report/specimen.hpp"

using namespace beadwork;
using namespace beadwork::testing;
namespace fs = std::filesystem;

namespace {

constexpr Index elements = 120;
const RunMeta about = {.name = "bar",
                       .deck = "<scene/>",
                       .resolved = "<scene name=\"bar\"/>",
                       .deck_sha256 = "5e88",
                       .overrides = {},
                       .files = {},
                       .version = "0.1.0",
                       .plugins = {"bond/spring 0.1.0 lib.so"},
                       .threads = 2,
                       .seed = 7,
                       .packing = "[{\"Z\": 6.2}]"};

void make(const fs::path& root, bool finished) {
  RunFolder folder = RunFolder::fresh(root, true);
  Domain domain;
  declare_bar(domain);
  fill_bar(domain, elements);
  Recorder recorder = Recorder::fresh(folder, about, domain);
  const BondTable& resin = *domain.families()[0];
  const FrameRequest request{
      {&domain.elements().column("velocity")}, {{&resin, "cohesive-beam", {&resin.rows().column("damage")}}}, false};
  for (const std::int64_t step : {0, 100}) {
    break_some(domain, 0, 30 + static_cast<Index>(step), step);
    recorder.write({step, 1e-7 * static_cast<Real>(step), 0}, request, domain);
  }
  std::string reason;
  if (finished && !recorder.consolidate(domain, reason)) throw MachineFailure(reason);
  save_checkpoint(folder.checkpoint(), domain,
                  {"0.1.0", "5e88", about.resolved, {1e-5, 100, 1e-7, 0, 0, 0}, 7, {{"packing", about.packing}}});
  folder.claim(folder.curve("force"));
  folder.claim(root / "curves/force.json");
  CurveFile curve = CurveFile::fresh(folder.curve("force"), {{"time", "s"}, {"force", "N"}});
  for (std::int64_t step = 0; step <= 100; step += 10)
    curve.add(step, std::vector<Real>{1e-7 * static_cast<Real>(step), 2});
  curve.write_sidecar("{\"title\": \"Force\", \"x\": \"time\", \"y\": [\"force\"]}\n");
  write_atomically(
      folder.summary(),
      R"({"name": "bar", "status": "done", "elements": 120, "time_step": 1e-7, "energy": {"work": 1.5}, "breaks": {"shear": 4},
    "packing": [{"Z": 6.2, "radius_histogram": {"edges": [1e-4, 2e-4, 3e-4], "counts": [7, 5]}}]})");
  write_atomically(folder.resolved(), about.resolved);
  write_atomically(folder.log(), "first line\nlast line\n");
}

// The page but for its pictures, which take long to draw with sanitizers; what is drawn is prepared.
void read_for_report(const fs::path& root) {
  report::Run run = report::open_run(root);
  for (const auto& part : {report::facts(run), report::curves(run, {}), report::ledger(run), report::breaks(run),
                           report::packing(run), report::deck_and_log(run)})
    if (part.size() > (std::size_t{1} << 30)) throw std::logic_error("a part of the page has no bounds");
  if (!run.recorded) return;
  run.recorded->meta();
  const auto sets = run.recorded->sets();
  std::vector<record::Frame> frames;
  for (const record::FrameHead& head : run.recorded->frames()) {
    frames.push_back(run.recorded->read(head));
    report::leave_out_odd(frames.back());
    report::complete_displacement(frames.back(), frames.front());
  }
  if (!frames.empty()) report::set_up(frames.front(), frames, sets, report::wanted_view(frames));
}

void load(const fs::path& root, Domain& domain) {
  declare_bar(domain);
  const CheckpointMeta meta = read_checkpoint_meta(root / "checkpoint.h5");
  load_checkpoint(root / "checkpoint.h5", domain);
  if (meta.moment.stage > 0) throw MachineFailure("there is one stage");
  domain.cut_families();
  domain.clear_loads();
  domain.gather();
}

void go_on(const fs::path& root, const Domain& domain) {
  RunFolder folder = RunFolder::resume(root);
  auto curves = folder.made_in(folder.curves());
  std::erase_if(curves, [](const fs::path& file) { return file.extension() != ".csv"; });
  const auto cuts = cuts_to({{"force", {100, "step [1],time [s],force [N]"}}}, curves);
  folder.clear_leftovers();
  Recorder recorder = Recorder::resume(folder, about, domain, 100);
  cut(cuts);
  std::string reason;
  recorder.consolidate(domain, reason);
}

/// Whether it came to its end; a Fault is one of the two things that may happen.
bool try_to(const std::function<void()>& task) {
  try {
    task();
    return true;
  } catch (const Fault& fault) {
    std::printf("  %s\n", fault.what());
    return false;
  }
}

int read(const fs::path& root) {
  const std::string name = root.filename().string();
  std::printf("%s\n", name.c_str());
  std::fflush(stdout);
  try {
    Domain domain;
    const bool whole = try_to([&] { load(root, domain); });
    try_to([&] { read_for_report(root); });
    if (name.starts_with("draw-") && !try_to([&] { write_report(root); })) throw std::logic_error("there is no report");
    try_to([&] { read_packing(root / "run.h5", {}); });
    if (whole) try_to([&] { go_on(root, domain); });
    if (whole && name.starts_with("refuse-")) throw std::logic_error("it was taken for whole");
    return 0;
  } catch (const std::exception& error) {
    std::printf("WRONG: %s\n", error.what());
    return 1;
  }
}

}  // namespace

int main(int count, char** words) {
  if (count < 3) return 2;
  int wrong = 0;
  if (std::string(words[1]) == "make") {
    make(fs::path(words[2]) / "finished", true);
    make(fs::path(words[2]) / "going-on", false);
  } else {
    for (int k = 2; k < count; ++k) wrong |= read(words[k]);
  }
  return wrong;
}
