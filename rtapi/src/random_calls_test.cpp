// SPDX-License-Identifier: MIT
//
// No call may crash, whatever its arguments: random descriptions and calls, most of them wrong,
// from a fixed seed. The asan preset runs this under the sanitizers.
#include <random>

#include "rtapi/testing/command_list_fixture.h"

namespace rtapi::testing {
namespace {

class RandomCallsTest : public CommandListTest {
 protected:
  uint64_t Below(uint64_t n) { return n ? random_() % n : 0; }
  bool Coin() { return random_() & 1; }
  // A small number, one near a power of two, or any at all.
  uint64_t Number() {
    switch (Below(3)) {
      case 0:
        return Below(9);
      case 1:
        return (uint64_t{1} << Below(64)) + Below(3) - 1;
      default:
        return random_();
    }
  }
  uint32_t Number32() { return static_cast<uint32_t>(Number()); }
  template <class E>
  E Enum(uint32_t count) {
    return static_cast<E>(Below(8) ? Below(count) : Number32());
  }
  template <class T>
  const T& Pick(const std::vector<T>& from) {
    return from[Below(from.size())];
  }
  std::string Name() {
    static const std::vector<std::string> names = {
        "RayGen", "Miss", "Hit",        "Any",       "Intersect",           "Call",
        "helper", "g1",   "g2",         "",          "\x01?Miss@@YAXXZ",    "nope",
        "Lrs",    "Cfg",  "g1::anyhit", "HlslGroup", std::string(300, 'x'), "a;b"};
    return Pick(names);
  }
  std::vector<std::string> Names() {
    std::vector<std::string> names(Below(4));
    for (auto& n : names) n = Name();
    return names;
  }
  std::vector<ExportDesc> Exports() {
    std::vector<ExportDesc> exports(Coin() ? 0 : Below(4));
    for (auto& e : exports) e = {Name(), Coin() ? Name() : ""};
    return exports;
  }
  uint64_t Address() {
    if (Below(6) == 0) return Number();
    const uint64_t step = std::vector<uint64_t>{1, 4, 8, 16, 64, 256}[Below(6)];
    return Pick(buffers_).GetGPUVirtualAddress() + step * Below(40);
  }

  StateSubobject Subobject(const std::vector<StateObject>& objects,
                           const std::vector<RootSignature>& signatures) {
    switch (Below(12)) {
      case 0:
        return StateObjectConfig{Enum<StateObjectFlags>(8)};
      case 1:
        return GlobalRootSignature{Pick(signatures)};
      case 2:
        return LocalRootSignature{Pick(signatures)};
      case 3:
        return NodeMask{Number32()};
      case 4:
      case 5:
        return DxilLibraryDesc{Below(9) ? library_ : ShaderLibrary(), Exports()};
      case 6:
        return ExistingCollectionDesc::Of(Pick(objects), Exports());
      case 7:
        return SubobjectToExportsAssociation{static_cast<uint32_t>(Below(9)), Names()};
      case 8:
        return DxilSubobjectToExportsAssociation{Name(), Names()};
      case 9:
        return RaytracingShaderConfig{Coin() ? 16 : Number32(), Coin() ? 8 : Number32()};
      case 10:
        if (Coin()) return RaytracingPipelineConfig{static_cast<uint32_t>(Below(33))};
        return RaytracingPipelineConfig1{static_cast<uint32_t>(Below(33)),
                                         Enum<RaytracingPipelineFlags>(2)};
      default:
        return HitGroupDesc{Coin() ? "g1" : Name(), Enum<HitGroupType>(2), Name(),
                            Coin() ? "Hit" : Name(), Coin() ? "" : "Intersect"};
    }
  }

