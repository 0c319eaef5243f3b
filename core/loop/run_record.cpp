#include <fmt/format.h>
#include <omp.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/base/failure.hpp"
#include "core/base/text.hpp"
#include "core/io/file.hpp"
#include "core/loop/forecast.hpp"
#include "core/loop/run_curve.hpp"
#include "core/loop/summary.hpp"
#include "core/version.hpp"

namespace beadwork {

RunMeta Run::meta() const {
  RunMeta meta;
  meta.name = scene_.name;
  meta.deck = scene_.deck_text;
  meta.resolved = scene_.resolved;
  meta.deck_sha256 = scene_.deck_sha256;
  meta.version = version;
  for (const Library& library : catalogue_.libraries())
    for (const PluginEntry& entry : library.entries)
      meta.plugins.push_back(fmt::format("{}/{} {} {}", kind_name(entry.kind), entry.tag, library.version, library.path.string()));
  meta.threads = options_.threads;
  meta.seed = scene_.seed;
  meta.packing = "[" + join(figures_.packing_reports, ",") + "]";
  return meta;
}

void Run::open_record() {
  write_atomically(folder_.resolved(), scene_.resolved);
  const Recorder::Options options;
  if (options_.resume) cut_curves(folder_.curves(), moment_.step);
  recorder_ = options_.resume ? Recorder::resume(folder_, meta(), options, domain(), moment_.step)
                              : Recorder::fresh(folder_, meta(), options, domain());
  write_summary();
}

Real& Run::state(const std::string& name) { return domain().scene().column(name).view<Real>()[0]; }

namespace {

// Both directions by one list, so that nothing is saved and not restored: f(name, number).
template <class F>
void each_state(std::vector<std::vector<Peak>>& peaks, std::vector<std::vector<std::vector<Real>>>& looked,
                std::vector<std::vector<Constraint>>& constraints, const F& f) {
  for (std::size_t s = 0; s < peaks.size(); ++s) {
    for (Peak& peak : peaks[s]) {
      f(fmt::format("peak-force.{}.{}", s, peak.set), peak.force);
      f(fmt::format("peak-displacement.{}.{}", s, peak.set), peak.displacement);
    }
    for (std::size_t w = 0; w < looked[s].size(); ++w)
      for (std::size_t k = 0; k < looked[s][w].size(); ++k) f(fmt::format("looked.{}.{}.{}", s, w, k), looked[s][w][k]);
    for (std::size_t k = 0; k < constraints[s].size(); ++k) {
      f(fmt::format("reaction.{}.{}", s, k), constraints[s][k].reaction);
      f(fmt::format("work.{}.{}", s, k), constraints[s][k].work);
    }
  }
}

}  // namespace

void Run::store_state() {
  state("time-step") = moment_.time_step;
  state("stage-start") = moment_.stage_start;
  state("stage-step") = static_cast<Real>(moment_.stage_step);
  state("bond-updates") = figures_.bond_updates;
  state("loop-seconds") = figures_.loop_seconds;
  state("wall-seconds") = wall_seconds();
  state("initial-energy") = initial_energy_;
  state("looks-owed") = static_cast<Real>(owed_);
  ledger_.each([&](const std::string& name, Real& number) { state("ledger." + name) = number; });
  quality_.each([&](const std::string& name, Real& number) { state("quality." + name) = number; });
  for (const std::string& family : scene_.families) state("released." + family) = released_[domain().find_family(family)];
  each_state(peaks_, looked_, constraints_, [&](const std::string& name, Real& number) { state(name) = number; });
}

void Run::restore_state() {
  moment_.time_step = state("time-step");
  moment_.stage_start = state("stage-start");
  moment_.stage_step = std::llround(state("stage-step"));
  figures_.bond_updates = state("bond-updates");
  figures_.loop_seconds = state("loop-seconds");
  wall_before_ = state("wall-seconds");
  initial_energy_ = state("initial-energy");
  owed_ = static_cast<std::size_t>(state("looks-owed"));
  ledger_.each([&](const std::string& name, Real& number) { number = state("ledger." + name); });
  quality_.each([&](const std::string& name, Real& number) { number = state("quality." + name); });
  for (const std::string& family : scene_.families) released_[domain().find_family(family)] = state("released." + family);
  each_state(peaks_, looked_, constraints_, [&](const std::string& name, Real& number) { number = state(name); });
}

void Run::save() {
  complete();
  store_state();
  for (auto& [name, curve] : curves_) curve->curve.sync();
  CheckpointMeta meta;
  meta.version = version;
  meta.deck_sha256 = scene_.deck_sha256;
  meta.resolved = scene_.resolved;
  meta.stage = moment_.stage;
  meta.time = moment_.time;
  meta.step = moment_.step;
  meta.seed = scene_.seed;
  meta.texts["packing"] = "[" + join(figures_.packing_reports, ",") + "]";
  meta.texts["free-bodies"] = free_.saved().dump();
  save_checkpoint(folder_.checkpoint(), domain(), meta);
  saved_ = Clock::now();
  has_checkpoint_ = true;
  saved_step_ = moment_.step;
}

void Run::load() {
  const CheckpointMeta meta = read_checkpoint_meta(folder_.checkpoint());
  refuse_other_deck(meta.resolved, scene_.resolved);
  load_checkpoint(folder_.checkpoint(), domain());
  moment_.stage = meta.stage;
  moment_.time = meta.time;
  moment_.step = meta.step;
  for (const auto& report : nlohmann::json::parse(meta.texts.at("packing"))) figures_.packing_reports.push_back(report.dump());
  free_ = FreeMotions::restored(nlohmann::ordered_json::parse(meta.texts.at("free-bodies")));
  restore_state();
  has_checkpoint_ = true;
  saved_step_ = meta.step;
  options_.say(fmt::format("resumed at step {}", moment_.step));
}

bool Run::save_now_and_then(Clock::time_point now) {
  if (std::chrono::duration<Real>(now - shown_).count() >= 1) {
    shown_ = now;
    show_progress();
  }
  const Real patience =
      has_checkpoint_ ? options_.checkpoint_seconds : std::min(options_.first_checkpoint_seconds, options_.checkpoint_seconds);
  if (std::chrono::duration<Real>(now - saved_).count() < patience) return false;
  save();
  reserve_room();
  write_summary();
  return true;
}

// Holds the room of the next checkpoint, where its part file will stand: when the disk is full it can still be written.
void Run::reserve_room() const {
  std::error_code error;
  std::uintmax_t size = std::filesystem::file_size(folder_.checkpoint(), error);
  if (error) {
    size = scene_.domain->elements().memory() + scene_.domain->scene().memory();
    for (const auto& family : scene_.domain->families()) size += family->rows().memory();
  }
  try {
    reserve(part_of(folder_.checkpoint()), size + size / 4 + 65536);
  } catch (const MachineFailure&) {
    std::filesystem::remove(part_of(folder_.checkpoint()), error);
  }
}

void Run::show_progress() { options_.progress(headway_of(scene_, moment_, constraints())); }

Real Run::wall_seconds() const { return wall_before_ + std::chrono::duration<Real>(Clock::now() - began_).count(); }

void Run::write_summary() {
  figures_.wall_seconds = wall_seconds();
  figures_.quality = quality();
  write_atomically(folder_.summary(), summary());
}

std::string Run::summary() const { return summary_json(scene_, figures_, free_, moment_, options_.threads, *this); }

// What is read from bonds is not saved: a watcher of it that is owed a look could not have it later.
bool Run::can_be_saved() const {
  if (!whole_) return false;
  const auto& watchers = scene_.stages[stage_number()].watchers;
  for (std::size_t w = watchers.size() - owed_; w < watchers.size(); ++w)
    if (scene_.section_readers.contains(watchers[w]) && due(w)) return false;
  return true;
}

// The machine gave out: what can still be kept is kept, each for itself.
void Run::rescue(const std::string& reason) {
  const auto attempt = [&](const std::string& what, const auto& task) {
    try {
      task();
      return true;
    } catch (const std::exception& failure) {
      options_.warn(fmt::format("{}: {}", what, failure.what()));
      return false;
    }
  };
  std::error_code error;
  if (!can_be_saved())
    std::filesystem::remove(part_of(folder_.checkpoint()), error);
  else
    attempt("the last step could not be saved", [&] { save(); });
  if (figures_.status == "running" || figures_.status == "done") {
    figures_.status = "failed";
    figures_.exit_reason = reason;
    if (has_checkpoint_)
      figures_.exit_reason += fmt::format("; the newest checkpoint is of step {}, go on with: beadwork run {} --out {} --resume",
                                          saved_step_, scene_.deck_path, folder_.root().string());
  }
  if (!attempt("summary.json could not be replaced", [&] { write_summary(); }))
    attempt("summary.json still says that the run goes on", [&] { overwrite(folder_.summary(), summary()); });
  if (recorder_) attempt("run.h5 lacks the last breaks", [&] { recorder_->write_breaks(domain()); });
}

// An orderly end, for better or worse: the record is whole, and says why the run ended.
void Run::close(const std::string& status, const std::string& reason) {
  figures_.status = status;
  figures_.exit_reason = reason;
  std::error_code error;
  std::filesystem::remove(part_of(folder_.checkpoint()), error);
  if (recorder_) {
    recorder_->write_breaks(domain());
    std::string why;
    if (!recorder_->consolidate(domain(), why)) options_.warn("run.h5 still links to its frames: " + why);
  }
  write_summary();
}

CurveSink& Run::curve(const CurvePlan& plan) {
  const auto there = curves_.find(plan.name);
  if (there != curves_.end()) return *there->second;
  std::vector<CurveColumn> columns{{"time", "s"}};
  for (const auto& [name, unit] : plan.columns) columns.push_back({name, unit});
  const auto file = folder_.curve(plan.name);
  auto made = std::make_unique<OpenCurve>(options_.resume ? Curve::resume(file, columns) : Curve::fresh(file, columns), moment_);
  made->curve.write_sidecar(curve_json(plan));
  return *(curves_[plan.name] = std::move(made));
}

void Run::frame(const FramePlan& plan) {
  FrameRequest request;
  request.picture = plan.picture;
  const auto columns = [&](const Table& table) {
    std::vector<const Column*> found;
    for (const std::string& name : plan.fields)
      if (const Column* column = table.find(name)) found.push_back(column);
    return found;
  };
  request.elements = columns(domain().elements());
  for (const auto& [law, table] : laws_) request.bonds.push_back({table, law->tag(), columns(table->rows())});
  recorder_->write({moment_.step, moment_.time, moment_.stage}, request, domain());
}

}  // namespace beadwork
