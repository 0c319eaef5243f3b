#pragma once
// What a job of a batch leaves for whoever follows it from another machine: how far it has come, and how it ended.

#include <filesystem>
#include <optional>
#include <string>

#include "core/loop/job_driver.hpp"

namespace beadwork::slurm {

struct Note {
  double share = 0;
  std::optional<JobEnd> end;
};

/// Nothing if there is none.
std::optional<Note> read_note(const std::filesystem::path& file);
/// MachineFailure if it cannot be written.
void write_note(const std::filesystem::path& file, const Note& note);

}  // namespace beadwork::slurm
