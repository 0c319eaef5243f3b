#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/failure.hpp"
#include "core/base/text.hpp"
#include "core/io/file.hpp"
#include "core/loop/blame.hpp"
#include "core/loop/bounded_json.hpp"
#include "core/loop/forecast.hpp"
#include "core/loop/json_text.hpp"
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
  for (const Override& each : scene_.overrides) meta.overrides.push_back(each.name + "=" + each.value);
  for (const auto& [path, sum] : files_) meta.files.push_back(sum + "  " + path);
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
  const Recorder::Options options;
  if (!options_.resume) {
    recorder_ = Recorder::fresh(folder_, meta(), options, domain());
  } else {
    const auto cuts = cuts_to(curve_ends_, curves_to_cut());
    folder_.clear_leftovers();
    recorder_ = Recorder::resume(folder_, meta(), options, domain(), frame_now_.is_of(moment_) ? moment_.step : moment_.step - 1);
    cut(cuts);
  }
  for (const std::string& note : recorder_->notes()) {
    options_.warn(note);
    figures_.notes.push_back(note);  // beside those of the sessions before
  }
  write_atomically(folder_.resolved(), scene_.resolved);
  write_summary();
}

std::vector<std::filesystem::path> Run::curves_to_cut() const {
  auto files = folder_.made_in(folder_.curves());
  std::erase_if(files, [](const auto& file) { return file.extension() != ".csv"; });
  return files;
}

// The frame of the step of the checkpoint, as it was then: what looked after it may have added to it.
void Run::frame_anew() {
  if (!frame_now_.can_be_made_anew(moment_)) return;
  complete();
  if (offered_.is_read()) offer();
  for (Derived* derived : scene_.derived) blaming(*derived, moment_, [&] { derived->derive(domain()); });
  frame(frame_now_.plan);
}

Real& Run::state(const std::string& name) { return domain().scene().column(name).view<Real>()[0]; }

