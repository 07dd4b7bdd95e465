// SPDX-License-Identifier: MIT
#include <cstring>

#include <rtapi/shader_table.h>

#include "rtapi/testing/state_object_fixture.h"

namespace rtapi::testing {
namespace {

class ShaderTableTest : public StateObjectTest {
 protected:
  ShaderTableTest() {
    StateObjectDesc desc = Base();
    desc.Add(Triangles("plain"));
    desc.Add(Triangles("mesh"));
    desc.Associate(
        desc.Add(LocalRootSignature{Local("RootConstants(num32BitConstants=1, b0), SRV(t0), "
                                          "RootConstants(num32BitConstants=3, b1), "
                                          "DescriptorTable(SRV(t1))")}),
        {"mesh"});
    so_ = Make(desc).value();
  }
  static std::vector<LocalArgument> MeshArguments() {
    const uint32_t three[3] = {7, 8, 9};
    return {LocalArgument::Constants(5u), LocalArgument::Address(GpuVirtualAddress{0x1122334455}),
            LocalArgument::Constants(three), LocalArgument::Table({0x66778899})};
  }
  StateObject so_;
};

TEST_F(ShaderTableTest, ROOT_05_BytesOfARecord) {
  ShaderTable table(so_, "hits");
  ASSERT_EQ(table.AddRecord("mesh", MeshArguments()).value(), 0u);
  ASSERT_EQ(table.AddRecord("plain").value(), 1u);
  ASSERT_EQ(table.AddNullRecord(), 2u);
  EXPECT_EQ(table.stride_bytes(), 96u);
  const auto bytes = table.bytes();
  ASSERT_EQ(bytes.size(), 288u);
  auto u32 = [&](size_t at) {
    uint32_t v;
    std::memcpy(&v, bytes.data() + at, 4);
    return v;
  };
  auto u64 = [&](size_t at) {
    uint64_t v;
    std::memcpy(&v, bytes.data() + at, 8);
    return v;
  };
  EXPECT_EQ(std::memcmp(bytes.data(), so_.GetShaderIdentifier("mesh")->data(), 32), 0);
  EXPECT_EQ(u32(32), 5u);
  EXPECT_EQ(u64(40), 0x1122334455u);
  EXPECT_EQ(u32(48), 7u);
  EXPECT_EQ(u32(56), 9u);
  EXPECT_EQ(u64(64), 0x66778899u);
  EXPECT_EQ(std::memcmp(bytes.data() + 96, so_.GetShaderIdentifier("plain")->data(), 32), 0);
  for (size_t i = 192; i < 288; ++i) EXPECT_EQ(bytes[i], std::byte{0});
}

TEST_F(ShaderTableTest, SBT_17_BuiltTablesAreAligned) {
  ShaderTable table(so_, "hits");
  EXPECT_EQ(table.GetTable().StartAddress, 0u);
  ASSERT_TRUE(table.Build(device_).ok());  // an empty table is an empty range
  EXPECT_EQ(table.GetTable().SizeInBytes, 0u);
  ASSERT_TRUE(table.AddRecord("plain").ok());
  ASSERT_TRUE(table.AddRecord("plain").ok());
  ASSERT_TRUE(table.Build(device_).ok());
  EXPECT_EQ(table.GetTable().StartAddress % 64, 0u);
  EXPECT_EQ(table.GetTable().StrideInBytes, 32u);
  EXPECT_EQ(table.GetTable().SizeInBytes, 64u);
  EXPECT_EQ(table.buffer().name(), "hits");
  EXPECT_EQ(table.GetRecord(2).StartAddress, 0u);
}

TEST_F(ShaderTableTest, RayGenerationRecordsAreEachAligned) {
  ShaderTable table(so_);
  ASSERT_TRUE(table.AddRecord("RayGen").ok());
  ASSERT_TRUE(table.AddRecord("RayGen").ok());
  ASSERT_TRUE(table.Build(device_).ok());
  EXPECT_EQ(table.GetRecord(1).StartAddress % 64, 0u);
  EXPECT_GE(table.GetRecord(1).SizeInBytes, 32u);
}

TEST_F(ShaderTableTest, ArgumentsAreChecked) {
  ShaderTable table(so_, "hits");
  EXPECT_ERROR(table.AddRecord("Hit"), "KA0840", "\"hits\", record 0 (Hit)", "mesh");
  EXPECT_ERROR(table.AddRecord("mesh"), "KA0841", "0 arguments", "4 parameters");
  EXPECT_ERROR(table.AddRecord("plain", {LocalArgument::Constants(1u)}), "KA0841", "none");
  auto arguments = MeshArguments();
  arguments[1] = LocalArgument::Constants(1u);
  EXPECT_ERROR(table.AddRecord("mesh", arguments), "KA0842", "argument 1", "32-bit constants",
               "an address");
  arguments = MeshArguments();
  arguments[3] = LocalArgument::Address(GpuVirtualAddress{64});
  EXPECT_ERROR(table.AddRecord("mesh", arguments), "KA0842", "a descriptor table");
  arguments = MeshArguments();
  arguments[2] = LocalArgument::Constants(1u);
  EXPECT_ERROR(table.AddRecord("mesh", arguments), "KA0843", "4 bytes", "12");
  EXPECT_EQ(table.record_count(), 0u);
  ShaderTable empty{StateObject()};
  EXPECT_ERROR(empty.AddRecord("x"), "KA0840", "(none)");
}

}  // namespace
}  // namespace rtapi::testing
