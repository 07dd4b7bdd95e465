// SPDX-License-Identifier: MIT
#include "expectations.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace kaamos::test {
namespace {

namespace fs = std::filesystem;

struct KindName {
  const char* name;
  ValueKind kind;
  uint32_t bytes;
};
constexpr KindName kKinds[] = {{"u32", ValueKind::kU32, 4},
                               {"i32", ValueKind::kI32, 4},
                               {"f32", ValueKind::kF32, 4},
                               {"u64", ValueKind::kU64, 8},
                               {"f64", ValueKind::kF64, 8}};

bool parse_value(ValueKind kind, const std::string& text, uint64_t& bits) {
  char* end = nullptr;
  switch (kind) {
    case ValueKind::kU32:
    case ValueKind::kU64:
      bits = std::strtoull(text.c_str(), &end, 0);
      break;
    case ValueKind::kI32:
      bits = static_cast<uint32_t>(std::strtoll(text.c_str(), &end, 0));
      break;
    case ValueKind::kF32:
      bits = std::bit_cast<uint32_t>(std::strtof(text.c_str(), &end));
      break;
    case ValueKind::kF64:
      bits = std::bit_cast<uint64_t>(std::strtod(text.c_str(), &end));
      break;
  }
  return end != text.c_str() && *end == '\0';
}

bool parse_expectation(std::istringstream& words, Expectation& out) {
  std::string kind;
  std::string value;
  if (!(words >> kind >> out.offset >> value)) return false;
  words >> out.ulps;
  for (const KindName& k : kKinds) {
    if (kind == k.name) {
      out.kind = k.kind;
      return parse_value(k.kind, value, out.bits);
    }
  }
  return false;
}

void parse_line(const std::string& line, uint32_t number, HlslTest& test) {
  const size_t comment = line.find("// ");
  if (comment == std::string::npos) return;
  std::istringstream words(line.substr(comment + 3));
  std::string key;
  words >> key;
  if (key == "FEATURE:") {
    std::getline(words >> std::ws, test.feature);
  } else if (key == "TRAP:") {
    std::getline(words >> std::ws, test.feature);
    test.feature = "trap " + test.feature;
  } else if (key == "OPTIONS:") {
    for (std::string word; words >> word;) test.options.push_back(word);
  } else if (key == "BREAKS:") {
    for (std::string word; words >> word;) test.breaks.push_back(word.substr(0, word.find(',')));
  } else if (key == "DISPATCH:") {
    for (uint32_t& count : test.dispatch) {
      if (!(words >> count)) {
        test.error = "line " + std::to_string(number) + ": DISPATCH needs three numbers";
      }
    }
  } else if (key == "EXPECT") {
    Expectation expectation;
    expectation.line = number;
    if (parse_expectation(words, expectation)) {
      test.expectations.push_back(expectation);
    } else {
      test.error = "line " + std::to_string(number) + ": an EXPECT that cannot be read: " + line;
    }
  }
}

HlslTest read_test(const fs::path& path, const fs::path& folder) {
  HlslTest test;
  test.path = path.string();
  test.name = fs::relative(path, folder).replace_extension().string();
  std::ifstream file(path);
  uint32_t number = 0;
  for (std::string line; std::getline(file, line);) {
    parse_line(line, ++number, test);
  }
  if (test.expectations.empty() && test.error.empty()) test.error = "no EXPECT in the file";
  if (test.feature.empty() && test.error.empty()) test.error = "neither FEATURE nor TRAP";
  return test;
}

// The distance of two floats in ulps.
int64_t ulps_between(float a, float b) {
  const auto ordered = [](float v) {
    const auto bits = std::bit_cast<int32_t>(v);
    return static_cast<int64_t>(bits < 0 ? int32_t(0x80000000u) - bits : bits);
  };
  return std::abs(ordered(a) - ordered(b));
}

bool matches(const Expectation& e, uint64_t actual) {
  if (e.kind == ValueKind::kF32) {
    const auto wanted = std::bit_cast<float>(static_cast<uint32_t>(e.bits));
    const auto found = std::bit_cast<float>(static_cast<uint32_t>(actual));
    if (std::isnan(wanted) || std::isnan(found)) return std::isnan(wanted) && std::isnan(found);
    return e.bits == actual || (e.ulps > 0 && ulps_between(wanted, found) <= e.ulps);
  }
  if (e.kind == ValueKind::kF64 && std::isnan(std::bit_cast<double>(e.bits))) {
    return std::isnan(std::bit_cast<double>(actual));
  }
  return e.bits == actual;
}

std::string show(ValueKind kind, uint64_t bits) {
  std::ostringstream out;
  out.precision(kind == ValueKind::kF64 ? 17 : 9);
  if (kind == ValueKind::kF32) out << std::bit_cast<float>(static_cast<uint32_t>(bits)) << " = ";
  if (kind == ValueKind::kF64) out << std::bit_cast<double>(bits) << " = ";
  if (kind == ValueKind::kI32) out << static_cast<int32_t>(bits) << " = ";
  out << "0x" << std::hex << bits;
  return out.str();
}

}  // namespace

std::vector<HlslTest> find_hlsl_tests(const std::string& folder,
                                      const std::vector<std::string>& parts) {
  std::vector<fs::path> paths;
  for (const std::string& part : parts) {
    std::error_code missing;
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(folder) / part, missing)) {
      if (entry.path().extension() == ".hlsl") paths.push_back(entry.path());
    }
  }
  std::sort(paths.begin(), paths.end());
  std::vector<HlslTest> tests;
  for (const fs::path& path : paths) tests.push_back(read_test(path, folder));
  return tests;
}

std::string compare(const Expectation& e, const std::vector<std::byte>& results) {
  const uint32_t bytes = kKinds[static_cast<size_t>(e.kind)].bytes;
  if (uint64_t{e.offset} + bytes > results.size()) {
    return "line " + std::to_string(e.line) + ": offset " + std::to_string(e.offset) +
           " lies behind the " + std::to_string(results.size()) + " bytes of results";
  }
  uint64_t actual = 0;
  std::memcpy(&actual, results.data() + e.offset, bytes);
  if (matches(e, actual)) return {};
  return "line " + std::to_string(e.line) + ": at byte " + std::to_string(e.offset) + " stands " +
         show(e.kind, actual) + ", expected " + show(e.kind, e.bits);
}

}  // namespace kaamos::test
