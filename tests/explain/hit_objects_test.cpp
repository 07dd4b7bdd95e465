// SPDX-License-Identifier: MIT
//
// Hit objects explained, and run by the interpreter as by native code.
#include <gtest/gtest.h>
#include <rtapi/explain.h>
#include <rtapi/rtapi.h>
#include <rtapi/shader_compiler.h>
#include <rtapi/shader_table.h>
#include <rtapi/upload.h>
#include <shaders/hit_objects.h>

#include <cstring>
#include <vector>

#include "tests/common/structures.h"

namespace {

using namespace rtapi;

ShaderLibrary interpreted() {
  ShaderCompileOptions options;
  options.File = KAAMOS_HIT_OBJECTS_HLSL;
  options.Target = "lib_6_9";
  options.PayloadQualifiers = false;
  options.Interpret = true;
  options.Spirv = false;
  const ShaderCompilation out = CompileShaderLibrary(options);
  out.Status.value();
  return out.Library;
}

// A triangle around (0, 0, 5) with ID 9; rays at x = 0 hit it, and at x = 10 miss.
class HitObjects : public testing::Test {
 protected:
  void SetUp() override {
    device_ = CreateDevice().value();
    queue_ = device_.CreateCommandQueue().value();
    RaytracingGeometryDesc triangle;
    vertices_ =
        CreateUploadBuffer(device_, std::vector<float>{-1, -1, 5, 0, 2, 5, 1, -1, 5}).value();
    triangle.Flags = RaytracingGeometryFlags::kOpaque;
    triangle.Triangles.VertexFormat = Format::kR32G32B32Float;
    triangle.Triangles.VertexCount = 3;
    triangle.Triangles.VertexBuffer = {vertices_.GetGPUVirtualAddress(), 12};
    bottom_ = kaamos::test::build_bottom_level(device_, queue_, {triangle}, "triangle");
    RaytracingInstanceDesc instance;
    instance.InstanceID = 9;
    instance.AccelerationStructure = bottom_.GetGPUVirtualAddress();
    scene_ = kaamos::test::build_top_level(device_, queue_, {instance}, "scene");
    results_ = device_
                   .CreateBuffer({.SizeInBytes = 64,
                                  .Flags = ResourceFlags::kAllowUnorderedAccess,
                                  .InitialState = ResourceStates::kUnorderedAccess})
                   .value();
  }

  CommandList record(const ShaderLibrary& library) {
    root_ = device_.CreateRootSignature("SRV(t0), UAV(u0)").value();
    const RootSignature local =
        device_
            .CreateRootSignature(
                "RootFlags(LOCAL_ROOT_SIGNATURE), RootConstants(b0, space = 1, "
                "num32BitConstants = 1)")
            .value();
    StateObjectDesc desc;
    desc.Add(DxilLibraryDesc{library, {}});
    desc.Add(HitGroupDesc{.HitGroupExport = "Group", .ClosestHitShaderImport = "Hit"});
    desc.Add(RaytracingShaderConfig{8, 8});
    desc.Add(RaytracingPipelineConfig{1});
    desc.Add(GlobalRootSignature{root_});
    desc.Associate(desc.Add(LocalRootSignature{local}), {"Group", "Miss"});
    pipeline_ = device_.CreateStateObject(desc).value();
    tables_.clear();
    for (int i = 0; i < 3; ++i) tables_.emplace_back(pipeline_);
    tables_[0].AddRecord("Generate").value();
    tables_[1].AddRecord("Miss", {LocalArgument::Constants(uint32_t{100})}).value();
    tables_[1].AddRecord("Miss", {LocalArgument::Constants(uint32_t{1000})}).value();
    tables_[2].AddRecord("Group", {LocalArgument::Constants(uint32_t{7})}).value();
    for (ShaderTable& table : tables_) table.Build(device_).value();
    CommandList list = device_.CreateCommandList().value();
    list.SetComputeRootSignature(root_);
    list.SetPipelineState1(pipeline_);
    list.SetComputeRootShaderResourceView(0, scene_.GetGPUVirtualAddress());
    list.SetComputeRootUnorderedAccessView(1, results_.GetGPUVirtualAddress());
    list.DispatchRays({.RayGenerationShaderRecord = tables_[0].GetRecord(0),
                       .MissShaderTable = tables_[1].GetTable(),
                       .HitGroupTable = tables_[2].GetTable(),
                       .Width = 2});
    return list;
  }

  std::vector<uint32_t> run(const ShaderLibrary& library) {
    CommandList list = record(library);
    queue_.ExecuteAndWait(list).value();
    const auto bytes = ReadbackBuffer(device_, queue_, results_).value();
    std::vector<uint32_t> words(16);
    std::memcpy(words.data(), bytes.data(), 64);
    return words;
  }

  Device device_;
  CommandQueue queue_;
  Buffer vertices_, bottom_, scene_, results_;
  RootSignature root_;
  StateObject pipeline_;
  std::vector<ShaderTable> tables_;
};

TEST_F(HitObjects, TheInterpreterDoesWhatNativeCodeDoes) {
  const auto native = run(LoadShaderLibrary(kaamos_shaders_hit_objects()).value());
  EXPECT_EQ(native[0], 16u);    // the record's 7, and the instance's ID
  EXPECT_EQ(native[1], 1000u);  // the miss that was made
  EXPECT_EQ(native[3], 7u);
  EXPECT_EQ(native[6], 9u);
  EXPECT_EQ(native[7], 254u);
  EXPECT_EQ(native[8], 0u);     // the ray beside it
  EXPECT_EQ(native[9], 1100u);  // its miss, and the one that was made
  EXPECT_EQ(native[11], 100u);
  EXPECT_EQ(run(interpreted()), native);
}

TEST_F(HitObjects, AnExplanationShowsTheTraceAndWhatEachInvokeRan) {
  CommandList list = record(LoadShaderLibrary(kaamos_shaders_hit_objects()).value());
  const PixelExplanation explanation = ExplainPixel(queue_, list, {.X = 0}).value();
  const auto& calls = explanation.RayGeneration.at(0).Calls;
  ASSERT_EQ(calls.size(), 4u);
  EXPECT_EQ(calls[0].Kind, ExplainedCallKind::kTraceRay);
  EXPECT_TRUE(calls[0].Hit);
  EXPECT_TRUE(calls[0].Shaders.empty());
  EXPECT_NE(calls[0].Note.find("hit object"), std::string::npos) << calls[0].Note;
  EXPECT_EQ(calls[1].Kind, ExplainedCallKind::kInvoke);
  EXPECT_EQ(calls[1].Depth, 1u);
  ASSERT_EQ(calls[1].Shaders.size(), 1u);
  EXPECT_EQ(calls[1].Shaders[0].Name, "Hit");
  EXPECT_EQ(calls[1].Shaders[0].Record.Index, 0u);
  EXPECT_EQ(calls[1].Before.at(0).Text, "0");
  EXPECT_EQ(calls[1].After.at(0).Text, "16");
  ASSERT_EQ(calls[2].Shaders.size(), 1u);
  EXPECT_EQ(calls[2].Shaders[0].Name, "Miss");
  EXPECT_EQ(calls[2].Shaders[0].Record.Index, 1u);
  EXPECT_EQ(calls[3].Note, "nothing runs: the hit object is a NOP");
  const std::string text = ToText(explanation);
  EXPECT_NE(text.find("Invoke, depth 1\n"), std::string::npos) << text;
  EXPECT_NE(ToJson(explanation).find("\"call\": \"Invoke\""), std::string::npos);
}

}  // namespace
