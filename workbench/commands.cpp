#include <algorithm>

#include "core/base/text.hpp"
#include "workbench/verbs.hpp"

namespace beadwork {

std::string command_line(const Words& words) {
  Words quoted;
  for (const std::string& word : words) quoted.push_back(shell_quoted(word));
  return join(quoted, " ");
}

Commands commands_of(const Words& words, const std::string& batch) {
  if (!batch.empty()) return {batch, batch};
  Words plain;
  const auto is_how = [](const std::string& word) {
    return word == "--resume" || word == "--overwrite" || word == "--resume-or-begin";
  };
  std::remove_copy_if(words.begin(), words.end(), std::back_inserter(plain), is_how);
  const auto with = [&](const std::string& flag) {
    Words all = plain;
    all.insert(std::find(all.begin(), all.end(), "--"), flag);  // behind "--" there are no options
    return command_line(all);
  };
  return {with("--resume"), with("--overwrite")};
}

}  // namespace beadwork
