#include "core/base/parallel.hpp"

#include <signal.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <limits>
#include <memory>
#include <mutex>
#include <system_error>
#include <thread>

#include "core/base/processors.hpp"

namespace beadwork {

namespace {

thread_local bool inside = false;

void relax() {
#if defined(__x86_64__)
  __builtin_ia32_pause();
#elif defined(__aarch64__)
  asm volatile("yield");
#endif
}

// How long a thread looks for what it waits for before it goes to sleep. The next loop of a step comes within
// microseconds, and to be woken takes longer than that; but where other programs want the processor, what is waited for
// cannot come while one looks. So the time halves whenever it was in vain, and doubles when it was not.
class Patience {
 public:
  explicit Patience(bool any) : most_(any ? 100'000 : 0), now_(most_) {}

  template <class Done>
  bool wait(const Done& done) {
    if (done()) return true;
    const auto began = Clock::now();
    while (Clock::now() - began < std::chrono::nanoseconds(now_)) {
      for (int k = 0; k < 16; ++k) {
        relax();
        if (!done()) continue;
        now_ = std::min(most_, 2 * now_);
        return true;
      }
    }
    now_ = std::max(std::min(most_, least), now_ / 2);
    return false;
  }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr int least = 2'000;
  int most_, now_;  // [ns]
};

// One thread leads: it opens the gate for a loop, does its part, closes the gate and waits for those that came in. A
// helper that sleeps, or that has no processor, does not come in, and nobody waits for it: each thread has pieces of
// its own, so that it finds in its cache what it has left there, and then takes those that others have not begun.
class Team {
 public:
  explicit Team(int size)
      : own_(static_cast<std::size_t>(size)), spins_(size <= allowed_processors()), patience_(spins_) {
    sigset_t all, before;  // signals are for the thread that leads
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    try {
      for (int t = 1; t < size; ++t) helpers_.emplace_back([this, t] { help(static_cast<std::size_t>(t)); });
    } catch (const std::system_error&) {  // fewer threads, then
    }
    pthread_sigmask(SIG_SETMASK, &before, nullptr);
  }
  ~Team() {
    ends_ = true;
    gate_ = next_generation();
    ring();
    for (std::thread& helper : helpers_) helper.join();
  }

  void share(std::int64_t count, void (*piece)(const void*, std::int64_t, std::int64_t), const void* loop) {
    const auto size = static_cast<std::int64_t>(helpers_.size()) + 1;
    count_ = count, piece_ = piece, loop_ = loop;
    pieces_ = std::min(count, pieces_each * size);
    for (std::int64_t t = 0; t < size; ++t) {
      Own& own = own_[static_cast<std::size_t>(t)];
      own.end = pieces_ * (t + 1) / size;
      own.next.store(pieces_ * t / size, std::memory_order_relaxed);
    }
    failed_at_ = std::numeric_limits<std::int64_t>::max();
    gate_ = next_generation() | open;
    ring();
    work(0);
    gate_ &= ~open;
    wait_for_helpers();
    if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
  }

 private:
  // So fine that the one who is done early finds something left to do, so coarse that to take one costs nothing.
  static constexpr std::int64_t pieces_each = 32;
  // The gate: which loop it is (above), whether it is open, and how many helpers are inside (below).
  static constexpr std::uint64_t open = std::uint64_t{1} << 31;
  static std::uint64_t inside_of(std::uint64_t gate) { return gate & (open - 1); }
  static std::uint32_t generation_of(std::uint64_t gate) { return static_cast<std::uint32_t>(gate >> 32); }
  std::uint64_t next_generation() const {
    return (gate_.load(std::memory_order_relaxed) / (2 * open) + 1) * (2 * open);
  }

  struct alignas(128) Own {
    std::atomic<std::int64_t> next{0};
    std::int64_t end = 0;
  };

  void ring() {
    bell_.fetch_add(1);
    if (asleep_ > 0) bell_.notify_all();
  }

