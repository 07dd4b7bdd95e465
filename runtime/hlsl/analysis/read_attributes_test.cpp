// SPDX-License-Identifier: MIT
#include "runtime/hlsl/analysis/read_attributes.h"

#include <gtest/gtest.h>

#include "runtime/hlsl/check/check_test_support.h"

namespace kaamos::hlsl {
namespace {

constexpr char kLibrary[] = R"(
struct [raypayload] Payload {
  float value : read(caller, closesthit) : write(caller, closesthit, anyhit);
};
struct Mine { float3 normal; };
typedef BuiltInTriangleIntersectionAttributes Triangle;
float unused(Triangle a) { return 1; }
float handed_on(Triangle a) { return unused(a); }
float used(Triangle a) { return a.barycentrics.x; }
float reached(Triangle a) { return used(a); }
void written(inout Mine a) { a.normal = 1; }
[shader("closesthit")] void Nothing(inout Payload p, Triangle a) { p.value = 1; }
[shader("closesthit")] void Unused(inout Payload p, Triangle a) { p.value = unused(a); }
[shader("closesthit")] void HandedOn(inout Payload p, Triangle a) { p.value = handed_on(a); }
[shader("anyhit")] void NothingOfMine(inout Payload p, Mine a) { IgnoreHit(); }
[shader("closesthit")] void Member(inout Payload p, Triangle a) { p.value = a.barycentrics.y; }
[shader("closesthit")] void Used(inout Payload p, Triangle a) { p.value = used(a); }
[shader("closesthit")] void Reached(inout Payload p, Triangle a) { p.value = reached(a); }
[shader("closesthit")] void Copied(inout Payload p, Mine a) { Mine b = a; p.value = b.normal.x; }
[shader("anyhit")] void Written(inout Payload p, Mine a) { written(a); p.value = 2; }
[shader("anyhit")] void Condition(inout Payload p, Mine a) { if (a.normal.y > 0) IgnoreHit(); }
)";

TEST(ReadAttributesTest, OnlyMentionsThatReachNothingCountAsUnread) {
  Compilation c(kLibrary);
  ASSERT_NE(c.module, nullptr) << c.messages();
  std::string unread, read;
  for (const ir::EntryPoint& entry : c.module->entry_points) {
    (reads_attributes(entry) ? read : unread) += entry.name + " ";
  }
  EXPECT_EQ(unread, "Nothing Unused HandedOn NothingOfMine ");
  EXPECT_EQ(read, "Member Used Reached Copied Written Condition ");
}

}  // namespace
}  // namespace kaamos::hlsl
