// SPDX-License-Identifier: MIT
//
// printf and errorf in every stage, interpreted, as native code and on Vulkan: the same lines.
#include <gtest/gtest.h>
#include <rtapi/error_ids.h>
#include <rtapi/rtapi.h>
#include <rtapi/shader_compiler.h>
#include <rtapi/shader_table.h>
#include <rtapi/upload.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "tests/common/structures.h"
#include "tests/vulkan/support.h"

namespace kaamos::shader_tests {
namespace {

using namespace rtapi;

ShaderCompileOptions options_for(const std::string& executor) {
  ShaderCompileOptions options;
  options.File = KAAMOS_TESTDATA "/printing.hlsl";
  options.Interpret = executor == "interpreted";
  options.Spirv = executor == "vulkan";
  options.Quick = true;
  return options;
}

class Printing : public ::testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    if (GetParam() == "vulkan") {
      if (const std::string why = test::why_no_vulkan(); !why.empty()) {
        if (test::vulkan_is_required()) FAIL() << why;
        GTEST_SKIP() << why;
      }
      validation_.emplace();
    }
    static std::map<std::string, ShaderLibrary> known;
    ShaderLibrary& made = known[GetParam()];
    if (!made) {
      const ShaderCompilation compiled = CompileShaderLibrary(options_for(GetParam()));
      ASSERT_TRUE(compiled.Status.ok()) << compiled.Status.error().message;
      made = compiled.Library;
    }
    library_ = made;
    make_device({});
  }

  void make_device(DeviceDesc desc) {
    desc.Backend = GetParam() == "vulkan" ? "vulkan" : "embree";
    desc.OnMessage = [this](const Message& message) {
      if (message.Id == error_ids::backend::kPrintsLost) lost_ = message.Text;
      if (message.Id != error_ids::backend::kShaderPrint &&
          message.Id != error_ids::backend::kShaderError) {
        return;
      }
      const bool is_error = message.Severity == MessageSeverity::kError;
      EXPECT_EQ(is_error, message.Id == error_ids::backend::kShaderError);
      lines_.push_back((is_error ? "error " : "") + message.Text.substr(message.Text.find('(')));
    };
    device_ = CreateDevice(desc).value();
    queue_ = device_.CreateCommandQueue().value();
    root_signature_ = device_.CreateRootSignature("SRV(t0)").value();
  }

  std::vector<std::string> dispatch(const std::string& entry, uint32_t groups = 1) {
    const PipelineState pipeline =
        device_.CreateComputePipelineState({root_signature_, library_, entry, entry}).value();
    CommandList list = device_.CreateCommandList().value();
    list.SetComputeRootSignature(root_signature_);
    list.SetPipelineState(pipeline);
    list.Dispatch(groups, 1, 1);
    queue_.ExecuteAndWait(list).value();
    return std::exchange(lines_, {});
  }

  // A triangle at the origin, hit group 0, and a box at x = 4, hit group 1.
  void make_scene() {
    const auto upload = [&](const std::vector<float>& values) {
      memory_.push_back(CreateUploadBuffer(device_, values, "input").value());
      return memory_.back().GetGPUVirtualAddress();
    };
    RaytracingGeometryDesc triangle;
    triangle.Triangles.VertexFormat = Format::kR32G32B32Float;
    triangle.Triangles.VertexCount = 3;
    triangle.Triangles.VertexBuffer = {upload({-1, -1, 1, 1, -1, 1, 0, 1, 1}), 12};
    RaytracingGeometryDesc box;
    box.Type = RaytracingGeometryType::kProceduralPrimitiveAabbs;
    box.AABBs = {1, {upload({3, -1, 1, 5, 1, 2}), sizeof(RaytracingAabb)}};
    std::vector<RaytracingInstanceDesc> instances(2);
    const RaytracingGeometryDesc geometries[] = {triangle, box};
    for (size_t i = 0; i < 2; ++i) {
      memory_.push_back(test::build_bottom_level(device_, queue_, {geometries[i]}));
      instances[i].AccelerationStructure = memory_.back().GetGPUVirtualAddress();
      instances[i].InstanceID = 11;
    }
    memory_.push_back(test::build_top_level(device_, queue_, instances));
  }

  std::vector<std::string> dispatch_rays(const std::string& entry, uint32_t width) {
    StateObjectDesc desc;
    desc.Subobjects.emplace_back(DxilLibraryDesc{library_, {}});
    desc.Subobjects.emplace_back(GlobalRootSignature{root_signature_});
    const StateObject pipeline = device_.CreateStateObject(desc).value();
    std::vector<ShaderTable> tables;
    for (const std::vector<std::string>& exports : std::vector<std::vector<std::string>>{
             {entry}, {"Miss"}, {"Triangles", "Boxes"}, {"Callable"}}) {
      ShaderTable& table = tables.emplace_back(pipeline, exports[0]);
      for (const std::string& one : exports) table.AddRecord(one).value();
      table.Build(device_).value();
    }
    DispatchRaysDesc rays;
    rays.RayGenerationShaderRecord = tables[0].GetRecord(0);
    rays.MissShaderTable = tables[1].GetTable();
    rays.HitGroupTable = tables[2].GetTable();
    rays.CallableShaderTable = tables[3].GetTable();
    rays.Width = width;
    CommandList list = device_.CreateCommandList().value();
    list.SetComputeRootSignature(root_signature_);
    if (!memory_.empty()) {
      list.SetComputeRootShaderResourceView(0, memory_.back().GetGPUVirtualAddress());
    }
    list.SetPipelineState1(pipeline);
    list.DispatchRays(rays);
    queue_.ExecuteAndWait(list).value();
    return std::exchange(lines_, {});
  }

