#include <fmt/format.h>
#include <omp.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/base/failure.hpp"
#include "core/base/text.hpp"
#include "core/io/file.hpp"
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
  recorder_ = options_.resume ? Recorder::resume(folder_, meta(), options, domain(), moment_.step)
                              : Recorder::fresh(folder_, meta(), options, domain());
  write_summary();
}

Real& Run::state(const std::string& name) { return domain().scene().column(name).view<Real>()[0]; }

namespace {

// Both directions by one list, so that nothing is saved and not restored: f(name, number).
template <class F>
void each_state(std::vector<std::vector<Real>>& maxima, std::vector<std::vector<std::vector<Real>>>& looked,
                std::vector<std::vector<Constraint>>& constraints, const F& f) {
  for (std::size_t s = 0; s < maxima.size(); ++s) {
    for (std::size_t k = 0; k < maxima[s].size(); ++k) f(fmt::format("until.{}.{}", s, k), maxima[s][k]);
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
  state("initial-energy") = initial_energy_;
  for (const std::string& family : scene_.families) state("released." + family) = released_[domain().find_family(family)];
  each_state(until_maxima_, looked_, constraints_, [&](const std::string& name, Real& number) { state(name) = number; });
}

void Run::restore_state() {
  moment_.time_step = state("time-step");
  moment_.stage_start = state("stage-start");
  moment_.stage_step = std::llround(state("stage-step"));
  figures_.bond_updates = state("bond-updates");
  figures_.loop_seconds = state("loop-seconds");
  initial_energy_ = state("initial-energy");
  for (const std::string& family : scene_.families) released_[domain().find_family(family)] = state("released." + family);
  each_state(until_maxima_, looked_, constraints_, [&](const std::string& name, Real& number) { number = state(name); });
}

void Run::save() {
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
  save_checkpoint(folder_.checkpoint(), domain(), meta);
  saved_ = Clock::now();
}

void Run::load() {
  const CheckpointMeta meta = read_checkpoint_meta(folder_.checkpoint());
  refuse_other_deck(meta.resolved, scene_.resolved);
  load_checkpoint(folder_.checkpoint(), domain());
  moment_.stage = meta.stage;
  moment_.time = meta.time;
  moment_.step = meta.step;
  resumed_at_ = meta.step;
  for (const auto& report : nlohmann::json::parse(meta.texts.at("packing"))) figures_.packing_reports.push_back(report.dump());
  restore_state();
  options_.say(fmt::format("resumed at step {}", moment_.step));
}

void Run::save_now_and_then() {
  const auto now = Clock::now();
  if (std::chrono::duration<Real>(now - shown_).count() >= 1) {
    shown_ = now;
    show_progress();
  }
  if (std::chrono::duration<Real>(now - saved_).count() < options_.checkpoint_seconds) return;
  save();
  write_summary();
}

void Run::show_progress() {
  const Until& until = *stage().until;
  const Real time = moment_.time - moment_.stage_start;
  Real done = 0;
  if (until.time() && *until.time() > 0) done = std::max(done, time / *until.time());
  if (until.steps() && *until.steps() > 0) done = std::max(done, static_cast<Real>(moment_.step - moment_.stage_step) / static_cast<Real>(*until.steps()));
  if (until.displacement() && *until.displacement() > 0) done = std::max(done, driven_displacement(constraints(), "", time) / *until.displacement());
  options_.progress(std::min<Real>(done, 1), fmt::format("stage '{}', step {}, time {:.4g} s, {} breaks", stage().name, moment_.step,
                                                         moment_.time, domain().breaks().breaks.size()));
}

void Run::write_summary() {
  figures_.wall_seconds = std::chrono::duration<Real>(Clock::now() - began_).count();
  write_atomically(folder_.summary(), summary_json(scene_, figures_, moment_, options_.threads, *this));
}

// An orderly end, for better or worse: the record is whole, and says why the run ended.
void Run::close(const std::string& status, const std::string& reason) {
  figures_.status = status;
  figures_.exit_reason = reason;
  if (recorder_) {
    recorder_->write_breaks(domain());
    std::string why;
    if (!recorder_->consolidate(domain(), why)) options_.warn("run.h5 still links to its frames: " + why);
  }
  write_summary();
}

CurveSink& Run::curve(const CurvePlan& plan) {
  auto& open = curves_[plan.name];
  if (open) return *open;
  std::vector<CurveColumn> columns{{"time", "s"}};
  for (const auto& [name, unit] : plan.columns) columns.push_back({name, unit});
  const auto file = folder_.curve(plan.name);
  open = std::make_unique<OpenCurve>(options_.resume ? Curve::resume(file, columns, resumed_at_) : Curve::fresh(file, columns), moment_);
  open->curve.write_sidecar(curve_json(plan));
  return *open;
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
