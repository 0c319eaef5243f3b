#include "core/base/parallel.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace beadwork {
namespace {

TEST(parallel, each_shared_does_each_once_whether_few_or_many) {
  for (const int threads : {1, 2, 3}) {
    omp_set_num_threads(threads);
    for (const Index count : {0, 1, 4, 5, 1000}) {
      std::vector<int> done(static_cast<std::size_t>(count), 0);
      each_shared(count, [&](Index k) { ++done[static_cast<std::size_t>(k)]; }, 5);
      EXPECT_EQ(done, std::vector<int>(static_cast<std::size_t>(count), 1)) << threads << " threads";
    }
  }
}

TEST(parallel, few_are_left_to_one_thread) {
  omp_set_num_threads(2);
  std::vector<int> by(8, -1);
  each_shared(4, [&](Index k) { by[static_cast<std::size_t>(k)] = omp_in_parallel(); }, 5);
  EXPECT_EQ(by, (std::vector<int>{0, 0, 0, 0, -1, -1, -1, -1}));
  each_shared(8, [&](Index k) { by[static_cast<std::size_t>(k)] = omp_in_parallel(); }, 5);
  EXPECT_EQ(by, std::vector<int>(8, 1));
}

TEST(parallel, any_shared_finds_the_only_one) {
  omp_set_num_threads(2);
  for (const Index only : {0, 499, 999}) EXPECT_TRUE(any_shared(1000, [&](Index k) { return k == only; }));
  EXPECT_FALSE(any_shared(1000, [](Index) { return false; }));
  EXPECT_FALSE(any_shared(0, [](Index) { return true; }));
}

}  // namespace
}  // namespace beadwork
