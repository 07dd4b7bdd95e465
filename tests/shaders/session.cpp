// SPDX-License-Identifier: MIT
#include "tests/shaders/session.h"

#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <optional>

#include "runtime/coverage/collector.h"

namespace kaamos::shader_tests {
namespace {

using Clock = std::chrono::steady_clock;

// What the child tells: a letter, the number of the test, and text, each message with its length
// before it.
enum class Word : char {
  kError = 'E',   // the text says why nothing runs; test 1: the machine lacks the device
  kReady = 'R',   // compiled
  kBegin = 'B',   // of a test
  kOutput = 'O',  // the three kinds of Report
  kFailure = 'F',
  kSkipped = 'S',
  kEnd = 'D',
};

struct Header {
  uint32_t bytes;
  uint32_t test;
  char word;
};

void write_all(int file, const void* bytes, size_t count) {
  const auto* at = static_cast<const char*>(bytes);
  while (count != 0) {
    const ssize_t written = write(file, at, count);
    if (written <= 0) _exit(1);  // nobody listens
    at += written;
    count -= static_cast<size_t>(written);
  }
}

void tell(int file, Word word, size_t test, const std::string& text = {}) {
  Header header = {};
  header.bytes = static_cast<uint32_t>(text.size());
  header.test = static_cast<uint32_t>(test);
  header.word = static_cast<char>(word);
  write_all(file, &header, sizeof header);
  write_all(file, text.data(), text.size());
}

Word word_of(Report::Kind kind) {
  return kind == Report::Kind::kOutput    ? Word::kOutput
         : kind == Report::Kind::kFailure ? Word::kFailure
                                          : Word::kSkipped;
}

[[noreturn]] void be_child(int file, const Source& source, const std::vector<const TestRun*>& runs,
                           size_t first, const std::string& executor) {
  Runner runner(source, executor);
  const std::string error = runner.prepare();
  if (!error.empty()) {
    tell(file, Word::kError, runner.has_no_device() ? 1 : 0, error);
    _exit(0);
  }
  tell(file, Word::kReady, 0);
  (void)coverage::write();
  for (size_t i = first; i < runs.size(); ++i) {
    tell(file, Word::kBegin, i);
    runner.run(*runs[i],
               [&](const Report& report) { tell(file, word_of(report.kind), i, report.text); });
    // At once, because the next test may end the process. Whether it can be written was tried.
    (void)coverage::write();
    tell(file, Word::kEnd, i);
  }
  // Without destructors: some drivers end slowly, and nothing is left to write.
  _exit(0);
}

// A child and what it says.
class Child {
 public:
  Child(const Source& source, const std::vector<const TestRun*>& runs, size_t first,
        const std::string& executor) {
    int ends[2];
    if (pipe(ends) != 0) return;
    std::fflush(nullptr);
    process_ = fork();
    if (process_ == 0) {
      close(ends[0]);
      be_child(ends[1], source, runs, first, executor);
    }
    close(ends[1]);
    file_ = ends[0];
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  ~Child() {
    if (file_ >= 0) close(file_);
    if (process_ > 0) {
      kill(process_, SIGKILL);
      waitpid(process_, nullptr, 0);
    }
  }

  bool started() const { return process_ > 0; }

  struct Message {
    Word word;
    size_t test;
    std::string text;
  };
  // Empty if it has ended, or said nothing until `deadline`.
  std::optional<Message> next(Clock::time_point deadline) {
    Header header = {};
    if (!read_all(&header, sizeof header, deadline)) return std::nullopt;
    Message out = {static_cast<Word>(header.word), header.test, std::string(header.bytes, '\0')};
    if (!read_all(out.text.data(), header.bytes, deadline)) return std::nullopt;
    return out;
  }
  bool timed_out() const { return timed_out_; }

  // How it ended: "a fault (Segmentation fault)".
  std::string end() {
    int status = 0;
    waitpid(process_, &status, 0);
    process_ = -1;
    if (WIFSIGNALED(status)) {
      return std::string("the process ended: ") + strsignal(WTERMSIG(status));
    }
    return "the process ended with code " + std::to_string(WEXITSTATUS(status));
  }

 private:
  bool read_all(void* bytes, size_t count, Clock::time_point deadline) {
    auto* at = static_cast<char*>(bytes);
    while (count != 0) {
      const auto left =
          std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now()).count();
      pollfd wait = {file_, POLLIN, 0};
      if (left <= 0 || poll(&wait, 1, static_cast<int>(left) + 1) == 0) {
        timed_out_ = true;
        return false;
      }
      const ssize_t got = read(file_, at, count);
      if (got <= 0) return false;
      at += got;
      count -= static_cast<size_t>(got);
    }
    return true;
  }