  // A triangle over a target of 3 x 2 pixels.
  std::vector<std::string> draw(const std::string& pixel) {
    const Texture target = device_
                               .CreateTexture({.Width = 3,
                                               .Height = 2,
                                               .Format = Format::kR8G8B8A8Unorm,
                                               .Flags = ResourceFlags::kAllowRenderTarget,
                                               .InitialState = ResourceStates::kRenderTarget,
                                               .Name = "target"})
                               .value();
    const DescriptorHeap heap =
        device_.CreateDescriptorHeap({.Type = DescriptorHeapType::kRtv, .NumDescriptors = 1})
            .value();
    device_.CreateRenderTargetView(target, heap.GetCPUDescriptorHandle(0)).value();
    GraphicsPipelineStateDesc desc;
    desc.pRootSignature = root_signature_;
    desc.VS = {library_, "Vertex"};
    desc.PS = {library_, pixel};
    desc.RasterizerState.CullMode = CullMode::kNone;
    desc.DepthStencilState.DepthEnable = false;
    desc.RTVFormats = {Format::kR8G8B8A8Unorm};
    const PipelineState pipeline = device_.CreateGraphicsPipelineState(desc).value();
    CommandList list = device_.CreateCommandList().value();
    list.SetGraphicsRootSignature(root_signature_);
    const CpuDescriptorHandle handle = heap.GetCPUDescriptorHandle(0);
    list.OMSetRenderTargets(1, &handle, false, nullptr);
    list.RSSetViewports({Viewport{0, 0, 3, 2, 0, 1}});
    list.RSSetScissorRects({Rect{0, 0, 3, 2}});
    list.IASetPrimitiveTopology(PrimitiveTopology::kTriangleList);
    list.SetPipelineState(pipeline);
    list.DrawInstanced(3, 1, 0, 0);
    queue_.ExecuteAndWait(list).value();
    return std::exchange(lines_, {});
  }

  std::optional<test::ValidationGuard> validation_;
  ShaderLibrary library_;
  Device device_;
  CommandQueue queue_;
  RootSignature root_signature_;
  std::vector<Buffer> memory_;  // the last is the top level
  std::vector<std::string> lines_;
  std::string lost_;
};
INSTANTIATE_TEST_SUITE_P(Executors, Printing, ::testing::Values("interpreted", "native", "vulkan"),
                         [](const auto& tested) { return std::string(tested.param); });

using Lines = std::vector<std::string>;

TEST_P(Printing, LinesComeThreadByThread) {
  EXPECT_EQ(dispatch("Threads", 1),
            (Lines{"(0,0,0): x 0 y -1", "(2,0,0): x 2 y -1", "(3,0,0): x 3 y -1", "(3,0,0): last",
                   "(0,1,0): x 0 y 0", "(2,1,0): x 2 y 0", "(3,1,0): x 3 y 0", "(3,1,0): last"}));
  EXPECT_TRUE(lost_.empty()) << lost_;
}

TEST_P(Printing, ValuesHaveTheirTypes) {
  EXPECT_EQ(
      dispatch("Values"),
      (Lines{"(0,0,0): -5 -5 42 beef BEEF 10 A", "(0,0,0):  3.14|1.235e+04|0.1|2%",
             "(0,0,0): (1.000000, 2.500000, -3.000000) (-5, 7) (1, 2, 3, 4)",
             "(0,0,0): text with %d and more: true",
             "(0,0,0): ((1, 2, 3), (4, 5, 6)) 0.1 (true, false)",
             "(0,0,0): 1099511627775 -1099511627776 0.3333333333333333",
             "(0,0,0): (1, 2, 0.5) 0.250000", "error (0,0,0): NaN nan and nan, infinity inf"}));
}

TEST_P(Printing, RowsPrintForEachOfTheirThreads) {
  EXPECT_EQ(dispatch_rays("Rows", 10),
            (Lines{"(1,0,0): row 1: 0.000", "(3,0,0): row 3: 2.414", "(5,0,0): row 5: 6.146",
                   "(7,0,0): row 7: 10.832", "(9,0,0): row 9: 16.306"}));
}

TEST_P(Printing, RayStagesSayWhichRayTheyBelongTo) {
  make_scene();
  EXPECT_EQ(dispatch_rays("Rays", 2),
            (Lines{"(0,0,0): before", "(0,0,0): any hit of 11", "(0,0,0): closest hit at 2",
                   "(0,0,0): box 0", "(0,0,0): box hit at 2.5", "(0,0,0): callable",
                   "(0,0,0): after 7",  //
                   "(1,0,0): before", "(1,0,0): any hit of 11", "(1,0,0): closest hit at 2",
                   "(1,0,0): miss", "(1,0,0): callable", "(1,0,0): after 7"}));
}