  void help(std::size_t thread) {
    Patience patience(spins_);
    std::uint32_t seen = 0;
    const auto called = [&] { return generation_of(gate_.load(std::memory_order_acquire)) != seen; };
    while (true) {
      if (!patience.wait(called)) sleep_until(called);
      std::uint64_t gate = gate_;
      seen = generation_of(gate);
      if (ends_) return;
      while ((gate & open) != 0 && generation_of(gate) == seen)
        if (gate_.compare_exchange_weak(gate, gate + 1)) {
          work(thread);
          leave();
          break;
        }
    }
  }

  template <class Called>
  void sleep_until(const Called& called) {
    ++asleep_;
    for (std::uint32_t rung = bell_; !called(); rung = bell_) bell_.wait(rung);
    --asleep_;
  }

  void leave() {
    const std::uint64_t before = gate_.fetch_sub(1);
    if (inside_of(before) != 1 || !leader_sleeps_) return;
    left_.fetch_add(1);
    left_.notify_one();
  }

  void wait_for_helpers() {
    const auto alone = [&] { return inside_of(gate_) == 0; };
    if (patience_.wait(alone)) return;
    leader_sleeps_ = true;
    for (std::uint32_t left = left_; !alone(); left = left_) left_.wait(left);
    leader_sleeps_ = false;
  }

  void work(std::size_t thread) {
    inside = true;
    for (std::size_t k = 0; k < own_.size(); ++k) {
      Own& own = own_[(thread + k) % own_.size()];
      while (own.next.load(std::memory_order_relaxed) < own.end) {
        const std::int64_t p = own.next.fetch_add(1, std::memory_order_relaxed);
        if (p < own.end) attempt(count_ * p / pieces_, count_ * (p + 1) / pieces_);
      }
    }
    inside = false;
  }

  void attempt(std::int64_t begin, std::int64_t end) try { piece_(loop_, begin, end); } catch (...) {
    const std::lock_guard lock(failing_);
    if (begin >= failed_at_) return;
    failed_at_ = begin;
    failure_ = std::current_exception();
  }

  std::vector<Own> own_;
  const bool spins_;
  Patience patience_;
  std::int64_t count_ = 0, pieces_ = 0;
  void (*piece_)(const void*, std::int64_t, std::int64_t) = nullptr;
  const void* loop_ = nullptr;
  std::mutex failing_;
  std::int64_t failed_at_ = 0;
  std::exception_ptr failure_;
  alignas(128) std::atomic<std::uint64_t> gate_{0};
  alignas(128) std::atomic<std::uint32_t> bell_{0};
  std::atomic<int> asleep_{0};
  std::atomic<std::uint32_t> left_{0};
  std::atomic<bool> leader_sleeps_{false}, ends_{false};
  std::vector<std::thread> helpers_;
};

std::mutex leading;
std::unique_ptr<Team> team;
std::atomic<int> wanted{0};

}  // namespace

void use_threads(int count) {
  const std::lock_guard lock(leading);
  count = std::max(1, count);
  if (count == wanted) return;
  wanted = count;
  team.reset();
}

int threads_in_use() {
  const int count = wanted.load(std::memory_order_relaxed);
  if (count > 0) return count;
  use_threads(allowed_processors());
  return wanted;
}

bool in_shared_loop() { return inside; }

void parallel::share(std::int64_t count, void (*piece)(const void*, std::int64_t, std::int64_t), const void* loop) {
  if (inside) return piece(loop, 0, count);
  threads_in_use();  // decides how many, where nobody has; it takes the lock for that
  const std::unique_lock lock(leading, std::try_to_lock);
  if (!lock.owns_lock()) return piece(loop, 0, count);  // another thread leads already
  if (!team) team = std::make_unique<Team>(wanted);
  team->share(count, piece, loop);
}

}  // namespace beadwork
