#pragma once
// One file per verb of the command line. Each adds its subcommand; when it is given, `chosen` is what is to be done.

#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/base/failure.hpp"
#include "core/loop/load.hpp"
#include "core/loop/run.hpp"

namespace beadwork {

using Chosen = std::function<int()>;
using Words = std::vector<std::string>;

/// What was typed, word by word, as a line that can be pasted into a shell.
std::string command_line(const Words& words);
/// `run` as it was typed, to go on or to begin again; where it is a part of a batch, that batch's command: it leaves
/// alone what is done, goes on with what has a checkpoint and was interrupted or stopped by the machine, and begins the
/// rest anew.
Commands commands_of(const Words& words, const std::string& batch);

void add_run(CLI::App& app, Chosen& chosen, const Words& words);
void add_check(CLI::App& app, Chosen& chosen);
void add_report(CLI::App& app, Chosen& chosen);
void add_describe(CLI::App& app, Chosen& chosen);
void add_plan(CLI::App& app, Chosen& chosen);
void add_new(CLI::App& app, Chosen& chosen);
void add_batch(CLI::App& app, Chosen& chosen, const Words& words);
void add_job(CLI::App& app, Chosen& chosen);
void add_calibrate(CLI::App& app, Chosen& chosen, const Words& words);
void add_law(CLI::App& app, Chosen& chosen, const Words& words);
void add_trade(CLI::App& app, Chosen& chosen, const Words& words);
void add_export(CLI::App& app, Chosen& chosen);

/// What every verb that reads a deck takes.
struct DeckArguments {
  std::string path;
  std::vector<std::string> settings;   ///< name=value
  std::vector<std::string> files;      ///< of such settings, a line each
  std::vector<std::string> libraries;  ///< files or folders
  bool no_plugins = false;             ///< the libraries that the deck itself names are not loaded

  void add_to(CLI::App& verb);
  /// The options alone, for a verb that takes several decks.
  void add_options_to(CLI::App& verb);
  /// DeckFailure if a setting is none.
  DeckRequest request() const;
};

/// "name=value" apart. DeckFailure with this complaint if it is no such thing.
Override setting_of(const std::string& text, const std::string& complaint);

/// What went wrong as the terminal shows it: with "error:", which complaints about a deck bring along.
std::string shown(const Fault& fault);

/// Throws DeckFailure with all complaints, or LibraryFailure. Warnings go to stderr.
Loaded load_checked(const DeckRequest& request);
/// A deck that can be run: DeckFailure if it holds a study.
Loaded load_run(const DeckArguments& arguments);
void refuse_study(const Loaded& loaded, const std::string& path);

}  // namespace beadwork