  std::mt19937_64 random_{20240607};
  std::vector<Buffer> buffers_;
};

TEST_F(RandomCallsTest, StateObjects) {
  builder_.Subobject("Lrs", 2, {"RootConstants(num32BitConstants=3, b0)"});
  builder_.Subobject("Cfg", 9, {}, {16, 8});
  builder_.Subobject("HlslGroup", 11, {"Any", "Hit", ""}, {0});
  library_ = builder_.Build();
  const std::vector<RootSignature> signatures = {RootSignature(), Local("SRV(t0)"), Local(""),
                                                 Global("CBV(b0), StaticSampler(s0)"), Global("")};
  std::vector<StateObject> objects(3);
  int made = 0, refused = 0;
  for (int i = 0; i < 4000; ++i) {
    StateObjectDesc desc = Coin() ? Base() : StateObjectDesc();
    desc.Type = Below(3) ? StateObjectType::kRaytracingPipeline : Enum<StateObjectType>(4);
    for (uint64_t n = Below(5); n > 0; --n) desc.Add(Subobject(objects, signatures));
    auto so =
        Below(8) ? device_.CreateStateObject(desc) : device_.AddToStateObject(desc, Pick(objects));
    so.ok() ? ++made : ++refused;
    if (!so.ok()) {
      EXPECT_EQ(so.error().message.rfind(so.error().id.text(), 0), 0u) << so.error().message;
      continue;
    }
    const std::string name = Name();
    const ShaderIdentifier* id = so->GetShaderIdentifier(name);
    EXPECT_TRUE(!id || !kaamos::runtime::is_null_identifier(id->data()));
    so->GetShaderStackSize(name);
    so->GetLocalRootSignature(name);
    objects[Below(objects.size())] = *so;
  }
  EXPECT_GT(made, 200);
  EXPECT_GT(refused, 200);
}

TEST_F(RandomCallsTest, RootSignatures) {
  int made = 0, refused = 0;
  for (int i = 0; i < 4000; ++i) {
    RootSignatureDesc desc;
    desc.Flags = Below(3) ? RootSignatureFlags::kNone : Enum<RootSignatureFlags>(0x90);
    for (uint64_t n = Below(4); n > 0; --n) {
      RootParameter p;
      p.ParameterType = Enum<RootParameterType>(5);
      p.Constants = {Number32(), static_cast<uint32_t>(Below(3)), Number32()};
      p.Descriptor = {Number32(), static_cast<uint32_t>(Below(3)), {}};
      for (uint64_t r = Below(3); r > 0; --r) {
        p.DescriptorTable.Ranges.push_back({Enum<DescriptorRangeType>(4),
                                            Number32(),
                                            Number32(),
                                            static_cast<uint32_t>(Below(3)),
                                            {},
                                            Number32()});
      }
      desc.Parameters.push_back(std::move(p));
    }
    device_.CreateRootSignature(desc).ok() ? ++made : ++refused;
  }
  EXPECT_GT(made, 200);
  EXPECT_GT(refused, 200);
}

TEST_F(RandomCallsTest, CommandLists) {
  const auto uav = ResourceFlags::kAllowUnorderedAccess;
  buffers_ = {MakeBuffer(4096, HeapType::kDefault, "a", uav),
              MakeBuffer(1000, HeapType::kUpload, "b"), MakeBuffer(3000, HeapType::kReadback, "c"),
              Buffer(),
              device_
                  .CreateBuffer({.SizeInBytes = 65536,
                                 .Flags = uav,
                                 .InitialState = ResourceStates::kRaytracingAccelerationStructure})
                  .value()};
  const std::vector<Texture> textures = {
      Texture(), device_.CreateTexture({.Width = 9, .Format = Format::kR32Float}).value(),
      device_
          .CreateTexture({.Dimension = ResourceDimension::kTexture3D,
                          .Width = 4,
                          .Height = 4,
                          .DepthOrArraySize = 4,
                          .MipLevels = 0,
                          .Format = Format::kR8G8B8A8Typeless,
                          .Flags = uav})
          .value()};
  const std::vector<DescriptorHeap> heaps = {
      DescriptorHeap(), device_.CreateDescriptorHeap({.NumDescriptors = 3}).value(),
      device_
          .CreateDescriptorHeap({.NumDescriptors = 3, .Flags = DescriptorHeapFlags::kShaderVisible})
          .value()};
  const std::vector<RootSignature> signatures = {
      RootSignature(), Local(""),
      Global("RootConstants(num32BitConstants=3, b0), CBV(b1), DescriptorTable(SRV(t0)), SRV(t1)")};
  const StateObject pipeline = Make(Base()).value();
  auto resource = [&]() -> Resource {
    if (Below(9) == 0) return {};
    return Coin() ? Resource(Pick(buffers_)) : Resource(Pick(textures));
  };
  auto cpu = [&] {
    return CpuDescriptorHandle{Pick(heaps).GetCPUDescriptorHandle(0).ptr + Below(5) * 16};
  };
  auto gpu = [&] {
    return GpuDescriptorHandle{Pick(heaps).GetGPUDescriptorHandle(0).ptr + Below(5) * 16};
  };
  auto side = [&]() -> TextureCopyLocation {
    if (Coin()) return {Pick(textures), static_cast<uint32_t>(Below(4))};
    return {Pick(buffers_),
            {Below(3) * 512,
             {Enum<Format>(60), Number32(), static_cast<uint32_t>(Below(4)),
              static_cast<uint32_t>(Below(4)), Coin() ? 256u : Number32()}}};
  };
  int closed = 0, failed = 0;
  for (int i = 0; i < 6000; ++i) {
    CommandList list = device_.CreateCommandList().value();
    for (uint64_t call = Below(3); call < 3; ++call) {
      switch (Below(15)) {
        case 13: {
          std::vector<IndirectArgumentDesc> arguments(Below(4));
          for (auto& a : arguments) {
            a.Type = Enum<IndirectArgumentType>(11);
            a.Constant = {static_cast<uint32_t>(Below(5)), static_cast<uint32_t>(Below(4)),
                          static_cast<uint32_t>(Below(4))};
          }
          arguments.push_back({.Type = IndirectArgumentType::kDispatchRays});
          auto made = device_.CreateCommandSignature({Coin() ? 256 : Number32(), arguments},
                                                     Pick(signatures));
          list.SetComputeRootSignature(signatures[2]);
          list.SetPipelineState1(pipeline);
          list.ExecuteIndirect(made.ok() ? *made : CommandSignature(),
                               static_cast<uint32_t>(Coin() ? Below(9) : Number()), Pick(buffers_),
                               Coin() ? 0 : Number(), Pick(buffers_), Coin() ? 8 : Number());
          break;
        }
        case 0:
          list.SetComputeRootSignature(Pick(signatures));
          list.SetComputeRootShaderResourceView(static_cast<uint32_t>(Below(5)), Address());
          break;
        case 1: {
          list.SetComputeRootSignature(signatures[2]);
          const uint32_t values[3] = {1, 2, 3};
          list.SetComputeRoot32BitConstants(static_cast<uint32_t>(Below(5)),
                                            static_cast<uint32_t>(Below(4)), values, Number32());
          break;
        }
        case 2:
          list.SetDescriptorHeaps({Pick(heaps)});
          list.SetComputeRootSignature(signatures[2]);
          list.SetComputeRootDescriptorTable(static_cast<uint32_t>(Below(5)), gpu());
          break;
        case 3: {
          list.SetPipelineState1(Below(9) ? pipeline : StateObject());
          DispatchRaysDesc d;
          d.RayGenerationShaderRecord = {Address(), Number()};
          d.HitGroupTable = {Address(), Number(), Number()};
          d.Width = Number32();
          d.Height = Number32();
          list.DispatchRays(d);
          break;
        }
        case 4:
          list.Dispatch(Number32(), Number32(), Number32());
          break;
        case 5: {
          RaytracingGeometryDesc g;
          g.Type = Enum<RaytracingGeometryType>(3);
          g.Triangles = {Coin() ? 0 : Address(),
                         Enum<Format>(60),
                         Format::kR32G32B32Float,
                         Number32(),
                         Number32(),
                         Coin() ? 0 : Address(),
                         {Address(), Number()}};
          const RaytracingGeometryTrianglesDesc triangles = g.Triangles;
          const RaytracingGeometryOmmLinkageDesc linkage = {
              {Address(), Number()}, Enum<Format>(100), Number32(), Address()};
          if (g.Type == RaytracingGeometryType::kOmmTriangles) {
            g.OmmTriangles = {Below(8) ? &triangles : nullptr, Below(8) ? &linkage : nullptr};
          }
          const RaytracingOpacityMicromapHistogramEntry entry = {
              Number32(), static_cast<uint32_t>(Below(14)),
              Enum<RaytracingOpacityMicromapFormat>(3)};
          const RaytracingOpacityMicromapArrayDesc array = {
              static_cast<uint32_t>(Below(2)), &entry, Address(), {Address(), Number()}};
          BuildRaytracingAccelerationStructureDesc d;
          d.Inputs.Type = Enum<RaytracingAccelerationStructureType>(3);
          d.Inputs.Flags = Enum<RaytracingAccelerationStructureBuildFlags>(256);
          d.Inputs.NumDescs = static_cast<uint32_t>(Below(2));
          if (d.Inputs.Type == RaytracingAccelerationStructureType::kOpacityMicromapArray) {
            d.Inputs.pOpacityMicromapArrayDesc = &array;
          } else {
            d.Inputs.pGeometryDescs = &g;
          }
          d.DestAccelerationStructureData = Address();
          d.SourceAccelerationStructureData = Coin() ? 0 : Address();
          d.ScratchAccelerationStructureData = Address();
          list.BuildRaytracingAccelerationStructure(d);
          break;
        }
        case 6:
          list.CopyRaytracingAccelerationStructure(
              Address(), Address(), Enum<RaytracingAccelerationStructureCopyMode>(5));
          break;
        case 7:
          list.CopyBufferRegion(Pick(buffers_), Number(), Pick(buffers_), Number(), Number());
          break;
        case 8: {
          const Box box = {Number32(), 0, 0, Number32(), Number32(), 1};
          list.CopyTextureRegion(side(), Number32(), static_cast<uint32_t>(Below(3)), 0, side(),
                                 Coin() ? nullptr : &box);
          break;
        }
        case 9:
          list.CopyResource(resource(), resource());
          break;
        case 10: {
          const float values[4] = {};
          list.ClearUnorderedAccessViewFloat(gpu(), cpu(), resource(), Coin() ? values : nullptr);
          break;
        }
        case 11:
          list.ResourceBarrier({Enum<ResourceBarrierType>(3), resource(), Number32(),
                                Enum<ResourceStates>(16), Enum<ResourceStates>(16)});
          break;
        case 12: {
          ShaderResourceViewDesc d;
          d.ViewDimension = Enum<SrvDimension>(12);
          d.Format = Enum<Format>(92);
          d.Buffer = {Number(), Number32(), Coin() ? 0 : Number32(), Enum<BufferSrvFlags>(2)};
          d.Texture2DArray = {Number32(), Number32(), Number32(), Number32(), 0, 0};
          d.TextureCubeArray = {Number32(), Number32(), Number32(), Number32(), 0};
          d.RaytracingAccelerationStructure.Location = Address();
          (void)device_.CreateShaderResourceView(resource(), d, cpu());
          break;
        }
        default: {
          UnorderedAccessViewDesc d;
          d.ViewDimension = Enum<UavDimension>(9);
          d.Format = Enum<Format>(92);
          d.Buffer = {Number(), Number32(), Coin() ? 0 : Number32(), 0, Enum<BufferUavFlags>(2)};
          d.Texture3D = {static_cast<uint32_t>(Below(4)), Number32(), Number32()};
          (void)device_.CreateUnorderedAccessView(resource(), d, cpu());
        }
      }
    }
    const bool sound = list.Close().ok();
    sound ? ++closed : ++failed;
    // The recording backend really copies buffers, so a range that slipped through would show.
    EXPECT_EQ(queue_.ExecuteCommandLists({list}).ok(), sound);
  }
  EXPECT_GT(closed, 50);
  EXPECT_GT(failed, 50);
}

}  // namespace
}  // namespace rtapi::testing
