// SPDX-License-Identifier: MIT
//
// EXPERIMENTAL: no argument of an indirect operation, however wrong, ends the process or the
// device. KAAMOS_FUZZ_ROUNDS in the environment says how many calls there are on Embree; on Vulkan
// there are a tenth as many.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "tests/fuzz/operations_fuzzer.h"
#include "tests/vulkan/support.h"

namespace kaamos::test {
namespace {

constexpr uint64_t kRounds = 20000;   // seconds
constexpr uint64_t kSession = 10000;  // calls on one device

struct Settings {
  uint64_t rounds = kRounds;
  uint64_t first = 0;  // session
  bool is_long = false;
};
Settings settings() {
  Settings settings;
  if (const char* rounds = std::getenv("KAAMOS_FUZZ_ROUNDS")) {
    settings.rounds = std::strtoull(rounds, nullptr, 10);
    settings.is_long = true;
  }
  if (const char* first = std::getenv("KAAMOS_FUZZ_SESSION")) {
    settings.first = std::strtoull(first, nullptr, 10);
  }
  return settings;
}

struct Totals {
  uint64_t rounds = 0;
  uint64_t hits = 0;
  uint64_t notes = 0;
  uint64_t refused = 0;
};

void run(const std::string& backend, uint64_t session, uint64_t rounds, Totals& totals) {
  OperationsFuzzer fuzzer(backend, session % 2 == 1, session);
  for (uint64_t i = 0; i < rounds; ++i) {
    std::string wrong = fuzzer.round();
    if (wrong.empty() && i % 16 == 15) wrong = fuzzer.look();
    ASSERT_EQ(wrong, "") << "call " << i << " of KAAMOS_FUZZ_SESSION=" << session;
  }
  totals.rounds += rounds;
  totals.hits += fuzzer.hits();
  totals.notes += fuzzer.notes();
  totals.refused += fuzzer.refused();
}

void run_all(const std::string& backend, uint64_t part) {
  const Settings all = settings();
  const uint64_t rounds = all.rounds / part;
  uint64_t session = all.first;
  Totals totals;
  while (totals.rounds < rounds) {
    // What a call that ends the process leaves behind.
    if (all.is_long) std::fprintf(stderr, "%s: session %lu\n", backend.c_str(), session);
    run(backend, session++, std::min(rounds - totals.rounds, kSession / part), totals);
    if (::testing::Test::HasFatalFailure()) return;
  }
  // The arguments are neither all right nor all wrong.
  EXPECT_GT(totals.hits, 0u);
  EXPECT_GT(totals.notes, 0u);
  EXPECT_LT(totals.refused, totals.rounds / 2);
}

TEST(OperationsFuzz, AnyArgumentIsSurvivedOnEmbree) {
  run_all("embree", 1);
}

TEST(OperationsFuzz, AnyArgumentIsSurvivedOnVulkan) {
  KAAMOS_NEED_VULKAN();
  run_all("vulkan", 10);
}

}  // namespace
}  // namespace kaamos::test
