#include "core/io/run_folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <vector>

namespace beadwork {

namespace {

using Path = std::filesystem::path;
using std::error_code;

// The checkpoint goes first and the summary last: a removal that is cut short leaves a folder that still counts as a
// run, but never one that could be resumed with half of its files.
const std::vector<std::string> files_of_a_run = {"checkpoint.h5", "run.h5", "run.xmf", "run.log", "resolved.xml", "summary.json", "report.html"};

bool is_part(const Path& file) { return file.extension() == ".part"; }

bool is_file_of_a_run(const Path& entry) {
  const Path name = is_part(entry) ? entry.stem() : entry.filename();
  return std::find(files_of_a_run.begin(), files_of_a_run.end(), name.string()) != files_of_a_run.end();
}

bool is_frame(const Path& entry) { return is_part(entry) || entry.extension() == ".h5"; }
bool is_curve(const Path& entry) { return is_part(entry) || entry.extension() == ".csv" || entry.extension() == ".json"; }

std::vector<Path> entries_of(const Path& folder) {
  error_code error;
  std::vector<Path> entries;
  for (auto it = std::filesystem::directory_iterator(folder, error); !error && it != std::filesystem::directory_iterator();
       it.increment(error))
    entries.push_back(it->path());
  if (error) throw file_failure("read folder", folder, error.value());
  return entries;
}

void remove_file(const Path& file) {
  error_code error;
  std::filesystem::remove(file, error);
  if (error) throw file_failure("remove", file, error.value());
}

// Removes the files that `ours` knows, then the folder if nothing else stands in it.
void clear_folder(const Path& folder, bool (*ours)(const Path&)) {
  error_code error;
  if (!std::filesystem::is_directory(std::filesystem::symlink_status(folder, error))) return;
  for (const Path& entry : entries_of(folder))
    if (ours(entry)) remove_file(entry);
  std::filesystem::remove(folder, error);  // refuses a folder that is not empty, which is what we want
}

void remove_parts(const Path& folder) {
  error_code error;
  if (!std::filesystem::is_directory(folder, error)) return;
  for (const Path& entry : entries_of(folder))
    if (is_part(entry)) remove_file(entry);
}

void make_folder(const Path& folder) {
  error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw file_failure("make folder", folder, error.value());
}

// A folder that cannot be written should be known before the packing, not after it.
void try_writing(const Path& folder) {
  const Path probe = folder / "run.log.part";
  const Descriptor file(::open(probe.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666));
  if (!file) throw file_failure("write into folder", folder, errno);
  const int error = write_all(file.number(), "?", 1);
  ::unlink(probe.c_str());
  if (error) throw file_failure("write into folder", folder, error);
}

enum class Content { nothing, run, unknown };

Content content_of(const Path& root) {
  const auto entries = entries_of(root);
  const bool run = std::any_of(entries.begin(), entries.end(), is_file_of_a_run);
  const bool other = std::any_of(entries.begin(), entries.end(), [](const Path& entry) {
    return entry.filename() != "curves" && entry.filename() != "frames";
  });
  if (run) return Content::run;
  return other ? Content::unknown : entries.empty() ? Content::nothing : Content::run;
}

void remove_run(const Path& root) {
  for (const std::string& name : files_of_a_run) {
    if (name == "run.h5") {
      clear_folder(root / "frames", is_frame);
      clear_folder(root / "curves", is_curve);
    }
    remove_file(root / name);
    remove_file(part_of(root / name));
  }
}

std::string first_of(const Path& root) { return entries_of(root).front().filename().string(); }

}  // namespace

RunFolder RunFolder::fresh(const Path& root, bool overwrite) {
  error_code error;
  const bool exists = std::filesystem::exists(root, error);
  if (error && error != std::errc::permission_denied)  // a name too long, a loop of links
    throw DeckFailure(fmt::format("'{}' cannot be the folder of a run: {}", root.string(), error.message()));
  if (exists && !std::filesystem::is_directory(root, error))
    throw DeckFailure(fmt::format("'{}' is a file; the output of a run is a folder", root.string()));
  make_folder(root);
  RunFolder folder(root);
  folder.lock();
  const Content content = content_of(root);
  if (content == Content::unknown)
    throw DeckFailure(fmt::format("folder '{}' is not empty and holds no run (it has '{}'); choose another, nothing is "
                                  "removed from it",
                                  root.string(), first_of(root)));
  if (content == Content::run && !overwrite)
    throw DeckFailure(fmt::format("folder '{}' already holds a run; choose another, or add --overwrite to replace the "
                                  "run, or --resume to continue it",
                                  root.string()));
  if (content == Content::run) remove_run(root);
  make_folder(folder.curves());
  try_writing(root);
  return folder;
}

RunFolder RunFolder::resume(const Path& root) {
  error_code error;
  if (!std::filesystem::is_directory(root, error))
    throw DeckFailure(fmt::format("there is no folder '{}' to resume from", root.string()));
  RunFolder folder(root);
  folder.lock();
  if (!std::filesystem::exists(folder.checkpoint(), error))
    throw DeckFailure(fmt::format("folder '{}' has no checkpoint.h5, so there is nothing to resume; run the deck "
                                  "without --resume",
                                  root.string()));
  for (const Path& part : {root, folder.frames(), folder.curves()}) remove_parts(part);
  make_folder(folder.curves());
  try_writing(root);
  return folder;
}

// The folder itself is locked: nothing is left behind, and the system lets go of it however the process ends.
void RunFolder::lock() {
  lock_ = Descriptor(::open(root_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (!lock_) throw file_failure("open folder", root_, errno);
  // Some network file systems have no locks; there two runs in one folder are the user's own care.
  if (::flock(lock_.number(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
    throw DeckFailure(fmt::format("another run is writing folder '{}'; wait for it, or choose another folder",
                                  root_.string()));
}

}  // namespace beadwork
