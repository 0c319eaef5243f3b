#include "workbench/slurm/note.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/text.hpp"
#include "core/io/file.hpp"

namespace beadwork::slurm {

// "at 0.25", or "ended 3 exit code 3".
std::optional<Note> read_note(const std::filesystem::path& file) {
  constexpr std::uintmax_t most = 4096;
  std::error_code error;
  if (!std::filesystem::exists(file, error)) return std::nullopt;
  std::string text;
  try {
    text = read_text(file, most);
  } catch (const MachineFailure&) {  // gone in between
    return std::nullopt;
  }
  const std::vector<std::string> words = split_words(text);
  const auto number = words.size() > 1 ? parse_number(words[1]) : std::nullopt;
  if (!number) return std::nullopt;
  if (words[0] == "at") return Note{std::clamp(*number, 0., 1.), {}};
  if (words[0] != "ended") return std::nullopt;
  return Note{0, JobEnd{static_cast<int>(*number), join({words.begin() + 2, words.end()}, " ")}};
}

void write_note(const std::filesystem::path& file, const Note& note) {
  write_atomically(file, note.end ? fmt::format("ended {} {}\n", note.end->code, note.end->how)
                                  : fmt::format("at {:.4f}\n", note.share));
}

}  // namespace beadwork::slurm
