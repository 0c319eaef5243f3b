#include "core/loop/local_jobs.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <list>
#include <optional>
#include <set>
#include <utility>

#include "core/base/failure.hpp"
#include "core/base/processors.hpp"
#include "core/io/own_folder.hpp"

namespace beadwork {

namespace {

using Clock = std::chrono::steady_clock;

// What somebody handles does again what it did before; what is ignored stays ignored. Until it is another program.
void default_signals() {
  for (const int number : asking_signals()) {
    struct sigaction action {};
    if (::sigaction(number, nullptr, &action) != 0 || action.sa_handler == SIG_IGN) continue;
    action = {};
    action.sa_handler = SIG_DFL;
    ::sigaction(number, &action, nullptr);
  }
}

void fall_silent() {
  const int nowhere = ::open("/dev/null", O_WRONLY);
  if (nowhere < 0) return;
  ::dup2(nowhere, STDOUT_FILENO);
  ::dup2(nowhere, STDERR_FILENO);
}

JobEnd end_of(int status) {
  if (WIFEXITED(status)) return {WEXITSTATUS(status), fmt::format("exit code {}", WEXITSTATUS(status))};
  const int signal = WTERMSIG(status);
  const ExitCode code = ends_by_asking(signal) ? ExitCode::interrupted : ExitCode::machine;
  return {static_cast<int>(code), fmt::format("killed by signal {} ({})", signal, ::strsignal(signal))};
}

// Those at work, each of which tells how far it has come.
class Pool {
 public:
  Pool(int at_once, Voice voice) : at_once_(static_cast<std::size_t>(at_once)), voice_(voice) {}
  bool is_full() const { return running_.size() >= at_once_; }
  bool is_empty() const { return running_.empty(); }

  void start(std::size_t number, std::vector<std::string> command) {
    int ends[2] = {-1, -1};
    const bool told = ::socketpair(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0, ends) == 0;
    Descriptor ours(ends[0]);
    const Descriptor theirs(ends[1]);
    if (told) command.insert(command.end(), {"--tell", std::to_string(inherited_descriptor)});
    const pid_t child = start_program(command, theirs.number(), voice_);
    if (child < 0)
      throw MachineFailure(fmt::format("error: cannot start {}: {}", command.front(), std::strerror(errno)));
    running_.push_back({child, number, std::move(ours), 0});
  }

  /// Sleeps a little, shorter if one tells something or ends.
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

  std::optional<std::pair<std::size_t, JobEnd>> reap() {
    for (auto it = running_.begin(); it != running_.end(); ++it) {
      int status = 0;
      if (::waitpid(it->child, &status, WNOHANG) != it->child) continue;
      const std::size_t number = it->number;
      running_.erase(it);
      return std::pair(number, end_of(status));
    }
    return std::nullopt;
  }

  std::vector<JobShare> shares() const {
    std::vector<JobShare> all;
    for (const Running& each : running_) all.push_back({each.number, each.share});
    return all;
  }

  void ask_to_stop() const {
    for (const Running& each : running_) ::kill(each.child, SIGTERM);
  }

 private:
  struct Running {
    pid_t child;
    std::size_t number;
    Descriptor ear;
    double share;
  };
  std::size_t at_once_;
  Voice voice_;
  std::list<Running> running_;
};

class Attendant {
 public:
  Attendant(const std::vector<Job>& jobs, int at_once, Voice voice, const std::atomic<int>* interrupt,
            JobEvents& events)
      : jobs_(jobs), interrupt_(interrupt), events_(events), pool_(at_once, voice) {
    for (std::size_t k = 0; k < jobs.size(); ++k) waiting_.push_back(k);
  }

  void attend() {
    try {
      go();
    } catch (...) {
      stop();
      throw;
    }
  }

 private:
  bool is_interrupted() const { return interrupt_ && *interrupt_; }

  void go() {
    bool asked = false;
    while (!pool_.is_empty() || (!is_interrupted() && !waiting_.empty())) {
      if (!is_interrupted()) start_some();
      if (is_interrupted() && !asked) {
        pool_.ask_to_stop();
        asked = true;
      }
      pool_.listen();
      while (const auto ended = pool_.reap()) {
        next_look_ = {};
        events_.ended(ended->first, ended->second);
      }
      events_.at_work(pool_.shares());
    }
  }

  void stop() {
    pool_.ask_to_stop();
    while (!pool_.is_empty()) {
      pool_.listen();
      while (pool_.reap()) {
      }
    }
  }

  // In their order, as far as there is room: what has to wait keeps its place.
  void start_some() {
    if (Clock::now() < next_look_) return;
    std::deque<std::size_t> left;
    bool busy = false;
    for (const std::size_t number : std::exchange(waiting_, {})) {
      const Turn turn = pool_.is_full() ? Turn::later : events_.turn_of(number);
      if (turn == Turn::never) continue;
      if (turn == Turn::later) {
        left.push_back(number);
      } else if (is_busy(jobs_[number].folder)) {
        if (elsewhere_.insert(number).second)
          events_.is_held_up(number,
                             fmt::format("{} is still writing this run; waiting", holder_of(jobs_[number].folder)));
        left.push_back(number);
        busy = true;
      } else if (!elsewhere_.contains(number) || !events_.was_done_elsewhere(number)) {
        pool_.start(number, jobs_[number].command);
        events_.began(number);
      }
    }
    waiting_ = std::move(left);
    if (busy) next_look_ = Clock::now() + std::chrono::milliseconds(500);
  }

  const std::vector<Job>& jobs_;
  const std::atomic<int>* interrupt_;
  JobEvents& events_;
  Pool pool_;
  std::deque<std::size_t> waiting_;
  std::set<std::size_t> elsewhere_;  // at which another process is, or was
  Clock::time_point next_look_;
};

}  // namespace

const std::vector<int>& asking_signals() {
  static const std::vector<int> all{SIGINT, SIGTERM, SIGHUP, SIGUSR1, SIGXCPU};
  return all;
}

bool ends_by_asking(int number) {
  const std::vector<int>& all = asking_signals();
  return std::find(all.begin(), all.end(), number) != all.end();
}

pid_t start_program(const std::vector<std::string>& command, int also, Voice voice) {
  std::vector<char*> words;
  for (const std::string& word : command) words.push_back(const_cast<char*>(word.c_str()));
  words.push_back(nullptr);
  const pid_t parent = ::getpid();
  asking_signals();  // made before the fork
  const pid_t child = ::fork();
  if (child != 0) return child;
  default_signals();
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (::getppid() != parent) ::_exit(127);  // it has ended already
  if (voice == Voice::silent) fall_silent();
  if (also >= 0 && also != inherited_descriptor) ::dup2(also, inherited_descriptor);
  if (also >= 0) ::fcntl(inherited_descriptor, F_SETFD, 0);
  ::execvp(words[0], words.data());
  ::_exit(127);
}

void LocalJobs::run(const std::vector<Job>& jobs, JobEvents& events) {
  Attendant(jobs, at_once_, voice_, interrupt_, events).attend();
}

Shares Shares::among(std::size_t runs) const {
  const int allowed = allowed_processors();
  Shares shares = *this;
  if (shares.jobs == 0) shares.jobs = std::max(1, allowed / std::max(1, shares.threads));
  if (runs > 0) shares.jobs = static_cast<int>(std::min<std::size_t>(runs, static_cast<std::size_t>(shares.jobs)));
  if (shares.threads == 0) shares.threads = std::max(1, allowed / shares.jobs);
  return shares;
}

}  // namespace beadwork
