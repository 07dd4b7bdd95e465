// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <rtapi/rtapi.h>
#include <rtapi/shader_compiler.h>
#include <rtapi/shader_table.h>
#include <rtapi/upload.h>
#include <shaders/code.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "rtapi/src/shaders/library_variant.h"
#include "tests/common/structures.h"
#include "tests/vulkan/support.h"

namespace kaamos::checks {
namespace {

using namespace rtapi;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

struct Settings {
  uint32_t index = 0;
  uint32_t flags = 0;
  float number = 1;
  float t_min = 0;
};

ShaderLibrary interpreted_library() {
  static const ShaderLibrary library = [] {
    ShaderCompileOptions options;
    options.File = KAAMOS_CODE_HLSL;
    options.Interpret = true;
    options.Spirv = false;
    const ShaderCompilation out = CompileShaderLibrary(options);
    out.Status.value();
    return out.Library;
  }();
  return library;
}

class CheckedCode : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    const std::string executor = GetParam();
    if (executor == "vulkan") KAAMOS_NEED_VULKAN();
    DeviceDesc desc;
    desc.Backend = executor == "vulkan" ? "vulkan" : "embree";
    desc.Checked = true;
    desc.OnMessage = [this](const Message& message) { messages_.push_back(message.Text); };
    device_ = CreateDevice(desc).value();
    queue_ = device_.CreateCommandQueue().value();
    library_ = executor == "interpreted" ? interpreted_library()
                                         : LoadShaderLibrary(kaamos_shaders_code()).value();
    vertices_ = upload(std::vector<float>(104, 1.0f), "sofa.vb");  // 26 vertices of 16 bytes
    leaf_ = upload(std::vector<uint32_t>(8, 4), "leaf.mask");
    result_ = buffer(64, "result");
    build_scene();
    build_heap();
  }

  template <class T>
  Buffer upload(const std::vector<T>& elements, const std::string& name) {
    keep_.push_back(CreateUploadBuffer(device_, elements, name).value());
    return keep_.back();
  }
  Buffer buffer(uint64_t bytes, const std::string& name,
                ResourceStates state = ResourceStates::kUnorderedAccess) {
    BufferDesc desc;
    desc.SizeInBytes = bytes;
    desc.Flags = ResourceFlags::kAllowUnorderedAccess;
    desc.InitialState = state;
    desc.Name = name;
    keep_.push_back(device_.CreateBuffer(desc).value());
    return keep_.back();
  }
  // A triangle around (0, 0, 0), with hit record 0; a box around (10, 0, 0), with record 1.
  void build_scene() {
    RaytracingGeometryDesc triangle;
    const std::vector<float> corners = {-1, -1, 0, 0, 2, 0, 1, -1, 0};
    triangle.Triangles.VertexFormat = Format::kR32G32B32Float;
    triangle.Triangles.VertexCount = 3;
    triangle.Triangles.VertexBuffer = {upload(corners, "corners").GetGPUVirtualAddress(), 12};
    RaytracingGeometryDesc box;
    box.Type = RaytracingGeometryType::kProceduralPrimitiveAabbs;
    const std::vector<RaytracingAabb> boxes = {{9, -1, 0, 11, 1, 1}};
    box.AABBs.AABBCount = 1;
    box.AABBs.AABBs = {upload(boxes, "boxes").GetGPUVirtualAddress(), sizeof(RaytracingAabb)};
    const Buffer levels[] = {
        kaamos::test::build_bottom_level(device_, queue_, {triangle}, "triangle"),
        kaamos::test::build_bottom_level(device_, queue_, {box}, "box")};
    keep_.insert(keep_.end(), {levels[0], levels[1]});
    bottom_ = levels[0];
    std::vector<RaytracingInstanceDesc> instances(2);
    for (uint32_t i = 0; i < 2; ++i) {
      instances[i].Transform[0][0] = instances[i].Transform[1][1] = instances[i].Transform[2][2] =
          1;
      instances[i].InstanceMask = 0xFF;
      instances[i].InstanceContributionToHitGroupIndex = i;
      instances[i].AccelerationStructure = levels[i].GetGPUVirtualAddress();
    }
    scene_ = kaamos::test::build_top_level(device_, queue_, instances, "scene");
  }
  // Slot 0: "raw", as it should be. Slot 1: a typed buffer.
  void build_heap() {
    DescriptorHeapDesc desc;
    desc.NumDescriptors = 6;
    desc.Flags = DescriptorHeapFlags::kShaderVisible;
    heap_ = device_.CreateDescriptorHeap(desc).value();
    raw_ = upload(std::vector<uint32_t>(8, 5), "raw");
    ShaderResourceViewDesc view;
    view.ViewDimension = SrvDimension::kBuffer;
    view.Format = Format::kR32Typeless;
    view.Buffer.NumElements = 8;
    view.Buffer.Flags = BufferSrvFlags::kRaw;
    device_.CreateShaderResourceView(raw_, view, heap_.GetCPUDescriptorHandle(0)).value();
    view.Format = Format::kR32Uint;
    view.Buffer.Flags = BufferSrvFlags::kNone;
    device_.CreateShaderResourceView(raw_, view, heap_.GetCPUDescriptorHandle(1)).value();
  }