TEST_P(Printing, DrawsSayWhichVertexAndPixel) {
  EXPECT_EQ(draw("Pixel"),
            (Lines{"(0,0,0): pixel", "(1,0,0): pixel", "(2,0,0): vertex", "(2,0,0): pixel",
                   "(0,1,0): pixel", "(1,1,0): pixel", "(2,1,0): pixel"}));
}

TEST_P(Printing, HelpersAndDiscardedPixelsAreSilent) {
  EXPECT_EQ(draw("Discards"), (Lines{"(2,0,0): vertex", "(2,0,0): kept at (2.500000, 0.500000), 1",
                                     "(2,1,0): kept at (2.500000, 1.500000), 1"}));
}

TEST_P(Printing, OneThreadCanBeChosen) {
  DeviceDesc desc;
  desc.PrintThread = {3, 1, 0};
  make_device(desc);
  EXPECT_EQ(dispatch("Threads"), (Lines{"(3,1,0): x 3 y 0", "(3,1,0): last"}));
}

TEST_P(Printing, CheckedDevicesPrintToo) {
  DeviceDesc desc;
  desc.Checked = true;
  make_device(desc);
  EXPECT_EQ(dispatch("Threads").size(), 8u);
}

TEST_P(Printing, WhatFindsNoRoomIsSaid) {
  // 4 MiB hold 149,795 records of 28 bytes; each thread writes two.
  const Lines lines = dispatch("Many", 1600);
  EXPECT_EQ(lines.size(), (size_t{4} * 1024 * 1024 - 32) / 28);
  EXPECT_NE(lost_.find("KA0847"), std::string::npos) << lost_;
  EXPECT_NE(lost_.find("4194304 bytes"), std::string::npos) << lost_;
  lost_.clear();
  EXPECT_EQ(dispatch("Threads").size(), 8u);
  EXPECT_TRUE(lost_.empty()) << lost_;
}

// What the compiler says of a print in a compute shader; empty: it compiles.
std::string refusal(const std::string& statement) {
  ShaderCompileOptions options;
  options.File = "a.hlsl";
  options.Source =
      "[shader(\"compute\")] [numthreads(1, 1, 1)] void f(uint i : SV_GroupIndex) { float2 v = "
      "i; " +
      statement + " }";
  options.Interpret = true;
  options.Spirv = false;
  const ShaderCompilation compiled = CompileShaderLibrary(options);
  return compiled.Diagnostics.empty() ? "" : compiled.Diagnostics[0].Message;
}

TEST(PrintFormat, MistakesAreExplained) {
  EXPECT_EQ(refusal("printf(\"%u %v2f\", i, v);"), "");
  EXPECT_EQ(refusal("printf(i);"), "printf: its first argument is not a string literal");
  EXPECT_EQ(refusal("printf();"), "printf: its first argument is not a string literal");
  EXPECT_EQ(refusal("errorf(\"%d\", v.x);"),
            "errorf: '%d' does not print value 1, which is a 'float'; %v prints any");
  EXPECT_EQ(refusal("printf(\"%f\", i);"),
            "printf: '%f' does not print value 1, which is a 'uint'; %v prints any");
  EXPECT_EQ(refusal("printf(\"%f\", v);"),
            "printf: '%f' does not print value 1, which is a 'float2'; %v prints any");
  EXPECT_EQ(refusal("printf(\"%v3f\", v);"),
            "printf: '%v3f' does not print value 1, which is a 'float2'; %v prints any");
  EXPECT_EQ(refusal("printf(\"%u %u\", i);"), "printf: there is no value for '%u'");
  EXPECT_EQ(refusal("printf(\"%u\", i, i);"), "printf: 2 values for 1 conversions");
  EXPECT_EQ(refusal("printf(\"%s\", i);"),
            "printf: '%s' prints a string literal, and value 1 is a 'uint'");
  EXPECT_EQ(refusal("printf(\"%u\", \"a\");"),
            "printf: '%u' prints a number, and value 1 is a string");
  EXPECT_EQ(refusal("printf(\"%y\", i);"), "printf: '%y' is no conversion");
  EXPECT_EQ(refusal("printf(\"%\");"), "printf: '%' is no conversion");
  EXPECT_EQ(refusal("printf(\"%*d\", i);"), "printf: '%*' is no conversion");
}

// A function of that name in the source is the source's.
TEST(PrintFormat, NamesAreNotTaken) {
  ShaderCompileOptions options;
  options.File = "a.hlsl";
  options.Source =
      "uint printf(uint x) { return x; } [shader(\"compute\")] [numthreads(1, 1, 1)] void f(uint i "
      ": "
      "SV_GroupIndex) { printf(i); }";
  options.Interpret = true;
  options.Spirv = false;
  EXPECT_TRUE(CompileShaderLibrary(options).Status.ok());
}

}  // namespace
}  // namespace kaamos::shader_tests
