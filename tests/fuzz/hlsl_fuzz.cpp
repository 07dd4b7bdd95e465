// SPDX-License-Identifier: MIT
//
// Feeds damaged HLSL to the compiler, which must not crash, hang or exhaust memory. A child process
// compiles the inputs; the parent watches it and records the input that killed it.
#include <signal.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>

#include "compile_input.h"
#include "mutate.h"

namespace kaamos::test {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

#if defined(__SANITIZE_THREAD__) || defined(__SANITIZE_ADDRESS__)
constexpr double kMaxCpuSeconds = 60;  // for one input, when everything takes ten times as long
#else
constexpr double kMaxCpuSeconds = 5;
#endif
constexpr uint64_t kMaxMegabytes = 3000;  // including what a sanitizer needs
constexpr int kMaxFindings = 20;
constexpr size_t kTextBytes = 8u << 20;

constexpr char kUsage[] =
    "hlsl_fuzz [--seed N] [--seconds S | --long S] [--out FOLDER] [--first N] [--replay PATH] "
    "[--compile N] SOURCE...\n"
    "  SOURCE          folders with the HLSL files to damage\n"
    "  --seed N        which sequence of inputs (default 1)\n"
    "  --seconds S     how long (default 3)\n"
    "  --long S        like --seconds, but KAAMOS_FUZZ_SECONDS in the environment overrides it\n"
    "  --first N       begin with input N of the sequence (default 0)\n"
    "  --out FOLDER    where to write failing inputs (default .)\n"
    "  --replay PATH   compile this file, or the .hlsl files of this folder, unchanged\n"
    "  --compile N     have the C++ of one in N inputs read by the host's compiler (default 0: "
    "none)\n";

struct Arguments {
  uint64_t seed = 1;
  uint64_t first = 0;
  uint64_t compile = 0;
  double seconds = 3;
  std::string out = ".";
  std::string replay;
  std::vector<std::string> folders;
};

// The report of the child to the parent; readable even after the child has died.
struct Shared {
  std::atomic<uint64_t> number;    // of the current input
  std::atomic<uint64_t> finished;  // inputs done by all children
  std::atomic<uint64_t> compiled;  // libraries that the C++ compiler took
  std::atomic<uint64_t> bytes;
  char text[kTextBytes];
  char path[4096];
  char broken[65536];  // the guarantee that was broken; empty if the child died of something else
};

std::optional<Arguments> parse_arguments(int argc, char** argv) {
  Arguments out;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word.rfind("--", 0) != 0) {
      out.folders.push_back(word);
      continue;
    }
    if (++i == argc) return std::nullopt;
    const std::string value = argv[i];
    if (word == "--seed") {
      out.seed = std::strtoull(value.c_str(), nullptr, 0);
    } else if (word == "--first") {
      out.first = std::strtoull(value.c_str(), nullptr, 0);
    } else if (word == "--compile") {
      out.compile = std::strtoull(value.c_str(), nullptr, 0);
    } else if (word == "--seconds") {
      out.seconds = std::strtod(value.c_str(), nullptr);
    } else if (word == "--long") {
      const char* wanted = std::getenv("KAAMOS_FUZZ_SECONDS");
      const std::string text = wanted != nullptr ? wanted : value;
      char* end = nullptr;
      out.seconds = std::strtod(text.c_str(), &end);
      if (end == text.c_str() || *end != '\0' || !(out.seconds > 0)) {
        std::fprintf(stderr, "hlsl_fuzz: \"%s\" is not a number of seconds above 0\n",
                     text.c_str());
        return std::nullopt;
      }
    } else if (word == "--out") {
      out.out = value;
    } else if (word == "--replay") {
      out.replay = value;
    } else {
      return std::nullopt;
    }
  }
  if (out.folders.empty()) return std::nullopt;
  return out;
}

