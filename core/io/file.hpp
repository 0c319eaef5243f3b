#pragma once
// Files that are there whole or not at all, and failures that say which file and why.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>

#include "core/base/failure.hpp"

namespace beadwork {

/// "cannot write 'out/run.h5': No space left on device. <what to do>", from a number of errno.
MachineFailure file_failure(std::string_view doing, const std::filesystem::path& file, int error);

/// A descriptor that is closed with its owner.
class Descriptor {
 public:
  Descriptor() = default;
  explicit Descriptor(int number) : number_(number) {}
  Descriptor(Descriptor&& other) noexcept;
  Descriptor& operator=(Descriptor&& other) noexcept;
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor();
  int number() const { return number_; }
  explicit operator bool() const { return number_ >= 0; }

 private:
  int number_ = -1;
};

/// Whether a link that stands in the place of a file is followed. In the folder of a run it is not: nobody but a run
/// writes there, and what the link points to is somebody else's.
enum class SymbolicLinks { refuse, follow };

/// Opens a regular file that is there, with the flags of open(2). A link, a folder, a pipe or a device under that name
/// is refused without being touched. Throws MachineFailure "cannot <doing> 'file': ...".
Descriptor open_regular(const std::filesystem::path& file, int flags, std::string_view doing,
                        SymbolicLinks links = SymbolicLinks::refuse);

/// The text of a regular file of at most `most` bytes. Throws MachineFailure.
std::string read_text(const std::filesystem::path& file, std::uintmax_t most);

/// Writes all of it, however often the system takes only a part. Returns errno, or 0.
int write_all(int descriptor, const void* data, std::size_t size);

/// Where a file stands until it is whole: beside the file, so that renaming it is one act of the system.
std::filesystem::path part_of(const std::filesystem::path& file);
/// Makes the part of a file anew, empty. One that a kill left behind is replaced; anything but a regular file in its
/// place is not ours, and a MachineFailure.
Descriptor make_part(const std::filesystem::path& file);

/// Writes beside `file`, waits until the disk has it, then takes the old one's place: whoever looks, at whatever
/// moment the process or the machine stops, finds the old text or the new one. Throws MachineFailure; the old file
/// then stands as it was.
void write_atomically(const std::filesystem::path& file, std::string_view text);
void write_atomically(const std::filesystem::path& file, std::initializer_list<std::span<const std::byte>> parts);

/// Takes that much room on the disk for a file beforehand; the file is made if need be. Throws MachineFailure.
void reserve(const std::filesystem::path& file, std::uintmax_t size);

/// Writes over what the file holds, in the room that it has already: for a disk that is full, and short texts only,
/// since a kill in between would tear it. Throws MachineFailure.
void overwrite(const std::filesystem::path& file, std::string_view text);

/// The second half of write_atomically, for a part file that somebody else has written and closed.
void put_in_place(const std::filesystem::path& part, const std::filesystem::path& file);

}  // namespace beadwork