  void run(const char* raygen, const Settings& settings = {}) {
    StateObjectDesc desc;
    DxilLibraryDesc code{library_, {}};
    for (const char* name : {raygen, "Hit", "Leaf", "Box", box_hit_, "Miss", callable_}) {
      code.Exports.push_back({name, ""});
    }
    desc.Add(code);
    HitGroupDesc triangles;
    triangles.HitGroupExport = "Triangles";
    triangles.ClosestHitShaderImport = "Hit";
    triangles.AnyHitShaderImport = "Leaf";
    desc.Add(triangles);
    HitGroupDesc boxes;
    boxes.HitGroupExport = "Boxes";
    boxes.Type = HitGroupType::kProceduralPrimitive;
    boxes.ClosestHitShaderImport = box_hit_;
    boxes.IntersectionShaderImport = "Box";
    desc.Add(boxes);
    const RootSignature global =
        device_
            .CreateRootSignature(
                "RootFlags(CBV_SRV_UAV_HEAP_DIRECTLY_INDEXED), SRV(t0), SRV(t1), UAV(u0), "
                "DescriptorTable(SRV(t2)), RootConstants(b0, num32BitConstants = 4), "
                "DescriptorTable(SRV(t0, space = 2, numDescriptors = 3), "
                "SRV(t0, space = 3, numDescriptors = unbounded, offset = 0), "
                "SRV(t0, space = 4, numDescriptors = unbounded, offset = 0), "
                "SRV(t0, space = 5, numDescriptors = unbounded, offset = 0))")
            .value();
    desc.Add(GlobalRootSignature{global});
    const RootSignature local =
        device_.CreateRootSignature("RootFlags(LOCAL_ROOT_SIGNATURE), SRV(t0, space = 1)").value();
    desc.Associate(desc.Add(LocalRootSignature{local}), {"Triangles"});
    desc.Add(RaytracingShaderConfig{32, 8});
    desc.Add(RaytracingPipelineConfig1{2});
    const StateObject pipeline = device_.CreateStateObject(desc).value();
    ShaderTable generation(pipeline), miss(pipeline), hit(pipeline), callable(pipeline);
    generation.AddRecord(raygen).value();
    miss.AddRecord("Miss").value();
    hit.AddRecord("Triangles",
                  {LocalArgument::Address(leaf_address_ != 0 ? leaf_address_
                                                             : leaf_.GetGPUVirtualAddress())})
        .value();
    hit.AddRecord("Boxes").value();
    callable.AddRecord(callable_).value();
    for (ShaderTable* table : {&generation, &miss, &hit, &callable}) table->Build(device_).value();
    DispatchRaysDesc rays;
    rays.RayGenerationShaderRecord = generation.GetRecord(0);
    rays.MissShaderTable = miss.GetTable();
    rays.HitGroupTable = hit.GetTable();
    rays.CallableShaderTable = callable.GetTable();
    rays.Width = width_;
    rays.Height = rays.Depth = 1;
    CommandList list = device_.CreateCommandList().value();
    if (before_) before_(list);
    list.SetDescriptorHeaps({&heap_, 1});
    list.SetComputeRootSignature(global);
    list.SetPipelineState1(pipeline);
    list.SetComputeRootShaderResourceView(0, scene_.GetGPUVirtualAddress());
    list.SetComputeRootShaderResourceView(
        1, vertices_address_ != 0 ? vertices_address_ : vertices_.GetGPUVirtualAddress());
    list.SetComputeRootUnorderedAccessView(2, result_.GetGPUVirtualAddress());
    list.SetComputeRootDescriptorTable(3, heap_.GetGPUDescriptorHandle(table_slot_));
    list.SetComputeRoot32BitConstants(4, 4, &settings, 0);
    list.SetComputeRootDescriptorTable(5, heap_.GetGPUDescriptorHandle(0));
    list.DispatchRays(rays);
    if (after_) after_(list);
    told_before_ = std::move(messages_);
    messages_.clear();
    status_ = queue_.ExecuteAndWait(list);
  }

