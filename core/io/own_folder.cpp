#include "core/io/own_folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>

#include <cerrno>
#include <fstream>
#include <sstream>

#include "core/base/failure.hpp"
#include "core/io/run_folder.hpp"

namespace beadwork {

namespace fs = std::filesystem;

namespace {

std::string with_article(const std::string& maker) { return (maker.front() == 'e' ? "an " : "a ") + maker; }

/// Two of them in one folder would start each run twice.
Descriptor locked(const fs::path& folder, Manifest::Of of) {
  Descriptor lock(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (lock && ::flock(lock.number(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
    throw DeckFailure(fmt::format("error: {} is running in '{}' already: {}; wait for it, or choose another --out",
                                  with_article(Manifest::maker(of)), folder.string(), holder_of(folder)));
  return lock;
}

}  // namespace

bool is_busy(const fs::path& folder) {
  const Descriptor descriptor(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  return descriptor && ::flock(descriptor.number(), LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
}

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

OwnFolder::OwnFolder(const fs::path& root, Manifest::Of of) : root_(root), of_(of) {
  make_output_folder(root, Manifest::maker(of));
  lock_ = locked(root, of);
  for (const Manifest::Of other : Manifest::all)
    if (other != of && Manifest::read(root, other))
      throw DeckFailure(fmt::format("error: '{}' holds what {} made; choose another folder", root.string(),
                                    with_article(Manifest::maker(other))));
  list_ = Manifest::read(root, of);
  if (!list_) Manifest::refuse_what_stands(root / Manifest::name_of(of), of);
}

fs::path OwnFolder::claim(const std::string& name) {
  if (!list_) {
    Manifest::refuse_what_stands(root_ / name, of_);  // then no list is left in the folder of somebody else
    list_ = Manifest::begin(root_, {}, of_);
  }
  list_->claim(name);
  return root_ / name;
}

void OwnFolder::clear() {
  std::error_code gone_already;
  if (!list_) return;
  for (const std::string& file : list_->files()) fs::remove(root_ / file, gone_already);
}

}  // namespace beadwork
