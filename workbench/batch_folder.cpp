// The folder of a batch: who writes it, and which of its files a batch has made.

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>

#include <cerrno>
#include <fstream>
#include <sstream>

#include "core/base/failure.hpp"
#include "core/io/run_folder.hpp"
#include "workbench/batch.hpp"

namespace beadwork {

namespace fs = std::filesystem;

namespace {

/// Two batches in one folder would start each run twice.
Descriptor locked(const fs::path& folder) {
  Descriptor lock(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (lock && ::flock(lock.number(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
    throw DeckFailure(fmt::format("error: a batch is running in '{}' already: {}; wait for it, or choose another --out",
                                  folder.string(), holder_of(folder)));
  return lock;
}

}  // namespace

std::string holder_of(const fs::path& path) {
  struct stat file;
  if (::stat(path.c_str(), &file) != 0) return "another process";
  const std::string inode = ":" + std::to_string(file.st_ino);
  std::ifstream locks("/proc/locks");
  for (std::string line; std::getline(locks, line);) {  // 1: FLOCK ADVISORY WRITE 4711 08:01:131090 0 EOF
    std::istringstream words(line);
    std::string number, kind, how, mode, process, place;
    if (words >> number >> kind >> how >> mode >> process >> place && kind == "FLOCK" && place.ends_with(inode))
      return "process " + process;
  }
  return "another process";
}

BatchFolder::BatchFolder(const fs::path& root) : root_(root) {
  make_output_folder(root, "batch");
  lock_ = locked(root);
  list_ = Manifest::read(root, Manifest::Of::batch);
  if (!list_) Manifest::refuse_what_stands(root / Manifest::file_name_of_batch, Manifest::Of::batch);
}

fs::path BatchFolder::claim(const std::string& name) {
  if (!list_) {
    Manifest::refuse_what_stands(root_ / name,
                                 Manifest::Of::batch);  // then no list is left in the folder of somebody else
    list_ = Manifest::begin(root_, {}, Manifest::Of::batch);
  }
  list_->claim(name);
  return root_ / name;
}

}  // namespace beadwork