  std::vector<uint32_t> result_of() {
    const auto bytes = ReadbackBuffer(device_, queue_, result_).value();
    std::vector<uint32_t> out(bytes.size() / 4);
    std::memcpy(out.data(), bytes.data(), out.size() * 4);
    return out;
  }
  // The message with this id; empty if there is none.
  std::string told(const std::string& id) const {
    for (const std::string& message : messages_) {
      if (message.starts_with(id)) return message;
    }
    return "";
  }
  std::string all() const {
    std::string out;
    for (const std::string& message : messages_) out += message + "\n";
    return out;
  }
  // The message with this id must contain these parts in this order, and shader code reports
  // nothing else.
  void expect(const std::string& id, const std::vector<std::string>& parts) {
    const std::string text = told(id);
    ASSERT_NE(text, "") << "no " << id << " among:\n" << all();
    size_t at = 0;
    for (const std::string& part : parts) {
      const size_t found = text.find(part, at);
      ASSERT_NE(found, std::string::npos) << "no \"" << part << "\" in\n" << text;
      at = found + part.size();
    }
    for (const std::string& message : messages_) {
      if (message < "KA0425") {
        EXPECT_EQ(message.substr(0, 6), id) << message;
      }
    }
  }

  Device device_;
  CommandQueue queue_;
  ShaderLibrary library_;
  Buffer vertices_, leaf_, result_, scene_, bottom_, raw_;
  DescriptorHeap heap_;
  std::vector<Buffer> keep_;
  std::vector<std::string> messages_;
  std::vector<std::string> told_before_;  // messages from creating the pipeline
  Status status_;
  // Values that tests break.
  uint64_t leaf_address_ = 0;
  uint64_t vertices_address_ = 0;
  uint32_t table_slot_ = 0;
  uint32_t width_ = 1;
  std::function<void(CommandList&)> before_, after_;  // more commands for the list
  const char* callable_ = "Call";
  const char* box_hit_ = "BoxHit";
};

TEST_P(CheckedCode, CleanCodeIsSilent) {
  width_ = 64;
  run("Clean", {127});
  EXPECT_TRUE(status_.ok()) << status_.error().message;
  EXPECT_EQ(all(), "");
}

TEST_P(CheckedCode, ReadPastARootBuffer) {
  width_ = 4;
  run("ReadVertex", {26});
  expect("KA0417",
         {"KA0417 root descriptor out of bounds: ray generation \"ReadVertex\" at pixel (", ",0), ",
          "code.hlsl:", ", ray generation record",
          ", parameter t1 \"vertices\": reads bytes 416..420 of buffer \"sofa.vb\" (416 "
          "bytes); it reads 0 here",
          "[and 3 more times]", "(DispatchRays, command "});
}

