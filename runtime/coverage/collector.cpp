// SPDX-License-Identifier: MIT
#include "runtime/coverage/collector.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <mutex>
#include <string_view>
#include <vector>

#include "runtime/coverage/tracefile.h"

namespace kaamos::coverage {
namespace {

namespace fs = std::filesystem;

std::string wanted_file() {
  const char* file = std::getenv("KAAMOS_COVERAGE");
  return file == nullptr || *file == '\0' ? std::string() : fs::absolute(file).string();
}

// A source file of a library.
struct SourceFile {
  std::string path;             // absolute if it exists
  uint32_t lines = UINT32_MAX;  // what is behind them was generated
  bool is_own = false;          // of Kaamos: no file of anybody's
};

SourceFile source_file(const std::string& name) {
  SourceFile out = {name};
  std::ifstream in(name, std::ios::binary);
  std::error_code ignored;
  if (!in || !fs::is_regular_file(name, ignored)) {
    out.is_own = fs::path(name).lexically_normal().string().starts_with("kaamos/");
    return out;
  }
  out.path = fs::absolute(name).lexically_normal().string();
  const std::string text(std::istreambuf_iterator<char>(in), {});
  out.lines = static_cast<uint32_t>(std::count(text.begin(), text.end(), '\n')) +
              (text.empty() || text.ends_with('\n') ? 0u : 1u);
  return out;
}

// What was not there before. `known` has it afterwards.
template <class Counts>
void take_new(const Counts& seen, Counts& known, Counts& out) {
  for (const auto& [key, count] : seen) {
    const auto [at, is_new] = known.try_emplace(key, count);
    if (!is_new && at->second >= count) continue;
    at->second = count;
    out[key] = count;
  }
}

class Collector {
 public:
  // Never destroyed: at exit, other threads may still hold libraries.
  static Collector& instance() {
    static Collector& one = *new Collector;
    return one;
  }

  std::string begin() {
    const std::lock_guard lock(mutex_);
    find_path();
    if (path_.empty() || began_) return {};
    began_ = true;
    return add_to_path({});
  }

  void add(const shader::LibraryDesc& library, const shader::CoverageDesc& table) {
    const std::lock_guard lock(mutex_);
    find_path();
    for (uint32_t i = 0; i < table.file_count; ++i) {
      const std::string name = table.files[i];
      if (!sources_.contains(name)) sources_[name] = source_file(name);
    }
    tables_[&library] = &table;
    live_.push_back(&table);
    if (!writes_at_exit_) std::atexit(&write_at_exit);
    writes_at_exit_ = true;
  }

  void remove(const shader::LibraryDesc& library, const shader::CoverageDesc& table) {
    const std::lock_guard lock(mutex_);
    live_.erase(std::find(live_.begin(), live_.end(), &table));
    const bool is_last = std::find(live_.begin(), live_.end(), &table) == live_.end();
    take(table, is_last);
    if (is_last) tables_.erase(&library);
  }

  const shader::CoverageDesc* table_of(const shader::LibraryDesc& library) {
    const std::lock_guard lock(mutex_);
    const auto at = tables_.find(&library);
    return at == tables_.end() ? nullptr : at->second;
  }

  std::string write() {
    const std::lock_guard lock(mutex_);
    if (path_.empty()) return {};
    for (const shader::CoverageDesc* table : live_) take(*table, false);
    Tracefile written = written_;
    Tracefile fresh;
    for (const auto& [path, file] : seen_) {
      FileCoverage part;
      take_new(file.lines, written[path].lines, part.lines);
      take_new(file.arms, written[path].arms, part.arms);
      if (!part.lines.empty() || !part.arms.empty()) fresh[path] = std::move(part);
    }
    if (fresh.empty()) return {};
    std::string error = add_to_path(fresh);
    if (error.empty()) written_ = std::move(written);
    return error;
  }

  void add_reader(Reader& reader) {
    const std::lock_guard lock(mutex_);
    readers_.push_back(&reader);
  }
  void remove_reader(Reader& reader) {
    const std::lock_guard lock(mutex_);
    for (const shader::CoverageDesc* table : live_) reader.read(*table, true);
    std::erase(readers_, &reader);
  }

 private:
  static void write_at_exit() {
    const std::string error = instance().write();
    if (!error.empty()) std::fprintf(stderr, "coverage is lost: %s\n", error.c_str());
  }

  void find_path() {
    if (path_.empty()) path_ = wanted_file();
  }

  std::string add_to_path(const Tracefile& more) const {
    const std::string error = add_to_file(path_, more);
    return error.empty() ? error : "\"" + path_ + "\" of $KAAMOS_COVERAGE: " + error;
  }

  void take(const shader::CoverageDesc& table, bool is_last) {
    for (Reader* reader : readers_) reader->read(table, is_last);
    std::vector<const SourceFile*> sources;
    for (uint32_t i = 0; i < table.file_count; ++i) sources.push_back(&sources_[table.files[i]]);
    for (uint32_t i = 0; i < table.point_count; ++i) {
      const shader::CoveragePoint& point = table.points[i];
      const SourceFile& source = *sources[point.file];
      if (source.is_own || point.line > source.lines) continue;
      const uint64_t ran = __atomic_load_n(&table.ran[i], __ATOMIC_RELAXED);
      FileCoverage& file = seen_[source.path];
      uint64_t& count = point.column == 0 ? file.lines[point.line]
                                          : file.arms[{point.line, point.column, point.arm}];
      count = std::max(count, ran);
    }
  }

  std::mutex mutex_;
  std::string path_;
  std::map<std::string, SourceFile> sources_;
  std::map<const shader::LibraryDesc*, const shader::CoverageDesc*> tables_;
  std::vector<const shader::CoverageDesc*> live_;  // one that was loaded twice is there twice
  std::vector<Reader*> readers_;
  Tracefile seen_;     // 0 or 1
  Tracefile written_;  // of it
  bool began_ = false;
  bool writes_at_exit_ = false;
};

// The library ends only after what it ran was taken over.
struct Collected {
  Collected(const shader::LibraryDesc& desc, const shader::CoverageDesc& of,
            std::shared_ptr<const void> keeps)
      : library(desc), table(of), owner(std::move(keeps)) {
    Collector::instance().add(library, table);
  }
  Collected(const Collected&) = delete;
  Collected& operator=(const Collected&) = delete;
  ~Collected() { Collector::instance().remove(library, table); }

  const shader::LibraryDesc& library;
  const shader::CoverageDesc& table;
  std::shared_ptr<const void> owner;
};

}  // namespace

bool is_asked() {
  const char* file = std::getenv("KAAMOS_COVERAGE");
  return file != nullptr && *file != '\0';
}

std::string begin() {
  return Collector::instance().begin();
}

std::shared_ptr<const void> collect(const shader::LibraryDesc& library,
                                    const shader::CoverageDesc& table,
                                    std::shared_ptr<const void> owner) {
  return std::make_shared<Collected>(library, table, std::move(owner));
}

const shader::CoverageDesc* table_of(const shader::LibraryDesc& library) {
  return Collector::instance().table_of(library);
}

std::string write() {
  return Collector::instance().write();
}

void add_reader(Reader& reader) {
  Collector::instance().add_reader(reader);
}
void remove_reader(Reader& reader) {
  Collector::instance().remove_reader(reader);
}

}  // namespace kaamos::coverage
