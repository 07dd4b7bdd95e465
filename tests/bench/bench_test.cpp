// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <sstream>

#include "measure.h"
#include "suite.h"

namespace kaamos::bench {
namespace {

struct Output {
  int status;
  std::string out;
  std::string errors;
};

Output run(const std::vector<std::string>& arguments) {
  std::ostringstream out;
  std::ostringstream errors;
  const int status = run_program(arguments, out, errors, false);
  return {status, out.str(), errors.str()};
}

std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, at);) parts.push_back(part);
  return parts;
}

TEST(Bench, EveryCaseGivesOneLine) {
  const Output list = run({"--list"});
  const auto names = split(list.out, '\n');
  EXPECT_GE(names.size(), 19u);
  const Output summary = run({"--summary", "--quick", "--threads", "2"});
  EXPECT_EQ(summary.status, 0);
  EXPECT_EQ(summary.errors, "");
  const auto lines = split(summary.out, '\n');
  ASSERT_EQ(lines.size(), names.size());
  for (size_t i = 0; i < lines.size(); ++i) {
    const auto fields = split(lines[i], '\t');
    ASSERT_EQ(fields.size(), 6u) << lines[i];
    EXPECT_EQ(fields[0], names[i]);
    for (int number : {1, 2, 3}) EXPECT_GT(std::stod(fields[number]), 0) << lines[i];
    EXPECT_NE(fields[4], "");
    EXPECT_TRUE(fields[5] == "higher" || fields[5] == "lower") << lines[i];
  }
}

TEST(Bench, OnlyTakesAPrefix) {
  const auto names = split(run({"--list", "--only", "build/tlas-"}).out, '\n');
  EXPECT_EQ(names, (std::vector<std::string>{"build/tlas-100", "build/tlas-1k", "build/tlas-10k"}));
  const Output none = run({"--summary", "--only", "dispatch/vulkan"});
  EXPECT_EQ(none.status, 2);
  EXPECT_NE(none.errors.find("no case begins with \"dispatch/vulkan\""), std::string::npos);
}

TEST(Bench, WrongArgumentsSayWhatIsAllowed) {
  const std::pair<std::vector<std::string>, std::string> kWrong[] = {
      {{"--frames"}, "unknown argument \"--frames\""},
      {{"--only"}, "--only needs a value"},
      {{"--pairs", "0"}, "--pairs is \"0\", allowed is 1 to 999"},
      {{"--pairs", "9x"}, "--pairs is \"9x\""},
      {{"--threads", "-1"}, "--threads is \"-1\", allowed is 1 to 256"},
      {{"--size", "640"}, "--size is \"640\", allowed is WxH"},
      {{"--size", "0x9"}, "--size is \"0x9\""},
      {{"--precision", "double"}, "--precision is \"double\", allowed is fast, robust or exact"},
      {{"--clock", "sun"}, "--clock is \"sun\", allowed is wall or cpu"},
  };
  for (const auto& [arguments, message] : kWrong) {
    const Output output = run(arguments);
    EXPECT_EQ(output.status, 2) << message;
    EXPECT_EQ(output.out, "");
    EXPECT_NE(output.errors.find(message), std::string::npos) << output.errors;
  }
}

TEST(Bench, ThePrecisionTableHasWrongHitsInFastOnly) {
  const Output table = run({"--precision-table", "--quick", "--threads", "2"});
  EXPECT_EQ(table.status, 0);
  EXPECT_EQ(table.errors, "");
  int rows = 0;
  int wrong_in_fast = 0;  // or the rays would find nothing
  const size_t start = table.out.find("Wrong hits");
  const size_t end = table.out.find("Largest error");
  ASSERT_LT(start, end);
  for (const std::string& line : split(table.out.substr(start, end - start), '\n')) {
    const auto cells = split(line, '|');  // before the first bar: nothing
    if (cells.size() < 5 || cells[2].find(" / ") == std::string::npos) continue;
    ++rows;
    EXPECT_EQ(cells[3], " 0 / 0 / 0 ") << line;
    EXPECT_EQ(cells[4], " 0 / 0 / 0 ") << line;
    wrong_in_fast += cells[2] != " 0 / 0 / 0 " ? 1 : 0;
  }
  EXPECT_GE(rows, 10) << table.out;
  EXPECT_GT(wrong_in_fast, 5) << table.out;
}

TEST(Bench, TheTableOfDrawsHasARowForEachSize) {
  const Output table = run({"--raster-table", "--quick", "--threads", "2"});
  EXPECT_EQ(table.status, 0);
  EXPECT_EQ(table.errors, "");
  int rows = 0;
  for (const std::string& line : split(table.out, '\n')) {
    const auto cells = split(line, '|');  // before the first bar: nothing
    if (cells.size() < 4 || cells[1].find(' ', 1) == std::string::npos) continue;
    if (cells[2] == " ms ") continue;  // a head
    ++rows;
    EXPECT_GT(std::stod(cells[2]), 0) << line;
    EXPECT_GT(std::stod(cells[3]), 0) << line;
  }
  EXPECT_EQ(rows, 6 + 3 + 2 * 2) << table.out;
}

TEST(Bench, ALineHasSixFields) {
  EXPECT_EQ(format_line({"build/x", 1.25, 0.5, 0.4, "ms", false}),
            "build/x\t1.25\t0.5\t0.4\tms\tlower");
}

TEST(Bench, PairsTakeTurnsAndGiveMedians) {
  std::string order;
  double ours = 0;
  Measure measure;
  measure.pairs = 3;
  const Pairs pairs = run_pairs(
      measure, [&] { return order += 'o', ++ours; }, [&] { return order += 'b', 2.0; });
  EXPECT_EQ(order, "obboob");
  EXPECT_EQ(pairs.ours, 2);
  EXPECT_EQ(pairs.baseline, 2);
  EXPECT_EQ(pairs.ratio, 1);
  EXPECT_EQ(median({4, 1, 3, 2}), 2.5);
}

}  // namespace
}  // namespace kaamos::bench