// The inputs of a run: mutations until time is up, or the given files as they are.
class Inputs {
 public:
  explicit Inputs(const Arguments& arguments)
      : arguments_(arguments), corpus_(read_corpus(arguments.folders)) {
    if (arguments.replay.empty()) return;
    if (fs::is_directory(arguments.replay)) {
      for (const auto& entry : fs::directory_iterator(arguments.replay)) {
        if (entry.path().extension() == ".hlsl") files_.push_back(entry.path());
      }
      std::sort(files_.begin(), files_.end());
    } else {
      files_.push_back(arguments.replay);
    }
  }
  const Corpus& corpus() const { return corpus_; }
  bool empty() const { return arguments_.replay.empty() ? corpus_.files.empty() : files_.empty(); }
  bool ends_before(uint64_t number, Clock::time_point start) const {
    if (!arguments_.replay.empty()) return number >= files_.size();
    return std::chrono::duration<double>(Clock::now() - start).count() > arguments_.seconds;
  }
  Input get(uint64_t number) const {
    if (arguments_.replay.empty()) return mutated_input(corpus_, arguments_.seed, number);
    std::ifstream file(files_[number], std::ios::binary);
    std::stringstream text;
    text << file.rdbuf();
    return {files_[number].string(), text.str()};
  }
  // A replayed file is tried with all options, a mutation with those that its number picks.
  uint64_t choices() const { return arguments_.replay.empty() ? 1 : 64; }

 private:
  const Arguments& arguments_;
  Corpus corpus_;
  std::vector<fs::path> files_;
};

void copy_text(char* to, size_t room, const std::string& text) {
  const size_t bytes = std::min(text.size(), room - 1);
  std::memcpy(to, text.data(), bytes);
  to[bytes] = '\0';
}

// Of the C++ that the host's compiler reads.
fs::path cpp_folder(const Arguments& arguments) {
  return fs::path(arguments.out) / ("fuzz_cpp_" + std::to_string(arguments.seed));
}

// What the parent writes if the child ends before the next input.
Input begin(const Inputs& inputs, uint64_t number, Shared& shared) {
  Input input = inputs.get(number);
  copy_text(shared.text, kTextBytes, input.text);
  copy_text(shared.path, sizeof(shared.path), input.path);
  shared.bytes = std::min(input.text.size(), kTextBytes);
  shared.number = number;
  return input;
}

// Ends the child if a library of the batch does not compile.
void check(CppBatch& batch, const Inputs& inputs, Shared& shared) {
  const size_t size = batch.size();
  const auto failure = batch.check();
  if (!failure) {
    shared.compiled += size;
    return;
  }
  begin(inputs, failure->input, shared);
  copy_text(shared.broken, sizeof(shared.broken), failure->messages);
  std::_Exit(1);
}

[[noreturn]] void child(const Arguments& arguments, const Inputs& inputs, Shared& shared,
                        Clock::time_point start) {
  std::optional<CppBatch> batch;
  if (arguments.compile != 0) batch.emplace(cpp_folder(arguments));
  for (uint64_t number = shared.number; !inputs.ends_before(number, start); ++number) {
    const Input input = begin(inputs, number, shared);
    for (uint64_t i = 0; i < inputs.choices(); ++i) {
      const uint64_t choice = (number + 1) * 0x9e3779b97f4a7c15u + i * 0x632be59bd9b4e019u;
      const std::string broken =
          compile_input(inputs.corpus(), arguments.folders, input, number, choice >> 16,
                        batch && number % arguments.compile == 0 ? &*batch : nullptr);
      if (broken.empty()) continue;
      copy_text(shared.broken, sizeof(shared.broken), broken);
      std::_Exit(1);
    }
    if (batch && batch->is_full()) check(*batch, inputs, shared);
    ++shared.finished;
  }
  if (batch) check(*batch, inputs, shared);
  std::_Exit(0);
}

