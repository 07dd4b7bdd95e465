// SPDX-License-Identifier: MIT
//
// Root signatures made of what a compiled library holds.
#include "rtapi/testing/expect_error.h"
#include "rtapi/testing/library_builder.h"
#include "rtapi/testing/null_backend.h"

namespace rtapi {
namespace {

using testing::LibraryBuilder;

namespace sh = kaamos::shader;

constexpr uint32_t kGlobal = 1;
constexpr uint32_t kLocal = 2;

TEST(LibraryRootSignature, TheOnlyGlobalOneNeedsNoName) {
  const Device device = testing::CreateNullDevice();
  LibraryBuilder b;
  b.Subobject("Record", kLocal, {"CBV(b1)"});
  b.Subobject("Scene", kGlobal, {"SRV(t3, space = 2)"});
  const ShaderLibrary library = b.Build();
  const auto root = device.CreateRootSignature(library);
  ASSERT_EQ(testing::MessageOf(root), "ok");
  EXPECT_FALSE(root->is_local());
  ASSERT_EQ(root->GetDesc().Parameters.size(), 1u);
  EXPECT_EQ(root->GetDesc().Parameters[0].Descriptor.ShaderRegister, 3u);
  EXPECT_EQ(root->GetDesc().Parameters[0].Descriptor.RegisterSpace, 2u);
}

TEST(LibraryRootSignature, ANameFindsSubobjectsAndEntryPoints) {
  const Device device = testing::CreateNullDevice();
  LibraryBuilder b;
  b.Subobject("Record", kLocal, {"CBV(b1)"});
  b.Subobject("Scene", kGlobal, {"SRV(t3)"});
  b.Export("Blur", sh::Stage::kCompute).root_signature = "UAV(u0), UAV(u1)";
  const ShaderLibrary library = b.Build();
  const auto local = device.CreateRootSignature(library, "Record");
  ASSERT_EQ(testing::MessageOf(local), "ok");
  EXPECT_TRUE(local->is_local());
  const auto blur = device.CreateRootSignature(library, "Blur");
  ASSERT_EQ(testing::MessageOf(blur), "ok");
  EXPECT_EQ(blur->GetDesc().Parameters.size(), 2u);
  EXPECT_OK(device.CreateRootSignature(library, "Scene"));
  EXPECT_ERROR(device.CreateRootSignature(library, "scene"), "KA0633",
               "\"Record\" (local), \"Scene\", \"Blur\"");
  EXPECT_ERROR(device.CreateRootSignature(library), "KA0633", "several");
}

TEST(LibraryRootSignature, EqualAttributesAreOneSignature) {
  const Device device = testing::CreateNullDevice();
  LibraryBuilder b;
  b.Export("Blur", sh::Stage::kCompute).root_signature = "UAV(u0)";
  b.Export("Sharpen", sh::Stage::kCompute).root_signature = "UAV(u0)";
  EXPECT_OK(device.CreateRootSignature(b.Build()));
}

TEST(LibraryRootSignature, WhatCannotBeUsedIsNamed) {
  const Device device = testing::CreateNullDevice();
  LibraryBuilder none("none.hlsl");
  none.Export("Main", sh::Stage::kRayGeneration);
  EXPECT_ERROR(device.CreateRootSignature(none.Build()), "KA0633", "it has none");
  LibraryBuilder local;
  local.Subobject("Record", kLocal, {"CBV(b1)"});
  EXPECT_ERROR(device.CreateRootSignature(local.Build()), "KA0633", "\"Record\" (local)");
  LibraryBuilder bad("bad.hlsl");
  bad.Subobject("Broken", kGlobal, {"CBV(t1)"});
  bad.Subobject("Twice", kGlobal, {"CBV(b1), CBV(b1)"});
  const ShaderLibrary library = bad.Build();
  EXPECT_ERROR(device.CreateRootSignature(library, "Broken"), "KA0633", "KA0608");
  EXPECT_ERROR(device.CreateRootSignature(library, "Twice"), "KA0633", "KA0604");
  EXPECT_ERROR(device.CreateRootSignature(ShaderLibrary{}, "Twice"), "KA0904");
  EXPECT_ERROR(Device{}.CreateRootSignature(library, "Twice"), "KA0904");
}

}  // namespace
}  // namespace rtapi
