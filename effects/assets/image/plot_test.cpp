// SPDX-License-Identifier: MIT
#include "effects/assets/image/plot.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "effects/assets/image/csv.h"

namespace kaamos::effects {
namespace {

// Returns what is wrong with the text as XML (tags that do not match, bare < and &), or nothing.
std::string xml_fault(const std::string& text) {
  std::vector<std::string> open;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '&') {
      const std::string rest = text.substr(i, 6);
      if (rest.rfind("&lt;", 0) != 0 && rest.rfind("&gt;", 0) != 0 && rest.rfind("&amp;", 0) != 0 &&
          rest.rfind("&quot;", 0) != 0) {
        return "a bare & at " + std::to_string(i);
      }
    }
    if (text[i] != '<') continue;
    const std::size_t end = text.find('>', i);
    if (end == std::string::npos) return "a tag without an end at " + std::to_string(i);
    const std::string tag = text.substr(i + 1, end - i - 1);
    if (tag.empty() || tag.find('<') != std::string::npos) return "a bare < in " + tag;
    if (tag[0] == '/') {
      if (open.empty() || open.back() != tag.substr(1)) return "</" + tag.substr(1) + "> unopened";
      open.pop_back();
    } else if (tag[0] != '?' && tag.back() != '/') {
      open.push_back(tag.substr(0, tag.find(' ')));
    }
    i = end;
  }
  return open.empty() ? "" : "<" + open.back() + "> stays open";
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

TEST(Plot, IsWellFormedWhateverTheTextsAre) {
  const double inf = std::numeric_limits<double>::infinity();
  Plot plot{.title = "a < b & \"c\"", .subtitle = "\x01", .x_label = "ms", .y_label = "RMSE"};
  plot.series = {{"one <tag>", {{1, 0.5, "1 & 2"}, {2, 0.25, "</text>"}, {0, 1, "none"}}},
                 {"two", {{3, inf, ""}, {4, std::nan(""), ""}, {5, 1e-5, "5"}}, false}};
  plot.levels = {{"reference", 1e-6}, {"none", 0}};
  const std::string svg = plot_svg(plot);
  EXPECT_EQ(xml_fault(svg), "");
  EXPECT_EQ(count(svg, "<circle "), 2u);
  EXPECT_NE(svg.find("3 points without error or time"), std::string::npos);
  EXPECT_NE(svg.find("a &lt; b &amp; &quot;c&quot;"), std::string::npos);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.find("inf"), std::string::npos);
}

TEST(Plot, NothingToDrawIsAPlotToo) {
  EXPECT_EQ(xml_fault(plot_svg({})), "");
  Plot single;
  single.series = {{"one", {{1, 1, "here"}}}};
  EXPECT_EQ(xml_fault(plot_svg(single)), "");
}

TEST(Plot, AxesAreLogarithmic) {
  Plot plot;
  plot.series = {{"halves", {{1, 1, ""}, {10, 0.1, ""}, {100, 0.01, ""}}}};
  const std::string svg = plot_svg(plot);
  double x[3], y[3];
  std::size_t at = 0;
  for (int i = 0; i < 3; ++i) {
    at = svg.find("<circle cx=", at) + 1;
    ASSERT_EQ(std::sscanf(svg.c_str() + at, "circle cx=\"%lf\" cy=\"%lf\"", &x[i], &y[i]), 2);
  }
  EXPECT_NEAR(x[1] - x[0], x[2] - x[1], 0.2);
  EXPECT_NEAR(y[1] - y[0], y[2] - y[1], 0.2);
  EXPECT_GT(x[1], x[0]);
  EXPECT_GT(y[1], y[0]);  // SVG's y points down
}

TEST(Csv, ComesBackAsItWas) {
  const Table table{{"setting", "a,b", "c"},
                    {{"say \"so\"", "1,5", ""}, {"two\nlines", "", "x"}, {"", "", ""}}};
  const auto parsed = parse_csv(write_csv(table));
  ASSERT_TRUE(parsed.ok()) << parsed.error().message;
  EXPECT_EQ(parsed.value().columns, table.columns);
  EXPECT_EQ(parsed.value().rows, table.rows);
}

TEST(Csv, TellsWhatIsWrong) {
  EXPECT_NE(parse_csv("").error().message.find("empty"), std::string::npos);
  EXPECT_NE(parse_csv("a,b\n1\n").error().message.find("row 2 has 1 cells, the first one has 2"),
            std::string::npos);
  EXPECT_NE(parse_csv("a\n\"b\n").error().message.find("row 2: a quote is not closed"),
            std::string::npos);
}

}  // namespace
}  // namespace kaamos::effects
