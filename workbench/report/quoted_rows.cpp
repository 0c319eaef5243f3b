#include "workbench/report/quoted_rows.hpp"

#include "core/io/file.hpp"

namespace beadwork::report {

std::vector<Row> quoted_rows(const std::filesystem::path& file) {
  constexpr std::uintmax_t longest = std::uintmax_t{1} << 30;
  const std::string text = read_text(file, longest);
  std::vector<Row> rows;
  Row row;
  std::string field;
  bool quoted = false;
  for (std::size_t k = 0; k < text.size(); ++k) {
    const char c = text[k];
    if (quoted && c == '"' && k + 1 < text.size() && text[k + 1] == '"') {
      field += text[++k];
    } else if (c == '"') {
      quoted = !quoted;
    } else if (!quoted && (c == ',' || c == '\n')) {
      row.push_back(std::move(field));
      field.clear();
      if (c == '\n') rows.push_back(std::move(row)), row.clear();
    } else {
      field += c;
    }
  }
  return rows;
}

}  // namespace beadwork::report
