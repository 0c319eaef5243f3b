#include "core/plugin/elf.hpp"

#include <elf.h>
#include <fmt/format.h>
#include <link.h>

#include <array>
#include <cstring>
#include <fstream>
#include <limits>
#include <optional>
#include <vector>

namespace beadwork {

namespace {

using Header = ElfW(Ehdr);
using Segment = ElfW(Phdr);
using Section = ElfW(Shdr);
using Entry = ElfW(Dyn);
using Size = std::uint64_t;

class Image {
 public:
  explicit Image(const std::filesystem::path& file) : in_(file, std::ios::binary) {
    std::error_code error;
    size_ = std::filesystem::file_size(file, error);
    if (error) size_ = 0;
  }
  Size size() const { return size_; }
  bool holds(Size offset, Size length) const { return offset <= size_ && length <= size_ - offset; }

  /// Nothing if they do not lie in the file.
  template <class T>
  std::optional<std::vector<T>> read(Size offset, Size count) {
    if (count > size_ / sizeof(T) || !holds(offset, count * sizeof(T))) return std::nullopt;
    std::vector<T> values(count);
    in_.seekg(static_cast<std::streamoff>(offset));
    in_.read(reinterpret_cast<char*>(values.data()), static_cast<std::streamsize>(count * sizeof(T)));
    if (!in_) return std::nullopt;
    return values;
  }

 private:
  std::ifstream in_;
  Size size_ = 0;
};

const std::string damaged = "it is damaged: ";

// What this program is itself; the compiler knows the rest.
std::optional<Header> own_header() {
  Image self("/proc/self/exe");
  const auto header = self.read<Header>(0, 1);
  return header ? std::optional(header->front()) : std::nullopt;
}

std::string why_odd(const Header& header) {
  if (std::memcmp(header.e_ident, ELFMAG, SELFMAG) != 0) return "it is no shared library";
  const auto own = own_header();
  if (own && (header.e_ident[EI_CLASS] != own->e_ident[EI_CLASS] || header.e_ident[EI_DATA] != own->e_ident[EI_DATA] ||
              header.e_machine != own->e_machine))
    return "it was built for another kind of processor";
  if (header.e_type != ET_DYN) return "it is no shared library, but an object file or a program";
  if (header.e_phentsize != sizeof(Segment) || header.e_phnum == 0) return damaged + "it has no segments";
  return "";
}

/// Those that are mapped, by address.
class Mapped {
 public:
  explicit Mapped(const std::vector<Segment>& segments) {
    for (const Segment& s : segments)
      if (s.p_type == PT_LOAD) loads_.push_back(s);
  }
  bool none() const { return loads_.empty(); }
  bool holds(Size address, Size length) const {
    for (const Segment& s : loads_)
      if (address >= s.p_vaddr && address - s.p_vaddr <= s.p_memsz && length <= s.p_memsz - (address - s.p_vaddr))
        return true;
    return false;
  }

