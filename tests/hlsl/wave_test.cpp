// SPDX-License-Identifier: MIT
//
// Wave intrinsics with every number of lanes, in every way in which a compute shader can run,
// against a model: threads of a wave as a list, and for each operation the list of those that are
// active. The last wave of a group is not full.
#include <gtest/gtest.h>
#include <kaamos/shader/abi.h>

#include <cstring>
#include <functional>

#include "executors.h"
#include "fixtures.h"
#include "tests/vulkan/support.h"

namespace kaamos::test {
namespace {

constexpr uint32_t kThreads = 43;
constexpr uint32_t kGroups = 3;
constexpr uint32_t kWords = 16;  // that a thread may write

constexpr char kHead[] = R"(
RWByteAddressBuffer results : register(u0);
uint mix(uint x) { x ^= x >> 15; x *= 0x2C1B3C6D; x ^= x >> 12; return x; }
static uint word = 0;
static uint thread = 0;
void write(uint x) { results.Store(64 * thread + 4 * word, x); ++word; }
)";
constexpr char kMain[] = R"(
[shader("compute")] [numthreads(43, 1, 1)]
void main(uint i : SV_GroupIndex, uint3 id : SV_DispatchThreadID) {
  thread = id.x;
  const uint v = mix(id.x + 5) & 1023;
)";

uint32_t mix(uint32_t x) {
  x ^= x >> 15;
  x *= 0x2C1B3C6Du;
  x ^= x >> 12;
  return x;
}

// One thread of the model.
struct Thread {
  uint32_t i = 0;     // in its group
  uint32_t lane = 0;  // in its wave
  uint32_t v = 0;
  std::vector<uint32_t> out;