TEST_P(CheckedCode, ReadFromTheMiddleOfARootBuffer) {
  vertices_address_ = vertices_.GetGPUVirtualAddress() + 400;
  run("ReadVertex", {1});
  expect("KA0417", {"bytes 416..420 of buffer \"sofa.vb\" (416 bytes), offset 16 from byte 400"});
}

TEST_P(CheckedCode, WriteAndAtomicPastARootBuffer) {
  run("WriteResult", {16});
  expect("KA0417", {"parameter u0 \"result\": writes bytes 64..68 of buffer \"result\" (64 bytes); "
                    "nothing is written here"});
  run("AddToResult", {1u << 28});
  expect("KA0417", {"parameter u0 \"result\": changes bytes 1073741824..1073741828 of buffer"});
}

// Allocations are further apart than that.
TEST_P(CheckedCode, RootAddressOfNoBuffer) {
  leaf_address_ = leaf_.GetGPUVirtualAddress() + 4096;
  run("Clean", {127});
  expect("KA0419", {"any-hit \"Leaf\"", "parameter t0, space 1 \"leaf\": is set to address 0x",
                    "which is in no live buffer", "accesses byte 16 from there"});
}

TEST_P(CheckedCode, AnyHitFollowsABadAddressInItsRecord) {
  leaf_address_ = leaf_.GetGPUVirtualAddress() + 16;
  run("Clean", {127});
  expect("KA0417", {"any-hit \"Leaf\" at pixel (0,0), ", "code.hlsl:", ", hit group table record 0",
                    ", parameter t0, space 1 \"leaf\": reads bytes 32..36 of buffer \"leaf.mask\" "
                    "(32 bytes), offset 16 from byte 16"});
}

TEST_P(CheckedCode, MisalignedOffset) {
  run("ReadRaw", {6});
  expect("KA0418", {"parameter t2 \"raw\": accesses byte 6", "is not a multiple of 4"});
}

TEST_P(CheckedCode, ReadPastAViewIsLegal) {
  run("ReadRaw", {4096});
  EXPECT_EQ(all(), "");
}

TEST_P(CheckedCode, WrongDescriptorInATable) {
  table_slot_ = 1;
  run("ReadRaw");
  expect("KA0422", {"parameter t2 \"raw\": the slot holds a typed buffer to read (SRV), but the "
                    "shader declares a raw buffer to read (SRV)"});
}

TEST_P(CheckedCode, IndexPastAnArray) {
  run("ReadMany", {0});
  EXPECT_EQ(all(), "");
  run("ReadMany", {3});
  expect("KA0420", {"ray generation \"ReadMany\"",
                    "parameter t0, space 2 \"many\": index 3 is past the end of 3 "
                    "elements; it reads as a null descriptor"});
  run("ReadAnyNumber", {6});
  expect("KA0421", {"parameter t0, space 3 \"any_number\"", "which has 6 descriptors"});
}

TEST_P(CheckedCode, WrongDescriptorInAnArray) {
  run("ReadMany", {1});
  expect("KA0422", {"parameter t0, space 2 \"many\": the slot holds a typed buffer"});
  run("ReadAnyNumber", {1});
  expect("KA0422", {"parameter t0, space 3 \"any_number\": the slot holds a typed buffer"});
}

