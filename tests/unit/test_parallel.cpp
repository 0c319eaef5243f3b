#include "core/base/parallel.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <mutex>
#include <numeric>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

namespace beadwork {
namespace {

TEST(parallel, each_shared_does_each_once_whether_few_or_many) {
  for (const int threads : {1, 2, 3, 16}) {
    use_threads(threads);
    for (const Index count : {0, 1, 4, 5, 31, 1000, 100000}) {
      std::vector<int> done(static_cast<std::size_t>(count), 0);
      each_shared(
          count, [&](Index k) { ++done[static_cast<std::size_t>(k)]; }, 5);
      EXPECT_EQ(done, std::vector<int>(static_cast<std::size_t>(count), 1)) << threads << " threads";
    }
  }
}

TEST(parallel, few_are_left_to_one_thread) {
  use_threads(2);
  std::vector<int> by(8, -1);
  each_shared(
      4, [&](Index k) { by[static_cast<std::size_t>(k)] = in_shared_loop(); }, 5);
  EXPECT_EQ(by, (std::vector<int>{0, 0, 0, 0, -1, -1, -1, -1}));
  each_shared(
      8, [&](Index k) { by[static_cast<std::size_t>(k)] = in_shared_loop(); }, 5);
  EXPECT_EQ(by, std::vector<int>(8, 1));
  EXPECT_FALSE(in_shared_loop());
}

// Loops so short that helpers come too late, and so long that they fall asleep in between: each sees what the one
// before it has left.
TEST(parallel, one_loop_is_done_before_the_next_begins) {
  for (const int threads : {2, 5}) {
    use_threads(threads);
    std::vector<std::int64_t> value(64, 0), before(64, 0);
    for (std::int64_t round = 1; round <= 20000; ++round) {
      each_shared(Index{64}, [&](Index k) {
        value[static_cast<std::size_t>(k)] = before[static_cast<std::size_t>((k + 17) % 64)] + 1;
      });
      each_shared(Index{64},
                  [&](Index k) { before[static_cast<std::size_t>(k)] = value[static_cast<std::size_t>(k)]; });
      if (round % 1000 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    EXPECT_EQ(before, std::vector<std::int64_t>(64, 20000));
  }
}

TEST(parallel, the_threads_take_part) {
  use_threads(3);
  std::set<std::thread::id> there;
  std::mutex adding;
  for (int go = 0; go < 1000 && there.size() < 3; ++go)
    each_shared(300, [&](int) {
      for (volatile int k = 0; k < 10000; k = k + 1) {
      }
      const std::lock_guard lock(adding);
      there.insert(std::this_thread::get_id());
    });
  EXPECT_EQ(there.size(), 3u);
}

TEST(parallel, a_loop_inside_a_loop_is_left_to_the_thread_that_meets_it) {
  use_threads(3);
  std::vector<int> done(400, 0);
  each_shared(20, [&](int i) {
    const auto mine = std::this_thread::get_id();
    each_shared(20, [&](int j) { done[static_cast<std::size_t>(20 * i + j)] += std::this_thread::get_id() == mine; });
  });
  EXPECT_EQ(done, std::vector<int>(400, 1));
}

TEST(parallel, two_threads_may_share_loops_at_one_time) {
  use_threads(3);
  std::vector<std::int64_t> sums(4);
  std::vector<std::thread> callers;
  for (std::int64_t& sum : sums)
    callers.emplace_back([&sum] {
      for (int go = 0; go < 200; ++go)
        sum += sum_shared<std::int64_t>(1000, 7, [](int begin, int end, std::int64_t& part) {
          for (int k = begin; k < end; ++k) part += k;
        });
    });
  for (std::thread& caller : callers) caller.join();
  EXPECT_EQ(sums, std::vector<std::int64_t>(4, 200 * 499500));
}

// What the first of all threw, as without threads; and the team goes on afterwards.
TEST(parallel, what_a_loop_throws_is_thrown_again) {
  for (const int threads : {1, 2, 7}) {
    use_threads(threads);
    for (int go = 0; go < 50; ++go) try {
        each_shared(1000, [](int k) {
          if (k >= 333 && k % 3 == 0) throw std::runtime_error(std::to_string(k));
        });
        ADD_FAILURE() << "nothing was thrown";
      } catch (const std::runtime_error& error) {
        EXPECT_STREQ(error.what(), "333");
      }
    EXPECT_THROW(each_shared(10, [](int) { throw 42; }), int);
    std::vector<int> done(1000, 0);
    each_shared(1000, [&](int k) { ++done[static_cast<std::size_t>(k)]; });
    EXPECT_EQ(std::accumulate(done.begin(), done.end(), 0), 1000);
  }
}

TEST(parallel, any_shared_finds_the_only_one) {
  use_threads(2);
  for (const Index only : {0, 499, 999}) EXPECT_TRUE(any_shared(1000, [&](Index k) { return k == only; }));
  EXPECT_FALSE(any_shared(1000, [](Index) { return false; }));
  EXPECT_FALSE(any_shared(0, [](Index) { return true; }));
}

TEST(parallel, sum_shared_gives_the_same_bits_with_any_number_of_threads) {
  const auto sum = [] {
    return sum_shared<Real>(100001, 512, [](int begin, int end, Real& part) {
      for (int k = begin; k < end; ++k) part += 1. / (1 + k);
    });
  };
  use_threads(1);
  const Real alone = sum();
  EXPECT_NEAR(alone, std::log(100001.) + 0.5772156649, 1e-5);
  for (const int threads : {2, 3, 8}) {
    use_threads(threads);
    EXPECT_EQ(alone, sum());
  }
}

}  // namespace
}  // namespace beadwork