  void write(uint32_t x) { out.push_back(x); }
};
using Active = std::vector<Thread*>;

Active those(const Active& active, const std::function<bool(const Thread&)>& condition) {
  Active out;
  for (Thread* thread : active) {
    if (condition(*thread)) out.push_back(thread);
  }
  return out;
}
uint32_t sum(const Active& active, const std::function<uint32_t(const Thread&)>& of) {
  uint32_t total = 0;
  for (const Thread* thread : active) total += of(*thread);
  return total;
}
uint32_t count(const Active& active) {
  return static_cast<uint32_t>(active.size());
}
uint32_t ballot(const Active& active) {
  return sum(active, [](const Thread& thread) { return 1u << thread.lane; });
}
// Those with a smaller lane.
Active before(const Active& active, const Thread& than) {
  return those(active, [&](const Thread& thread) { return thread.lane < than.lane; });
}

// `body` in HLSL, `model` for the threads of one wave, which are all active at first.
struct Case {
  const char* name;
  const char* body;
  bool wide;  // whether it can run eight threads at once
  void (*model)(const Active& wave, uint32_t lanes);
  const char* target = "lib_6_7";
};

void model_lanes(const Active& wave, uint32_t lanes) {
  for (Thread* thread : wave) {
    thread->write(lanes);
    thread->write(thread->lane);
    thread->write(thread == wave[0] ? 1 : 0);
    thread->write(ballot(wave));
  }
}

void model_waves_of_group(const Active& wave, uint32_t lanes) {
  for (Thread* thread : wave) {
    thread->write(thread->i / lanes);
    thread->write((kThreads + lanes - 1) / lanes);
    if (thread->v % 2 == 1) thread->write(thread->i / lanes + 7);
  }
}

void model_reductions(const Active& wave, uint32_t) {
  const Active odd = those(wave, [](const Thread& thread) { return thread.v % 2 == 1; });
  const Active even = those(wave, [](const Thread& thread) { return thread.v % 2 == 0; });
  for (const Active& half : {odd, even}) {
    uint32_t product = 1, least = ~0u, most = 0, bits = ~0u;
    for (const Thread* thread : half) {
      product *= thread->v | 1;
      least = std::min(least, thread->v);
      most = std::max(most, thread->v);
      bits &= thread->v;
    }
    for (Thread* thread : half) {
      thread->write(sum(half, [](const Thread& each) { return each.v; }));
      thread->write(product);
      thread->write(least);
      thread->write(most);
      thread->write(bits);
      thread->write(ballot(half));
      thread->write(half[0]->v);
      thread->write(half.back()->v);
    }
  }
}

void model_prefixes(const Active& wave, uint32_t) {
  const Active some = those(wave, [](const Thread& thread) { return thread.v % 5 != 0; });
  for (Thread* thread : some) {
    const Active earlier = before(some, *thread);
    uint32_t product = 1;
    for (const Thread* each : earlier) product *= each->v | 1;
    thread->write(sum(earlier, [](const Thread& each) { return each.v; }));
    thread->write(product);
    thread->write(sum(earlier, [](const Thread& each) { return each.v > 500 ? 1u : 0u; }));
  }
}

void model_partitions(const Active& wave, uint32_t) {
  const auto key = [](const Thread& thread) { return thread.v % 3; };
  for (Thread* thread : wave) {
    const Active same = those(wave, [&](const Thread& each) { return key(each) == key(*thread); });
    const Active earlier = before(same, *thread);
    uint32_t all = ~0u, any = 0, odd = 0;
    for (const Thread* each : earlier) {
      all &= each->v;
      any |= each->v;
      odd ^= each->v;
    }
    thread->write(ballot(same));
    thread->write(sum(earlier, [](const Thread& each) { return each.v; }));
    thread->write(count(earlier));
    thread->write(all);
    thread->write(any);
    thread->write(odd);
  }
}

void model_reads(const Active& wave, uint32_t) {
  const uint32_t size = count(wave);
  const auto at = [&](uint32_t lane) { return wave[lane]->v; };
  for (Thread* thread : wave) {
    thread->write(at((thread->lane * 7 + 3) % size));
    thread->write(at(size - 1));
    // Quads are whole except the last one of a group.
    const uint32_t quad = thread->lane & ~3u;
    const bool whole = quad + 3 < size;
    thread->write(whole ? at(thread->lane ^ 1) : 1);
    thread->write(whole ? at(thread->lane ^ 2) : 1);
    thread->write(whole ? at(thread->lane ^ 3) : 1);
    thread->write(whole ? at(quad + 2) : 1);
    bool any = false, all = true;
    for (uint32_t lane = quad; lane < std::min(quad + 4, size); ++lane) {
      any = any || at(lane) % 4 == 0;
      all = all && at(lane) % 8 != 0;
    }
    thread->write(any ? 1 : 0);
    thread->write(all ? 1 : 0);
  }
}

void model_loops(const Active& wave, uint32_t) {
  std::vector<uint32_t> totals(kThreads);
  Active left = wave;
  for (uint32_t k = 0; k < 6; ++k) {
    const Active skip = those(left, [&](const Thread& t) { return (t.i + k) % 3 == 0; });
    Active go = those(left, [&](const Thread& t) { return (t.i + k) % 3 != 0; });
    left = those(left, [&](const Thread& t) { return (t.i + k) % 3 == 0 || t.v % 7 != k; });
    go = those(go, [&](const Thread& t) { return t.v % 7 != k; });
    for (const Thread* thread : go) totals[thread->i] += count(go) * (k + 1);
  }
  for (Thread* thread : wave) {
    thread->write(totals[thread->i]);
    thread->write(count(wave));
  }
}

void model_different_lengths(const Active& wave, uint32_t) {
  std::vector<uint32_t> totals(kThreads);
  for (uint32_t a = 0; a < 4; ++a) {
    const Active outer = those(wave, [&](const Thread& t) { return a < t.v % 5; });
    for (uint32_t b = 0; b < 3; ++b) {
      const Active inner = those(outer, [&](const Thread& t) { return b <= t.i % 3; });
      for (const Thread* thread : inner) totals[thread->i] += ballot(inner) ^ (a * 16 + b);
    }
    for (const Thread* thread : outer) totals[thread->i] += count(outer) << 16;
  }
  for (Thread* thread : wave) thread->write(totals[thread->i]);
}

void model_early_returns(const Active& wave, uint32_t) {
  // f(x): lanes return at k == x % 4.
  std::vector<uint32_t> results(kThreads);
  const auto f = [&](const Active& callers, const std::function<uint32_t(const Thread&)>& x) {
    for (uint32_t k = 0; k < 4; ++k) {
      const Active leaving = those(callers, [&](const Thread& t) { return x(t) % 4 == k; });
      const Active present = those(callers, [&](const Thread& t) { return x(t) % 4 >= k; });
      for (const Thread* thread : leaving) {
        results[thread->i] = count(leaving) * 100 + count(present);
      }
    }
  };
  const Active some = those(wave, [](const Thread& t) { return t.v % 3 == 1; });
  const Active rest = those(wave, [](const Thread& t) { return t.v % 3 != 1; });
  f(some, [](const Thread& t) { return t.v; });
  f(rest, [](const Thread& t) { return t.i; });
  for (Thread* thread : wave) thread->write(results[thread->i]);
  const Active stay = those(wave, [](const Thread& t) { return t.v % 11 > 3; });
  for (Thread* thread : stay) {
    thread->write(sum(stay, [](const Thread& each) { return each.v; }));
  }
}

void model_barriers(const Active& wave, uint32_t) {
  // Through groupshared memory.
  uint32_t most = 0;
  for (const Thread* thread : wave) most = std::max(most, thread->v);
  for (Thread* thread : wave) thread->write(most);
}

constexpr Case kCases[] = {
    {"lanes", R"(
  write(WaveGetLaneCount());
  write(WaveGetLaneIndex());
  write(WaveIsFirstLane());
  write(WaveActiveBallot(true).x);
})",
     true, model_lanes},
    {"waves_of_group", R"(
  write(GetGroupWaveIndex());
  write(GetGroupWaveCount());
  if (v % 2 == 1) write(GetGroupWaveIndex() + 7);
})",
     true, model_waves_of_group, "lib_6_10"},
    {"reductions", R"(
  if (v % 2 == 1) {
    write(WaveActiveSum(v));
    write(WaveActiveProduct(v | 1));
    write(WaveActiveMin(v));
    write(WaveActiveMax(v));
    write(WaveActiveBitAnd(v));
    write(WaveActiveBallot(true).x);
    write(WaveReadLaneFirst(v));
    write(WaveReadLaneAt(v, firstbithigh(WaveActiveBallot(true).x)));
  } else {
    write(WaveActiveSum(v));
    write(WaveActiveProduct(v | 1));
    write(WaveActiveMin(v));
    write(WaveActiveMax(v));
    write(WaveActiveBitAnd(v));
    write(WaveActiveBallot(true).x);
    write(WaveReadLaneFirst(v));
    write(WaveReadLaneAt(v, firstbithigh(WaveActiveBallot(true).x)));
  }
})",
     true, model_reductions},
    {"prefixes", R"(
  if (v % 5 == 0) return;
  write(WavePrefixSum(v));
  write(WavePrefixProduct(v | 1));
  write(WavePrefixCountBits(v > 500));
})",
     true, model_prefixes},
    {"partitions", R"(
  const uint4 same = WaveMatch(v % 3);
  write(same.x);
  write(WaveMultiPrefixSum(v, same));
  write(WaveMultiPrefixCountBits(true, same));
  write(WaveMultiPrefixBitAnd(v, same));
  write(WaveMultiPrefixBitOr(v, same));
  write(WaveMultiPrefixBitXor(v, same));
})",
     true, model_partitions},
    {"reads", R"(
  const uint lane = WaveGetLaneIndex();
  const uint size = WaveActiveCountBits(true);
  const bool whole = (lane | 3) < size;
  write(WaveReadLaneAt(v, (lane * 7 + 3) % size));
  write(WaveReadLaneAt(v, size - 1));
  const uint x = QuadReadAcrossX(v), y = QuadReadAcrossY(v), d = QuadReadAcrossDiagonal(v);
  const uint c = QuadReadLaneAt(v, 2);
  write(whole ? x : 1);
  write(whole ? y : 1);
  write(whole ? d : 1);
  write(whole ? c : 1);
  write(QuadAny(v % 4 == 0));
  write(QuadAll(v % 8 != 0));
})",
     true, model_reads},
    {"loops", R"(
  uint total = 0;
  for (uint k = 0; k < 6; ++k) {
    if ((i + k) % 3 == 0) continue;
    if (v % 7 == k) break;
    total += WaveActiveSum(k + 1);
  }
  write(total);
  write(WaveActiveCountBits(true));
})",
     true, model_loops},
    {"different_lengths", R"(
  uint total = 0;
  for (uint a = 0; a < v % 5; ++a) {
    uint b = 0;
    do {
      total += WaveActiveBallot(true).x ^ (a * 16 + b);
    } while (b++ < i % 3);
    total += WaveActiveCountBits(true) << 16;
  }
  write(total);
})",
     true, model_different_lengths},
    {"early_returns", R"(
  uint result = 0;
  if (v % 3 == 1) {
    result = f(v);
  } else {
    result = f(i);
  }
  write(result);
  if (v % 11 <= 3) return;
  write(WaveActiveSum(v));
})",
     true, model_early_returns},
    {"barriers", R"(
  if (i < 32) shared_words[i] = 0;
  GroupMemoryBarrierWithGroupSync();
  if (WaveIsFirstLane()) shared_words[i / WaveGetLaneCount()] = WaveActiveMax(v);
  GroupMemoryBarrierWithGroupSync();
  const uint most = WaveActiveMax(v);
  if (WaveIsFirstLane()) shared_words[i / WaveGetLaneCount()] = most;
  GroupMemoryBarrierWithGroupSync();
  write(shared_words[i / WaveGetLaneCount()]);
})",
     false, model_barriers},
};
constexpr char kHelpers[] = R"(
groupshared uint shared_words[32];
uint f(uint x) {
  for (uint k = 0; k < 4; ++k) {
    const uint present = WaveActiveCountBits(true);
    if (x % 4 == k) return WaveActiveCountBits(true) * 100 + present;
  }
  return 0;
}
)";

