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

const Row kGood = {500, "error", "kFailed", "a | b", "", "Do <it> a_b __c."};

TEST(ErrorTables, IdsAreUniqueAndEachHasAMeaningAndACure) {
  EXPECT_THAT(faults_of(all_layers()), IsEmpty());
}

TEST(ErrorTables, FaultsAreFound) {
  Row no_meaning = kGood;
  no_meaning.number = 501;
  no_meaning.meaning.clear();
  Row no_cure = kGood;
  no_cure.number = 502;
  no_cure.cure.clear();
  Row outside = kGood;
  outside.number = 700;
  Row early = kGood;
  early.number = 610;
  EXPECT_THAT(
      faults_of({{"A", "", {{500, 599}}, {kGood, no_meaning, no_cure, outside}},
                 {"B", "", {{500, 599}, {600, 620}}, {early, kGood}}}),
      ElementsAre(HasSubstr("KA0501 (A) has no meaning"), HasSubstr("KA0502 (A) has no cure"),
                  HasSubstr("KA0700 (A) is outside"), HasSubstr("KA0500 (B) is an id of A"),
                  HasSubstr("KA0500 (B) is out of order")));
}

TEST(ErrorTables, TheMarkdownShowsTextsAsTheyAre) {
  const std::string page = markdown({{"A", "About A.", {{500, 599}}, {kGood}}});
  EXPECT_THAT(page,
              HasSubstr("\n## A\n\nAbout A.\n\n| id | severity | code | meaning | cure |\n"
                        "|---|---|---|---|---|\n"
                        "| KA0500 | error | `kFailed` | a \\| b | Do \\<it> a_b \\_\\_c. |\n"));
}

// The page is the program's output.
TEST(ErrorTables, ThePageIsCurrent) {
  std::ifstream file(KAAMOS_SOURCE_DIR "/rtapi/ERRORS.md");
  std::stringstream page;
  page << file.rdbuf();
  EXPECT_TRUE(page.str() == markdown(all_layers()))
      << "rtapi/ERRORS.md is not what the error tables say. Write it with\n  "
      << KAAMOS_ERRORS_PROGRAM << " --markdown > " << KAAMOS_SOURCE_DIR << "/rtapi/ERRORS.md";
}

}  // namespace
}  // namespace kaamos::errors
