#include "workbench/slurm/tool.hpp"

#include <fmt/format.h>
#include <signal.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <string_view>

#include "core/base/failure.hpp"
#include "core/io/file.hpp"
#include "core/loop/local_jobs.hpp"

extern char** environ;  // NOLINT: the name is the system's

namespace beadwork::slurm {

namespace {

// A file in memory: no pipe to be emptied while the program writes, and none that breaks.
Descriptor memory(const char* name, std::string_view text = "") {
  Descriptor file(::memfd_create(name, MFD_CLOEXEC));
  const int error = file ? write_all(file.number(), text.data(), text.size()) : errno;
  if (error != 0) throw MachineFailure(fmt::format("error: cannot start a program: {}", std::strerror(error)));
  ::lseek(file.number(), 0, SEEK_SET);
  return file;
}

std::string text_of(const Descriptor& file) {
  std::string text;
  char piece[65536];
  ::lseek(file.number(), 0, SEEK_SET);
  for (ssize_t size; (size = ::read(file.number(), piece, sizeof piece)) > 0;)
    text.append(piece, static_cast<std::size_t>(size));
  return text;
}

// How it is started: with the signals as they are for a fresh program, and apart from those of the terminal.
class Start {
 public:
  Start() {
    ::posix_spawn_file_actions_init(&files);
    ::posix_spawnattr_init(&attributes);
    sigset_t all;
    ::sigemptyset(&all);
    for (const int number : asking_signals()) ::sigaddset(&all, number);
    for (const int number : {SIGPIPE, SIGXFSZ}) ::sigaddset(&all, number);
    ::posix_spawnattr_setsigdefault(&attributes, &all);
    ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP);
  }
  Start(const Start&) = delete;
  Start& operator=(const Start&) = delete;
  ~Start() {
    ::posix_spawn_file_actions_destroy(&files);
    ::posix_spawnattr_destroy(&attributes);
  }
  posix_spawn_file_actions_t files;
  posix_spawnattr_t attributes;
};

int code_of(pid_t child) {
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace

bool is_of_slurm(const std::string& variable) {
  // Where Slurm is, and who one is there, holds inside of a job as well.
  for (const std::string_view kept : {"SLURM_CONF=", "SLURM_CONF_SERVER=", "SLURM_JWT="})
    if (variable.starts_with(kept)) return false;
  for (const std::string_view prefix :
       {"SLURM_", "SLURMD_", "SBATCH_", "SRUN_", "SALLOC_", "SQUEUE_", "SACCT_", "SCONTROL_", "SCANCEL_"})
    if (variable.starts_with(prefix)) return true;
  return false;
}

Answer ask(const std::vector<std::string>& command, const std::string& input, int kept) {
  std::vector<char*> words, variables;
  for (const std::string& word : command) words.push_back(const_cast<char*>(word.c_str()));
  words.push_back(nullptr);
  for (char** each = environ; *each; ++each)
    if (!is_of_slurm(*each)) variables.push_back(*each);
  variables.push_back(nullptr);
  const Descriptor in = memory("input", input), out = memory("output"), error = memory("error");
  Start start;
  ::posix_spawn_file_actions_adddup2(&start.files, in.number(), STDIN_FILENO);
  ::posix_spawn_file_actions_adddup2(&start.files, out.number(), STDOUT_FILENO);
  ::posix_spawn_file_actions_adddup2(&start.files, error.number(), STDERR_FILENO);
  if (kept >= 0) ::posix_spawn_file_actions_adddup2(&start.files, kept, kept);  // no longer closed by exec
  pid_t child = -1;
  const int failure = ::posix_spawnp(&child, words[0], &start.files, &start.attributes, words.data(), variables.data());
  if (failure == ENOENT) return {127, "", ""};
  if (failure != 0) return {-1, "", std::strerror(failure)};
  const int code = code_of(child);
  return {code, text_of(out), text_of(error)};
}

}  // namespace beadwork::slurm
