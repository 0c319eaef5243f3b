#include "workbench/terminal.hpp"

#include <cstdio>

#include "core/base/utf8.hpp"

namespace beadwork {

namespace {

void write(std::FILE* stream, std::string_view text) {
  const std::string safe = safe_text(text);
  std::fwrite(safe.data(), 1, safe.size(), stream);
}

}  // namespace

void write_out(std::string_view text) { write(stdout, text); }
void write_error(std::string_view text) { write(stderr, text); }

}  // namespace beadwork
