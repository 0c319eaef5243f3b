#include "core/io/file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

namespace beadwork {

namespace {

std::string remedy(int error) {
  switch (error) {
    case ENOSPC:
    case EDQUOT: return " Free some space, or write to another folder";
    case EACCES:
    case EPERM:
    case EROFS: return " Choose a folder that you may write to";
    case EFBIG: return " Raise the limit on the size of a file (ulimit -f)";
    default: return "";
  }
}

// What stands under the name is not what a run writes.
MachineFailure not_regular(std::string_view doing, const std::filesystem::path& file, mode_t mode) {
  const char* what = S_ISLNK(mode)    ? "a link"
                     : S_ISDIR(mode)  ? "a folder"
                     : S_ISFIFO(mode) ? "a pipe"
                                      : "no regular file";
  return MachineFailure(
      fmt::format("cannot {} '{}': it is {}, and only a file is taken here. Remove it", doing, file.string(), what));
}

// A rename is safe from a power cut only once its folder is on the disk too. Some file systems cannot do it: then the
// rename is at least safe from a kill.
void sync_folder_of(const std::filesystem::path& file) {
  const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
  const Descriptor descriptor(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (descriptor) ::fsync(descriptor.number());
}

[[noreturn]] void drop_part(const std::filesystem::path& part, const std::filesystem::path& file, int error) {
  ::unlink(part.c_str());
  throw file_failure("write", file, error);
}

}  // namespace

MachineFailure file_failure(std::string_view doing, const std::filesystem::path& file, int error) {
  const bool full = error == ENOSPC || error == EDQUOT;
  const std::string why = full ? fmt::format("the disk is full ({})", std::strerror(error)) : std::strerror(error);
  return MachineFailure(fmt::format("cannot {} '{}': {}.{}", doing, file.string(), why, remedy(error)));
}

Descriptor::Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}

Descriptor& Descriptor::operator=(Descriptor&& other) noexcept {
  std::swap(number_, other.number_);
  return *this;
}

Descriptor::~Descriptor() {
  if (number_ >= 0) ::close(number_);
}

int write_all(int descriptor, const void* data, std::size_t size) {
  const char* at = static_cast<const char*>(data);
  while (size > 0) {
    const ssize_t taken = ::write(descriptor, at, size);
    if (taken < 0 && errno == EINTR) continue;
    if (taken < 0) return errno;
    at += taken;
    size -= static_cast<std::size_t>(taken);
  }
  return 0;
}

Descriptor open_regular(const std::filesystem::path& file, int flags, std::string_view doing, SymbolicLinks links) {
  struct stat status {};
  // Without O_NONBLOCK a pipe would be waited for; of a regular file it changes nothing.
  Descriptor descriptor(::open(
      file.c_str(), flags | O_CLOEXEC | O_NONBLOCK | O_NOCTTY | (links == SymbolicLinks::refuse ? O_NOFOLLOW : 0), 0666));
  const int error = errno;
  if (!descriptor && ::lstat(file.c_str(), &status) == 0 && !S_ISREG(status.st_mode) &&
      (links == SymbolicLinks::refuse || !S_ISLNK(status.st_mode)))
    throw not_regular(doing, file, status.st_mode);
  if (!descriptor) throw file_failure(doing, file, error);
  if (::fstat(descriptor.number(), &status) != 0) throw file_failure(doing, file, errno);
  if (!S_ISREG(status.st_mode)) throw not_regular(doing, file, status.st_mode);
  return descriptor;
}

std::string read_text(const std::filesystem::path& file, std::uintmax_t most) {
  const Descriptor in = open_regular(file, O_RDONLY, "read");
  std::string text;
  char piece[65536];
  for (;;) {
    const ssize_t taken = ::read(in.number(), piece, sizeof piece);
    if (taken < 0 && errno == EINTR) continue;
    if (taken < 0) throw file_failure("read", file, errno);
    if (taken == 0) return text;
    text.append(piece, static_cast<std::size_t>(taken));
    if (text.size() > most)
      throw MachineFailure(fmt::format("cannot read '{}': it is longer than {} bytes", file.string(), most));
  }
}

std::filesystem::path part_of(const std::filesystem::path& file) {
  std::filesystem::path part = file;
  part += ".part";
  return part;
}

Descriptor make_part(const std::filesystem::path& file) {
  const std::filesystem::path part = part_of(file);
  struct stat status {};
  if (::lstat(part.c_str(), &status) == 0) {
    if (!S_ISREG(status.st_mode)) throw not_regular("write", part, status.st_mode);
    if (::unlink(part.c_str()) != 0) throw file_failure("write", file, errno);
  }
  Descriptor out(::open(part.c_str(), O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666));
  if (!out) throw file_failure("write", file, errno);
  return out;
}

void write_atomically(const std::filesystem::path& file, std::string_view text) {
  write_atomically(file, {std::as_bytes(std::span(text.data(), text.size()))});
}

void write_atomically(const std::filesystem::path& file, std::initializer_list<std::span<const std::byte>> parts) {
  const std::filesystem::path part = part_of(file);
  {
    const Descriptor out = make_part(file);
    for (const auto& bytes : parts)
      if (const int error = write_all(out.number(), bytes.data(), bytes.size())) drop_part(part, file, error);
  }
  put_in_place(part, file);
}

void reserve(const std::filesystem::path& file, std::uintmax_t size) {
  const Descriptor out = open_regular(file, O_RDWR | O_CREAT, "write");
  if (const int error = ::posix_fallocate(out.number(), 0, static_cast<off_t>(size)))
    throw file_failure("write", file, error);
}

void overwrite(const std::filesystem::path& file, std::string_view text) {
  const Descriptor out = open_regular(file, O_WRONLY | O_CREAT, "write");
  if (const int error = write_all(out.number(), text.data(), text.size())) throw file_failure("write", file, error);
  if (::ftruncate(out.number(), static_cast<off_t>(text.size())) != 0) throw file_failure("write", file, errno);
}

void put_in_place(const std::filesystem::path& part, const std::filesystem::path& file) {
  {
    const Descriptor out = open_regular(part, O_RDWR, "write");
    if (::fsync(out.number()) != 0 && errno != EINVAL) drop_part(part, file, errno);
  }
  if (::rename(part.c_str(), file.c_str()) != 0) drop_part(part, file, errno);
  sync_folder_of(file);
}

}  // namespace beadwork
