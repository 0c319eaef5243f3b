#include "workbench/batch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <thread>

#include "core/base/failure.hpp"
#include "core/base/text.hpp"
#include "core/io/file.hpp"
#include "workbench/verbs.hpp"

namespace beadwork {

namespace {

struct BatchArguments {
  DeckArguments deck;
  std::string out, engine = "local";
  std::vector<std::string> variations;
  Words words;
  int jobs = 0, threads = 1;
};

std::string folder_name(const std::vector<Variation>& variations, const std::vector<std::string>& values) {
  std::vector<std::string> pieces;
  for (std::size_t k = 0; k < values.size(); ++k) pieces.push_back(variations[k].name + "=" + values[k]);
  std::string name = pieces.empty() ? "run" : join(pieces, ",");
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c)) && std::string_view(".,=+-_").find(c) == std::string_view::npos) c = '-';
  return name;
}

BatchRun run_of(const BatchArguments& arguments, const std::vector<Variation>& variations, const std::vector<std::string>& values) {
  namespace fs = std::filesystem;
  BatchRun run;
  run.name = folder_name(variations, values);
  run.values = values;
  run.folder = fs::absolute(arguments.out) / run.name;
  run.command = {fs::canonical("/proc/self/exe").string(), "run", fs::absolute(arguments.deck.path).string(), "--quiet",
                 "--out", run.folder.string(), "--threads", std::to_string(arguments.threads)};
  DeckArguments deck = arguments.deck;
  for (std::size_t k = 0; k < values.size(); ++k) deck.settings.push_back(variations[k].name + "=" + values[k]);
  run.command.insert(run.command.end(), {"--batch", command_line(arguments.words)});
  for (const std::string& setting : deck.settings) run.command.insert(run.command.end(), {"--set", setting});
  for (const std::string& library : deck.libraries) run.command.insert(run.command.end(), {"--plugins", fs::absolute(library).string()});
  // Every deck is checked before the first one runs.
  run.done = is_done(run, load_scene(deck).deck->sha256);
  return run;
}

std::vector<BatchRun> runs_of(const BatchArguments& arguments, const std::vector<Variation>& variations) {
  std::vector<BatchRun> runs;
  for (const auto& values : combinations(variations)) {
    BatchRun run = run_of(arguments, variations, values);
    for (const BatchRun& other : runs)
      if (other.name == run.name) throw DeckFailure(fmt::format("error: two runs would write folder '{}'", run.folder.string()));
    runs.push_back(std::move(run));
  }
  return runs;
}

int batch(const BatchArguments& arguments) {
  std::vector<Variation> variations;
  for (const std::string& text : arguments.variations) {
    variations.push_back(variation_of(text));
    for (std::size_t k = 0; k + 1 < variations.size(); ++k)
      if (variations[k].name == variations.back().name)
        throw DeckFailure(fmt::format("error: --vary {} is given twice", variations[k].name));
  }
  std::vector<BatchRun> runs = runs_of(arguments, variations);
  const std::filesystem::path out = arguments.out;
  std::error_code error;
  std::filesystem::create_directories(out, error);
  if (error) throw MachineFailure(fmt::format("error: cannot make folder '{}': {}", out.string(), error.message()));
  const auto done = std::count_if(runs.begin(), runs.end(), [](const BatchRun& run) { return run.done; });
  std::printf("%zu runs, %td of them done already\n", runs.size(), done);
  std::fflush(stdout);
  const int processors = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  const int at_once = arguments.jobs > 0 ? arguments.jobs : std::max(1, processors / arguments.threads);
  const auto table = out / "batch.csv";
  write_atomically(table, batch_table(variations, runs));
  if (arguments.engine == "slurm") {
    submit_to_slurm(runs, at_once, arguments.threads, std::filesystem::absolute(out));
    return 0;
  }
  run_here(runs, at_once, variations, table);
  if (worst(runs) == static_cast<int>(ExitCode::interrupted)) std::printf("interrupted; go on with: %s\n", command_line(arguments.words).c_str());
  std::printf("%s\n", table.c_str());
  return worst(runs);
}

}  // namespace

Variation variation_of(const std::string& text) {
  const std::size_t equals = text.find('=');
  Variation variation;
  if (equals != std::string::npos) {
    variation.name = trim(text.substr(0, equals));
    for (const std::string& value : split(text.substr(equals + 1), ',')) variation.values.emplace_back(trim(value));
  }
  const bool has_empty = std::find(variation.values.begin(), variation.values.end(), "") != variation.values.end();
  if (variation.name.empty() || has_empty)
    throw DeckFailure(fmt::format("error: --vary wants name=value,value,..., got \"{}\"", text));
  return variation;
}

std::vector<std::vector<std::string>> combinations(const std::vector<Variation>& variations) {
  std::vector<std::vector<std::string>> all{{}};
  for (const Variation& variation : variations) {
    std::vector<std::vector<std::string>> longer;
    for (const auto& values : all)
      for (const std::string& value : variation.values) {
        longer.push_back(values);
        longer.back().push_back(value);
      }
    all = std::move(longer);
  }
  return all;
}

int worst(const std::vector<BatchRun>& runs) {
  const std::vector<int> mildest_first{0, 5, 2, 3, 4, 1};
  const auto rank = [&](int code) { return std::find(mildest_first.begin(), mildest_first.end(), code) - mildest_first.begin(); };
  int code = 0;
  for (const BatchRun& run : runs) {
    const int own = run.done ? 0 : run.code < 0 ? 5 : run.code;
    if (rank(own) > rank(code)) code = own;
  }
  return code;
}

void add_batch(CLI::App& app, Chosen& chosen, const Words& words) {
  CLI::App* verb = app.add_subcommand("batch", "Runs a deck with many values of its parameters, and tabulates the results");
  verb->footer("Example: beadwork batch deck.xml --out out/sweep --vary 'young=30 GPa,40 GPa' --vary seed=1,2,3 --jobs 2\n"
               "What is done is left alone, what was interrupted goes on: give the same command again.");
  auto arguments = std::make_shared<BatchArguments>();
  arguments->words = words;
  arguments->deck.add_to(*verb);
  verb->add_option("--out", arguments->out, "Folder for the runs, one folder each, and for batch.csv")->required();
  verb->add_option("--vary", arguments->variations, "Values of a parameter: name=value,value,...; several give all combinations")->allow_extra_args(false);
  verb->add_option("--jobs", arguments->jobs, "Runs at once; as many as there are processors where absent")->check(CLI::Range(1, 1024));
  verb->add_option("--threads", arguments->threads, "Threads of each run")->check(CLI::Range(1, 1024))->capture_default_str();
  verb->add_option("--engine", arguments->engine, "local: processes of this machine; slurm: an array of jobs")
      ->check(CLI::IsMember({"local", "slurm"}))
      ->capture_default_str();
  verb->callback([&chosen, arguments] { chosen = [arguments] { return batch(*arguments); }; });
}

}  // namespace beadwork
