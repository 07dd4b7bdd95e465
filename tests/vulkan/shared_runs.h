// SPDX-License-Identifier: MIT
//
// Several tests of a GoogleTest program in one process, although ctest asks for them one by one.
// Starting a process and making its first device takes many times longer than most tests.
//
// The first process that is asked for a test of a group runs the whole group and keeps each test's
// result and output in the folder KAAMOS_SHARED_RUNS; the others take theirs from there. Whoever
// has to wait runs another group in the meantime. A group is so many neighbours in the program's
// list; tests on Vulkan and others do not share one. If a group crashes or is not done within the
// limit, the test that was running and those behind it run one by one. If it ends otherwise than
// its tests say, all of them do. Whoever sets
// KAAMOS_SHARED_RUNS empties the folder first: scripts/test does for each run of ctest.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace kaamos::test {

struct TestResult {
  bool passed = false;  // or skipped; the output says so
  std::string output;
};

// The parts of a group's output, one for each of `names` up to the first that did not begin or end.
std::vector<TestResult> split_output(const std::string& output,
                                     const std::vector<std::string>& names);

// The tests that a program lists for --gtest_list_tests, without disabled ones.
std::vector<std::string> parse_test_list(const std::string& listed);

class SharedRuns {
 public:
  // `folder` is that of this program's groups.
  SharedRuns(const std::string& folder, std::vector<char*> command, size_t share,
             double limit_seconds);

  // Empty if the test must run by itself.
  std::optional<TestResult> result_of(const std::string& name);
  // Returns the signals that ended groups which this process started.
  const std::vector<std::string>& crashes() const { return crashes_; }

 private:
  struct Group {
    std::string path;  // of its files, without their endings
    std::vector<std::string> names;
  };

  bool list_groups(bool on_vulkan);
  bool is_done(const Group& group) const;
  // Returns whether the group is done now: false if another process is at it.
  bool try_to_run(const Group& group);
  void run_group(const Group& group);
  bool run_another(const Group& than);

  std::string folder_;
  std::vector<char*> command_;
  size_t share_;
  double limit_seconds_;
  double start_seconds_;
  std::vector<Group> groups_;
  std::vector<std::string> crashes_;
};

}  // namespace kaamos::test
