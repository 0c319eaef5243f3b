#include "core/io/curve_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <fstream>
#include <stdexcept>
#include <tuple>

namespace beadwork {

namespace {

// A comma in a name would be read as the end of a column.
std::string first_line(const std::vector<CurveColumn>& columns) {
  std::string line = "step [1]";
  for (const CurveColumn& column : columns) {
    if ((column.name + column.unit).find_first_of(",\"\n") != std::string::npos)
      throw std::logic_error(fmt::format("'{} [{}]' cannot head a column of a curve", column.name, column.unit));
    line += fmt::format(",{} [{}]", column.name, column.unit);
  }
  return line;
}

template <class T>
void append(std::string& row, T number) {
  char digits[32];
  const auto end = std::to_chars(digits, digits + sizeof digits, number).ptr;
  row.append(digits, end);
}

std::ifstream open_to_read(const std::filesystem::path& file) {
  open_regular(file, O_RDONLY, "read");  // refuses what would be followed or waited for
  return std::ifstream(file, std::ios::binary);
}

std::string head_of(std::ifstream& in, const std::filesystem::path& file) {
  std::string head;
  if (!std::getline(in, head) || in.eof())
    throw MachineFailure(
        fmt::format("curve '{}' has no first line; remove it to go on without its rows", file.string()));
  return head;
}

// What rows a resume keeps: up to the checkpoint, and whole ones only. A row that ends with the file, not with its
// line, is torn.
std::uintmax_t kept_length(const std::filesystem::path& file, const CurveEnd& end) {
  std::ifstream in = open_to_read(file);
  const std::string head = head_of(in, file);
  if (end.length > 0 && head != end.first_line)
    throw DeckFailure(
        fmt::format("curve '{}' has the columns \"{}\", the checkpoint knows it with \"{}\"; put that line back, or "
                    "remove the file to go on without its rows",
                    file.string(), head, end.first_line));
  std::uintmax_t length = head.size() + 1;
  for (std::string row; length < end.length && std::getline(in, row) && !in.eof();) length += row.size() + 1;
  return length;
}

}  // namespace

std::vector<CurveCut> cuts_to(const std::map<std::string, CurveEnd>& ends,
                              const std::vector<std::filesystem::path>& files) {
  std::vector<CurveCut> cuts;
  for (const auto& file : files) {
    const auto known = ends.find(file.stem().string());
    cuts.push_back({file, kept_length(file, known == ends.end() ? CurveEnd{} : known->second)});
  }
  return cuts;
}

std::vector<std::string> lost_rows(const std::map<std::string, CurveEnd>& ends, const std::vector<CurveCut>& cuts) {
  std::vector<std::string> lost;
  for (const auto& [name, end] : ends) {
    const auto found = std::find_if(cuts.begin(), cuts.end(),
                                    [&, n = name](const CurveCut& cut) { return cut.file.stem().string() == n; });
    if (found == cuts.end())
      lost.push_back(
          fmt::format("curve '{}' is gone, and is begun anew: its rows up to the checkpoint are lost", name));
    else if (found->length < end.length)
      lost.push_back(fmt::format(
          "curve '{}' has lost rows: it goes on behind the first {} of the {} bytes that it had at the checkpoint",
          name, found->length, end.length));
  }
  return lost;
}

void cut(const std::vector<CurveCut>& cuts) {
  for (const CurveCut& cut : cuts)
    if (::ftruncate(open_regular(cut.file, O_WRONLY, "cut").number(), static_cast<off_t>(cut.length)) != 0)
      throw file_failure("cut", cut.file, errno);
}

CurveFile::CurveFile(std::filesystem::path file, const std::vector<CurveColumn>& columns)
    : file_(std::move(file)), first_line_(beadwork::first_line(columns)), columns_(columns.size()) {}

CurveFile CurveFile::fresh(const std::filesystem::path& file, const std::vector<CurveColumn>& columns) {
  write_atomically(file, first_line(columns) + "\n");
  CurveFile curve(file, columns);
  curve.open();
  return curve;
}

CurveFile CurveFile::resume(const std::filesystem::path& file, const std::vector<CurveColumn>& columns) {
  std::error_code error;
  if (!std::filesystem::exists(file, error)) return fresh(file, columns);
  std::ifstream in = open_to_read(file);
  const std::string head = head_of(in, file);
  if (head != first_line(columns))
    throw DeckFailure(
        fmt::format("curve '{}' has the columns \"{}\", this deck wants \"{}\"; resume with the deck that wrote it",
                    file.string(), head, first_line(columns)));
  CurveFile curve(file, columns);
  curve.open();
  return curve;
}

void CurveFile::open() { descriptor_ = open_regular(file_, O_WRONLY | O_APPEND, "write"); }

void CurveFile::add(std::int64_t step, std::span<const Real> values) {
  if (values.size() != columns_)
    throw std::logic_error(fmt::format("curve '{}' has {} columns, not {}", file_.string(), columns_, values.size()));
  row_.clear();
  append(row_, step);
  for (const Real value : values) {
    row_ += ',';
    append(row_, value);
  }
  row_ += '\n';
  const off_t before = ::lseek(descriptor_.number(), 0, SEEK_END);
  const int error = write_all(descriptor_.number(), row_.data(), row_.size());
  if (error == 0) return;
  if (before >= 0) std::ignore = ::ftruncate(descriptor_.number(), before);  // half a row is worse than none
  throw file_failure("write", file_, error);
}

void CurveFile::sync() {
  if (::fsync(descriptor_.number()) != 0 && errno != EINVAL) throw file_failure("write", file_, errno);
}

CurveEnd CurveFile::end() const {
  const off_t end = ::lseek(descriptor_.number(), 0, SEEK_END);
  if (end < 0) throw file_failure("read", file_, errno);
  return {static_cast<std::uintmax_t>(end), first_line_};
}

void CurveFile::write_sidecar(const std::string& json) const {
  std::filesystem::path sidecar = file_;
  write_atomically(sidecar.replace_extension(".json"), json);
}

}  // namespace beadwork
