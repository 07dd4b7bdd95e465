// SPDX-License-Identifier: MIT
//
// Shader tables, which checked mode proves before a dispatch.
#include <cstring>

#include "tests/checks/world.h"

namespace kaamos::checks::test {
namespace {

using namespace rtapi;

class Tables : public World {
 protected:
  void SetUp() override {
    World::SetUp();
    if (!IsSkipped()) build_scene();
  }
  // The bytes of a table, for tests to damage.
  std::span<std::byte> bytes(TableSet& set, size_t table) {
    return set.tables[table].buffer().data<std::byte>();
  }
};

TEST_P(Tables, NothingWrongNothingSaid) {
  TableSet set = make_tables(pipeline_, "RayGen", {"WithData"});
  dispatch(set.desc);
  dispatch(set.desc);
  // Records that no ray can reach may contain anything. [SBT-24]
  set = make_tables(pipeline_, "RayGen", {"Plain", "Plain"});
  std::memset(bytes(set, 2).data() + set.desc.HitGroupTable.StrideInBytes, 0xAB, 32);
  dispatch(set.desc);
  // A NULL identifier runs nothing. [SBT-18]
  std::memset(bytes(set, 2).data(), 0, 32);
  dispatch(set.desc);
  expect_none();
}

TEST_P(Tables, RecordOutsideItsTable) {
  build_scene(3, 2);
  const TableSet set = make_tables(pipeline_, "RayGenTwo", {"Plain", "Plain"}, {"Miss", "Miss"});
  dispatch(set.desc);
  const auto texts = told();
  ASSERT_EQ(texts.size(), 3u);  // 3, 5 and 7
  EXPECT_EQ(texts[0].substr(0, texts[0].find(" (checks.hlsl")),
            "KA0430 record outside its shader table: hit group table record 3, reached from ray "
            "generation shader \"RayGenTwo\"");
  EXPECT_NE(texts[0].find(") at instance 0, geometry 0, ray type 1: instance contribution 2 + "
                          "multiplier 2 * geometry 0 + ray contribution 1: bytes 96..128 of a "
                          "table of 64 bytes (2 records of stride 32, byte 0 of buffer \"hit "
                          "groups\" (64 bytes)). Add the missing records, or correct SizeInBytes, "
                          "StrideInBytes or the terms of the index. (DispatchRays, command 0"),
            std::string::npos)
      << texts[0];
}

// Every ray in this scene hits, so the miss table is never reached, which is legal. [SBT-24]
TEST_P(Tables, RecordsThatCouldBeReached) {
  TableSet set = make_tables(pipeline_);
  set.desc.MissShaderTable = {};
  dispatch(set.desc);
  ASSERT_FALSE(messages_.empty());
  EXPECT_EQ(messages_[0].Severity, MessageSeverity::kInfo);
  expect_one("KA0442",
             {"1 record that rays or calls could reach, but did not. The first: miss table "
              "record 0, reached from ray generation shader \"RayGen\" (checks.hlsl",
              "there is no such table"});
  dispatch(set.desc);
  expect_none();  // reported only once
  set = make_tables(pipeline_, "RayGen", {"Plain", "Plain"});
  bottom_ = build(bottom_inputs(triangles()), "floor");
  auto aside = instance(bottom_, 1);
  aside.Transform[0][3] = 1000;
  top_ = build(top_inputs({instance(bottom_), aside}), "scene");
  std::memset(bytes(set, 2).data() + set.desc.HitGroupTable.StrideInBytes, 0xAB, 32);
  dispatch(set.desc);
  expect_one("KA0442", {"hit group table record 1 holds no shader identifier", "instance 1"});
}

TEST_P(Tables, NoTableAtAll) {
  TableSet set = make_tables(pipeline_);
  set.desc.MissShaderTable = {};
  top_ = build(top_inputs({}), "nothing");
  dispatch(set.desc);
  expect_one("KA0430", {"miss table record 0", "with MissShaderIndex 0", "there is no such table",
                        "Set it in DispatchRaysDesc."});
}

TEST_P(Tables, CallableOutsideItsTable) {
  const TableSet set = make_tables(pipeline_, "RayGenCall");
  dispatch(set.desc);
  expect_one("KA0430", {"callable table record 2", "by CallShader(2)", "there is no such table"});
}

TEST_P(Tables, WrongStrideIsRecognised) {
  build_scene(1, 1);
  const TableSet set = make_tables(pipeline_, "RayGen", {"WithData", "WithData", "WithData"});
  DispatchRaysDesc desc = set.desc;
  ASSERT_EQ(desc.HitGroupTable.StrideInBytes, 64u);
  desc.HitGroupTable.StrideInBytes = 96;
  dispatch(desc);
  expect_one("KA0431",
             {"hit group table record 1 holds no shader identifier", "instance contribution 1",
              "with stride 96. The table has identifiers every 64 bytes: was it written with a "
              "stride of 64? StrideInBytes must be the same."});
  build_scene();
  desc.HitGroupTable.StrideInBytes = 32;
  dispatch(desc);
  expect_one("KA0435",
             {"hit group table record 0 holds \"WithData\"",
              "takes 12 bytes after the 32 of the identifier, 44 in all, but StrideInBytes is 32",
              "Use a stride of at least 64"});
}

TEST_P(Tables, TableThatStartsTooEarly) {
  const TableSet set = make_tables(pipeline_);
  Buffer shifted = upload(std::vector<uint32_t>(64, 0xABABABABu), "shifted");
  std::memcpy(shifted.data<std::byte>().data() + 32,
              set.tables[2].buffer().data<std::byte>().data(), 32);
  DispatchRaysDesc desc = set.desc;
  desc.HitGroupTable = {shifted.GetGPUVirtualAddress(), 256, 32};
  dispatch(desc);
  expect_one("KA0431", {"There is an identifier 32 bytes further on: does the table start there?"});
}

TEST_P(Tables, GarbageInAReachedRecord) {
  TableSet set = make_tables(pipeline_);
  std::memset(bytes(set, 2).data(), 0xAB, 32);
  dispatch(set.desc);
  expect_one("KA0431", {"Write the 32 bytes that GetShaderIdentifier returns"});
}

TEST_P(Tables, IdentifierOfAnotherPipeline) {
  const StateObject other = make_pipeline();
  const TableSet others = make_tables(other);
  TableSet set = make_tables(pipeline_);
  std::memcpy(bytes(set, 2).data(), others.tables[2].buffer().data<std::byte>().data(), 32);
  dispatch(set.desc);
  expect_one("KA0432", {"hit group table record 0 holds the identifier of \"Plain\" from a state "
                        "object other than the one that SetPipelineState1 set"});
}

TEST_P(Tables, WrongKindOfShader) {
  const TableSet set = make_tables(pipeline_, "RayGen", {"Plain"}, {"Call"});
  dispatch(set.desc);
  messages_.clear();
  TableSet wrong = make_tables(pipeline_);
  std::memcpy(bytes(wrong, 2).data(), pipeline_.GetShaderIdentifier("Miss")->data(), 32);
  dispatch(wrong.desc);
  expect_one("KA0433", {"hit group table record 0 holds \"Miss\", which is a miss export"});
}

TEST_P(Tables, GroupTypeAndGeometryType) {
  const TableSet set = make_tables(pipeline_, "RayGen", {"Boxes"});
  dispatch(set.desc);
  expect_one("KA0434", {"holds hit group \"Boxes\", which is for procedural primitives, but is "
                        "reached by triangles"});
  const std::vector<RaytracingGeometryDesc> boxes = {box()};
  bottom_ = build(bottom_inputs(boxes), "boxes");
  top_ = build(top_inputs({instance(bottom_)}), "scene");
  dispatch(set.desc);
  expect_none();
}

TEST_P(Tables, TableEndsInsideTheRecord) {
  TableSet set = make_tables(pipeline_, "RayGen", {"WithData"});
  set.desc.HitGroupTable.SizeInBytes = 40;
  dispatch(set.desc);
  expect_one("KA0440", {"holds \"WithData\"", "needs 44 bytes, but the table ends after 40"});
}

TEST_P(Tables, ArgumentsNeverWritten) {
  TableSet set = make_tables(pipeline_, "RayGen", {"WithData"});
  std::memset(bytes(set, 2).data() + 32, 0, 12);
  dispatch(set.desc);
  expect_one("KA0436",
             {"hit group table record 0, closest-hit shader \"HitLocal\": all 12 bytes of "
              "arguments after the identifier are 0, but the shader reads t0, space 1 "
              "\"local_data\""});
}

TEST_P(Tables, ArgumentOfAFreedBuffer) {
  TableSet set = make_tables(pipeline_, "RayGen", {"WithData"});
  const uint64_t wild = 0x123456780;
  std::memcpy(bytes(set, 2).data() + 32, &wild, 8);
  // On the CPU a wild address may remove the device, so only the messages are checked.
  CommandList commands = list();
  record_dispatch(commands, set.desc);
  (void)execute(commands);
  expect_one("KA0437", {"closest-hit shader \"HitLocal\", local parameter t0, space 1 "
                        "\"local_data\": the root descriptor is 0x123456780, which is in no live "
                        "buffer"});
}

TEST_P(Tables, MisalignedArgument) {
  TableSet set = make_tables(pipeline_, "RayGen", {"WithData"});
  const uint64_t odd = local_.GetGPUVirtualAddress() + 2;
  std::memcpy(bytes(set, 2).data() + 32, &odd, 8);
  dispatch(set.desc);
  const auto texts = told();
  ASSERT_FALSE(texts.empty());
  EXPECT_EQ(texts[0].substr(0, 6), "KA0438");
  EXPECT_NE(
      texts[0].find(
          "byte 2 of buffer \"local data\" (16 bytes); a buffer must start at a multiple of 4"),
      std::string::npos)
      << texts[0];
}

TEST_P(Tables, ShaderWithAnotherGlobalRootSignature) {
  RootSignature other = device_.CreateRootSignature("SRV(t0), UAV(u0), SRV(t9)").value();
  StateObjectDesc desc;
  desc.Add(DxilLibraryDesc{pipeline_library(), {{"RayGen"}, {"Hit"}, {"Miss"}}});
  desc.Add(HitGroupDesc{.HitGroupExport = "Plain", .ClosestHitShaderImport = "Hit"});
  desc.Add(RaytracingShaderConfig{.MaxPayloadSizeInBytes = 4});
  desc.Add(RaytracingPipelineConfig{.MaxTraceRecursionDepth = 1});
  desc.Add(GlobalRootSignature{global_});
  desc.Associate(desc.Add(GlobalRootSignature{other}), {"Miss"});
  pipeline_ = device_.CreateStateObject(desc).value();
  const TableSet set = make_tables(pipeline_);
  dispatch(set.desc);
  expect_one("KA0439",
             {"miss table record 0 runs miss shader \"Miss\"",
              "whose global root signature differs from the one that SetComputeRootSignature set"});
}

INSTANTIATE_TEST_SUITE_P(Embree, Tables, ::testing::Values("embree"));
INSTANTIATE_TEST_SUITE_P(Vulkan, Tables, ::testing::Values("vulkan"));

}  // namespace
}  // namespace kaamos::checks::test
