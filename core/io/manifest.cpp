#include "core/io/manifest.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <tuple>

#include "core/base/text.hpp"

namespace beadwork {

namespace {

using Path = std::filesystem::path;

std::string signature(Manifest::Of of) {
  return fmt::format("beadwork: the files that a {} made, format 1", Manifest::maker(of));
}

constexpr std::uintmax_t longest = std::uintmax_t{1} << 30;

bool is_plain_name(std::string_view name) {
  return !name.empty() && name != "." && name != ".." && name.find('/') == std::string_view::npos &&
         std::none_of(name.begin(), name.end(), [](char c) { return static_cast<unsigned char>(c) < 32 || c == 127; });
}

// A run, batch or study writes into its folder and one level below it. Whatever else a damaged list says names nothing.
bool can_be_listed(std::string_view file) {
  for (const std::string_view below : {"curves/", "frames/"})
    if (file.starts_with(below)) return is_plain_name(file.substr(below.size()));
  for (const Manifest::Of of : Manifest::all)
    if (file == Manifest::name_of(of)) return false;
  return is_plain_name(file);
}

// What a kill left of a last line is the beginning of a name, and may be that of another file.
void drop_torn_line(int list, const Path& file) {
  const off_t end = ::lseek(list, 0, SEEK_END);
  off_t whole = end;
  for (char last = 0; whole > 0; --whole) {
    if (::pread(list, &last, 1, whole - 1) != 1) throw file_failure("read", file, errno);
    if (last == '\n') break;
  }
  if (whole < end && ::ftruncate(list, whole) != 0) throw file_failure("write", file, errno);
}

bool stands(const Path& file) {
  std::error_code error;
  return std::filesystem::exists(std::filesystem::symlink_status(file, error));
}

}  // namespace

const char* Manifest::maker(Of of) {
  switch (of) {
    case Of::run: return "run";
    case Of::batch: return "batch";
    case Of::study: return "study";
    case Of::exported: return "export";
  }
  return "";
}

Path Manifest::place() const { return folder_ / name_of(of_); }

std::optional<Manifest> Manifest::read(const Path& folder, Of of) {
  Manifest manifest(folder, of);
  if (!stands(manifest.place())) return std::nullopt;
  std::vector<std::string> lines = split(read_text(manifest.place(), longest), '\n');
  if (lines.front() != signature(of) || lines.size() < 2) return std::nullopt;
  lines.pop_back();  // empty, or torn by a kill: then its file was not made
  for (std::size_t k = 1; k < lines.size(); ++k)
    if (can_be_listed(lines[k])) manifest.add(lines[k]);
  return manifest;
}

Manifest Manifest::begin(const Path& folder, const std::vector<std::string>& files, Of of) {
  Manifest manifest(folder, of);
  std::string text = signature(of) + "\n";
  for (const std::string& file : files) {
    manifest.add(file);
    text += file + "\n";
  }
  write_atomically(manifest.place(), text);
  return manifest;
}

void Manifest::refuse_what_stands(const Path& file, Of of) {
  if (stands(file))
    throw DeckFailure(
        fmt::format("'{}' is there already, and no {} made it: it is left alone. Rename it, or choose another {}",
                    file.string(), maker(of), of == Of::run ? "name" : "folder"));
}

void Manifest::add(const std::string& file) {
  if (known_.insert(file).second) files_.push_back(file);
}

void Manifest::refresh() {
  if (const auto now = read(folder_, of_))
    for (const std::string& file : now->files_) add(file);
}

void Manifest::claim(const std::string& file) {
  if (lists(file)) return;
  const Path list = place();
  if (!can_be_listed(file)) throw DeckFailure(fmt::format("\"{}\" cannot be the name of a file of a run", file));
  if (stands(folder_ / file)) refresh();
  if (lists(file)) return;
  refuse_what_stands(folder_ / file, of_);
  if (!open_) {
    open_ = open_regular(list, O_RDWR | O_APPEND, "write");
    drop_torn_line(open_.number(), list);
  }
  const off_t end = ::lseek(open_.number(), 0, SEEK_END);
  const std::string line = file + "\n";
  int error = write_all(open_.number(), line.data(), line.size());
  if (error == 0 && ::fdatasync(open_.number()) != 0 && errno != EINVAL) error = errno;
  if (error != 0) {
    if (end >= 0) std::ignore = ::ftruncate(open_.number(), end);
    throw file_failure("write", list, error);
  }
  add(file);
}

}  // namespace beadwork
