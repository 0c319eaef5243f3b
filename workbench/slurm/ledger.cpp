#include "workbench/slurm/ledger.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <random>
#include <thread>

#include "core/base/failure.hpp"
#include "core/base/text.hpp"
#include "core/io/own_folder.hpp"

namespace beadwork::slurm {

namespace {

std::string new_word() {
  std::random_device random;
  return fmt::format("beadwork-{:08x}{:08x}", random(), random());
}

}  // namespace

// A line each: "jobs", the word and the names, and, once there is an answer, "number", the word and the number; tabs in
// between, which no name has.
std::vector<Entry> read_ledger(const std::filesystem::path& file) {
  constexpr std::uintmax_t most = std::uintmax_t{1} << 30;
  std::vector<Entry> entries;
  std::error_code error;
  if (!std::filesystem::exists(file, error)) return entries;
  for (const std::string& line : split(read_text(file, most), '\n')) {
    const std::vector<std::string> pieces = split(line, '\t');
    if (pieces.size() < 3) continue;
    if (pieces[0] == "jobs") entries.push_back({pieces[1], {pieces.begin() + 2, pieces.end()}});
    if (pieces[0] == "number")
      for (Entry& entry : entries)
        if (entry.word == pieces[1]) entry.number = pieces[2];
  }
  return entries;
}

Ledger::Ledger(const std::filesystem::path& file, std::chrono::milliseconds patience)
    : file_(file), open_(::open(file.c_str(), O_RDWR | O_APPEND | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0666)) {
  if (!open_) throw file_failure("write", file, errno);
  using Clock = std::chrono::steady_clock;
  for (const auto until = Clock::now() + patience; ::flock(open_.number(), LOCK_EX | LOCK_NB) != 0;) {
    if (errno != EWOULDBLOCK && errno != EINTR) break;  // some network file systems have no locks
    if (Clock::now() >= until)
      throw MachineFailure(fmt::format("error: {} still submits jobs for {}: give the command again once it has ended",
                                       holder_of(file), file.parent_path().string()));
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  entries_ = read_ledger(file);
}

void Ledger::append(const std::string& line) {
  // Behind a line that a kill has torn it is a line of its own.
  const std::string text = "\n" + line + "\n";
  int error = write_all(open_.number(), text.data(), text.size());
  if (error == 0 && ::fsync(open_.number()) != 0) error = errno;
  if (error != 0) throw file_failure("write", file_, error);
}

std::string Ledger::intend(const std::vector<std::string>& jobs) {
  Entry entry{new_word(), jobs};
  append("jobs\t" + entry.word + "\t" + join(jobs, "\t"));
  entries_.push_back(entry);
  return entry.word;
}

void Ledger::answered(const std::string& word, const std::string& number) {
  append("number\t" + word + "\t" + number);
  for (Entry& entry : entries_)
    if (entry.word == word) entry.number = number;
}

void Ledger::clear() {
  if (::ftruncate(open_.number(), 0) != 0) throw file_failure("write", file_, errno);
  entries_.clear();
}

}  // namespace beadwork::slurm