namespace {

// Both directions by one list, so that nothing is saved and not restored: f(name, number).
template <class F>
void each_state(std::vector<std::vector<Peak>>& peaks, std::vector<std::vector<std::vector<Real>>>& looked, std::vector<std::vector<Real>>& last_look,
                std::vector<std::vector<Constraint>>& constraints, std::vector<std::pair<const Failure*, LargestUse>>& uses, const F& f) {
  for (auto& [criterion, use] : uses)
    use.each([&, id = criterion->id()](const char* name, Real& number, const char*) { f(fmt::format("largest-use.{}.{}", id, name), number); });
  for (std::size_t s = 0; s < peaks.size(); ++s) {
    for (Peak& peak : peaks[s]) {
      f(fmt::format("peak-force.{}.{}", s, peak.set), peak.force);
      f(fmt::format("peak-displacement.{}.{}", s, peak.set), peak.displacement);
    }
    for (std::size_t w = 0; w < looked[s].size(); ++w)
      for (std::size_t k = 0; k < looked[s][w].size(); ++k) f(fmt::format("looked.{}.{}.{}", s, w, k), looked[s][w][k]);
    for (std::size_t w = 0; w < last_look[s].size(); ++w) f(fmt::format("last-look.{}.{}", s, w), last_look[s][w]);
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
  each_state(peaks_, looked_, last_look_, constraints_, figures_.largest_uses, [&](const std::string& name, Real& number) { state(name) = number; });
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
  each_state(peaks_, looked_, last_look_, constraints_, figures_.largest_uses, [&](const std::string& name, Real& number) { number = state(name); });
}

// Rows that come after the checkpoint are dropped by a resume, be they of its very step.
std::string Run::curve_ends() {
  for (auto& [name, curve] : curves_) {
    curve->curve.sync();
    curve_ends_[name] = curve->curve.end();
  }
  nlohmann::json json = nlohmann::json::object();
  for (const auto& [name, end] : curve_ends_) json[name] = {end.length, end.first_line};
  return json_text(json);
}

void Run::save() {
  complete();
  store_state();
  CheckpointMeta meta;
  meta.version = version;
  meta.deck_sha256 = scene_.deck_sha256;
  meta.resolved = scene_.resolved;
  meta.stage = moment_.stage;
  meta.time = moment_.time;
  meta.step = moment_.step;
  meta.seed = scene_.seed;
  meta.texts["packing"] = "[" + join(figures_.packing_reports, ",") + "]";
  meta.texts["files"] = json_text(nlohmann::json(files_));
  meta.texts["curves"] = curve_ends();
  meta.texts["frame"] = frame_now_.json();
  meta.texts["free-bodies"] = json_text(free_.saved());
  meta.texts["notes"] = json_text(nlohmann::json(figures_.notes));
  save_checkpoint(folder_.checkpoint(), domain(), meta);
  saved_ = Clock::now();
  has_checkpoint_ = true;
  saved_step_ = moment_.step;
}

namespace {

FileSums file_sums_of(const CheckpointMeta& meta) {
  FileSums sums;
  const auto there = meta.texts.find("files");
  if (there == meta.texts.end()) return sums;
  const auto json = bounded_json(there->second);
  if (!json.is_object()) throw MachineFailure("the checkpoint does not hold the list of the files that the deck names");
  for (const auto& [path, sum] : json.items())
    if (sum.is_string()) sums[path] = sum.get<std::string>();
  return sums;
}

}  // namespace

void Run::load() {
  const CheckpointMeta meta = read_checkpoint_meta(folder_.checkpoint());
  refuse_other_deck({meta.resolved, file_sums_of(meta)}, scene_.resolved_tree, files_);
  load_checkpoint(folder_.checkpoint(), domain());
  check_restored(meta);
  moment_.stage = meta.stage;
  moment_.time = meta.time;
  moment_.step = meta.step;
  for (const auto& report : bounded_json(meta.texts.at("packing"))) figures_.packing_reports.push_back(json_text(report));
  const auto ends = bounded_json(meta.texts.at("curves"));
  for (const auto& [curve, end] : ends.items()) curve_ends_[curve] = {end[0].get<std::uintmax_t>(), end[1].get<std::string>()};
  for (const auto& note : bounded_json(meta.texts.at("notes"))) figures_.notes.push_back(note.get<std::string>());
  frame_now_ = *FrameNow::of(meta.texts.at("frame"));
  free_ = FreeMotions::restored(bounded_json(meta.texts.at("free-bodies")), domain()).value();
  restore_state();
  has_checkpoint_ = true;
  saved_step_ = meta.step;
  former_summary_ = ended_summary();
  if (meta.version != version)
    options_.warn(fmt::format("this run was written by beadwork {}, and goes on with {}: its results may be other bits than those of either alone", meta.version, version));
  options_.say(fmt::format("resumed at step {}", moment_.step));
}

// What the loop takes for granted of a checkpoint, beyond what its reader knows of.
void Run::check_restored(const CheckpointMeta& meta) const {
  const auto refuse_if = [&](bool wrong, const std::string& what) {
    if (wrong) throw MachineFailure(fmt::format("cannot read checkpoint '{}': {}", folder_.checkpoint().string(), what));
  };
  const auto stages = scene_.stages.size();
  refuse_if(static_cast<std::size_t>(meta.stage) >= stages, fmt::format("it is of stage {}, the deck has {}", meta.stage + 1, stages));
  refuse_if(!meta.texts.contains("packing") || !bounded_json(meta.texts.at("packing")).is_array(), "its report on the packing is not whole");
  refuse_if(!meta.texts.contains("free-bodies") || !FreeMotions::restored(bounded_json(meta.texts.at("free-bodies")), *scene_.domain),
            "what it says of free bodies is not whole");
  const auto curves = meta.texts.contains("curves") ? bounded_json(meta.texts.at("curves")) : nlohmann::ordered_json();
  const auto is_end = [](const auto& end) { return end.is_array() && end.size() == 2 && end[0].is_number_unsigned() && end[1].is_string(); };
  refuse_if(!curves.is_object() || !std::all_of(curves.begin(), curves.end(), is_end), "what it says of curves is not whole");
  const auto notes = meta.texts.contains("notes") ? bounded_json(meta.texts.at("notes")) : nlohmann::ordered_json();
  refuse_if(!notes.is_array() || !std::all_of(notes.begin(), notes.end(), [](const auto& note) { return note.is_string(); }),
            "what is to be known of its record is not whole");
  refuse_if(!meta.texts.contains("frame") || !FrameNow::of(meta.texts.at("frame")), "what it says of a frame is not whole");
  const auto number = [&](const char* name) { return scene_.domain->scene().column(name).view<const Real>()[0]; };
  for (const char* name : {"time-step", "stage-start", "stage-step", "looks-owed", "wall-seconds"})
    refuse_if(!std::isfinite(number(name)), fmt::format("'{}' is no number", name));
  refuse_if(!(number("time-step") >= 0), "its time step is negative");
  refuse_if(!(number("stage-step") >= 0 && number("stage-step") <= static_cast<Real>(meta.step)), "its stage begins at no step before it");
  const auto watchers = static_cast<Real>(scene_.stages[static_cast<std::size_t>(meta.stage)].watchers.size());
  refuse_if(!(number("looks-owed") >= 0 && number("looks-owed") <= watchers), "it counts more watchers than the deck has");
}

// What the run that is resumed says of its end; nothing if it was killed before it could.
std::optional<std::string> Run::ended_summary() const {
  constexpr std::uintmax_t longest = std::uintmax_t{1} << 26;
  std::error_code error;
  if (!std::filesystem::exists(folder_.summary(), error)) return std::nullopt;
  std::string text = read_text(folder_.summary(), longest);
  const auto json = bounded_json(text);
  const bool ended = json.is_object() && json.contains("status") && json["status"] != "running";
  return ended ? std::optional(std::move(text)) : std::nullopt;
}

// A resume that comes to nothing leaves what the run said of its end.
void Run::leave_as_found() const {
  try {
    write_atomically(folder_.summary(), *former_summary_);
  } catch (const std::exception& failure) {
    options_.warn(fmt::format("summary.json could not be put back: {}", failure.what()));
    try {
      overwrite(folder_.summary(), *former_summary_);  // in the room that it has
    } catch (const std::exception&) {  // said already
    }
  }
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

void Run::show_progress() {
  Headway headway = headway_of(scene_, moment_, constraints());
  Real largest = 0;
  for (const auto& [criterion, use] : figures_.largest_uses) largest = std::max(largest, use.value);
  if (!figures_.largest_uses.empty()) headway.detail += fmt::format(", largest utilisation {:.3g}", largest);
  options_.progress(headway);
}

Real Run::wall_seconds() const { return wall_before_ + std::chrono::duration<Real>(Clock::now() - began_).count(); }

void Run::write_summary() {
  figures_.wall_seconds = wall_seconds();
  figures_.quality = quality();
  write_atomically(folder_.summary(), summary());
}

std::string Run::summary() const { return summary_json(scene_, files_, figures_, free_, moment_, options_.threads, *this); }

// The end of a stage has been saved before it is looked at: what has looked then would look twice.
bool Run::can_be_saved() const { return whole_ && !ending_; }

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
  if (former_summary_) return leave_as_found();
  std::error_code error;
  if (!can_be_saved())
    std::filesystem::remove(part_of(folder_.checkpoint()), error);
  else
    attempt("the last step could not be saved", [&] { save(); });
  if (figures_.status == "running" || figures_.status == "done") {
    figures_.status = "failed";
    figures_.exit_code = ExitCode::machine;
    figures_.exit_reason = reason;
    if (has_checkpoint_)
      figures_.exit_reason += fmt::format("; the newest checkpoint is of step {}, go on with: {}", saved_step_, options_.commands.go_on);
  }
  if (!attempt("summary.json could not be replaced", [&] { write_summary(); }))
    attempt("summary.json still says that the run goes on", [&] { overwrite(folder_.summary(), summary()); });
  if (recorder_) attempt("run.h5 lacks the last breaks", [&] { recorder_->write_breaks(domain()); });
}

// An orderly end, for better or worse: the record is whole, and says why the run ended.
void Run::close(const std::string& status, ExitCode code, const std::string& reason) {
  repeats_.conclude();
  for (const auto& [criterion, use] : figures_.largest_uses) options_.say(sentence(use, *criterion));
  figures_.status = status;
  figures_.exit_code = code;
  figures_.exit_reason = reason;
  std::error_code error;
  std::filesystem::remove(part_of(folder_.checkpoint()), error);
  if (recorder_) {
    recorder_->write_breaks(domain());
    std::string why;
    if (!recorder_->consolidate(domain(), why)) options_.warn("run.h5 still links to its frames: " + why);
  }
  if (former_summary_ && status != "done") return leave_as_found();
  write_summary();
}

CurveSink& Run::curve(const CurvePlan& plan) {
  const auto there = curves_.find(plan.name);
  if (there != curves_.end()) return *there->second;
  if (!is_plain_name(plan.name)) throw std::invalid_argument(fmt::format("a curve wants {}, got \"{}\"", plain_name, plan.name));
  std::vector<CurveColumn> columns{{"time", "s"}};
  for (const auto& [name, unit] : plan.columns) columns.push_back({name, unit});
  const auto file = folder_.curve(plan.name);
  folder_.claim(file);
  folder_.claim(std::filesystem::path(file).replace_extension(".json"));
  auto made = std::make_unique<OpenCurve>(options_.resume ? Curve::resume(file, columns) : Curve::fresh(file, columns), moment_);
  made->curve.write_sidecar(curve_json(plan));
  return *(curves_[plan.name] = std::move(made));
}

namespace {

// "all" is every field but the core's own, of which the frame has what it needs.
std::vector<const Column*> columns_of(const Table& table, const FramePlan& plan) {
  std::vector<const Column*> found;
  for (const std::string& name : plan.fields) {
    if (name == every_field)
      for (const Column* column : table.columns()) found.push_back(column);
    else if (const Column* column = table.find(name))
      found.push_back(column);
  }
  constexpr std::string_view own[] = {"first", "second", "target", "free-start", "free-body"};
  std::erase_if(found, [&](const Column* column) { return std::find(std::begin(own), std::end(own), column->field().name) != std::end(own); });
  return found;
}

}  // namespace

void Run::frame(const FramePlan& plan) {
  FrameRequest request;
  request.picture = plan.picture;
  request.view = plan.view;
  const auto columns = [&](const Table& table) { return columns_of(table, plan); };
  request.elements = columns(domain().elements());
  for (const auto& [law, table] : laws_) request.bonds.push_back({table, law->tag(), columns(table->rows())});
  recorder_->write({moment_.step, moment_.time, moment_.stage}, request, domain());
  frame_now_.add(moment_, plan);
}

}  // namespace beadwork
