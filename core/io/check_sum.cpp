#include "core/io/check_sum.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>

#include "core/io/file.hpp"

namespace beadwork {

namespace {

constexpr std::string_view mark = "\nbeadwork check sum ";
constexpr std::size_t trailer_size = mark.size() + 16 + 1;

// Four lanes of multiply and fold, as a hash of strings does it: a flipped bit changes its lane for good, and the
// lanes are independent, so that the sum is as fast as memory.
std::uint64_t check_sum(std::span<const std::byte> bytes) {
  constexpr std::uint64_t prime = 0x9E3779B97F4A7C15u;
  std::array<std::uint64_t, 4> lane{1, 2, 3, 4};
  const auto add = [](std::uint64_t& sum, std::uint64_t word) {
    sum = (sum ^ word) * prime;
    sum ^= sum >> 29;
  };
  std::size_t at = 0;
  std::array<std::uint64_t, 4> words{};
  for (; at + sizeof words <= bytes.size(); at += sizeof words) {
    std::memcpy(words.data(), bytes.data() + at, sizeof words);
    for (std::size_t k = 0; k < lane.size(); ++k) add(lane[k], words[k]);
  }
  words = {};
  std::memcpy(words.data(), bytes.data() + at, bytes.size() - at);
  for (std::size_t k = 0; k < lane.size(); ++k) add(lane[k], words[k]);
  std::uint64_t sum = bytes.size();
  for (const std::uint64_t part : lane) add(sum, part);
  return sum;
}

class Mapping {
 public:
  explicit Mapping(const std::filesystem::path& file) {
    const Descriptor in = open_regular(file, O_RDONLY, "read");
    struct stat status {};
    if (::fstat(in.number(), &status) != 0) throw file_failure("read", file, errno);
    size_ = static_cast<std::size_t>(status.st_size);
    if (size_ == 0) return;
    data_ = ::mmap(nullptr, size_, PROT_READ, MAP_PRIVATE, in.number(), 0);
    if (data_ == MAP_FAILED) throw file_failure("read", file, errno);
  }
  ~Mapping() {
    if (size_ > 0 && data_ != MAP_FAILED) ::munmap(data_, size_);
  }
  Mapping(const Mapping&) = delete;
  Mapping& operator=(const Mapping&) = delete;
  std::span<const std::byte> bytes() const { return {static_cast<const std::byte*>(data_), size_}; }

 private:
  void* data_ = nullptr;
  std::size_t size_ = 0;
};

}  // namespace

std::string check_sum_trailer(std::span<const std::byte> bytes) {
  return fmt::format("{}{:016x}\n", mark, check_sum(bytes));
}

void verify_check_sum(const std::filesystem::path& file) {
  const Mapping mapping(file);
  const auto bytes = mapping.bytes();
  const auto damaged = [&](const char* how) {
    return MachineFailure(
        fmt::format("'{}' {}: it is damaged, or was not written by this program", file.string(), how));
  };
  if (bytes.size() < trailer_size) throw damaged("is too short");
  const auto content = bytes.first(bytes.size() - trailer_size);
  const std::string trailer = check_sum_trailer(content);
  if (std::memcmp(trailer.data(), bytes.data() + content.size(), mark.size()) != 0)
    throw damaged("has no check sum at its end");
  if (std::memcmp(trailer.data(), bytes.data() + content.size(), trailer_size) != 0)
    throw damaged("does not fit its check sum");
}

}  // namespace beadwork
