// SPDX-License-Identifier: MIT
//
// Compute and ray generation shaders whose threads diverge in every possible way, run several at
// once and one by one: they must write the same bytes.
#include <gtest/gtest.h>
#include <kaamos/shader/abi.h>

#include <algorithm>

#include "executors.h"
#include "fixtures.h"
#include "runtime/hlsl/analysis/wide_plan.h"
#include "wide_cases.h"

namespace kaamos::test {
namespace {

// As compute shaders of 64 threads, and as ray generation shaders with rows whose length is not a
// multiple of 8.
constexpr char kThreads[] = "[numthreads(64, 1, 1)] void main(uint3 id : SV_DispatchThreadID";
constexpr uint32_t kGroups[3] = {4, 1, 1};
constexpr uint32_t kRays[3] = {13, 20, 1};

struct Form {
  std::string name;
  std::string text;
  bool rays = false;
};

std::vector<Form> make_forms() {
  std::vector<Form> out;
  const auto add_rays = [&out](const WideCase& test, const std::string& head) {
    std::string body = test.body;
    const size_t begin = body.find(kThreads);
    if (begin == std::string::npos) return;  // another signature
    const size_t end = body.find('{', begin) + 1;
    const bool group = body.substr(begin, end - begin).find("SV_GroupID") != std::string::npos;
    body.replace(
        begin, end - begin,
        std::string("[shader(\"raygeneration\")] void Main() {\n"
                    "const uint3 id = {DispatchRaysIndex().y * 13 + DispatchRaysIndex().x, "
                    "0, 0};\n") +
            (group ? "const uint3 g = id / 64;\n" : ""));
    out.push_back({std::string("rays_of_") + test.name, head + body, true});
  };
  for (const WideCase& test : kWideCases) {
    std::string body = test.body;
    body.insert(body.find("[numthreads"), "[shader(\"compute\")] ");
    out.push_back({test.name, kWideHead + body});
    add_rays(test, kWideHead);
  }
  for (const WideCase& test : kWideRayCases) {
    add_rays(test, std::string(kWideHead) + kWideRayHead);
  }
  return out;
}
const std::vector<Form>& forms() {
  static const std::vector<Form> all = make_forms();
  return all;
}

std::vector<hlsl::FrontendOptions> all_options() {
  std::vector<hlsl::FrontendOptions> out;
  for (const Form& form : forms()) {
    hlsl::FrontendOptions options;
    options.path = form.name + ".hlsl";
    options.text = form.text;
    out.push_back(options);
  }
  return out;
}

const Compiled& compiled(size_t index, hlsl::WideThreads wide) {
  static const std::vector<Compiled> scalar =
      compile_native(all_options(), hlsl::WideThreads::kNever);
  static const std::vector<Compiled> all =
      compile_native(all_options(), hlsl::WideThreads::kAlways);
  return (wide == hlsl::WideThreads::kNever ? scalar : all)[index];
}

std::vector<std::byte> run(const Compiled& code, bool rays) {
  EXPECT_EQ(code.error, "");
  if (code.library == nullptr) return {};
  const auto out = run_on_device("embree", *code.library, rays ? kRays : kGroups);
  EXPECT_EQ(out.error(), "");
  return out ? *out : std::vector<std::byte>();
}

class Wide : public testing::TestWithParam<size_t> {};

TEST_P(Wide, GivesWhatSingleThreadsGive) {
  const bool rays = forms()[GetParam()].rays;
  const auto expected = run(compiled(GetParam(), hlsl::WideThreads::kNever), rays);
  const auto actual = run(compiled(GetParam(), hlsl::WideThreads::kAlways), rays);
  ASSERT_EQ(expected.size(), actual.size());
  EXPECT_TRUE(
      std::any_of(expected.begin(), expected.end(), [](std::byte b) { return b != std::byte{0}; }));
  const auto [e, a] = std::mismatch(expected.begin(), expected.end(), actual.begin());
  if (e != expected.end()) {
    const auto word = (e - expected.begin()) / 4;
    ADD_FAILURE() << "thread " << word / 16 << ", word " << word % 16;
  }
}

// Otherwise the test above would compare scalar code with itself.
TEST_P(Wide, IsPlannedAtAll) {
  const auto compiled = compile_module(all_options()[GetParam()]);
  ASSERT_TRUE(compiled) << compiled.error();
  const auto& module = *compiled;
  hlsl::WidePlan plan;
  std::string reason;
  for (const hlsl::ir::EntryPoint& entry : module->entry_points) {
    const bool candidate =
        entry.stage == hlsl::ir::kStageCompute || entry.stage == hlsl::ir::kStageRayGeneration;
    if (!candidate) continue;
    EXPECT_NE(plan.add(entry, reason), nullptr) << reason;
  }
}

INSTANTIATE_TEST_SUITE_P(Threads, Wide, testing::Range(size_t{0}, forms().size()),
                         [](const auto& test) { return forms()[test.param].name; });

struct Refused {
  const char* body;
  const char* reason;
};

TEST(WidePlan, SaysWhyAShaderRunsThreadByThread) {
  const Refused refused[] = {
      {"groupshared uint shared_words[8];\n[shader(\"compute\")] [numthreads(8, 1, 1)] void "
       "main(uint i : SV_GroupIndex) { shared_words[i] = i; results.Store(4 * i, shared_words[i]); "
       "}",
       "it reads groupshared memory"},
      {"[shader(\"compute\")] [numthreads(8, 1, 1)] void main(uint i : SV_GroupIndex) { "
       "results.Store(4 * i, i); GroupMemoryBarrierWithGroupSync(); }",
       "it has a barrier"},
      {"ByteAddressBuffer many[4] : register(t4);\n[shader(\"compute\")] [numthreads(8, 1, 1)] "
       "void main(uint i : SV_GroupIndex) { results.Store(4 * i, "
       "many[NonUniformResourceIndex(i & 3)].Load(0)); }",
       "it chooses a resource for each thread"},
      {"static ByteAddressBuffer kept;\nByteAddressBuffer other : register(t4);\n"
       "[shader(\"compute\")] [numthreads(8, 1, 1)] void main(uint i : SV_GroupIndex) { "
       "kept = words; if (i & 1) kept = other; results.Store(4 * i, kept.Load(0)); }",
       "\"kept\" is a resource that only some threads may change"},
      {"static ByteAddressBuffer kept;\nvoid keep() { kept = words; }\n"
       "[shader(\"compute\")] [numthreads(8, 1, 1)] void main(uint i : SV_GroupIndex) { "
       "if (i & 1) keep(); results.Store(4 * i, kept.Load(0)); }",
       "\"kept\" is a resource that only some threads may change"},
  };
  for (const Refused& test : refused) {
    hlsl::FrontendOptions options;
    options.path = "refused.hlsl";
    options.text = std::string(kWideHead) + test.body;
    const auto compiled = compile_module(options);
    ASSERT_TRUE(compiled) << compiled.error();
    const auto& module = *compiled;
    hlsl::WidePlan plan;
    std::string reason;
    EXPECT_EQ(plan.add(module->entry_points[0], reason), nullptr);
    EXPECT_EQ(reason, test.reason);
  }
}

}  // namespace
}  // namespace kaamos::test