double cpu_seconds(pid_t process) {
  clockid_t clock;
  timespec time = {};
  if (clock_getcpuclockid(process, &clock) != 0 || clock_gettime(clock, &time) != 0) return 0;
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

uint64_t resident_megabytes(pid_t process) {
  std::ifstream file("/proc/" + std::to_string(process) + "/statm");
  uint64_t total = 0;
  uint64_t resident = 0;
  file >> total >> resident;
  return resident * static_cast<uint64_t>(sysconf(_SC_PAGESIZE)) >> 20;
}

// Waits for the child to end. Empty: it finished all inputs; otherwise says what happened.
std::string watch(pid_t process, Shared& shared) {
  uint64_t done = shared.finished;
  double began = cpu_seconds(process);
  for (;;) {
    int status = 0;
    if (waitpid(process, &status, WNOHANG) == process) {
      if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return {};
      if (shared.broken[0] != '\0') return shared.broken;
      return WIFSIGNALED(status) ? std::string("killed by ") + strsignal(WTERMSIG(status))
                                 : "ended with status " + std::to_string(WEXITSTATUS(status));
    }
    const double now = cpu_seconds(process);
    if (shared.finished != done) {
      done = shared.finished;
      began = now;
    }
    const uint64_t memory = resident_megabytes(process);
    std::string reason;
    if (now - began > kMaxCpuSeconds) {
      reason = "took more than " + std::to_string(int(kMaxCpuSeconds)) + " s of processor time";
    }
    if (memory > kMaxMegabytes) reason = "took " + std::to_string(memory) + " MB";
    if (!reason.empty()) {
      kill(process, SIGKILL);
      waitpid(process, &status, 0);
      return reason;
    }
    usleep(20000);
  }
}

void write_finding(const Arguments& arguments, const Shared& shared, const std::string& reason) {
  const std::string name = arguments.out + "/fuzz_" + std::to_string(arguments.seed) + "_" +
                           std::to_string(shared.number) + ".hlsl";
  std::ofstream(name, std::ios::binary).write(shared.text, static_cast<ssize_t>(shared.bytes));
  std::printf("FOUND: seed %llu, input %llu, made of %s: %s\nwritten to %s\n",
              static_cast<unsigned long long>(arguments.seed),
              static_cast<unsigned long long>(shared.number.load()), shared.path, reason.c_str(),
              name.c_str());
  std::fwrite(shared.text, 1, std::min<size_t>(shared.bytes, 4000), stdout);
  std::printf("\n");
  std::fflush(stdout);
}

int fuzz(const Arguments& arguments) {
  const Inputs inputs(arguments);
  if (inputs.empty()) {
    std::fprintf(stderr, "hlsl_fuzz: there are no .hlsl files in the folders given\n");
    return 2;
  }
  void* memory =
      mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) return 2;
  Shared& shared = *static_cast<Shared*>(memory);
  shared.number = arguments.first;
  const auto start = Clock::now();
  int findings = 0;
  for (;;) {
    shared.broken[0] = '\0';
    const pid_t process = fork();
    if (process < 0) return 2;
    if (process == 0) child(arguments, inputs, shared, start);
    const std::string reason = watch(process, shared);
    if (reason.empty()) break;
    write_finding(arguments, shared, reason);
    if (++findings == kMaxFindings) break;
    ++shared.number;
  }
  if (arguments.compile != 0) {
    std::error_code ignored;
    fs::remove_all(cpp_folder(arguments), ignored);
  }
  const std::chrono::duration<double> seconds = Clock::now() - start;
  std::printf("hlsl_fuzz: seed %llu, %llu inputs in %.0f s, %llu compiled as C++, %d findings\n",
              static_cast<unsigned long long>(arguments.seed),
              static_cast<unsigned long long>(shared.finished.load()), seconds.count(),
              static_cast<unsigned long long>(shared.compiled.load()), findings);
  return findings == 0 ? 0 : 1;
}

}  // namespace
}  // namespace kaamos::test

int main(int argc, char** argv) {
  const auto arguments = kaamos::test::parse_arguments(argc, argv);
  if (!arguments) {
    std::fputs(kaamos::test::kUsage, stderr);
    return 2;
  }
  return kaamos::test::fuzz(*arguments);
}
