#include "core/base/processors.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <map>

#include "tests/support/scratch.hpp"

namespace beadwork {
namespace {

namespace fs = std::filesystem;

// A machine of 16 processors with the files and variables that a test gives it.
class Processors : public ::testing::Test {
 protected:
  void write(const std::string& file, const std::string& text) {
    fs::create_directories((root_ / file).parent_path());
    std::ofstream(root_ / file) << text;
  }
  int allowed() {
    Limits limits;
    limits.root = root_;
    limits.affinity = 16;
    limits.variable = [this](const char* name) { return variables_.contains(name) ? variables_[name] : nullptr; };
    return allowed_processors(limits);
  }
  std::map<std::string, const char*> variables_;

 private:
  testing::Scratch scratch_;
  fs::path root_ = scratch_.path();
};

TEST_F(Processors, are_those_that_the_scheduler_grants) { EXPECT_EQ(allowed(), 16); }

TEST_F(Processors, follow_the_quota_of_a_control_group) {
  write("proc/self/cgroup", "0::/job/step\n");
  write("sys/fs/cgroup/job/step/cpu.max", "max 100000\n");
  EXPECT_EQ(allowed(), 16);
  write("sys/fs/cgroup/job/step/cpu.max", "400000 100000\n");
  EXPECT_EQ(allowed(), 4);
  write("sys/fs/cgroup/job/cpu.max", "150000 100000\n");  // of the group around it
  EXPECT_EQ(allowed(), 2);
  write("sys/fs/cgroup/job/cpu.max", "5000 100000\n");
  EXPECT_EQ(allowed(), 1);
}

TEST_F(Processors, follow_the_quota_of_a_container_that_does_not_see_its_path) {
  write("proc/self/cgroup", "0::/../../docker/4711\n");
  write("sys/fs/cgroup/cpu.max", "300000 100000\n");
  EXPECT_EQ(allowed(), 3);
}

TEST_F(Processors, follow_the_quota_of_the_first_version_of_groups) {
  write("proc/self/cgroup", "12:memory:/m\n4:cpu,cpuacct:/batch\n2:cpuset:/\n");
  write("sys/fs/cgroup/cpu,cpuacct/batch/cpu.cfs_quota_us", "250000\n");
  write("sys/fs/cgroup/cpu,cpuacct/batch/cpu.cfs_period_us", "50000\n");
  EXPECT_EQ(allowed(), 5);
  write("sys/fs/cgroup/cpu,cpuacct/batch/cpu.cfs_quota_us", "-1\n");
  EXPECT_EQ(allowed(), 16);
  write("sys/fs/cgroup/cpu/cpu.cfs_quota_us", "200000\n");
  write("sys/fs/cgroup/cpu/cpu.cfs_period_us", "100000\n");
  EXPECT_EQ(allowed(), 2);
}

TEST_F(Processors, follow_what_the_user_and_the_queue_say) {
  variables_["OMP_NUM_THREADS"] = "6,2";
  EXPECT_EQ(allowed(), 6);
  variables_["SLURM_CPUS_PER_TASK"] = "3";
  EXPECT_EQ(allowed(), 3);
  variables_["SLURM_CPUS_PER_TASK"] = "64";  // more than there are
  EXPECT_EQ(allowed(), 6);
}

TEST_F(Processors, take_no_notice_of_what_is_no_number) {
  for (const char* odd : {"", "many", "0", "-3", "4x", "99999999999999999999"}) {
    variables_["OMP_NUM_THREADS"] = odd;
    EXPECT_EQ(allowed(), 16) << odd;
  }
  write("proc/self/cgroup", "0\n::\n0::\nnonsense");
  write("sys/fs/cgroup/cpu.max", "0 0\n");
  EXPECT_EQ(allowed(), 16);
}

TEST(processors, of_this_process_are_at_least_one) { EXPECT_GE(allowed_processors(), 1); }

}  // namespace
}  // namespace beadwork