 private:
  std::vector<Segment> loads_;
};

std::string why_segments(const Image& image, const std::vector<Segment>& segments) {
  Size last = 0;
  for (const Segment& s : segments) {
    if (s.p_type != PT_GNU_STACK && s.p_filesz > 0 && !image.holds(s.p_offset, s.p_filesz))
      return fmt::format("it is cut off: of {} bytes a part ends at {}", image.size(), s.p_offset + s.p_filesz);
    if (s.p_type != PT_LOAD) continue;
    constexpr Size most = Size{1} << 40;
    if (s.p_filesz > s.p_memsz || s.p_memsz > most || s.p_vaddr > most || s.p_vaddr < last)
      return damaged + "its segments lie in no order";
    if (s.p_align > 1 &&
        ((s.p_align & (s.p_align - 1)) != 0 || s.p_align > most || (s.p_vaddr - s.p_offset) % s.p_align != 0))
      return damaged + "its segments are not aligned";
    last = s.p_vaddr + s.p_memsz;
  }
  return "";
}

// Tables that the loader walks through before anything else is known of the library.
std::string why_dynamic(const std::vector<Entry>& entries, const Mapped& mapped) {
  Size strings = 0, length = 0, symbols = 0;
  for (const Entry& e : entries) {
    if (e.d_tag == DT_NULL) break;
    if (e.d_tag == DT_STRTAB) strings = e.d_un.d_ptr;
    if (e.d_tag == DT_STRSZ) length = e.d_un.d_val;
    if (e.d_tag == DT_SYMTAB) symbols = e.d_un.d_ptr;
    const bool pointer = e.d_tag == DT_HASH || e.d_tag == DT_GNU_HASH || e.d_tag == DT_RELA || e.d_tag == DT_JMPREL ||
                         e.d_tag == DT_INIT || e.d_tag == DT_FINI || e.d_tag == DT_INIT_ARRAY ||
                         e.d_tag == DT_FINI_ARRAY || e.d_tag == DT_VERSYM || e.d_tag == DT_VERNEED ||
                         e.d_tag == DT_VERDEF || e.d_tag == DT_PLTGOT;
    if (pointer && !mapped.holds(e.d_un.d_ptr, 1)) return damaged + "a table lies outside of it";
  }
  if (!mapped.holds(strings, length) || !mapped.holds(symbols, 1)) return damaged + "its names lie outside of it";
  for (const Entry& e : entries) {
    if (e.d_tag == DT_NULL) break;
    if ((e.d_tag == DT_NEEDED || e.d_tag == DT_SONAME || e.d_tag == DT_RUNPATH || e.d_tag == DT_RPATH) &&
        e.d_un.d_val >= length)
      return damaged + "a name lies outside of its names";
  }
  const auto sized = [&](auto start_tag, auto size_tag) {
    Size start = 0, size = 0;
    for (const Entry& e : entries) {
      if (e.d_tag == start_tag) start = e.d_un.d_ptr;
      if (e.d_tag == size_tag) size = e.d_un.d_val;
    }
    return size == 0 || mapped.holds(start, size);
  };
  const bool whole = sized(DT_RELA, DT_RELASZ) && sized(DT_JMPREL, DT_PLTRELSZ) &&
                     sized(DT_INIT_ARRAY, DT_INIT_ARRAYSZ) && sized(DT_FINI_ARRAY, DT_FINI_ARRAYSZ);
  return whole ? "" : damaged + "a table ends outside of it";
}

// Not needed to load it, but where they lie tells of a library that was cut off behind its last segment.
std::string why_sections(Image& image, const Header& header) {
  if (header.e_shnum == 0) return "";
  if (header.e_shentsize != sizeof(Section)) return damaged + "its sections have an odd size";
  const auto sections = image.read<Section>(header.e_shoff, header.e_shnum);
  if (!sections)
    return fmt::format("it is cut off: of {} bytes the list of its sections ends at {}", image.size(),
                       header.e_shoff + Size{header.e_shnum} * sizeof(Section));
  for (const Section& s : *sections)
    if (s.sh_type != SHT_NOBITS && s.sh_type != SHT_NULL && !image.holds(s.sh_offset, s.sh_size))
      return fmt::format("it is cut off: of {} bytes a section ends at {}", image.size(), s.sh_offset + s.sh_size);
  return "";
}

}  // namespace

std::string why_no_shared_library(const std::filesystem::path& file) {
  std::error_code error;
  const auto kind = std::filesystem::status(file, error).type();
  if (kind == std::filesystem::file_type::not_found) return "there is no such file";
  if (error) return error.message();
  if (kind != std::filesystem::file_type::regular) return "it is no file";
  Image image(file);
  const auto header = image.read<Header>(0, 1);
  if (!header) return image.size() == 0 ? "it is empty, or cannot be read" : "it is no shared library";
  if (std::string why = why_odd(header->front()); !why.empty()) return why;
  const auto segments = image.read<Segment>(header->front().e_phoff, header->front().e_phnum);
  if (!segments) return damaged + "the list of its segments lies outside of it";
  if (std::string why = why_segments(image, *segments); !why.empty()) return why;
  if (std::string why = why_sections(image, header->front()); !why.empty()) return why;
  const Mapped mapped(*segments);
  for (const Segment& s : *segments)
    if (s.p_type == PT_DYNAMIC) {
      const auto entries = image.read<Entry>(s.p_offset, s.p_filesz / sizeof(Entry));
      if (!entries || !mapped.holds(s.p_vaddr, s.p_memsz)) return damaged + "what the loader needs lies outside of it";
      return why_dynamic(*entries, mapped);
    }
  return damaged + "it lacks what the loader needs";
}

}  // namespace beadwork