TEST_P(CheckedCode, FreedResourceInAnArray) {
  ShaderResourceViewDesc view;
  view.ViewDimension = SrvDimension::kBuffer;
  view.Format = Format::kR32Typeless;
  // Far inside the buffer, where the small buffers of the next run do not end up.
  view.Buffer.FirstElement = 200000;
  view.Buffer.NumElements = 4;
  view.Buffer.Flags = BufferSrvFlags::kRaw;
  Buffer short_lived =
      CreateUploadBuffer(device_, std::vector<uint32_t>(1u << 18, 9), "gone").value();
  device_.CreateShaderResourceView(short_lived, view, heap_.GetCPUDescriptorHandle(2)).value();
  run("ReadMany", {2});
  EXPECT_EQ(all(), "");
  short_lived = {};
  run("ReadMany", {2});
  expect("KA0425", {"parameter t0, space 2 \"many\": element 2 is a raw buffer, at address 0x",
                    "which has been freed; it reads as a null descriptor"});
  EXPECT_EQ(result_of()[0], 0u);
  TextureDesc texture_desc;
  texture_desc.Width = texture_desc.Height = 4;
  texture_desc.Format = Format::kR32Float;
  Texture picture = device_.CreateTexture(texture_desc).value();
  ShaderResourceViewDesc picture_view;
  picture_view.ViewDimension = SrvDimension::kTexture2D;
  picture_view.Format = Format::kR32Float;
  picture_view.Texture2D.MipLevels = 1;
  device_.CreateShaderResourceView(picture, picture_view, heap_.GetCPUDescriptorHandle(3)).value();
  run("ReadPicture", {3});
  EXPECT_EQ(all(), "");
  picture = {};
  run("ReadPicture", {3});
  expect("KA0425",
         {"parameter t0, space 4 \"pictures\": element 3 is a texture, which has been freed"});
}

// Only the code knows which elements of an array are used; the layer knows the state of each.
TEST_P(CheckedCode, StatesOfTexturesInArrays) {
  const auto texture = [&](const char* name, ResourceStates state, uint32_t slot) {
    TextureDesc desc;
    desc.Width = desc.Height = 4;
    desc.MipLevels = 2;
    desc.Format = Format::kR32Float;
    desc.Flags = ResourceFlags::kAllowUnorderedAccess;
    desc.InitialState = state;
    desc.Name = name;
    const Texture out = device_.CreateTexture(desc).value();
    ShaderResourceViewDesc view;
    view.ViewDimension = SrvDimension::kTexture2D;
    view.Format = Format::kR32Float;
    view.Texture2D.MipLevels = 1;
    device_.CreateShaderResourceView(out, view, heap_.GetCPUDescriptorHandle(slot)).value();
    return out;
  };
  const Texture wall = texture("wall", ResourceStates::kUnorderedAccess, 3);
  const Texture floor = texture("floor", ResourceStates::kCommon, 4);
  run("ReadPicture", {4});
  run("ReadPictureOfHeap", {4});
  EXPECT_EQ(all(), "");
  for (const char* shader : {"ReadPicture", "ReadPictureOfHeap"}) {
    run(shader, {3});
    expect("KA0451", {std::string("ray generation \"") + shader + "\" at pixel",
                      "element 3 is a view of texture \"wall\", which is in state "
                      "kUnorderedAccess since it was created; it must be in state "
                      "kNonPixelShaderResource. Record ResourceBarrier::Transition from "
                      "kUnorderedAccess to kNonPixelShaderResource first."});
  }
  // The access happens all the same.
  EXPECT_EQ(result_of()[0], 0x7FC0u);
  // Only the view's subresources count.
  before_ = [&](CommandList& list) {
    list.ResourceBarrier(ResourceBarrier::Transition(wall, ResourceStates::kUnorderedAccess,
                                                     ResourceStates::kNonPixelShaderResource, 1));
  };
  run("ReadPicture", {3});
  expect("KA0451", {"element 3 is a view of subresource 0 (mip 0, array element 0) of texture "
                    "\"wall\", which is in state kUnorderedAccess since it was created"});
  before_ = [&](CommandList& list) {
    list.ResourceBarrier(ResourceBarrier::Transition(wall, ResourceStates::kUnorderedAccess,
                                                     ResourceStates::kNonPixelShaderResource, 0));
  };
  run("ReadPicture", {3});
  // A barrier in the same list may name the state that an array read promoted the texture to.
  after_ = [&](CommandList& list) {
    list.ResourceBarrier(ResourceBarrier::Transition(floor, ResourceStates::kNonPixelShaderResource,
                                                     ResourceStates::kCopyDest));
  };
  before_ = {};
  run("ReadPicture", {4});
  EXPECT_EQ(all(), "");
  after_ = {};
  run("ReadPicture", {4});
  expect("KA0451", {"element 4 is a view of texture \"floor\", which is in state kCopyDest since "
                    "ResourceBarrier, command "});
}

