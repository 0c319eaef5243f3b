#include "core/io/run_folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <map>
#include <stdexcept>
#include <vector>

namespace beadwork {

namespace {

using Path = std::filesystem::path;
using std::error_code;

// What every run writes. The checkpoint is removed first and the summary last: a removal that is cut short leaves a
// folder that still counts as a run, but never one that could be resumed with half of its files.
const std::vector<std::string> files_of_a_run = {"checkpoint.h5", "run.h5",       "run.xmf",
                                                 "run.log",       "resolved.xml", "summary.json"};
constexpr const char* folders_of_a_run[] = {"curves", "frames"};

bool is_part(const Path& file) { return file.extension() == ".part"; }

std::vector<Path> entries_of(const Path& folder) {
  error_code error;
  std::vector<Path> entries;
  for (auto it = std::filesystem::directory_iterator(folder, error);
       !error && it != std::filesystem::directory_iterator(); it.increment(error))
    entries.push_back(it->path());
  if (error) throw file_failure("read folder", folder, error.value());
  return entries;
}

void remove_file(const Path& file) {
  if (::unlink(file.c_str()) != 0 && errno != ENOENT) throw file_failure("remove", file, errno);
}

// A link in the place of a folder would lead out of the run.
bool is_own_folder(const Path& folder) {
  error_code error;
  const auto status = std::filesystem::symlink_status(folder, error);
  if (std::filesystem::is_directory(status)) return true;
  if (!std::filesystem::exists(status)) return false;
  throw DeckFailure(fmt::format("'{}' is no folder, but something that no run made; remove it", folder.string()));
}

void make_folder(const Path& folder) {
  error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw file_failure("make folder", folder, error.value());
}

bool is_empty_folder(const Path& folder) {
  error_code error;
  return std::filesystem::is_directory(std::filesystem::symlink_status(folder, error)) && entries_of(folder).empty();
}

// Nothing that anybody could miss: what a run leaves that is stopped before it has begun, too.
bool holds_nothing(const Path& root) {
  const auto entries = entries_of(root);
  return std::all_of(entries.begin(), entries.end(), [&](const Path& entry) {
    return entry.filename() == part_of(Manifest::file_name) || is_empty_folder(entry);
  });
}

[[noreturn]] void refuse_content(const Path& root) {
  error_code error;
  if (std::filesystem::exists(root / "resolved.xml", error) && std::filesystem::exists(root / "run.log", error))
    throw DeckFailure(
        fmt::format("folder '{}' holds a run of a Beadwork that kept no list of its files ({}), so it cannot be told "
                    "from others' files and is left alone; choose another folder, or remove it",
                    root.string(), Manifest::file_name));
  throw DeckFailure(
      fmt::format("folder '{}' is not empty and holds no run (it has '{}'); choose another, nothing is removed from it",
                  root.string(), entries_of(root).front().filename().string()));
}

void remove_run(const Path& root, const Manifest& manifest) {
  std::vector<std::string> files = manifest.files();
  std::erase(files, "run.log");  // the new one takes its place
  std::stable_partition(files.begin(), files.end(), [](const std::string& file) { return file == "checkpoint.h5"; });
  std::stable_partition(files.begin(), files.end(), [](const std::string& file) { return file != "summary.json"; });
  std::map<Path, bool> there;
  for (const char* folder : folders_of_a_run) there[folder] = is_own_folder(root / folder);
  for (const Path file : files) {
    if (file.has_parent_path() && !there[file.parent_path()]) continue;
    remove_file(root / file);
    remove_file(part_of(root / file));
  }
  error_code error;
  for (const char* folder : folders_of_a_run)
    std::filesystem::remove(root / folder, error);  // refuses one that is not empty, as we want
}

}  // namespace

void make_output_folder(const Path& root, std::string_view what) {
  error_code error;
  const bool exists = std::filesystem::exists(root, error);
  if (error && error != std::errc::permission_denied)  // a name too long, a loop of links
    throw DeckFailure(fmt::format("'{}' cannot be the folder of a {}: {}", root.string(), what, error.message()));
  if (exists && !std::filesystem::is_directory(root, error))
    throw DeckFailure(fmt::format("'{}' is a file; the output of a {} is a folder", root.string(), what));
  make_folder(root);
}

RunFolder RunFolder::fresh(const Path& root, bool overwrite) {
  make_output_folder(root, "run");
  RunFolder folder(root);
  folder.lock();
  auto former = Manifest::read(root);
  if (!former && !holds_nothing(root)) refuse_content(root);
  if (former && !overwrite)
    throw DeckFailure(
        fmt::format("folder '{}' already holds a run; choose another, or add --overwrite to replace the run, or "
                    "--resume to continue it",
                    root.string()));
  if (former)
    folder.former_ = std::move(former);
  else
    folder.begin();
  return folder;
}

void RunFolder::begin() {
  manifest_ = Manifest::begin(root_, files_of_a_run);
  if (!is_own_folder(curves())) make_folder(curves());
}

void RunFolder::take_over() {
  if (!former_) return;
  const Path own_log = log();
  remove_run(root_, *former_);
  former_.reset();
  error_code error;
  std::filesystem::rename(own_log, log(), error);
  if (error) std::filesystem::remove(log(), error);  // the former one's: nobody has written any of this run
  begin();
}

std::filesystem::path RunFolder::log() const {
  const Path file = root_ / "run.log";
  return former_ ? part_of(file) : file;
}

RunFolder RunFolder::resume(const Path& root) {
  error_code error;
  if (!std::filesystem::is_directory(root, error))
    throw DeckFailure(fmt::format("there is no folder '{}' to resume from", root.string()));
  RunFolder folder(root);
  folder.lock();
  if (!std::filesystem::exists(folder.checkpoint(), error))
    throw DeckFailure(
        fmt::format("folder '{}' has no checkpoint.h5, so there is nothing to resume; run the deck without --resume",
                    root.string()));
  folder.manifest_ = Manifest::read(root);
  if (!folder.manifest_) refuse_content(root);
  return folder;
}

void RunFolder::clear_leftovers() const {
  for (const Path& folder : {root_, frames(), curves()}) {
    if (folder != root_ && !is_own_folder(folder)) continue;
    for (const Path& entry : entries_of(folder)) {
      const bool ours =
          is_part(entry) && manifest_->lists(entry.lexically_relative(root_).replace_extension().string());
      if (ours) remove_file(entry);
    }
  }
  make_folder(curves());
}

void RunFolder::claim(const Path& file) {
  if (former_) throw std::logic_error(fmt::format("'{}' is claimed where a former run still stands", file.string()));
  const Path relative = file.lexically_relative(root_);
  manifest_->claim(relative.string());
  if (relative.has_parent_path() && !is_own_folder(root_ / relative.parent_path()))
    make_folder(root_ / relative.parent_path());
}

std::vector<std::filesystem::path> RunFolder::made_in(const Path& folder) {
  std::vector<Path> made;
  manifest_->refresh();
  if (!is_own_folder(folder)) return made;
  for (const Path& entry : entries_of(folder))
    if (manifest_->lists(entry.lexically_relative(root_).string())) made.push_back(entry);
  std::sort(made.begin(), made.end());
  return made;
}

// The folder itself is locked: nothing is left behind, and the system lets go of it however the process ends.
void RunFolder::lock() {
  lock_ = Descriptor(::open(root_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (!lock_) throw file_failure("open folder", root_, errno);
  // Some network file systems have no locks; there two runs in one folder are the user's own care.
  if (::flock(lock_.number(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
    throw DeckFailure(
        fmt::format("another run is writing folder '{}'; wait for it, or choose another folder", root_.string()));
}

}  // namespace beadwork
