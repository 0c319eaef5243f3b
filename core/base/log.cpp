#include "core/base/log.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace beadwork {

void Log::say_once(const std::string& subject, const std::string& line) {
  const auto there = std::find_if(heard_.begin(), heard_.end(), [&](const Heard& h) { return h.subject == subject; });
  if (there == heard_.end()) {
    heard_.push_back({subject, line, 0});
    say_(line);
  } else if (line != there->newest) {
    there->newest = line;
    ++there->more;
  }
}

void Log::conclude() {
  for (const Heard& heard : heard_) {
    if (heard.more == 1) say_("in the end " + heard.newest);
    if (heard.more > 1)
      say_(fmt::format("in the end {} ({} such lines before this one were left out)", heard.newest, heard.more - 1));
  }
  heard_.clear();
}

}  // namespace beadwork