TEST_P(CheckedCode, StructureOfAnArray) {
  const auto view_of = [&](uint64_t address, uint32_t slot) {
    ShaderResourceViewDesc view;
    view.ViewDimension = SrvDimension::kRaytracingAccelerationStructure;
    view.RaytracingAccelerationStructure.Location = address;
    device_.CreateShaderResourceView(Resource(), view, heap_.GetCPUDescriptorHandle(slot)).value();
  };
  view_of(scene_.GetGPUVirtualAddress(), 4);
  view_of(bottom_.GetGPUVirtualAddress(), 5);
  for (const char* shader : {"TraceAnyScene", "QueryAnyScene"}) {
    run(shader, {4});
    EXPECT_EQ(all(), "");
    run(shader, {5});
    expect("KA0464", {std::string("ray generation shader \"") + shader + "\" uses",
                      "which is a bottom level"});
  }
}

TEST_P(CheckedCode, RecordsThatNoConstantsReach) {
  run("TraceAny", {0});
  EXPECT_EQ(all(), "");
  run("TraceAny", {7});
  expect("KA0430", {"hit group table record 7, reached from ray generation shader \"TraceAny\" "
                    "(code.hlsl:",
                    ") at instance 0, geometry 0, ray type 7: instance contribution 0 + "
                    "multiplier 0 * geometry 0 + ray contribution 7"});
  run("TraceAny", {.index = 0x300, .t_min = 50});
  expect("KA0430", {"miss table record 3, reached from ray generation shader \"TraceAny\"",
                    "with MissShaderIndex 3"});
  run("TraceAny", {1});
  expect("KA0434",
         {"hit group table record 1 holds hit group \"Boxes\"", "is reached by triangles"});
  run("CallAny", {0});
  EXPECT_EQ(all(), "");
  run("CallAny", {9});
  expect("KA0430", {"callable table record 9, reached from ray generation shader \"CallAny\" by "
                    "CallShader(9)"});
}

TEST_P(CheckedCode, AttributesOfAnotherType) {
  run("TraceBox");
  EXPECT_TRUE(told_before_.empty());
  box_hit_ = "BoxHitOther";
  run("TraceBox");
  ASSERT_EQ(told_before_.size(), 1u);
  EXPECT_EQ(told_before_[0],
            "KA0412 attribute type mismatch: hit group \"Boxes\": the attributes of intersection "
            "shader \"Box\" and of closest-hit shader \"BoxHitOther\" (uint2 place 0;) have "
            "different scalars. All shaders of a hit group must use one type.");
}

// Libraries from elsewhere, loaded without their source on a machine without a compiler. The second
// load must not compile again, even if nobody held the library in between.
TEST(CheckedLibrary, ALibraryThatIsLoadedAgainIsNotCompiledAgain) {
  const auto variant = [] {
    const ShaderLibrary library = LoadShaderLibrary(kaamos_shaders_code()).value();
    return rtapi::detail::variant_of(library, {.checks = true}, false).library.impl().get();
  };
  const auto* first = variant();
  EXPECT_EQ(variant(), first);
}

TEST_P(CheckedCode, CodeThatIsNotCheckedOrIsSlow) {
  if (std::string(GetParam()) == "interpreted") GTEST_SKIP() << "of libraries with native code";
  static shader::LibraryDesc bare = *kaamos_shaders_code();
  bare.source = nullptr;
  library_ = LoadShaderLibrary(&bare).value();
  run("Clean", {127});
  ASSERT_FALSE(told_before_.empty());
  EXPECT_EQ(told_before_[0].find("KA0423 shader code is not checked: \""), 0u) << told_before_[0];
  EXPECT_NE(told_before_[0].find("runs without checks of its code: it carries no source"),
            std::string::npos);
  if (std::string(GetParam()) != "native") return;
  static shader::LibraryDesc slow = *kaamos_shaders_code();
  library_ = LoadShaderLibrary(&slow).value();
  setenv("KAAMOS_CXX", "no-such-compiler", 1);
  run("Clean", {127});
  const std::vector<std::string> told_first = told_before_;
  run("Clean", {127});
  unsetenv("KAAMOS_CXX");
  EXPECT_TRUE(told_before_.empty()) << "said twice: " << told_before_[0];
  told_before_ = told_first;
  ASSERT_FALSE(told_before_.empty());
  EXPECT_EQ(told_before_[0].find("KA0424 shader code is interpreted: \""), 0u) << told_before_[0];
  EXPECT_NE(told_before_[0].find("about a hundred times slower: the compiler \"no-such-compiler\""),
            std::string::npos);
  EXPECT_EQ(all(), "");
}

