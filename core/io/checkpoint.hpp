#pragma once
// Saves a domain to the bit and brings it back. What is saved follows from the columns alone: every column that is
// kept (of the elements, of each family of bonds, of the scene), every named set, and the log of breaks.

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

#include "core/domain/domain.hpp"
#include "core/domain/moment.hpp"

namespace beadwork {

struct CheckpointMeta {
  std::string version;  ///< of the program
  std::string deck_sha256;
  std::string resolved;  ///< text of the resolved deck, for comparing it line by line
  Moment moment;
  std::uint64_t seed = 0;
  std::map<std::string, std::string> texts;  ///< whatever else the caller wants back
};

/// Takes the place of the former checkpoint in one act, so that there is always a whole one.
void save_checkpoint(const std::filesystem::path& file, const Domain& domain, const CheckpointMeta& meta);

/// MachineFailure if the file is missing, damaged (its check sum is compared) or no checkpoint.
CheckpointMeta read_checkpoint_meta(const std::filesystem::path& file);

/// Fills the domain of a scene that has declared its columns and families. Elements are made; a column that the file
/// has and the scene has not is added; a family that the file has not stays empty. Columns that are not kept are zero
/// (orientation: unturned), and `cut_families` is still to be called. DeckFailure if the scene keeps a column that the
/// file has not, or has with another type or unit, or if the file has a family that the scene has not.
void load_checkpoint(const std::filesystem::path& file, Domain& domain);

}  // namespace beadwork
