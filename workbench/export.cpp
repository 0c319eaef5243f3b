// `export`: what a run has recorded, for other programs.

#include <fmt/format.h>

#include <algorithm>

#include "core/base/text.hpp"
#include "core/io/own_folder.hpp"
#include "workbench/export/formats.hpp"
#include "workbench/report/report.hpp"
#include "workbench/terminal.hpp"
#include "workbench/verbs.hpp"

namespace beadwork {

namespace {

namespace fs = std::filesystem;

struct ExportArguments {
  std::string folder, out, format = "vtu", frames = "all", length = "m";
};

exported::Lengths lengths_of(const std::string& name) {
  const auto unit = find_unit(name);
  if (!unit) throw DeckFailure(fmt::format("error: --length-unit: {}", why_no_unit(name)));
  if (!(unit->dimension == find_unit("m")->dimension))
    throw DeckFailure(fmt::format("error: --length-unit wants a unit of length, such as um, got \"{}\"", name));
  return {name, *unit};
}

std::vector<std::string> steps_of(const std::vector<record::FrameHead>& heads) {
  std::vector<std::string> steps;
  for (const record::FrameHead& head : heads) steps.push_back(std::to_string(head.step));
  return steps;
}

std::vector<record::FrameHead> chosen_frames(const std::vector<record::FrameHead>& all, const std::string& which) {
  if (which == "all") return all;
  if (which == "first") return {all.front()};
  if (which == "last") return {all.back()};
  std::vector<record::FrameHead> some;
  for (const std::string& word : split(which, ',')) {
    const std::string step(trim(word));
    const auto found = std::find_if(all.begin(), all.end(),
                                    [&](const record::FrameHead& head) { return std::to_string(head.step) == step; });
    if (found == all.end())
      throw DeckFailure(fmt::format(
          "error: --frames wants all, first, last or steps of recorded frames, and there is none of step \"{}\"; "
          "recorded: {}",
          step, join(steps_of(all))));
    const bool is_new =
        std::none_of(some.begin(), some.end(), [&](const auto& other) { return other.name == found->name; });
    if (is_new) some.push_back(*found);
  }
  return some;
}

std::vector<exported::File> files_of(const exported::Moment& moment, const std::string& format,
                                     const exported::Families& families) {
  if (format == "xyz") return exported::as_xyz(moment, families);
  if (format == "csv") return exported::as_csv(moment);
  return exported::as_vtu(moment);
}

int export_run(const ExportArguments& arguments) {
  const exported::Lengths lengths = lengths_of(arguments.length);
  const fs::path run = arguments.folder;
  if (is_batch(run) || is_study(run))
    throw DeckFailure(fmt::format("error: '{}' holds several runs; export one of them, such as '{}'", run.string(),
                                  (run / "NAME").string()));
  std::error_code error;
  if (!fs::is_regular_file(run / "run.h5", error))
    throw DeckFailure(fmt::format("error: '{}' is not the folder of a run: it holds no run.h5", run.string()));
  const record::FrameReader recorded(run / "run.h5");
  if (recorded.frames().empty())
    throw DeckFailure(fmt::format("error: '{}' has recorded no frames: <watch><snapshot/></watch> does", run.string()));
  const auto heads = chosen_frames(recorded.frames(), arguments.frames);
  OwnFolder folder(arguments.out, Manifest::Of::exported);
  folder.clear();
  std::size_t count = 0;
  const auto write = [&](const std::vector<exported::File>& files) {
    for (const exported::File& file : files) write_atomically(folder.claim(file.name), file.text), ++count;
  };
  const auto moment_at = [&](const record::FrameHead& head) {
    return exported::moment_of(recorded.read(head, record::Columns::whole), lengths);
  };
  exported::Families families;
  if (arguments.format == "xyz")  // a family may begin in a later stage
    for (const record::FrameHead& head : heads) families.add(moment_at(head));
  std::vector<exported::Chapter> chapters;
  for (const record::FrameHead& head : heads) {
    const exported::Moment moment = moment_at(head);
    write(files_of(moment, arguments.format, families));
    chapters.push_back({moment.name, moment.time, exported::grids_of(moment)});
  }
  if (arguments.format == "vtu") write(exported::vtu_series(chapters));
  if (arguments.format == "csv") write(exported::as_csv(recorded.breaks(), lengths));
  say("{} frames in {} files: {}\n", heads.size(), count, folder.root().string());
  return 0;
}

}  // namespace

void add_export(CLI::App& app, Chosen& chosen) {
  CLI::App* verb = app.add_subcommand("export", "Writes the recorded frames of a run for other programs");
  verb->footer(
      "Example: beadwork export out/dcb --out out/dcb-ovito --format xyz --length-unit mm\n"
      "vtu: ParaView opens elements.pvd and bonds-NAME.pvd. xyz: OVITO opens elements-*.xyz, and its modifier 'Load "
      "trajectory' bonds-*.dump. csv: tables, with breaks.csv.");
  auto arguments = std::make_shared<ExportArguments>();
  verb->add_option("folder", arguments->folder, "Folder of a run")->required();
  verb->add_option("--out", arguments->out, "Folder for the files")->required();
  verb->add_option("--format", arguments->format, "vtu (ParaView, VTK, meshio), xyz (OVITO, ASE) or csv")
      ->check(CLI::IsMember({"vtu", "xyz", "csv"}))
      ->capture_default_str();
  verb->add_option("--frames", arguments->frames, "all, first, last, or steps of recorded frames: 0,5000")
      ->capture_default_str();
  verb->add_option("--length-unit", arguments->length,
                   "Unit of places, radii and whatever is a length, such as um: some programs draw nothing that is as "
                   "small as 1e-6; all else is in SI")
      ->capture_default_str();
  verb->callback([&chosen, arguments] { chosen = [arguments] { return export_run(*arguments); }; });
}

}  // namespace beadwork
