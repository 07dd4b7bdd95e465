// SPDX-License-Identifier: MIT
#include "runtime/coverage/tracefile.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "runtime/files/write_file.h"

namespace kaamos::coverage {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kEnd = "end_of_record";

// The numbers of "3,17,0,-", where '-' is 0; false if there are fewer.
template <size_t count>
bool read_numbers(std::string_view text, std::array<uint64_t, count>& out) {
  for (uint64_t& number : out) {
    if (text.starts_with('-')) {
      number = 0;
      text.remove_prefix(1);
    } else {
      const auto [behind, error] = std::from_chars(text.data(), text.data() + text.size(), number);
      if (error != std::errc()) return false;
      text.remove_prefix(static_cast<size_t>(behind - text.data()));
    }
    if (text.starts_with(',')) {
      text.remove_prefix(1);
    } else if (&number != &out.back()) {
      return false;
    }
  }
  return true;
}

// A record inside of a file's section.
bool read_record(std::string_view line, FileCoverage& out) {
  const std::string_view values = line.substr(std::min(line.size(), line.find(':') + 1));
  if (line.starts_with("DA:")) {
    std::array<uint64_t, 2> numbers;
    if (!read_numbers(values, numbers)) return false;
    out.lines[static_cast<uint32_t>(numbers[0])] += numbers[1];
  } else if (line.starts_with("BRDA:")) {
    std::array<uint64_t, 4> numbers;
    if (!read_numbers(values, numbers)) {
      out.others.emplace_back(line);  // blocks and branches of others may be text
      return true;
    }
    out.arms[{static_cast<uint32_t>(numbers[0]), static_cast<uint32_t>(numbers[1]),
              static_cast<uint32_t>(numbers[2])}] += numbers[3];
  } else if (!line.starts_with("LF:") && !line.starts_with("LH:") && !line.starts_with("BRF:") &&
             !line.starts_with("BRH:")) {
    out.others.emplace_back(line);
  }
  return true;
}

void add(Tracefile& to, const Tracefile& more) {
  for (const auto& [path, from] : more) {
    FileCoverage& file = to[path];
    for (const auto& [line, count] : from.lines) file.lines[line] += count;
    for (const auto& [arm, count] : from.arms) file.arms[arm] += count;
  }
}

template <class Counts>
std::string totals(const Counts& counts, const std::string& found, const std::string& hit) {
  const auto hits = std::ranges::count_if(counts, [](const auto& one) { return one.second != 0; });
  return found + ":" + std::to_string(counts.size()) + "\n" + hit + ":" + std::to_string(hits) +
         "\n";
}

// Holds the lock of a folder, which whoever changes a tracefile in it takes. The file itself is
// replaced, so that a lock on it would be one on its past.
class FolderLock {
 public:
  explicit FolderLock(const fs::path& folder)
      : file_(open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
    if (file_ < 0) {
      error_ = errno;
      return;
    }
    while (flock(file_, LOCK_EX) != 0) {
      if (errno == EINTR) continue;
      error_ = errno;
      return;
    }
  }
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;
  ~FolderLock() {
    if (file_ >= 0) close(file_);
  }
  int error() const { return error_; }

 private:
  int file_;
  int error_ = 0;
};

}  // namespace

std::optional<Tracefile> parse_tracefile(std::string_view text, size_t& bad_line) {
  Tracefile out;
  FileCoverage* file = nullptr;
  for (bad_line = 1; !text.empty(); ++bad_line) {
    const size_t end = std::min(text.size(), text.find('\n'));
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(text.size(), end + 1));
    if (line.starts_with("SF:")) {
      if (file != nullptr) return std::nullopt;
      file = &out[std::string(line.substr(3))];
    } else if (line == kEnd) {
      if (file == nullptr) return std::nullopt;
      file = nullptr;
    } else if (file != nullptr) {
      if (!read_record(line, *file)) return std::nullopt;
    } else if (!line.empty() && !line.starts_with("TN:") && !line.starts_with('#')) {
      return std::nullopt;
    }
  }
  if (file != nullptr) return std::nullopt;
  return out;
}

std::string to_text(const Tracefile& tracefile) {
  std::string out;
  for (const auto& [path, file] : tracefile) {
    out += "TN:\nSF:" + path + "\n";
    for (const std::string& other : file.others) out += other + "\n";
    for (auto at = file.arms.begin(); at != file.arms.end();) {
      const auto next = std::find_if(at, file.arms.end(), [&](const auto& one) {
        return one.first.line != at->first.line || one.first.column != at->first.column;
      });
      // '-': nothing came to the branch at all.
      const bool ran = std::any_of(at, next, [](const auto& one) { return one.second != 0; });
      for (; at != next; ++at) {
        const auto& [arm, count] = *at;
        out += "BRDA:" + std::to_string(arm.line) + "," + std::to_string(arm.column) + "," +
               std::to_string(arm.arm) + "," + (ran ? std::to_string(count) : "-") + "\n";
      }
    }
    out += totals(file.arms, "BRF", "BRH");
    for (const auto& [line, count] : file.lines) {
      out += "DA:" + std::to_string(line) + "," + std::to_string(count) + "\n";
    }
    out += totals(file.lines, "LF", "LH") + std::string(kEnd) + "\n";
  }
  return out;
}

std::string add_to_file(const std::string& path, const Tracefile& more) {
  const FolderLock lock(fs::absolute(path).parent_path());
  if (lock.error() != 0)
    return "its folder cannot be opened: " + std::string(std::strerror(lock.error()));
  Tracefile all;
  if (std::ifstream in(path, std::ios::binary); in) {
    size_t line = 0;
    auto known = parse_tracefile(std::string(std::istreambuf_iterator<char>(in), {}), line);
    if (!known) return "line " + std::to_string(line) + " of it is not of an LCOV tracefile";
    all = *std::move(known);
  }
  add(all, more);
  const int error = files::write_file(path, to_text(all));
  return error == 0 ? std::string() : std::strerror(error);
}

}  // namespace kaamos::coverage
