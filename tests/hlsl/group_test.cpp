// SPDX-License-Identifier: MIT
//
// Compute shaders with barriers, run in every way in which a group can run: split at the barriers,
// on fibers, interpreted. All must write the same bytes, and everything that can be split must be.
#include <dlfcn.h>
#include <gtest/gtest.h>
#include <kaamos/shader/abi.h>

#include <algorithm>

#include "executors.h"
#include "fixtures.h"
#include "runtime/hlsl/analysis/split_groups.h"
#include "runtime/hlsl/cpp/emit_cpp.h"
#include "runtime/hlsl/driver/host_compiler.h"

namespace kaamos::test {
namespace {

struct Case {
  const char* name;
  bool is_cut;
  const char* body;
};

// Precedes each case. Word i of the constant buffer is i.
constexpr char kHead[] = R"(
RWByteAddressBuffer results : register(u0);
cbuffer Numbers : register(b0) { uint zero; uint one; uint two; uint three; uint4 more; };
groupshared uint memory[128];
groupshared float tile[8][8];
#define WAIT GroupMemoryBarrierWithGroupSync()
uint mix(uint x) { x ^= x >> 15; x *= 0x2C1B3C6D; x ^= x >> 12; return x; }
)";

constexpr Case kCases[] = {
    {"reduction", true, R"(
[shader("compute")] [numthreads(64, 1, 1)]
void main(uint i : SV_GroupIndex, uint3 id : SV_DispatchThreadID, uint3 g : SV_GroupID) {
  const uint mine = mix(id.x);
  memory[i] = mine;
  for (uint s = 32; s > 0; s >>= 1) {
    WAIT;
    if (i < s) memory[i] += memory[i + s];
  }
  WAIT;
  results.Store(4 * id.x, mine ^ memory[0]);
})"},
    {"prefix_sum", true, R"(
[shader("compute")] [numthreads(128, 1, 1)]
void main(uint i : SV_GroupIndex, uint3 id : SV_DispatchThreadID) {
  memory[i] = mix(id.x) & 255;
  WAIT;
  [unroll] for (uint d = 1; d < 128; d *= 2) {
    uint sum = memory[i];
    if (i >= d) sum += memory[i - d];
    WAIT;
    memory[i] = sum;
    WAIT;
  }
  results.Store(4 * id.x, memory[i]);
})"},
    {"bitonic_sort_in_nested_loops", true, R"(
[shader("compute")] [numthreads(64, 1, 1)]
void main(uint i : SV_GroupIndex, uint3 id : SV_DispatchThreadID) {
  memory[i] = mix(id.x + 7);
  for (uint k = 2; k <= 64; k *= 2) {
    for (uint j = k / 2; j > 0; j /= 2) {
      WAIT;
      const uint other = i ^ j;
      const uint a = memory[i], b = memory[other];
      const bool up = (i & k) == 0;
      const bool low = other > i;
      WAIT;
      memory[i] = (low == up) ? min(a, b) : max(a, b);
    }
  }
  WAIT;
  results.Store(4 * id.x, memory[i]);
})"},
    {"matrix_product_by_tiles", true, R"(
groupshared float other[8][8];
[shader("compute")] [numthreads(8, 8, 1)]
void main(uint3 t : SV_GroupThreadID, uint3 g : SV_GroupID, uint i : SV_GroupIndex) {
  float sum = 0;
  for (uint step = 0; step < two + two; ++step) {
    tile[t.y][t.x] = float(mix(i + step * 64 + g.x) & 1023) / 7;
    other[t.y][t.x] = float(mix(i * 3 + step) & 1023) / 3;
    WAIT;
    for (uint k = 0; k < 8; ++k) sum += tile[t.y][k] * other[k][t.x];
    WAIT;
  }
  results.Store(4 * (g.x * 64 + i), asuint(sum));
})"},
    {"early_return_of_single_threads", true, R"(
[shader("compute")] [numthreads(32, 1, 1)]
void main(uint i : SV_GroupIndex, uint3 id : SV_DispatchThreadID) {
  memory[i] = 5;
  if (mix(id.x) % 3 == 0) {
    results.Store(4 * id.x, 1);
    return;
  }
  memory[i] = id.x;
  WAIT;
  for (uint k = 0; k < 4; ++k) {
    if (memory[(i + k) & 31] % 7 == k + 1) { results.Store(4 * id.x, 100 + k); return; }
  }
  WAIT;
  results.Store(4 * id.x, 1000 + memory[(i + 9) & 31]);
})"},
    {"all_return_inside_an_endless_loop", true, R"(
[shader("compute")] [numthreads(16, 1, 1)]
void main(uint i : SV_GroupIndex, uint3 id : SV_DispatchThreadID) {
  uint turns = 0;
  for (;;) {
    memory[i] = turns;
    WAIT;
    ++turns;
    if (turns > (id.x & 3)) { results.Store(4 * id.x, turns * 10 + memory[(i + 1) & 15]); return; }
    WAIT;
  }
})"},
    {"uniform_conditions", true, R"(
[shader("compute")] [numthreads(16, 1, 1)]
void main(uint i : SV_GroupIndex, uint3 id : SV_DispatchThreadID, uint3 g : SV_GroupID) {
  uint x = mix(id.x);
  if (three > two) {
    memory[i] = x;
    WAIT;
    x += memory[15 - i];
  } else {
    WAIT;
    x = 0;
  }
  WAIT;
  if ((g.x & 1) == one) {
    memory[i] = x;
    WAIT;
    x ^= memory[i ^ 1];
  }
  const uint limit = more.y;
  uint k = 0;
  do {
    WAIT;
    memory[i] = x + k;
    WAIT;
    x += memory[(i + k) & 15];
    k += two;
    if (k == 4) continue;
    x *= 3;
    if (k > limit) break;
  } while (k < 8);
  results.Store(4 * id.x, x);
})"},
    {"helpers_with_barriers", true, R"(
static uint rounds = 3;
uint share(uint i, inout uint value, out uint left) {
  left += 1;
  memory[i] = value;
  WAIT;
  left = memory[(i + 63) & 63];
  value += memory[(i + 1) & 63];
  WAIT;
  rounds += left & 1;
  return value ^ left;
}
void twice(uint i, inout uint value) {
  uint unused;
  value += share(i, value, unused);
  value += share(63 - i, value, unused) + unused;
}
[shader("compute")] [numthreads(64, 1, 1)]
void main(uint i : SV_GroupIndex, uint3 id : SV_DispatchThreadID) {
  uint value = mix(id.x);
  i = 63 - i;
  for (int k = 0; k < 3; ++k) twice(i, value);
  results.Store(8 * id.x, value);
  results.Store(8 * id.x + 4, rounds * 100 + i);
})"},
    {"structs_and_arrays_live_across", true, R"(
struct Part { float3 v; bool flag; uint values[3]; };
[shader("compute")] [numthreads(4, 4, 2)]
void main(uint3 t : SV_GroupThreadID, uint i : SV_GroupIndex, uint3 id : SV_DispatchThreadID) {
  Part part;
  part.v = float3(t) * 0.5f;
  part.flag = (i & 1) != 0;
  [unroll] for (uint k = 0; k < 3; ++k) part.values[k] = mix(i + k);
  memory[i] = part.values[t.x % 3];
  AllMemoryBarrierWithGroupSync();
  part.values[1] += memory[31 - i];
  part.v.yx += part.flag ? 2 : 1;
  DeviceMemoryBarrierWithGroupSync();
  const uint at = (id.x + 16 * (id.y + 4 * id.z)) * 16;
  results.Store4(at, uint4(asuint(part.v), part.values[0] ^ part.values[1] ^ part.values[2]));
})"},
    {"atomics_in_turn", true, R"(
groupshared uint total;
[shader("compute")] [numthreads(32, 1, 1)]
void main(uint i : SV_GroupIndex, uint3 id : SV_DispatchThreadID) {
  if (i == 0) total = 0;
  WAIT;
  uint before;
  InterlockedAdd(total, mix(id.x) & 15, before);
  InterlockedMax(memory[i & 3], mix(id.x));
  WAIT;
  results.Store(4 * id.x, total + memory[i & 3]);
})"},
    {"a_name_for_everything", true, R"(
[shader("compute")] [numthreads(8, 1, 1)]
void main(uint n : SV_GroupIndex, uint3 thread : SV_DispatchThreadID, uint3 group : SV_GroupID) {
  uint size = mix(thread.x), ended = n, alive = group.x, statics = 2, invocation = 1;
  memory[n] = size;
  WAIT;
  size += memory[n ^ 1] + ended * statics + alive + invocation;
  uint ctx = size;
  WAIT;
  results.Store(4 * thread.x, size ^ ctx << 1);
})"},
    // Cases that must stay on fibers.
    {"condition_of_the_thread", false, R"(
[shader("compute")] [numthreads(16, 1, 1)]
void main(uint i : SV_GroupIndex, uint3 id : SV_DispatchThreadID) {
  uint turns = memory[0] + 2;  // the same for all, but nothing says so
  for (uint k = 0; k < turns; ++k) {
    memory[16 + i] = mix(k + id.x);
    WAIT;
    results.Store(4 * id.x, memory[16 + (i ^ 1)]);
    WAIT;
  }
})"},
    {"counter_that_a_thread_changes", false, R"(
[shader("compute")] [numthreads(16, 1, 1)]
void main(uint i : SV_GroupIndex, uint3 id : SV_DispatchThreadID) {
  for (uint k = 0; k < 4; ++k) {
    memory[i] = k + id.x;
    WAIT;
    results.Store(4 * id.x, memory[i ^ 1] + k);
    WAIT;
    if (memory[0] == 12345678) k = 7;
  }
})"},
    {"barrier_in_a_switch", false, R"(
[shader("compute")] [numthreads(16, 1, 1)]
void main(uint i : SV_GroupIndex, uint3 id : SV_DispatchThreadID) {
  memory[i] = id.x * 3;
  switch (two) {
    case 1: break;
    case 2: WAIT; results.Store(4 * id.x, memory[15 - i]); break;
  }
})"},
    {"helper_that_returns_early", false, R"(
uint get(uint i) { WAIT; if (i > 3) return memory[i]; return memory[0] + 1; }
[shader("compute")] [numthreads(16, 1, 1)]
void main(uint i : SV_GroupIndex, uint3 id : SV_DispatchThreadID) {
  memory[i] = id.x + 2;
  results.Store(4 * id.x, get(i));
})"},
    {"too_much_to_keep", false, R"(
[shader("compute")] [numthreads(128, 1, 1)]
void main(uint i : SV_GroupIndex, uint3 id : SV_DispatchThreadID) {
  uint own[1024];
  for (uint k = 0; k < 1024; ++k) own[k] = mix(k ^ id.x);
  memory[i] = own[i];
  WAIT;
  results.Store(4 * id.x, own[memory[127 - i] & 1023]);
})"},
};
constexpr size_t kCaseCount = std::size(kCases);

hlsl::FrontendOptions options_of(const Case& test) {
  hlsl::FrontendOptions options;
  options.path = std::string(test.name) + ".hlsl";
  options.text = std::string(kHead) + test.body;
  return options;
}

std::unique_ptr<hlsl::ir::Module> module_of(const Case& test) {
  auto module = compile_module(options_of(test));
  EXPECT_EQ(module.error(), "");
  return module ? *std::move(module) : nullptr;
}

// All cases in one shared object: "cut_3", "fibers_3".
void* native_code() {
  static void* const handle = []() -> void* {
    std::string source;
    for (size_t i = 0; i < kCaseCount; ++i) {
      const auto module = module_of(kCases[i]);
      if (module == nullptr) return nullptr;
      for (const bool split : {true, false}) {
        const std::string name = (split ? "cut_" : "fibers_") + std::to_string(i);
        source += hlsl::emit_cpp(*module, {.entry_point = name, .split_groups = split});
      }
    }
    const auto compiler = hlsl::find_host_compiler();
    if (!compiler) return nullptr;
    const auto object = hlsl::build_shared_object(*compiler, source, hlsl::Optimisation::kFull,
                                                  std::string(KAAMOS_BINARY_DIR) + "/shader-cache");
    EXPECT_EQ(object.error.message(), "");
    return dlopen(object.path.c_str(), RTLD_NOW | RTLD_LOCAL);
  }();
  return handle;
}

const shader::LibraryDesc* native_library(const std::string& name) {
  void* handle = native_code();
  void* entry = handle != nullptr ? dlsym(handle, name.c_str()) : nullptr;
  return entry != nullptr ? reinterpret_cast<shader::LibraryEntryPointFn>(entry)() : nullptr;
}

std::vector<std::byte> run(const shader::LibraryDesc& library) {
  const auto out = run_on_device("embree", library, {4, 1, 1});
  EXPECT_EQ(out.error(), "");
  return out ? *out : std::vector<std::byte>();
}

class Groups : public testing::TestWithParam<size_t> {};

TEST_P(Groups, GiveTheSameOnEveryExecutor) {
  const Case& test = kCases[GetParam()];
  const std::string number = std::to_string(GetParam());
  const shader::LibraryDesc* cut = native_library("cut_" + number);
  const shader::LibraryDesc* fibers = native_library("fibers_" + number);
  ASSERT_NE(cut, nullptr);
  ASSERT_NE(fibers, nullptr);
  EXPECT_EQ(cut->exports[0].compute->group != nullptr, test.is_cut);
  EXPECT_EQ(fibers->exports[0].compute->group, nullptr);
  const std::vector<std::byte> expected = run(*fibers);
  EXPECT_TRUE(
      std::any_of(expected.begin(), expected.end(), [](std::byte b) { return b != std::byte{0}; }));
  EXPECT_TRUE(run(*cut) == expected);
  const Compiled interpreted = compile_interpreted(options_of(test));
  ASSERT_NE(interpreted.library, nullptr) << interpreted.error;
  EXPECT_TRUE(run(*interpreted.library) == expected);
}

INSTANTIATE_TEST_SUITE_P(Split, Groups, testing::Range(size_t{0}, kCaseCount),
                         [](const auto& test) { return std::string(kCases[test.param].name); });

TEST(GroupPlan, SaysWhyABodyCannotBeCut) {
  const auto reason_of = [](const char* name) {
    for (const Case& test : kCases) {
      if (std::string(test.name) != name) continue;
      const auto module = module_of(test);
      std::string reason;
      const bool planned = hlsl::plan_group(module->entry_points[0], reason).has_value();
      EXPECT_EQ(planned, reason.empty());
      return reason;
    }
    return std::string("no such case");
  };
  EXPECT_EQ(reason_of("reduction"), "");
  EXPECT_EQ(reason_of("condition_of_the_thread"),
            "a condition around a barrier may differ between threads (line 12)");
  EXPECT_EQ(reason_of("barrier_in_a_switch"),
            "a barrier, or a way out of a loop with barriers, is in a switch");
  EXPECT_EQ(reason_of("helper_that_returns_early"),
            "a function with barriers returns before its end");
}

}  // namespace
}  // namespace kaamos::test