  pid_t process_ = -1;
  int file_ = -1;
  bool timed_out_ = false;
};

class Session {
 public:
  Session(const Source& source, const std::vector<const TestRun*>& runs, std::string executor,
          double timeout_seconds)
      : source_(source), runs_(runs), executor_(std::move(executor)), timeout_(timeout_seconds) {}

  SessionResult run() {
    for (const TestRun* test : runs_) out_.results.push_back({test, executor_});
    size_t first = 0;
    while (first < runs_.size() && out_.error.empty()) first = run_from(first);
    return std::move(out_);
  }

 private:
  // Returns the first test that has not run.
  size_t run_from(size_t first) {
    Child child(source_, runs_, first, executor_);
    if (!child.started()) {
      out_.error = "no process can be started";
      return first;
    }
    // Compiling native code takes the C++ compiler's time.
    constexpr std::chrono::seconds kToCompile{600};
    Clock::time_point deadline = Clock::now() + kToCompile;
    Clock::time_point begin;
    size_t running = first;
    bool is_ready = false;
    while (const auto message = child.next(deadline)) {
      if (message->word == Word::kError) {
        out_.error = message->text;
        out_.has_no_device = message->test == 1;
        return first;
      }
      TestResult& result = out_.results[message->test];
      switch (message->word) {
        case Word::kError:
          break;
        case Word::kReady:
          is_ready = true;
          break;
        case Word::kBegin:
          running = message->test;
          begin = Clock::now();
          deadline = begin + std::chrono::milliseconds(static_cast<int64_t>(timeout_ * 1000));
          break;
        case Word::kOutput:
          result.output.push_back(message->text);
          break;
        case Word::kFailure:
          result.failures.push_back(message->text);
          break;
        case Word::kSkipped:
          result.skipped = message->text;
          result.outcome = TestResult::Outcome::kSkipped;
          break;
        case Word::kEnd:
          result.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
          if (!result.failures.empty()) result.outcome = TestResult::Outcome::kFailed;
          deadline = Clock::now() + kToCompile;
          running = message->test + 1;
          break;
      }
    }
    if (running >= runs_.size()) return running;
    const std::string why =
        child.timed_out() ? "it ran for more than " + seconds_text() + " s" : child.end();
    if (!is_ready) {
      out_.error = "before the first test: " + why;
      return first;
    }
    TestResult& result = out_.results[running];
    result.failures.push_back(result.test->file + ":" + std::to_string(result.test->line) + ": " +
                              why);
    result.outcome = TestResult::Outcome::kFailed;
    result.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    return running + 1;
  }

  std::string seconds_text() const {
    char text[32];
    std::snprintf(text, sizeof text, "%g", timeout_);
    return text;
  }

  const Source& source_;
  const std::vector<const TestRun*>& runs_;
  const std::string executor_;
  const double timeout_;
  SessionResult out_;
};

}  // namespace

SessionResult run_tests(const Source& source, const std::vector<const TestRun*>& runs,
                        const std::string& executor, double timeout_seconds) {
  std::vector<const TestRun*> wanted;
  for (const TestRun* run : runs) {
    if (run->skip.empty()) wanted.push_back(run);
  }
  SessionResult ran =
      wanted.empty() ? SessionResult() : Session(source, wanted, executor, timeout_seconds).run();
  SessionResult out;
  out.error = ran.error;
  out.has_no_device = ran.has_no_device;
  size_t next = 0;
  for (const TestRun* run : runs) {
    if (run->skip.empty()) {
      out.results.push_back(std::move(ran.results[next++]));
      continue;
    }
    TestResult skipped = {run, executor};
    skipped.outcome = TestResult::Outcome::kSkipped;
    skipped.skipped = run->skip;
    out.results.push_back(std::move(skipped));
  }
  return out;
}

}  // namespace kaamos::shader_tests
