// SPDX-License-Identifier: MIT
//
// Tests which pieces a body is cut into, which variables the group shares and which each thread
// keeps. What the pieces compute is compared with fibers in tests/hlsl/group_test.cpp.
#include "runtime/hlsl/analysis/split_groups.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "runtime/hlsl/driver/frontend.h"
#include "runtime/hlsl/front/file_loader.h"

namespace kaamos::hlsl {
namespace {

// "threads", "once x" and so on, with nested regions in braces.
std::string text_of(const std::vector<Region>& regions) {
  std::string out;
  for (const Region& region : regions) {
    if (!out.empty()) out += " ";
    switch (region.kind) {
      case RegionKind::kThreads:
        out += region.may_return ? "threads-return" : "threads";
        break;
      case RegionKind::kOnce:
        out += "once";
        break;
      case RegionKind::kBarrier:
        out += "barrier";
        break;
      case RegionKind::kIf:
        out += "if{" + text_of(region.body) + "}{" + text_of(region.orelse) + "}";
        break;
      case RegionKind::kLoop:
        out += "loop{" + text_of(region.prelude) + "}{" + text_of(region.body) + "}{" +
               text_of(region.step) + "}";
        break;
      case RegionKind::kBreak:
        out += "break";
        break;
      case RegionKind::kContinue:
        out += "continue";
        break;
      case RegionKind::kReturn:
        out += "return";
        break;
    }
  }
  return out;
}

std::string names_of(const std::unordered_set<const ir::Variable*>& variables) {
  std::vector<std::string> names;
  for (const ir::Variable* variable : variables) names.push_back(variable->name);
  std::sort(names.begin(), names.end());
  std::string out;
  for (const std::string& name : names) out += (out.empty() ? "" : " ") + name;
  return out;
}

struct Planned {
  std::string regions;
  std::string uniform;
  std::string kept;
  std::string reason;
};

// `body` is the body of a kernel with 8 x 8 threads.
Planned plan(const std::string& body, const std::string& before = "") {
  DiskFileLoader loader;
  SourceManager sources(loader);
  DiagnosticEngine diagnostics;
  FrontendOptions options;
  options.path = "test.hlsl";
  options.text =
      "RWByteAddressBuffer results : register(u0);\n"
      "ByteAddressBuffer input : register(t0);\n"
      "cbuffer Numbers : register(b0) { uint a; uint b; uint4 more[2]; };\n"
      "groupshared uint memory[64];\n"
      "static const uint kRounds = 4;\n"
      "#define WAIT GroupMemoryBarrierWithGroupSync()\n" +
      before +
      "\n[shader(\"compute\")] [numthreads(8, 8, 1)]\n"
      "void main(uint i : SV_GroupIndex, uint3 g : SV_GroupID,\n"
      "          uint3 t : SV_GroupThreadID) {" +
      body + "}";
  const auto module = compile_to_ir(options, sources, diagnostics);
  EXPECT_TRUE(module != nullptr) << render_all(diagnostics, sources);
  Planned out;
  if (module == nullptr) return out;
  const auto found = plan_group(module->entry_points[0], out.reason);
  if (!found) return out;
  return {text_of(found->regions), names_of(found->uniform), names_of(found->kept), out.reason};
}

TEST(SplitGroups, CutsStraightLinesAndKeepsWhatLivesAcross) {
  const Planned found = plan(R"(
    uint mine = i * 3;
    uint passing = mine + 1;
    memory[i] = passing;
    WAIT;
    uint other = memory[i ^ 1];
    results.Store(4 * i, mine + other);)");
  EXPECT_EQ(found.regions, "threads barrier threads");
  EXPECT_EQ(found.kept, "mine");
  EXPECT_EQ(found.uniform, "");
}

TEST(SplitGroups, CountersOfLoopsBelongToTheGroup) {
  const Planned found = plan(R"(
    memory[i] = i;
    uint unneeded = 7;
    for (uint s = 32, last = kRounds; s > last; s >>= 1) {
      WAIT;
      if (i < s) memory[i] += memory[i + s] + unneeded;
    })");
  EXPECT_EQ(found.regions, "threads once once loop{}{barrier threads}{once}");
  EXPECT_EQ(found.uniform, "last s");
  EXPECT_EQ(found.kept, "unneeded");
}

TEST(SplitGroups, ConstantBuffersAndTheGroupsIdAreUniform) {
  EXPECT_EQ(plan("if (a + more[1].y > b) { WAIT; }").regions, "if{barrier}{}");
  EXPECT_EQ(plan("if (more[g.x & 1].z == max(g.y, 3)) { WAIT; }").regions, "if{barrier}{}");
  EXPECT_EQ(plan("const uint n = a * 2; const bool go = n > 3; if (go) { WAIT; }").uniform, "go n");
}

TEST(SplitGroups, WhatThreadsCanChangeIsNot) {
  const std::string text = "a condition around a barrier may differ between threads (line 10)";
  for (const char* body : {
           "if (i < 3) { WAIT; }",
           "if (t.y == g.y) { WAIT; }",
           "if (memory[0] == 1) { WAIT; }",
           "if (input.Load(0) == 1) { WAIT; }",  // may alias what the group writes
           "uint n = 4; if (i == 0) n = 5; if (n > a) { WAIT; }",
           "uint n = 4; n += i; if (n > a) { WAIT; }",
           "uint n[2] = {1, 2}; n[i & 1] = 3; if (n[0] > a) { WAIT; }",
           "uint n = 4; InterlockedAdd(memory[0], 1, n); if (n > a) { WAIT; }",
           "uint3 id = g; id.x = t.x; if (id.x > a) { WAIT; }",
           "for (uint k = 0; k < 4; ++k) { if (i == k) break; WAIT; }",
           "for (uint k = 0; k < 4; ++k) { if (i == k) continue; WAIT; }",
           "for (uint k = i; k < 4; ++k) { WAIT; }",
           "g.x = i; if (g.x > a) { WAIT; }",
       }) {
    EXPECT_EQ(plan(body).reason, text) << body;
  }
}

TEST(SplitGroups, VariablesThatDependOnEachOtherFallTogether) {
  EXPECT_EQ(plan(R"(uint x = 1; uint y = 2;
    for (uint k = 0; k < 3; ++k) { WAIT; const uint old = x; x = y; y = old; }
    if (x > a) { WAIT; })")
                .reason,
            "");
  EXPECT_NE(plan(R"(uint x = 1; uint y = 2;
    for (uint k = 0; k < 3; ++k) { WAIT; const uint old = x; x = y; y = old + i; }
    if (x > a) { WAIT; })")
                .reason,
            "");
}

TEST(SplitGroups, ThreadsMayEndEarly) {
  const Planned found = plan(R"(
    if (i > 40) return;
    WAIT;
    results.Store(0, 1);
    if (a == 1) { WAIT; return; }
    WAIT;)");
  EXPECT_EQ(found.regions, "threads-return barrier threads if{barrier return}{} barrier");
}

TEST(SplitGroups, LoopsWithoutBarriersStayWhole) {
  const Planned found = plan(R"(
    uint sum = 0;
    for (uint k = 0; k < i; ++k) { if (k == 5) break; sum += k; }
    switch (i) { case 0: sum = 1; break; default: break; }
    WAIT;
    results.Store(4 * i, sum);)");
  EXPECT_EQ(found.regions, "threads barrier threads");
  EXPECT_EQ(found.kept, "sum");
}

TEST(SplitGroups, BarriersWithoutSynchronisationCutNothing) {
  EXPECT_EQ(plan("memory[i] = 1; GroupMemoryBarrier(); memory[i] = 2; WAIT;").regions,
            "threads barrier");
  EXPECT_EQ(plan("memory[i] = 1; GroupMemoryBarrier();").reason, "it has no barriers");
}

TEST(SplitGroups, FunctionsStandInPlaceOfTheirCalls) {
  const Planned found = plan("uint x = i; exchange(x, a); results.Store(4 * i, x);", R"(
    void exchange(inout uint value, uint rounds) {
      for (uint k = 0; k < rounds; ++k) {
        memory[value & 63] = value;
        WAIT;
        value += memory[k];
        WAIT;
      }
    })");
  EXPECT_EQ(found.regions,
            "threads once once loop{}{threads barrier threads barrier}{once} threads");
  EXPECT_EQ(found.uniform, "k rounds");
}

TEST(SplitGroups, WrittenParametersAreKept) {
  EXPECT_EQ(plan("i += 1; WAIT; results.Store(0, i);").kept, "i");
  EXPECT_EQ(plan("WAIT; results.Store(0, i + t.x);").kept, "");
}

}  // namespace
}  // namespace kaamos::hlsl
