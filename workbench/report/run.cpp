#include "workbench/report/run.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "core/base/failure.hpp"
#include "core/io/file.hpp"
#include "core/loop/bounded_json.hpp"
#include "core/loop/json_text.hpp"
#include "workbench/report/text.hpp"

namespace beadwork::report {

namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t longest_text = std::uintmax_t{1} << 26;
constexpr std::uintmax_t longest_curve = std::uintmax_t{1} << 31;

bool stands(const fs::path& file) {
  std::error_code error;
  return fs::exists(fs::symlink_status(file, error));
}

/// Empty where there is no such file; where it cannot be read, that is noted.
std::string text_of_file(const fs::path& file, std::uintmax_t longest, std::vector<std::string>& notes) {
  if (!stands(file)) return "";
  try {
    return beadwork::read_text(file, longest);
  } catch (const MachineFailure& problem) {
    notes.push_back(file.filename().string() + " was left out: " + problem.what() + ".");
    return "";
  }
}

Json read_json(const fs::path& file, std::vector<std::string>& notes) {
  const std::string text = text_of_file(file, longest_text, notes);
  if (text.empty()) return Json::object();
  Json json = bounded_json(text);
  if (json.is_object()) return json;
  notes.push_back(file.filename().string() + " is not readable as JSON and was left out.");
  return Json::object();
}

std::vector<fs::path> files_ending(const fs::path& folder, const std::string& ending, std::vector<std::string>& notes) {
  std::vector<fs::path> files;
  std::error_code error;
  const auto status = fs::symlink_status(folder, error);
  if (fs::is_symlink(status)) notes.push_back(folder.filename().string() + " is a link and was not followed.");
  if (!fs::is_directory(status)) return files;
  for (auto it = fs::directory_iterator(folder, error); !error && it != fs::directory_iterator(); it.increment(error))
    if (it->path().extension() == ending) files.push_back(it->path());
  std::sort(files.begin(), files.end());
  return files;
}

void note_dropped(const Table& table, const std::string& name, std::vector<std::string>& notes) {
  if (table.dropped_rows > 0)
    notes.push_back("In curves/" + name + ", " + plural(table.dropped_rows, "row") +
                    (table.dropped_rows == 1 ? " was" : " were") + " cut off or not numbers, and left out.");
  if (table.odd_numbers > 0)
    notes.push_back("In curves/" + name + ", " + plural(table.odd_numbers, "number") +
                    (table.odd_numbers == 1 ? " is" : " are") +
                    " infinite, undefined or too large to be drawn: gaps in the curve.");
}

/// The load comes first, and what nobody described comes last.
int place_of(const Curve& curve) {
  if (curve.sidecar.empty()) return 2;
  const auto& columns = curve.table.columns;
  return std::none_of(columns.begin(), columns.end(), [](const Column& c) { return c.unit == "N"; });
}

void read_curves(Run& run) {
  const fs::path folder = run.folder / "curves";
  for (const fs::path& file : files_ending(folder, ".csv", run.notes)) {
    Curve curve;
    curve.name = file.stem().string();
    curve.table = parse_table(text_of_file(file, longest_curve, run.notes));
    note_dropped(curve.table, file.filename().string(), run.notes);
    curve.sidecar = read_json(fs::path(file).replace_extension(".json"), run.notes);
    if (curve.table.rows() == 0) {
      run.notes.push_back("curves/" + file.filename().string() + " holds no rows yet.");
      continue;
    }
    run.curves.push_back(std::move(curve));
  }
  std::stable_sort(run.curves.begin(), run.curves.end(),
                   [](const Curve& a, const Curve& b) { return place_of(a) < place_of(b); });
  if (run.curves.empty()) run.notes.push_back("There are no curves: no watcher wrote any, or the run ended before.");
}

void read_record(Run& run) {
  const fs::path file = run.folder / "run.h5";
  if (!stands(file)) {
    run.notes.push_back("There is no run.h5, so there are no pictures of the specimen and no log of breaks.");
    return;
  }
  try {
    run.recorded = std::make_unique<record::FrameReader>(file);
  } catch (const std::exception& problem) {
    run.notes.push_back("run.h5 cannot be read, so there are no pictures of the specimen (" +
                        std::string(problem.what()) + ").");
    return;
  }
  if (const int lost = run.recorded->unreadable_frames(); lost > 0)
    run.notes.push_back(plural(lost, "frame") + " of run.h5 cannot be read, and " + (lost == 1 ? "was" : "were") +
                        " left out.");
}

/// A run that was killed has no summary, but its record knows what it was.
void complete_from_record(Run& run) {
  if (!run.recorded) return;
  std::map<std::string, std::string> meta = run.recorded->meta();
  for (const char* key : {"version", "deck_sha256"})
    if (!run.summary.contains(key) && !meta[key].empty()) run.summary[key] = meta[key];
  if (run.scene.empty()) run.scene = meta["name"];
  if (run.deck.empty()) run.deck = meta["resolved"];
  if (run.summary.contains("packing")) return;
  Json packing = bounded_json(meta["packing"]);
  if (packing.is_structured() && !packing.empty()) run.summary["packing"] = std::move(packing);
}

/// The first `name` of the deck's outermost tag; the deck has been checked when the run wrote it.
std::string name_in_deck(const std::string& deck) {
  const auto tag = deck.find("<scene");
  const auto end = deck.find('>', std::min(tag, deck.size()));
  const auto start = deck.find("name=\"", std::min(tag, deck.size()));
  if (start == std::string::npos || start > end) return "";
  std::string name = deck.substr(start + 6, deck.find('"', start + 6) - start - 6);
  for (const auto& [entity, character] : std::initializer_list<std::pair<std::string, const char*>>{
           {"&lt;", "<"}, {"&gt;", ">"}, {"&quot;", "\""}, {"&apos;", "'"}, {"&amp;", "&"}})
    for (auto at = name.find(entity); at != std::string::npos; at = name.find(entity, at + 1))
      name.replace(at, entity.size(), character);
  return name;
}

void read_status(Run& run) {
  run.status = text_of(run.summary, "status");
  if (!run.status.empty() && run.status != "running") return;
  run.status = "unfinished";
  run.notes.emplace_back(
      "The run has not said how it ended: it is still going on, or it was killed. What follows is what it had "
      "written.");
}

/// What the run itself said of its record.
void read_notes(Run& run) {
  const auto said = run.summary.find("notes");
  if (said == run.summary.end() || !said->is_array()) return;
  for (const Json& note : *said)
    if (note.is_string()) run.notes.push_back(note.get<std::string>() + ".");
  run.summary.erase(said);
}

}  // namespace

