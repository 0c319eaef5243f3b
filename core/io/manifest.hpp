#pragma once
// The list of the files that a run made: `run.files`, a line that says so, then a path on each line. A folder is that
// of a run if it has one, and what is not on it is somebody else's. A batch keeps one of its own, `batch.files`, a
// study, `study.files`, and an export, `export.files`.

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/io/file.hpp"

namespace beadwork {

class Manifest {
 public:
  static constexpr const char* file_name = "run.files";
  enum class Of { run, batch, study, exported };
  static constexpr Of all[] = {Of::run, Of::batch, Of::study, Of::exported};
  /// "run", "batch", "study" or "export".
  static const char* maker(Of of);
  /// Of the list: "batch.files".
  static std::string name_of(Of of) { return std::string(maker(of)) + ".files"; }

  /// That of a folder; nothing if there is none, or a file of this name that no run wrote. MachineFailure if it cannot
  /// be read.
  static std::optional<Manifest> read(const std::filesystem::path& folder, Of of = Of::run);
  /// Writes one that lists these files of the folder, in the place of a former one.
  static Manifest begin(const std::filesystem::path& folder, const std::vector<std::string>& files, Of of = Of::run);

  /// DeckFailure if something stands there: it is somebody else's. To be asked of a file that is on no list.
  static void refuse_what_stands(const std::filesystem::path& file, Of of = Of::run);

  /// In the order in which they were put on the list.
  const std::vector<std::string>& files() const { return files_; }
  bool lists(const std::string& file) const { return known_.contains(file); }
  /// Puts a file of the folder ("curves/force.csv") on the list, and waits until the disk has it: to be called before
  /// the file is made, so that no kill leaves one that is not listed. DeckFailure if it is there and not on the list,
  /// or if its name cannot be that of a file of a run.
  void claim(const std::string& file);
  /// Reads what others, such as a report, have put on the list in the meantime.
  void refresh();

 private:
  Manifest(std::filesystem::path folder, Of of) : folder_(std::move(folder)), of_(of) {}
  std::filesystem::path place() const;
  void add(const std::string& file);

  std::filesystem::path folder_;
  Of of_;
  std::vector<std::string> files_;
  std::set<std::string> known_;
  Descriptor open_;  ///< for appending, once something is
};

}  // namespace beadwork