hlsl::FrontendOptions options_of(const Case& test) {
  hlsl::FrontendOptions options;
  options.path = std::string(test.name) + ".hlsl";
  options.target = test.target;
  options.experimental = true;
  options.text = std::string(kHead) + kHelpers + kMain + test.body;
  return options;
}

std::vector<uint32_t> expected_words(const Case& test, uint32_t lanes) {
  std::vector<Thread> threads(size_t{kThreads} * kGroups);
  for (uint32_t n = 0; n < threads.size(); ++n) {
    threads[n].i = n % kThreads;
    threads[n].lane = threads[n].i % lanes;
    threads[n].v = mix(n + 5) & 1023;
  }
  for (uint32_t group = 0; group < kGroups; ++group) {
    for (uint32_t first = 0; first < kThreads; first += lanes) {
      Active wave;
      for (uint32_t i = first; i < std::min(first + lanes, kThreads); ++i) {
        wave.push_back(&threads[group * kThreads + i]);
      }
      test.model(wave, lanes);
    }
  }
  std::vector<uint32_t> words(threads.size() * kWords);
  for (size_t n = 0; n < threads.size(); ++n) {
    std::copy(threads[n].out.begin(), threads[n].out.end(), words.begin() + n * kWords);
  }
  return words;
}

// Returns where the results differ from the model; empty if nowhere.
std::string difference(const Case& test, const Compiled& code, const std::string& backend,
                       uint32_t lanes) {
  if (code.library == nullptr) return code.error;
  const auto ran = run_on_device(backend, *code.library, {kGroups, 1, 1}, nullptr,
                                 backend == "embree" ? lanes : 0);
  if (!ran) return ran.error();
  const std::vector<std::byte>& bytes = *ran;
  const std::vector<uint32_t> expected = expected_words(test, lanes);
  for (size_t n = 0; n < expected.size(); ++n) {
    uint32_t word = 0;
    std::memcpy(&word, bytes.data() + 4 * n, sizeof(word));
    if (word == expected[n]) continue;
    return "thread " + std::to_string(n / kWords % kThreads) + " of group " +
           std::to_string(n / kWords / kThreads) + ", word " + std::to_string(n % kWords) + ": " +
           std::to_string(word) + " instead of " + std::to_string(expected[n]);
  }
  return {};
}