TEST_P(CheckedCode, HeapIndex) {
  run("ReadHeap", {6});
  expect("KA0421", {"index 6 is outside the heap of 6 descriptors"});
  run("ReadHeap", {1});
  expect("KA0422", {"the slot holds a typed buffer"});
}

TEST_P(CheckedCode, NanNormalsMakeNanRays) {
  run("Trace", {0, 0, kNan});
  expect("KA0401", {"ray generation \"Trace\" at pixel (0,0), ", "code.hlsl:",
                    "Origin (0,0,-1), TMin 0, Direction (", "nan", "TMax 100; the ray misses"});
}

TEST_P(CheckedCode, RayInterval) {
  run("Trace", {0, 0, 1, -1});
  expect("KA0402", {"TMin -1", "TMin must be at least 0"});
  run("Trace", {0, 0, 1, 200});
  expect("KA0402", {"TMin 200", "TMax 100"});
}

TEST_P(CheckedCode, RayFlags) {
  for (const uint32_t flags : {0x3u, 0x41u, 0x30u, 0x110u, 0x300u, 0x800u}) {
    run("Trace", {0, flags});
    expect("KA0403", {"flags 0x"});
  }
  for (const uint32_t flags : {0x1u, 0x8u, 0x24u, 0x214u, 0x400u}) {
    run("Trace", {0, flags});
    EXPECT_EQ(all(), "") << flags;
  }
}

TEST_P(CheckedCode, OneRayForTraceRayAndAQuery) {
  run("TraceTwice", {0, 8});
  expect("KA0404", {"flags 0x8: a RayQuery runs no closest-hit shader"});
}

TEST_P(CheckedCode, TransformReadAfterAMiss) {
  run("ReadTransform", {0, 0, 50});
  expect("KA0410", {"CommittedObjectToWorld3x4() was read without a hit"});
  run("ReadTransform", {0, 0, 0});
  EXPECT_EQ(all(), "");
}

TEST_P(CheckedCode, CandidateReadWithoutOne) {
  run("ReadCandidate", {0, 0, 50});
  expect("KA0409", {"CandidatePrimitiveIndex() has no candidate"});
}

TEST_P(CheckedCode, CommitOutOfRange) {
  run("CommitBox", {0, 0, 200});
  expect("KA0411", {"t 200 is not between TMin 0", "100"});
}

TEST_P(CheckedCode, PayloadOfAnotherType) {
  run("TraceOther");
  expect("KA0407", {"miss \"Miss\"", "the caller passes 8 bytes, but the shader's type has 16"});
}

TEST_P(CheckedCode, CallableDataOfAnotherType) {
  callable_ = "CallWide";
  run("CallOther");
  expect("KA0408", {"callable \"CallWide\"", "the caller passes 8 bytes"});
}

TEST_P(CheckedCode, HitKindOutOfRange) {
  run("TraceBox", {200});
  expect("KA0406", {"intersection \"Box\"", "kind 200"});
}

TEST_P(CheckedCode, RecursionPastTheDeclaredDepth) {
  run("Trace", {5});
  EXPECT_FALSE(status_.ok());
  expect("KA0405", {"closest-hit \"Hit\"", "depth 2, but MaxTraceRecursionDepth is 2"});
}

INSTANTIATE_TEST_SUITE_P(Executors, CheckedCode, testing::Values("native", "interpreted", "vulkan"),
                         [](const auto& tested) { return std::string(tested.param); });

}  // namespace
}  // namespace kaamos::checks
