// SPDX-License-Identifier: MIT
// Functions without a body in a library by itself: what it says of them, and what is refused.
#include <gmock/gmock.h>

#include "runtime/hlsl/check/marked_test_support.h"

namespace kaamos::hlsl {
namespace {

using Id = DiagnosticId;
using testing::ElementsAre;

TEST(Imports, ShadersThatReachThemAreSetAside) {
  const Compilation c(R"(
struct Payload { float x; };
RWByteAddressBuffer b : register(u3);
float pick(float x, inout Payload p);
float spare(float x);
export float twice(float x) { Payload p = {1}; return 2 * pick(x, p); }
export float plain(float x) { return b.Load(0) + x; }
[shader("raygeneration")] void First() { plain(1); }
[shader("raygeneration")] void Second() { twice(1); }
[shader("miss")] void Miss(inout Payload p) { pick(1, p); }
)");
  ASSERT_NE(c.module, nullptr) << c.messages();
  ASSERT_EQ(c.module->imports.size(), 1u);
  EXPECT_EQ(c.module->imports[0].name, "pick");
  EXPECT_EQ(c.module->imports[0].mangled, "\01?pick@@YAMMUPayload@@@Z");
  EXPECT_EQ(c.module->imports[0].signature, "float pick(float, inout Payload)");
  ASSERT_EQ(c.module->entry_points.size(), 1u);
  EXPECT_EQ(c.module->entry_points[0].name, "First");
  ASSERT_EQ(c.module->unlinked_entry_points.size(), 2u);
  EXPECT_EQ(c.module->unlinked_entry_points[0].name, "Second");
  EXPECT_EQ(c.module->unlinked_entry_points[1].payload_bytes, 4u);
  EXPECT_THAT(c.module->unlinked_entry_points[1].imports, ElementsAre(0u));
  ASSERT_EQ(c.module->library_functions.size(), 2u);
  EXPECT_THAT(c.module->library_functions[0].imports, ElementsAre(0u));
  EXPECT_THAT(c.module->library_functions[0].callers, ElementsAre(1u));
  EXPECT_THAT(c.module->library_functions[1].imports, ElementsAre());
  EXPECT_THAT(c.module->library_functions[1].callers, ElementsAre(0u));
  EXPECT_TRUE(c.function("twice").empty());
}

TEST(Imports, ResourcesOfExportedFunctionsHaveRegisters) {
  const Compilation c(R"(
RWByteAddressBuffer first;
RWByteAddressBuffer second;
export void put(uint x) { second.Store(0, x); }
)");
  ASSERT_NE(c.module, nullptr) << c.messages();
  ASSERT_EQ(c.module->bindings.size(), 1u);
  EXPECT_EQ(c.module->bindings[0].name, "second");
  EXPECT_EQ(c.module->bindings[0].register_index, 0u);
}

TEST(Imports, ALaterBodyIsTheLibrarysOwn) {
  const Compilation c(kernel("results.Store(0, f());", "uint f();") + "uint f() { return 1; }");
  ASSERT_NE(c.module, nullptr) << c.messages();
  EXPECT_TRUE(c.module->imports.empty());
  EXPECT_EQ(c.module->entry_points.size(), 1u);
}

TEST(Imports, Refused) {
  expect_at_mark(Id::kInitialiserImport,
                 kernel("results.Store(0, asuint(g));",
                        "float f();\nfloat h() { return f(); }\nstatic float @g = h();"));
  expect_at_mark(Id::kImportParameter,
                 kernel("@f(all);", "Texture2D all[];\nvoid f(Texture2D a[]);"));
  FrontendOptions options;
  options.target = "lib_6_7";
  expect_at_mark(Id::kImportPayload, R"(
struct [raypayload] Payload { float x : read(caller, miss) : write(caller, miss); };
void pass(inout Payload p);
[shader("miss")] void Miss(inout Payload p) { pass(@p); }
)",
                 options);
}

}  // namespace
}  // namespace kaamos::hlsl
