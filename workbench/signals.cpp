#include "workbench/signals.hpp"

#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <cerrno>

#include "core/loop/local_jobs.hpp"

namespace beadwork {

std::atomic<int> interrupted{0};

namespace {

void note(int number) { interrupted = number; }

bool is_ignored(int number) {
  struct sigaction now {};
  return ::sigaction(number, nullptr, &now) == 0 && now.sa_handler == SIG_IGN;
}

void handle(int number, void (*with)(int)) {
  struct sigaction action {};
  action.sa_handler = with;
  action.sa_flags = SA_RESTART;
  ::sigemptyset(&action.sa_mask);
  ::sigaction(number, &action, nullptr);
}

}  // namespace

void hold_standard_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (::fcntl(stream, F_GETFD) < 0 && errno == EBADF && ::open("/dev/null", O_RDWR) != stream)
      ::_exit(1);  // takes the lowest free number
}

void heed_signals() {
  for (const int number : asking_signals())
    if (number != SIGHUP || !is_ignored(SIGHUP)) handle(number, note);
  for (const int number : {SIGPIPE, SIGXFSZ}) handle(number, SIG_IGN);
}

}  // namespace beadwork
