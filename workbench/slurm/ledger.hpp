#pragma once
// What has been submitted, kept in a file, so that whoever comes after the one who submitted it finds it again.

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/io/file.hpp"

namespace beadwork::slurm {

/// Of an array: its word stands in the file before it is submitted, and goes along with it. Should whoever submits it
/// be killed in between, the queue still tells by that word that it is there.
struct Entry {
  std::string word;
  std::vector<std::string> jobs;        ///< names, by their tasks
  std::optional<std::string> number{};  ///< of the job; "" if it was refused; nothing as long as no answer is known
};

/// The entries of such a file; nothing if there is none. A line that a kill has torn is left out.
std::vector<Entry> read_ledger(const std::filesystem::path& file);

class Ledger {
 public:
  /// Makes or opens it, and waits for an sbatch that one who was killed has left at work; MachineFailure if that takes
  /// longer.
  explicit Ledger(const std::filesystem::path& file, std::chrono::milliseconds patience = std::chrono::seconds(30));
  const std::vector<Entry>& entries() const { return entries_; }
  /// A word of its own for an array of these; it is on the disk now.
  std::string intend(const std::vector<std::string>& jobs);
  /// What came of it: the number of the job, "" for none.
  void answered(const std::string& word, const std::string& number);
  /// Nothing of what it holds is in the queue any more.
  void clear();
  /// To be held open by what submits.
  int descriptor() const { return open_.number(); }

 private:
  void append(const std::string& line);
  std::filesystem::path file_;
  Descriptor open_;
  std::vector<Entry> entries_;
};

}  // namespace beadwork::slurm
