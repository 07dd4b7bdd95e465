// SPDX-License-Identifier: MIT
//
// HLSL on Vulkan where a fault of the driver or of the shader must do no harm: workarounds in
// generated code, each compared with the result without it on the driver that it is for; endless
// recursion and wild addresses, which remove the device. [runtime/vulkan/README.md]
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rtapi/rtapi.h>

#include <cstdlib>
#include <cstring>

#include "fixtures.h"
#include "tests/vulkan/support.h"
#include "twin_device.h"

namespace kaamos::test {
namespace {

using ::testing::HasSubstr;

Compiled compile(const std::string& text) {
  hlsl::FrontendOptions options;
  options.path = "faults.hlsl";
  options.include_folders = {std::string(KAAMOS_SOURCE_DIR) + "/tests/hlsl"};
  options.text = "#include \"scene.hlsli\"\n" + text;
  Compiled code = compile_vulkan(options);
  EXPECT_EQ(code.error, "");
  return code;
}

// The first words of `results` after one thread.
std::vector<uint32_t> words_after(const std::string& text) {
  const Compiled code = compile(text);
  std::vector<uint32_t> words(8);
  if (code.library == nullptr) return words;
  const auto bytes = run_on_device("vulkan", *code.library, {1, 1, 1});
  EXPECT_EQ(bytes.error(), "");
  if (bytes) std::memcpy(words.data(), bytes->data(), 32);
  return words;
}

std::string error_of(const std::string& text) {
  const Compiled code = compile(text);
  if (code.library == nullptr) return "";
  return run_on_device("vulkan", *code.library, {4, 4, 1}).error();
}

std::vector<uint32_t> words_without(const char* workaround, const std::string& text) {
  setenv("KAAMOS_VULKAN_DISABLE_WORKAROUNDS", workaround, 1);
  auto words = words_after(text);
  unsetenv("KAAMOS_VULKAN_DISABLE_WORKAROUNDS");
  return words;
}

bool is_lavapipe() {
  const auto device = rtapi::CreateDevice({.Backend = "vulkan"});
  return device && device->GetInfo().Name.find("llvmpipe") != std::string::npos;
}

// Tests a workaround: the first word with it, and without it as long as the driver has the fault.
// If the second check fails, the driver has been fixed, and the table of workarounds needs a last
// version.
void expect_first_word(const char* workaround, uint32_t right, uint32_t wrong,
                       const std::string& text) {
  EXPECT_EQ(words_after(text)[0], right);
  if (is_lavapipe()) {
    EXPECT_EQ(words_without(workaround, text)[0], wrong);
  }
}

TEST(VulkanFaults, B1_RejectedReportsLeaveAttributesAlone) {
  KAAMOS_NEED_VULKAN();
  expect_first_word("B1", 11, 22, R"(
struct Attributes { uint number; };
[shader("intersection")] void BoxReport() {
  Attributes attributes;
  attributes.number = 11;
  ReportHit(20, 0, attributes);
  attributes.number = 22;
  ReportHit(21, 0, attributes);  // behind the first
}
[shader("closesthit")] void BoxHit(inout Payload payload, Attributes attributes) {
  payload.numbers.x = attributes.number;
}
[shader("raygeneration")] void Main() {
  results.Store(0, trace(0, 0xF0, test_ray(0)).numbers.x);
}
)");
}

TEST(VulkanFaults, B3_HitValuesSurviveANestedTrace) {
  KAAMOS_NEED_VULKAN();
  // The outer ray hits a triangle, and the ray that starts behind it hits a box.
  expect_first_word("B3", 254, 5, R"(
struct Attributes { uint number; };
[shader("intersection")] void BoxReport() {
  Attributes attributes = (Attributes)0;
  ReportHit(20, 5, attributes);
}
[shader("closesthit")] void BoxHit(inout Payload payload, Attributes attributes) {
  payload.numbers.x = HitKind();
}
[shader("closesthit")] void Hit(inout Payload payload,
                                BuiltInTriangleIntersectionAttributes attributes) {
  Payload inner = (Payload)0;
  TraceRay(scene, 0, 0xF0, 0, 0, 0, test_ray(0), inner);
  payload.numbers.x = HitKind();
}
[shader("raygeneration")] void Main() {
  results.Store(0, trace(0, 0x0F, test_ray(0)).numbers.x);
}
)");
}

TEST(VulkanFaults, B7_RayTCurrentFollowsAcceptedReports) {
  KAAMOS_NEED_VULKAN();
  expect_first_word("B7", 20, 100, R"(
struct Attributes { uint number; };
[shader("intersection")] void BoxReport() {
  Attributes attributes = (Attributes)0;
  ReportHit(20, 0, attributes);
  results.Store(0, uint(RayTCurrent()));
}
[shader("raygeneration")] void Main() { trace(0, 0xF0, test_ray(0)); }
)");
}

TEST(VulkanFaults, B11_RowsThatAlternateAreAllThere) {
  KAAMOS_NEED_VULKAN();
  const Compiled code = compile(R"(
[shader("raygeneration")] void Main() {
  const uint2 at = DispatchRaysIndex().xy;
  results.InterlockedAdd(4 * (at.x + 3 * at.y), 1 + at.y);
}
)");
  ASSERT_NE(code.library, nullptr);
  for (const char* disabled : {"", "B11"}) {
    setenv("KAAMOS_VULKAN_DISABLE_WORKAROUNDS", disabled, 1);
    const auto bytes = run_on_device("vulkan", *code.library, {3, 101, 1});
    unsetenv("KAAMOS_VULKAN_DISABLE_WORKAROUNDS");
    ASSERT_TRUE(bytes) << bytes.error();
    for (uint32_t i = 0; i < 3 * 101; ++i) {
      uint32_t word;
      std::memcpy(&word, bytes->data() + 4 * i, sizeof(word));
      ASSERT_EQ(word, 1 + i / 3) << i;
    }
  }
}

TEST(VulkanFaults, EndlessTracesRemoveTheDevice) {
  KAAMOS_NEED_VULKAN();
  const std::string error = error_of(R"(
[shader("closesthit")] void Hit(inout Payload payload,
                                BuiltInTriangleIntersectionAttributes attributes) {
  TraceRay(scene, 0, 0x0F, 0, 0, 0, test_ray(0), payload);
}
[shader("raygeneration")] void Main() { trace(0, 0x0F, test_ray(0)); }
)");
  EXPECT_THAT(error, HasSubstr("KA0890"));
  EXPECT_THAT(error, HasSubstr("MaxTraceRecursionDepth 4,"));
}

TEST(VulkanFaults, EndlessCallsRemoveTheDevice) {
  KAAMOS_NEED_VULKAN();
  EXPECT_THAT(error_of(R"(
struct Data { uint depth; };
[shader("callable")] void Deeper(inout Data data) {
  ++data.depth;
  CallShader(0, data);
}
[shader("raygeneration")] void Main() {
  Data data = (Data)0;
  CallShader(0, data);
}
)"),
              HasSubstr("KA0891"));
}

// One single-thread dispatch with its own root descriptor.
struct RootDescriptorRun {
  RootDescriptorRun(const std::string& text, uint64_t address) {
    desc.Backend = "vulkan";
    desc.OnMessage = [this](const rtapi::Message& message) { messages += message.Text + "\n"; };
    rtapi::Device device = rtapi::CreateDevice(desc).value();
    rtapi::CommandQueue queue = device.CreateCommandQueue().value();
    const Compiled code = compile(text);
    if (code.library == nullptr) return;
    const auto library = rtapi::LoadShaderLibrary(code.library).value();
    const auto out = device
                         .CreateBuffer({.SizeInBytes = 256,
                                        .Flags = rtapi::ResourceFlags::kAllowUnorderedAccess})
                         .value();
    rtapi::RootSignatureDesc root_desc;
    root_desc.Parameters = {rtapi::RootParameter::Srv(0), rtapi::RootParameter::Uav(0)};
    const auto root = device.CreateRootSignature(root_desc).value();
    rtapi::StateObjectDesc object;
    object.Add(rtapi::DxilLibraryDesc{library, {}});
    object.Add(rtapi::RaytracingShaderConfig{64, 32});
    object.Add(rtapi::RaytracingPipelineConfig{1});
    object.Add(rtapi::GlobalRootSignature{root});
    const auto pipeline = device.CreateStateObject(object).value();
    rtapi::ShaderTable ray_generation(pipeline), miss(pipeline);
    ray_generation.AddRecord("Main").value();
    ray_generation.Build(device).value();
    miss.AddRecord("Miss").value();
    miss.Build(device).value();
    rtapi::CommandList list = device.CreateCommandList().value();
    list.SetComputeRootSignature(root);
    list.SetPipelineState1(pipeline);
    list.SetComputeRootShaderResourceView(0, address != 0 ? address : out.GetGPUVirtualAddress());
    list.SetComputeRootUnorderedAccessView(1, out.GetGPUVirtualAddress());
    rtapi::DispatchRaysDesc dispatch;
    dispatch.RayGenerationShaderRecord = ray_generation.GetRecord(0);
    dispatch.MissShaderTable = miss.GetTable();
    dispatch.Width = dispatch.Height = dispatch.Depth = 1;
    list.DispatchRays(dispatch);
    const auto status = queue.ExecuteAndWait(list);
    if (!status) {
      error = status.error().message;
      return;
    }
    const auto bytes = rtapi::ReadbackBuffer(device, queue, out).value();
    std::memcpy(&word, bytes.data(), sizeof(word));
  }

  rtapi::DeviceDesc desc;
  std::string messages;
  std::string error;
  uint32_t word = 0;
};

TEST(VulkanFaults, RaysAgainstWhatIsNoStructureMissAndAreReported) {
  KAAMOS_NEED_VULKAN();
  const RootDescriptorRun run(R"(
[shader("raygeneration")] void Main() { results.Store(0, trace(0, 0xFF, test_ray(0)).numbers.w); }
)",
                              0);
  EXPECT_EQ(run.error, "");
  EXPECT_EQ(run.word, 99u);  // Miss ran
  EXPECT_THAT(run.messages, HasSubstr("KA0894"));
}

}  // namespace
}  // namespace kaamos::test
