#pragma once
// Whether a deck is the one that began a run.

#include <map>
#include <string>
#include <vector>

#include "core/deck/write.hpp"

namespace beadwork {

/// The files that a deck names for data: the SHA-256 of each by its absolute path.
using FileSums = std::map<std::string, std::string>;
/// As they are now. MachineFailure if one cannot be read.
FileSums file_sums(const std::vector<std::string>& paths);

/// What a checkpoint knows of the deck that began its run.
struct DeckRecord {
  std::string resolved;
  FileSums files;
};

/// A run goes on only with the deck that began it. What says when to end, how often to look, where files and libraries
/// lie, or what the scene is called may differ; else DeckFailure with each difference, at its place in the deck.
void refuse_other_deck(const DeckRecord& saved, const PlainNode& now, const FileSums& files);

}  // namespace beadwork