std::string name_of_folder(const fs::path& folder) {
  std::error_code error;
  const fs::path whole = fs::weakly_canonical(folder, error);
  return (error ? folder : whole).filename().string();
}

std::string text_of(const Json& json, const std::string& key, const std::string& otherwise) {
  if (!json.is_object()) return otherwise;
  const auto found = json.find(key);
  if (found == json.end()) return otherwise;
  return found->is_string() ? found->get<std::string>() : json_text(*found);
}

Run open_curves(const fs::path& folder) {
  std::error_code error;
  const bool there = fs::is_directory(folder, error);
  if (error == std::errc::filename_too_long || error == std::errc::too_many_symbolic_link_levels)
    throw DeckFailure("cannot use '" + folder.string() + "': " + error.message());
  if (!there) throw DeckFailure("there is no folder '" + folder.string() + "' to report on");
  const auto written = {"summary.json", "resolved.xml", "run.log", "run.h5"};
  if (std::none_of(written.begin(), written.end(), [&](const char* name) { return stands(folder / name); }))
    throw DeckFailure("'" + folder.string() +
                      "' is not the folder of a run: it holds none of summary.json, resolved.xml, run.log, run.h5");
  Run run;
  run.folder = folder;
  run.summary = read_json(folder / "summary.json", run.notes);
  read_status(run);
  read_notes(run);
  run.scene = text_of(run.summary, "name");
  read_curves(run);
  return run;
}

Run open_run(const fs::path& folder) {
  Run run = open_curves(folder);
  run.deck = text_of_file(folder / "resolved.xml", longest_text, run.notes);
  run.log = text_of_file(folder / "run.log", longest_text, run.notes);
  if (run.scene.empty()) run.scene = name_in_deck(run.deck);
  read_record(run);
  try {
    complete_from_record(run);
  } catch (const std::exception& problem) {
    run.notes.push_back("What run.h5 says of the run cannot be read (" + std::string(problem.what()) + ").");
  }
  if (run.scene.empty()) run.scene = name_of_folder(folder);
  if (run.deck.empty()) run.notes.emplace_back("There is no resolved.xml, so the deck is not shown.");
  if (run.log.empty()) run.notes.emplace_back("There is no run.log, or it is empty.");
  return run;
}

}  // namespace beadwork::report
