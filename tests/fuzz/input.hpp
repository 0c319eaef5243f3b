#pragma once
// What the targets share: each takes the bytes of one input and has them read. It may be refused, with what the program
// catches; anything else (a signal, a sanitizer's word, another exception, a minute without an end) is a finding.

#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <string>

#include "core/base/failure.hpp"
#include "core/io/file.hpp"

namespace beadwork::fuzz {

/// The input as a file of this name, in a folder of this process alone.
inline std::filesystem::path as_file(const std::string& bytes, const char* name) {
  static const std::filesystem::path folder = [] {
    const auto path = std::filesystem::temp_directory_path() / ("beadwork-fuzz-" + std::to_string(::getpid()));
    std::filesystem::create_directories(path);
    return path;
  }();
  write_atomically(folder / name, bytes);
  return folder / name;
}

/// Runs it, and lets those failures pass which the program reports.
template <class Read>
int refused_or_read(const Read& read) {
  try {
    read();
  } catch (const DeckFailure&) {
  } catch (const MachineFailure&) {
  }
  return 0;
}

}  // namespace beadwork::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
