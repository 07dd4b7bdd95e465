// SPDX-License-Identifier: MIT
#include "shared_runs.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <thread>

#include "child_process.h"

namespace kaamos::test {
namespace {

namespace fs = std::filesystem;

constexpr const char* kBegins = "[ RUN      ] ";

std::string read_file(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

// Whole or not at all.
bool write_file(const std::string& path, const std::string& text) {
  const std::string part = path + "." + std::to_string(getpid());
  {
    std::ofstream out(part, std::ios::binary);
    out << text;
    out.flush();
    if (!out) return false;
  }
  std::error_code failed;
  fs::rename(part, path, failed);
  return !failed;
}

// A file that one process at a time holds.
class Lock {
 public:
  Lock(const std::string& path, bool wait)
      : file_(open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644)) {
    held_ = file_ >= 0 && flock(file_, wait ? LOCK_EX : LOCK_EX | LOCK_NB) == 0;
  }
  ~Lock() {
    if (file_ >= 0) close(file_);
  }
  Lock(const Lock&) = delete;
  Lock& operator=(const Lock&) = delete;
  bool held() const { return held_; }

 private:
  int file_;
  bool held_ = false;
};

bool is_on_vulkan(std::string name) {
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  return name.find("vulkan") != std::string::npos;
}

// Returns where `mark` stands with the whole name behind it, from `start` on.
size_t find_mark(const std::string& output, const char* mark, const std::string& name,
                 size_t start) {
  const std::string wanted = mark + name;
  for (size_t at = output.find(wanted, start); at != std::string::npos;
       at = output.find(wanted, at + 1)) {
    const size_t end = at + wanted.size();
    if (end < output.size() && std::strchr(" ,\n", output[end]) != nullptr) return at;
  }
  return std::string::npos;
}

int run_words(const std::vector<char*>& command, const std::string& option, double limit_seconds,
              const std::string& output) {
  std::vector<char*> words = {command[0]};
  for (size_t i = 1; i < command.size(); ++i) {
    if (std::strncmp(command[i], "--gtest_filter=", 15) != 0) words.push_back(command[i]);
  }
  words.push_back(const_cast<char*>(option.c_str()));
  words.push_back(nullptr);
  return run(words.data(), limit_seconds, output);
}

}  // namespace

std::vector<std::string> parse_test_list(const std::string& listed) {
  std::vector<std::string> names;
  std::string suite;
  std::stringstream lines(listed);
  for (std::string line; std::getline(lines, line);) {
    line.resize(std::min(line.size(), line.find("  #")));
    if (line.size() > 2 && line.compare(0, 2, "  ") == 0) {
      const std::string name = suite + line.substr(2);
      if (!suite.empty() && name.find("DISABLED_") == std::string::npos) names.push_back(name);
    } else {
      suite = !line.empty() && line.back() == '.' ? line : "";
    }
  }
  return names;
}

std::vector<TestResult> split_output(const std::string& output,
                                     const std::vector<std::string>& names) {
  std::vector<TestResult> results;
  size_t at = 0;
  for (const std::string& name : names) {
    const size_t begin = find_mark(output, kBegins, name, at);
    if (begin == std::string::npos) break;
    const size_t ok = find_mark(output, "[       OK ] ", name, begin);
    const size_t failed = find_mark(output, "[  FAILED  ] ", name, begin);
    const size_t skipped = find_mark(output, "[  SKIPPED ] ", name, begin);
    const size_t end = std::min({ok, failed, skipped});
    if (end == std::string::npos) break;
    at = std::min(output.find('\n', end), output.size() - 1) + 1;
    results.push_back({end != failed, output.substr(begin, at - begin)});
  }
  return results;
}

SharedRuns::SharedRuns(const std::string& folder, std::vector<char*> command, size_t share,
                       double limit_seconds)
    : folder_(folder),
      command_(std::move(command)),
      share_(share),
      limit_seconds_(limit_seconds),
      start_seconds_(now_seconds()) {}

bool SharedRuns::list_groups(bool on_vulkan) {
  std::error_code failed;
  fs::create_directories(folder_, failed);
  const std::string list = folder_ + "/tests";
  {
    const Lock lock(folder_ + "/tests.lock", true);
    if (!lock.held()) return false;
    if (!fs::exists(list, failed)) {
      const std::string part = list + ".part";
      if (run_words(command_, "--gtest_list_tests", limit_seconds_, part) != 0) return false;
      fs::rename(part, list, failed);
    }
  }
  const std::string kind = on_vulkan ? "/vulkan-" : "/group-";
  for (const std::string& name : parse_test_list(read_file(list))) {
    if (is_on_vulkan(name) != on_vulkan) continue;
    if (groups_.empty() || groups_.back().names.size() >= share_) {
      groups_.push_back({folder_ + kind + std::to_string(groups_.size()), {}});
    }
    groups_.back().names.push_back(name);
  }
  return true;
}

bool SharedRuns::is_done(const Group& group) const {
  std::error_code ignored;
  return fs::exists(group.path + ".done", ignored);
}

void SharedRuns::run_group(const Group& group) {
  std::string filter = "--gtest_filter=";
  for (const std::string& name : group.names) filter += name + ":";
  filter.pop_back();
  const int status = run_words(command_, filter, limit_seconds_, group.path + ".output");
  // A group that runs out of time may just be many slow tests; one that hangs does so alone, too.
  if (crashed(status) && status != -1) {
    crashes_.push_back("or another of " + std::to_string(group.names.size()) +
                       " tests in its process " + describe(status, limit_seconds_));
  }
  const std::string output = read_file(group.path + ".output");
  const auto results = split_output(output, group.names);
  bool kept = false;
  if (crashed(status)) {
    // The fault is that of the test that had begun. Without one, it may be that of any of them.
    kept = results.size() < group.names.size() &&
           find_mark(output, kBegins, group.names[results.size()], 0) != std::string::npos;
  } else {
    const bool all_passed =
        std::all_of(results.begin(), results.end(), [](const TestResult& r) { return r.passed; });
    kept = results.size() == group.names.size() && (WEXITSTATUS(status) == 0) == all_passed;
  }
  for (size_t i = 0; kept && i < results.size(); ++i) {
    write_file(group.path + "." + std::to_string(i),
               (results[i].passed ? "passed\n" : "failed\n") + results[i].output);
  }
  write_file(group.path + ".done", "");
}

bool SharedRuns::try_to_run(const Group& group) {
  const Lock lock(group.path + ".lock", false);
  if (!lock.held()) return false;
  if (!is_done(group)) run_group(group);
  return true;
}

bool SharedRuns::run_another(const Group& than) {
  if (now_seconds() - start_seconds_ > limit_seconds_ / 2) return false;
  for (const Group& group : groups_) {
    if (&group != &than && !is_done(group) && try_to_run(group)) return true;
  }
  return false;
}

std::optional<TestResult> SharedRuns::result_of(const std::string& name) {
  if (!list_groups(is_on_vulkan(name))) return std::nullopt;
  for (const Group& group : groups_) {
    const auto found = std::find(group.names.begin(), group.names.end(), name);
    if (found == group.names.end()) continue;
    while (!is_done(group) && !try_to_run(group)) {
      if (!run_another(group)) std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    const auto index = static_cast<size_t>(found - group.names.begin());
    const std::string text = read_file(group.path + "." + std::to_string(index));
    const size_t line = text.find('\n');
    if (line == std::string::npos) return std::nullopt;
    return TestResult{text.substr(0, line) == "passed", text.substr(line + 1)};
  }
  return std::nullopt;
}

}  // namespace kaamos::test
