#include "core/loop/record.hpp"

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
#include "core/loop/summary.hpp"
#include "core/version.hpp"

namespace beadwork {

Record::Record(RunState& state, const Catalogue& catalogue, RunFolder& folder, RunOptions& options, Fresh& fresh,
               Balance& balance)
    : state_(state),
      catalogue_(catalogue),
      folder_(folder),
      options_(options),
      fresh_(fresh),
      balance_(balance),
      files_(file_sums(state.scene.files())),
      began_(Clock::now()),
      saved_(began_),
      shown_(began_) {
  take_rows(this);
}

Record::~Record() { take_rows(nullptr); }

// Of all curves.
void Record::take_rows(CurveSink* sink) const {
  for (const auto& plugin : state_.scene.plugins)
    if (const auto* watcher = as_kind<Watcher>(*plugin))
      for (Curve* curve : watcher->curves()) curve->write_to(sink);
}

RunMeta Record::meta() const {
  RunMeta meta;
  meta.name = state_.scene.name;
  meta.deck = state_.scene.deck_text;
  meta.resolved = state_.scene.resolved;
  meta.deck_sha256 = state_.scene.deck_sha256;
  for (const Override& each : state_.scene.overrides) meta.overrides.push_back(each.name + "=" + each.value);
  for (const auto& [path, sum] : files_) meta.files.push_back(sum + "  " + path);
  meta.version = version;
  for (const Library& library : catalogue_.libraries())
    for (const PluginEntry& entry : library.entries)
      meta.plugins.push_back(
          fmt::format("{}/{} {} {}", kind_name(entry.kind), entry.tag, library.version, library.path.string()));
  meta.threads = options_.threads;
  meta.seed = state_.scene.seed;
  meta.packing = "[" + join(figures_.packing_reports, ",") + "]";
  return meta;
}

void Record::open() {
  std::vector<std::string> notes;
  if (!options_.resume) {
    folder_.take_over();
    recorder_ = Recorder::fresh(folder_, meta(), state_.domain());
  } else {
    const auto cuts = cuts_to(curve_ends_, curves_to_cut());
    folder_.clear_leftovers();
    recorder_ = Recorder::resume(folder_, meta(), state_.domain(),
                                 frame_now_.is_of(state_.moment) ? state_.moment.step : state_.moment.step - 1);
    notes = lost_rows(curve_ends_, cuts);
    cut(cuts);
  }
  notes.insert(notes.end(), recorder_->notes().begin(), recorder_->notes().end());
  for (const std::string& note : notes) {
    options_.log.warn(note);
    figures_.notes.push_back(note);  // beside those of the sessions before
  }
  write_atomically(folder_.resolved(), state_.scene.resolved);
  write_summary();
}

std::vector<std::filesystem::path> Record::curves_to_cut() const {
  auto files = folder_.made_in(folder_.curves());
  std::erase_if(files, [](const auto& file) { return file.extension() != ".csv"; });
  return files;
}

// The frame of the step of the checkpoint, as it was then: what looked after it may have added to it.
void Record::frame_anew() {
  if (!frame_now_.can_be_made_anew(state_.moment)) return;
  fresh_.everything();
  frame(frame_now_.plan);
}

// Rows that come after the checkpoint are dropped by a resume, be they of its very step.
std::string Record::curve_ends() {
  for (auto& [name, curve] : curves_) {
    curve.sync();
    curve_ends_[name] = curve.end();
  }
  nlohmann::json json = nlohmann::json::object();
  for (const auto& [name, end] : curve_ends_) json[name] = {end.length, end.first_line};
  return json_text(json);
}

void Record::save() {
  fresh_.complete();
  state_.wall_seconds = wall_seconds();
  CheckpointMeta meta;
  meta.version = version;
  meta.deck_sha256 = state_.scene.deck_sha256;
  meta.resolved = state_.scene.resolved;
  meta.moment = state_.moment;
  meta.seed = state_.scene.seed;
  meta.texts["packing"] = "[" + join(figures_.packing_reports, ",") + "]";
  meta.texts["files"] = json_text(nlohmann::json(files_));
  meta.texts["curves"] = curve_ends();
  meta.texts["frame"] = frame_now_.json();
  meta.texts["free-bodies"] = json_text(balance_.free_motions().saved());
  meta.texts["notes"] = json_text(nlohmann::json(figures_.notes));
  save_checkpoint(folder_.checkpoint(), state_.domain(), meta);
  saved_ = Clock::now();
  saved_step_ = state_.moment.step;
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

void Record::load() {
  const CheckpointMeta meta = read_checkpoint_meta(folder_.checkpoint());
  refuse_other_deck({meta.resolved, file_sums_of(meta)}, state_.scene.resolved_tree, files_);
  load_checkpoint(folder_.checkpoint(), state_.domain());
  check_restored(meta);
  state_.moment = meta.moment;
  wall_before_ = state_.wall_seconds;
  for (const auto& report : bounded_json(meta.texts.at("packing")))
    figures_.packing_reports.push_back(json_text(report));
  const auto ends = bounded_json(meta.texts.at("curves"));
  for (const auto& [curve, end] : ends.items())
    curve_ends_[curve] = {end[0].get<std::uintmax_t>(), end[1].get<std::string>()};
  for (const auto& note : bounded_json(meta.texts.at("notes"))) figures_.notes.push_back(note.get<std::string>());
  frame_now_ = *FrameNow::of(meta.texts.at("frame"));
  balance_.restore(FreeMotions::restored(bounded_json(meta.texts.at("free-bodies")), state_.domain()).value());
  saved_step_ = meta.moment.step;
  former_summary_ = ended_summary();
  if (meta.version != version)
    options_.log.warn(
        fmt::format("this run was written by beadwork {}, and goes on with {}: its results may be other bits than "
                    "those of either alone",
                    meta.version, version));
  options_.log.say(fmt::format("resumed at step {}", state_.moment.step));
}

// What the loop takes for granted of a checkpoint, beyond what its reader knows of.
void Record::check_restored(const CheckpointMeta& meta) const {
  const auto refuse_if = [&](bool wrong, const std::string& what) {
    if (wrong)
      throw MachineFailure(fmt::format("cannot read checkpoint '{}': {}", folder_.checkpoint().string(), what));
  };
  const auto stages = state_.scene.stages.size();
  refuse_if(static_cast<std::size_t>(meta.moment.stage) >= stages,
            fmt::format("it is of stage {}, the deck has {}", meta.moment.stage + 1, stages));
  refuse_if(!meta.texts.contains("packing") || !bounded_json(meta.texts.at("packing")).is_array(),
            "its report on the packing is not whole");
  refuse_if(!meta.texts.contains("free-bodies") ||
                !FreeMotions::restored(bounded_json(meta.texts.at("free-bodies")), state_.domain()),
            "what it says of free bodies is not whole");
  const auto curves = meta.texts.contains("curves") ? bounded_json(meta.texts.at("curves")) : nlohmann::ordered_json();
  const auto is_end = [](const auto& end) {
    return end.is_array() && end.size() == 2 && end[0].is_number_unsigned() && end[1].is_string();
  };
  refuse_if(!curves.is_object() || !std::all_of(curves.begin(), curves.end(), is_end),
            "what it says of curves is not whole");
  const auto notes = meta.texts.contains("notes") ? bounded_json(meta.texts.at("notes")) : nlohmann::ordered_json();
  refuse_if(
      !notes.is_array() || !std::all_of(notes.begin(), notes.end(), [](const auto& note) { return note.is_string(); }),
      "what is to be known of its record is not whole");
  refuse_if(!meta.texts.contains("frame") || !FrameNow::of(meta.texts.at("frame")),
            "what it says of a frame is not whole");
  refuse_if(!std::isfinite(state_.wall_seconds), "'wall-seconds' is no number");
  const auto watchers =
      static_cast<Real>(state_.scene.stages[static_cast<std::size_t>(meta.moment.stage)].watchers.size());
  refuse_if(!(state_.looks_owed >= 0 && state_.looks_owed <= watchers), "it counts more watchers than the deck has");
}

// What the run that is resumed says of its end; nothing if it was killed before it could.
std::optional<std::string> Record::ended_summary() const {
  constexpr std::uintmax_t longest = std::uintmax_t{1} << 26;
  std::error_code error;
  if (!std::filesystem::exists(folder_.summary(), error)) return std::nullopt;
  std::string text = read_text(folder_.summary(), longest);
  const auto json = bounded_json(text);
  const bool ended = json.is_object() && json.contains("status") && json["status"] != "running";
  return ended ? std::optional(std::move(text)) : std::nullopt;
}

// A resume that comes to nothing leaves what the run said of its end.
void Record::leave_as_found() const {
  try {
    write_atomically(folder_.summary(), *former_summary_);
  } catch (const std::exception& failure) {
    options_.log.warn(fmt::format("summary.json could not be put back: {}", failure.what()));
    try {
      overwrite(folder_.summary(), *former_summary_);  // in the room that it has
    } catch (const std::exception&) {                  // said already
    }
  }
}

bool Record::save_now_and_then(Clock::time_point now) {
  if (std::chrono::duration<Real>(now - shown_).count() >= 1) {
    shown_ = now;
    show_progress();
  }
  const Real patience = saved_step_ ? options_.checkpoint_seconds
                                    : std::min(options_.first_checkpoint_seconds, options_.checkpoint_seconds);
  if (std::chrono::duration<Real>(now - saved_).count() < patience) return false;
  save();
  reserve_room();
  write_summary();
  return true;
}

// Holds the room of the next checkpoint, where its part file will stand: when the disk is full it can still be written.
void Record::reserve_room() const {
  std::error_code error;
  std::uintmax_t size = std::filesystem::file_size(folder_.checkpoint(), error);
  if (error) {
    size = state_.domain().elements().memory() + state_.domain().scene().memory();
    for (const auto& [name, list] : state_.domain().lists()) size += list.memory();
    for (const auto& family : state_.domain().families()) size += family->rows().memory();
  }
  try {
    reserve(part_of(folder_.checkpoint()), size + size / 4 + 65536);
  } catch (const MachineFailure&) {
    std::filesystem::remove(part_of(folder_.checkpoint()), error);
  }
}

void Record::show_progress() {
  Headway headway = headway_of(state_.scene, state_.moment, state_.held());
  Real largest = 0;
  for (const auto& [criterion, use] : state_.uses) largest = std::max<Real>(largest, use.value);
  if (!state_.uses.empty()) headway.detail += fmt::format(", largest utilisation {:.3g}", largest);
  options_.progress(headway);
}

Real Record::wall_seconds() const { return wall_before_ + std::chrono::duration<Real>(Clock::now() - began_).count(); }

void Record::write_summary() {
  if (folder_.holds_former()) return;  // this run has not begun, and leaves that one as it was
  figures_.wall_seconds = wall_seconds();
  figures_.loop_seconds = state_.loop_seconds;
  figures_.bond_updates = state_.bond_updates;
  figures_.quality = balance_.quality(figures_.status == "failed");
  write_atomically(folder_.summary(), summary());
}

std::string Record::summary() const { return summary_json(state_, balance_, files_, figures_, options_.threads); }

// The machine gave out: what can still be kept is kept, each for itself.
void Record::rescue(const std::string& reason) {
  const auto attempt = [&](const std::string& what, const auto& task) {
    try {
      task();
      return true;
    } catch (const std::exception& failure) {
      options_.log.warn(fmt::format("{}: {}", what, failure.what()));
      return false;
    }
  };
  if (former_summary_) return leave_as_found();
  if (folder_.holds_former()) return;
  std::error_code error;
  if (state_.phase != RunState::Phase::between_steps)
    std::filesystem::remove(part_of(folder_.checkpoint()), error);
  else
    attempt("the last step could not be saved", [&] { save(); });
  if (figures_.status == "running" || figures_.status == "done") {
    figures_.status = "failed";
    figures_.exit_code = ExitCode::machine;
    figures_.exit_reason = reason;
    if (saved_step_)
      figures_.exit_reason +=
          fmt::format("; the newest checkpoint is of step {}, go on with: {}", *saved_step_, options_.commands.go_on);
  }
  if (!attempt("summary.json could not be replaced", [&] { write_summary(); }))
    attempt("summary.json still says that the run goes on", [&] { overwrite(folder_.summary(), summary()); });
  if (recorder_) attempt("run.h5 lacks the last breaks", [&] { recorder_->write_breaks(state_.domain()); });
}

// An orderly end, for better or worse: the record is whole, and says why the run ended.
void Record::close(const std::string& status, ExitCode code, const std::string& reason) {
  options_.log.conclude();
  say_largest_uses(status == "failed");
  figures_.status = status;
  figures_.exit_code = code;
  figures_.exit_reason = reason;
  std::error_code error;
  std::filesystem::remove(part_of(folder_.checkpoint()), error);
  if (recorder_) {
    recorder_->write_breaks(state_.domain());
    std::string why;
    if (!recorder_->consolidate(state_.domain(), why)) options_.log.warn("run.h5 still links to its frames: " + why);
  }
  if (former_summary_ && status != "done") return leave_as_found();
  if (folder_.holds_former())
    options_.log.say("this run had not begun: the one that it was to replace stands as it was");
  write_summary();
}

// Of a plugin that has failed it need not be known.
void Record::say_largest_uses(bool failed) const {
  for (const auto& [criterion, use] : state_.uses) {
    try {
      options_.log.say(sentence(use, *criterion));
    } catch (const PhysicsFailure&) {
      if (!failed) throw;
    }
  }
}

void Record::row(const std::string& curve, const CurvePlan& plan, std::span<const Real> values) {
  auto there = curves_.find(curve);
  if (there == curves_.end()) there = curves_.emplace(curve, begun(curve, plan)).first;
  std::vector<Real> all{state_.moment.time};
  all.insert(all.end(), values.begin(), values.end());
  there->second.add(state_.moment.step, all);
}

CurveFile Record::begun(const std::string& curve, const CurvePlan& plan) {
  if (!is_plain_name(curve))
    throw std::invalid_argument(fmt::format("a curve wants {}, got \"{}\"", plain_name, curve));
  std::vector<CurveColumn> columns{{"time", "s"}};
  for (const auto& [name, unit] : plan.columns) columns.push_back({name, unit});
  const auto file = folder_.curve(curve);
  folder_.claim(file);
  folder_.claim(std::filesystem::path(file).replace_extension(".json"));
  CurveFile made = options_.resume ? CurveFile::resume(file, columns) : CurveFile::fresh(file, columns);
  made.write_sidecar(curve_json(plan));
  return made;
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
  std::erase_if(found, [&](const Column* column) {
    return std::find(std::begin(own), std::end(own), column->field().name) != std::end(own);
  });
  return found;
}

}  // namespace

void Record::frame(const FramePlan& plan) {
  FrameRequest request;
  request.picture = plan.picture;
  request.view = plan.view;
  const auto columns = [&](const Table& table) { return columns_of(table, plan); };
  request.elements = columns(state_.domain().elements());
  for (const auto& [law, table] : state_.laws) request.bonds.push_back({table, law->tag(), columns(table->rows())});
  recorder_->write({state_.moment.step, state_.moment.time, state_.moment.stage}, request, state_.domain());
  frame_now_.add(state_.moment, plan);
}

}  // namespace beadwork