const Compiled& native(size_t index, hlsl::WideThreads wide) {
  static const auto all_options = [] {
    std::vector<hlsl::FrontendOptions> out;
    for (const Case& test : kCases) out.push_back(options_of(test));
    return out;
  }();
  static const std::vector<Compiled> single =
      compile_native(all_options, hlsl::WideThreads::kNever);
  static const std::vector<Compiled> at_once =
      compile_native(all_options, hlsl::WideThreads::kAlways);
  return (wide == hlsl::WideThreads::kNever ? single : at_once)[index];
}

constexpr uint32_t kLaneCounts[] = {4, 8, 16, 32};

class Waves : public testing::TestWithParam<size_t> {};

TEST_P(Waves, GiveWhatTheModelGivesThreadByThread) {
  for (const uint32_t lanes : kLaneCounts) {
    EXPECT_EQ(difference(kCases[GetParam()], native(GetParam(), hlsl::WideThreads::kNever),
                         "embree", lanes),
              "")
        << lanes << " lanes";
  }
}

TEST_P(Waves, GiveWhatTheModelGivesEightThreadsAtOnce) {
  const Case& test = kCases[GetParam()];
  const Compiled& code = native(GetParam(), hlsl::WideThreads::kAlways);
  ASSERT_NE(code.library, nullptr) << code.error;
  EXPECT_EQ(code.library->exports[0].compute->lanes != nullptr, test.wide);
  for (const uint32_t lanes : kLaneCounts) {
    EXPECT_EQ(difference(test, code, "embree", lanes), "") << lanes << " lanes";
  }
}

