#pragma once
// What a run left behind, as far as it is there. What is missing is told in sentences, not thrown.

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/io/frame_reader.hpp"
#include "workbench/report/table.hpp"

namespace beadwork::report {

using Json = nlohmann::ordered_json;  // keys stay in the order in which the run wrote them

struct Curve {
  std::string name;  ///< of the file, without its ending
  Table table;
  Json sidecar = Json::object();  ///< how to draw it; empty if there is no such file
};

struct Run {
  std::filesystem::path folder;
  std::string scene;  ///< its name, from the summary, the deck or the folder
  Json summary = Json::object();
  std::string status;  ///< done, failed, interrupted, or "unfinished" where no summary says
  std::string deck, log;
  std::vector<Curve> curves;
  std::unique_ptr<record::FrameReader> recorded;  ///< null if run.h5 is missing or cannot be read
  std::vector<std::string> notes;                 ///< what is missing, one sentence each
};

/// Throws MachineFailure if the folder does not exist or holds nothing that a run writes.
Run open_run(const std::filesystem::path& folder);
/// The same, with its summary, its curves and what is to be said of them only.
Run open_curves(const std::filesystem::path& folder);

/// What a folder is called, also where it is given as "." or with a slash behind.
std::string name_of_folder(const std::filesystem::path& folder);

/// The value of a key as text, or `otherwise`.
std::string text_of(const Json&, const std::string& key, const std::string& otherwise = "");

}  // namespace beadwork::report
