#include "core/io/file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
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
    default: return "";
  }
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

std::filesystem::path part_of(const std::filesystem::path& file) {
  std::filesystem::path part = file;
  part += ".part";
  return part;
}

void write_atomically(const std::filesystem::path& file, std::string_view text) {
  write_atomically(file, {std::as_bytes(std::span(text.data(), text.size()))});
}

void write_atomically(const std::filesystem::path& file, std::initializer_list<std::span<const std::byte>> parts) {
  const std::filesystem::path part = part_of(file);
  {
    const Descriptor out(::open(part.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
    if (!out) throw file_failure("write", file, errno);
    for (const auto& bytes : parts)
      if (const int error = write_all(out.number(), bytes.data(), bytes.size())) drop_part(part, file, error);
  }
  put_in_place(part, file);
}

void reserve(const std::filesystem::path& file, std::uintmax_t size) {
  const Descriptor out(::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666));
  if (!out) throw file_failure("write", file, errno);
  if (const int error = ::posix_fallocate(out.number(), 0, static_cast<off_t>(size))) throw file_failure("write", file, error);
}

void overwrite(const std::filesystem::path& file, std::string_view text) {
  const Descriptor out(::open(file.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666));
  if (!out) throw file_failure("write", file, errno);
  if (const int error = write_all(out.number(), text.data(), text.size())) throw file_failure("write", file, error);
  if (::ftruncate(out.number(), static_cast<off_t>(text.size())) != 0) throw file_failure("write", file, errno);
}

void put_in_place(const std::filesystem::path& part, const std::filesystem::path& file) {
  {
    const Descriptor out(::open(part.c_str(), O_RDWR | O_CLOEXEC));
    if (!out) throw file_failure("write", file, errno);
    if (::fsync(out.number()) != 0 && errno != EINVAL) drop_part(part, file, errno);
  }
  if (::rename(part.c_str(), file.c_str()) != 0) drop_part(part, file, errno);
  sync_folder_of(file);
}

}  // namespace beadwork
