#include <CLI/CLI.hpp>
#include <sstream>

#include "core/base/failure.hpp"
#include "core/version.hpp"
#include "workbench/signals.hpp"
#include "workbench/terminal.hpp"
#include "workbench/verbs.hpp"

using namespace beadwork;

int main(int argc, char** argv) {
  hold_standard_streams();
  CLI::App app{"Beadwork: a workbench for the discrete element method of bonded solids", "beadwork"};
  app.set_version_flag("--version", version);
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 done, 2 deck, 3 physics or a plugin's failure, 4 plugin library, 5 interrupted and resumable, 1 "
      "anything else");
  std::function<int()> chosen;
  const Words words(argv, argv + argc);
  add_run(app, chosen, words);
  add_check(app, chosen);
  add_report(app, chosen);
  add_describe(app, chosen);
  add_plan(app, chosen);
  add_new(app, chosen);
  add_batch(app, chosen, words);
  add_job(app, chosen);
  add_calibrate(app, chosen, words);
  add_law(app, chosen, words);
  add_trade(app, chosen, words);
  add_export(app, chosen);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    std::ostringstream out, problem;
    const int code = app.exit(error, out, problem);
    write_out(out.str());
    write_error(problem.str());
    return code == 0 ? 0 : static_cast<int>(ExitCode::deck);
  }
  try {
    return chosen();
  } catch (const Fault& fault) {
    say_error("{}\n", shown(fault));
    return static_cast<int>(fault.code());
  } catch (const std::bad_alloc&) {
    write_error("error: out of memory\n");
  } catch (const std::filesystem::filesystem_error& error) {
    say_error("error: cannot use '{}': {}\n", error.path1().string(), error.code().message());
    const bool is_no_path =
        error.code() == std::errc::filename_too_long || error.code() == std::errc::too_many_symbolic_link_levels;
    if (is_no_path) return static_cast<int>(ExitCode::deck);
  } catch (const std::exception& error) {
    say_error("error: {}\n", error.what());
  } catch (...) {
    write_error("error: something was thrown that is no std::exception\n");
  }
  return static_cast<int>(ExitCode::machine);
}