TEST_P(Waves, GiveWhatTheModelGivesInterpreted) {
  const Compiled code = compile_interpreted(options_of(kCases[GetParam()]));
  for (const uint32_t lanes : kLaneCounts) {
    EXPECT_EQ(difference(kCases[GetParam()], code, "embree", lanes), "") << lanes << " lanes";
  }
}

// Returns how many lanes a wave has on the Vulkan device.
uint32_t lanes_on_vulkan() {
  hlsl::FrontendOptions options;
  options.path = "lanes.hlsl";
  options.text =
      "RWByteAddressBuffer results : register(u0);\n[shader(\"compute\")] [numthreads(1, 1, 1)]\n"
      "void main() { results.Store(0, WaveGetLaneCount()); }\n";
  const Compiled code = compile_vulkan(options);
  if (code.library == nullptr) return 0;
  const auto bytes = run_on_device("vulkan", *code.library, {1, 1, 1});
  uint32_t lanes = 0;
  if (bytes) std::memcpy(&lanes, bytes->data(), sizeof(lanes));
  return lanes;
}

TEST_P(Waves, GiveWhatTheModelGivesOnVulkan) {
  KAAMOS_NEED_VULKAN();
  const uint32_t lanes = lanes_on_vulkan();
  ASSERT_GE(lanes, 4u);
  ASSERT_LE(lanes, 32u) << "the model's masks have 32 bits";
  EXPECT_EQ(difference(kCases[GetParam()], compile_vulkan(options_of(kCases[GetParam()])), "vulkan",
                       lanes),
            "");
}

INSTANTIATE_TEST_SUITE_P(All, Waves, testing::Range<size_t>(0, std::size(kCases)),
                         [](const auto& given) { return std::string(kCases[given.param].name); });

}  // namespace
}  // namespace kaamos::test
