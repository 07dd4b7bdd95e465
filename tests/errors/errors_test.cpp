// SPDX-License-Identifier: MIT
#include <fstream>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/errors/tables.h"

namespace kaamos::errors {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr Row kGood = {500, "kGood", "kError", "kFailed", "a | b", "", "Do <it> a_b __c."};

TEST(ErrorTables, IdsAreUniqueAndEachHasAMeaningAndACure) {
  EXPECT_THAT(faults_of(all_layers()), IsEmpty());
}

TEST(ErrorTables, FaultsAreFound) {
  Row no_meaning = kGood;
  no_meaning.number = 501;
  no_meaning.meaning = "";
  Row no_cure = kGood;
  no_cure.number = 502;
  no_cure.cure = "";
  Row outside = kGood;
  outside.number = 700;
  Row early = kGood;
  early.number = 610;
  Row named = kGood, named_too = kGood;
  named.number = 800;
  named_too.number = 801;
  EXPECT_THAT(
      faults_of({{"A", "", {{500, 599}}, true, "", {kGood, no_meaning, no_cure, outside}},
                 {"B", "", {{500, 599}, {600, 620}}, true, "", {early, kGood}},
                 {"C", "", {{800, 899}}, true, "c", {named, named_too}}}),
      ElementsAre(HasSubstr("KA0501 (A) has no meaning"), HasSubstr("KA0502 (A) has no cure"),
                  HasSubstr("KA0700 (A) is outside"), HasSubstr("KA0500 (B) is an id of A"),
                  HasSubstr("KA0500 (B) is out of order"),
                  HasSubstr("KA0801 (C) has the name kGood")));
}

TEST(ErrorTables, TheMarkdownShowsTextsAsTheyAre) {
  const std::string page = markdown({{"A", "About A.", {{500, 599}}, true, "", {kGood}}});
  EXPECT_THAT(page,
              HasSubstr("\n## A\n\nAbout A.\n\n| id | severity | code | meaning | cure |\n"
                        "|---|---|---|---|---|\n"
                        "| KA0500 | error | `kFailed` | a \\| b | Do \\<it> a_b \\_\\_c. |\n"));
}

TEST(ErrorTables, TheHeaderHasANameForEachId) {
  const std::string text = header(
      {{"A", "", {{500, 599}}, true, "a", {kGood}}, {"B", "", {{500, 599}}, true, "", {kGood}}});
  EXPECT_THAT(text, HasSubstr("\nnamespace a {\n"
                              "inline constexpr ErrorId kGood{500};  ///< a \\| b\n"
                              "}  // namespace a\n"));
  EXPECT_EQ(text.find("\"B\""), std::string::npos);
}

// A committed file is the program's output.
void expect_current(const std::string& file, const char* option, const std::string& text) {
  const std::string path = KAAMOS_SOURCE_DIR "/" + file;
  std::ifstream in(path);
  std::stringstream committed;
  committed << in.rdbuf();
  EXPECT_TRUE(committed.str() == text)
      << file << " is not what the error tables say. Write it with\n  " << KAAMOS_ERRORS_PROGRAM
      << " " << option << " > " << path;
}

TEST(ErrorTables, ThePageIsCurrent) {
  expect_current("rtapi/ERRORS.md", "--markdown", markdown(all_layers()));
}

TEST(ErrorTables, TheHeaderIsCurrent) {
  expect_current("rtapi/include/rtapi/error_ids.h", "--header", header(all_layers()));
}

}  // namespace
}  // namespace kaamos::errors
