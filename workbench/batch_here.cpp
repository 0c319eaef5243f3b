// Runs as processes of this machine: started, listened to, waited for.

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <list>
#include <optional>
#include <set>

#include "core/base/failure.hpp"
#include "core/io/file.hpp"
#include "workbench/batch.hpp"
#include "workbench/progress.hpp"
#include "workbench/signals.hpp"
#include "workbench/terminal.hpp"

namespace beadwork {

pid_t start_program(const std::vector<std::string>& command, int also) {
  std::vector<char*> words;
  for (const std::string& word : command) words.push_back(const_cast<char*>(word.c_str()));
  words.push_back(nullptr);
  const pid_t parent = ::getpid();
  const pid_t child = ::fork();
  if (child != 0) return child;
  default_signals();
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (::getppid() != parent) ::_exit(127);  // it has ended already
  if (also >= 0 && also != inherited_descriptor) ::dup2(also, inherited_descriptor);
  if (also >= 0) ::fcntl(inherited_descriptor, F_SETFD, 0);
  ::execvp(words[0], words.data());
  ::_exit(127);
}

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

/// Whether some process is writing this folder.
bool is_busy(const fs::path& folder) {
  const Descriptor descriptor(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  return descriptor && ::flock(descriptor.number(), LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
}

struct Ended {
  BatchRun* run;
  int status;  // of waitpid
};

// Processes of this machine, so many at once, each of which tells how far it has come.
class Pool {
 public:
  explicit Pool(int at_once) : at_once_(static_cast<std::size_t>(at_once)) {}
  bool is_full() const { return running_.size() >= at_once_; }
  bool is_empty() const { return running_.empty(); }
  std::size_t size() const { return running_.size(); }

  void start(BatchRun& run) {
    std::vector<std::string> command = run.command;
    int ends[2] = {-1, -1};
    const bool told = ::socketpair(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0, ends) == 0;
    Descriptor ours(ends[0]);
    const Descriptor theirs(ends[1]);
    if (told) command.insert(command.end(), {"--tell", std::to_string(inherited_descriptor)});
    const pid_t child = start_program(command, theirs.number());
    if (child < 0)
      throw MachineFailure(fmt::format("error: cannot start {}: {}", command.front(), std::strerror(errno)));
    running_.push_back({child, &run, std::move(ours), 0});
  }

  /// Sleeps a little, shorter if a run tells something.
  void listen() {
    std::vector<pollfd> waiting;
    for (const Running& each : running_)
      if (each.ear) waiting.push_back({each.ear.number(), POLLIN, 0});
    ::poll(waiting.data(), waiting.size(), 50);
    for (Running& each : running_) {
      char text[64];
      ssize_t size;
      while (each.ear && (size = ::recv(each.ear.number(), text, sizeof text - 1, MSG_DONTWAIT)) > 0) {
        text[size] = 0;
        each.share = std::clamp(std::strtod(text, nullptr), each.share, 1.);
      }
      if (each.ear && size == 0) each.ear = Descriptor();
    }
  }

  std::optional<Ended> reap() {
    for (auto it = running_.begin(); it != running_.end(); ++it) {
      int status = 0;
      if (::waitpid(it->child, &status, WNOHANG) != it->child) continue;
      const Ended ended{it->run, status};
      running_.erase(it);
      return ended;
    }
    return std::nullopt;
  }

  /// Sum of how far each has come, 0 to 1.
  double shares() const {
    double sum = 0;
    for (const Running& each : running_) sum += each.share;
    return sum;
  }

  void note_rows() {
    for (const Running& each : running_) note_row(*each.run);
  }

  void ask_to_stop() const {
    for (const Running& each : running_) ::kill(each.child, SIGTERM);
  }

 private:
  struct Running {
    pid_t child;
    BatchRun* run;
    Descriptor ear;
    double share;
  };
  std::size_t at_once_;
  std::list<Running> running_;
};

class Here {
 public:
  Here(std::vector<BatchRun>& runs, int at_once, const std::vector<Variation>& variations, const fs::path& table)
      : runs_(runs), variations_(variations), table_(table), pool_(at_once) {
    for (BatchRun& run : runs_) {
      if (run.done || run.refused)
        ++ended_;
      else
        waiting_.push_back(&run);
    }
    all_ = waiting_.size();
  }

  /// Whatever fails on the way: no run is left to itself.
  void attend() {
    try {
      write();
      go();
    } catch (...) {
      stop();
      throw;
    }
  }

 private:
  void go() {
    bool asked = false;
    while (!pool_.is_empty() || (!interrupted && !waiting_.empty())) {
      if (!interrupted) start_some();
      if (interrupted && !asked) {
        pool_.ask_to_stop();
        asked = true;
      }
      pool_.listen();
      while (const auto ended = pool_.reap()) note_end(*ended);
      show();
    }
    for (BatchRun& run : runs_)
      if (!run.done && !run.refused && run.code < 0) note_row(run);
    write();
  }

  void stop() {
    progress_.hide();
    pool_.ask_to_stop();
    while (!pool_.is_empty()) {
      pool_.listen();
      while (pool_.reap()) {
      }
    }
  }

  // Runs that have ended are not read again: there may be many.
  void write() {
    pool_.note_rows();
    write_atomically(table_, batch_table(variations_, runs_));
  }

  void start_some() {
    if (Clock::now() < next_look_) return;
    bool busy = false;
    for (std::size_t k = waiting_.size(); k > 0 && !pool_.is_full(); --k) {
      BatchRun& run = *waiting_.front();
      waiting_.pop_front();
      if (is_busy(run.folder)) {
        if (elsewhere_.insert(&run).second)
          tell(fmt::format("{}: {} is still writing this run; waiting", run.name, holder_of(run.folder)));
        waiting_.push_back(&run);
        busy = true;
      } else if (elsewhere_.contains(&run) && is_done(run)) {
        run.code = 0;
        note_done(run, "done");
      } else {
        pool_.start(run);
      }
    }
    if (busy) next_look_ = Clock::now() + std::chrono::milliseconds(500);
  }

  void note_end(const Ended& ended) {
    BatchRun& run = *ended.run;
    const int status = ended.status;
    if (WIFEXITED(status))
      run.code = WEXITSTATUS(status);
    else
      run.code = static_cast<int>(ends_by_asking(WTERMSIG(status)) ? ExitCode::interrupted : ExitCode::machine);
    run.done = run.code == 0;
    next_look_ = {};
    const std::string log = (run.folder / "run.log").string();
    const std::string why =
        WIFSIGNALED(status) ? fmt::format("killed by signal {} ({})", WTERMSIG(status), ::strsignal(WTERMSIG(status)))
                            : fmt::format("exit code {}", run.code);
    if (run.code == static_cast<int>(ExitCode::interrupted))
      note_done(run, "interrupted, goes on when the same command is given again");
    else
      note_done(run, run.done ? "done" : fmt::format("{}, see {}", why, log));
  }

  void note_done(BatchRun& run, const std::string& how) {
    run.done = run.code == 0;
    run.results = results_of(run.folder);
    note_row(run);
    ++ended_;
    ++here_;
    tell(fmt::format("[{}/{}] {}: {}", ended_, runs_.size(), run.name, how));
    write();
  }

  void tell(const std::string& line) {
    progress_.hide();
    beadwork::say("{}\n", line);
    std::fflush(stdout);
  }

  void show() {
    if (all_ == 0) return;
    progress_.show({.work = "batch",
                    .detail = fmt::format("{} of {} runs done, {} at work", ended_, runs_.size(), pool_.size()),
                    .share = (static_cast<double>(here_) + pool_.shares()) / static_cast<double>(all_)});
  }

  std::vector<BatchRun>& runs_;
  const std::vector<Variation>& variations_;
  const fs::path table_;
  Pool pool_;
  std::deque<BatchRun*> waiting_;
  std::set<const BatchRun*> elsewhere_;  // at which another process is, or was
  std::size_t ended_ = 0, here_ = 0, all_ = 0;
  Clock::time_point next_look_;
  Progress progress_{[](const std::string& line) {
    beadwork::say("{}\n", line);
    std::fflush(stdout);
  }};
};

}  // namespace

void run_here(std::vector<BatchRun>& runs, int at_once, const std::vector<Variation>& variations,
              const fs::path& table) {
  heed_signals();
  Here(runs, at_once, variations, table).attend();
}

}  // namespace beadwork
