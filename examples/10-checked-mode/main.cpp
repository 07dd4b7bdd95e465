// SPDX-License-Identifier: MIT
// Five classic mistakes. Each is made once, and checked mode's message is printed; then it is
// fixed, and checked mode is silent.
#include <shaders/mistakes.h>

#include <cstdio>
#include <cstring>

#include "../common/example.h"

using namespace rtapi;

namespace {

struct World {
  example::Setup setup;
  RootSignature root_signature;
  StateObject pipeline;
  StateObject other_pipeline;  // made from the same shaders a second time
  example::Mesh mesh, front;
  Buffer bottom_level;
  Buffer top_level;
  Buffer results;
};

StateObject CreatePipeline(const Device& device, const RootSignature& root_signature) {
  const RootSignature local =
      device
          .CreateRootSignature(
              "RootFlags(LOCAL_ROOT_SIGNATURE), RootConstants(num32BitConstants = 1, b0, space = "
              "1)")
          .value();
  StateObjectDesc desc;
  desc.Add(DxilLibraryDesc{LoadShaderLibrary(kaamos_shaders_mistakes()).value(), {}});
  desc.Add(HitGroupDesc{.HitGroupExport = "Group", .ClosestHitShaderImport = "ClosestHit"});
  desc.Add(RaytracingShaderConfig{.MaxPayloadSizeInBytes = 4});
  desc.Add(RaytracingPipelineConfig{.MaxTraceRecursionDepth = 1});
  desc.Add(GlobalRootSignature{root_signature});
  desc.Associate(desc.Add(LocalRootSignature{local}), {"Group"});
  return device.CreateStateObject(desc).value();
}

World CreateWorld(const example::Setup& setup) {
  World w;
  w.setup = setup;
  w.root_signature = setup.device.CreateRootSignature("SRV(t0), UAV(u0)").value();
  w.pipeline = CreatePipeline(setup.device, w.root_signature);
  w.other_pipeline = CreatePipeline(setup.device, w.root_signature);
  w.mesh = example::CreateMesh(setup, {-1, -1, 0, 1, -1, 0, 0, 1, 0}, {});
  w.front = example::CreateMesh(setup, {-1, -1, -0.5f, 1, -1, -0.5f, 0, 1, -0.5f}, {});
  // Two geometries: with a multiplier of 1 they use records 0 and 1. The ray hits the second.
  w.bottom_level = BuildBottomLevel(setup.device, setup.queue, {w.mesh.geometry, w.front.geometry},
                                    "bottom level")
                       .value();
  w.top_level = BuildTopLevel(setup.device, setup.queue,
                              {example::Instance(w.bottom_level, 0, 0, 0)}, "top level")
                    .value();
  w.results =
      setup.device
          .CreateBuffer(
              {.SizeInBytes = 4, .Flags = ResourceFlags::kAllowUnorderedAccess, .Name = "results"})
          .value();
  return w;
}

void Bind(const World& w, CommandList& list) {
  list.SetComputeRootSignature(w.root_signature);
  list.SetComputeRootShaderResourceView(0, w.top_level.GetGPUVirtualAddress());
  list.SetComputeRootUnorderedAccessView(1, w.results.GetGPUVirtualAddress());
  list.SetPipelineState1(w.pipeline);
}

struct Tables {
  ShaderTable raygen, miss, hit;
  DispatchRaysDesc desc;
};

Tables CreateTables(const World& w, uint32_t hit_records) {
  Tables t{ShaderTable(w.pipeline, "ray generation"),
           ShaderTable(w.pipeline, "miss table"),
           ShaderTable(w.pipeline, "hit group table"),
           {}};
  t.raygen.AddRecord("RayGen").value();
  t.miss.AddRecord("Miss").value();
  for (uint32_t i = 0; i < hit_records; ++i) {
    t.hit.AddRecord("Group", {LocalArgument::Constants(i + 1)}).value();
  }
  for (ShaderTable* table : {&t.raygen, &t.miss, &t.hit}) table->Build(w.setup.device).value();
  t.desc.RayGenerationShaderRecord = t.raygen.GetRecord(0);
  t.desc.MissShaderTable = t.miss.GetTable();
  t.desc.HitGroupTable = t.hit.GetTable();
  return t;
}

void Dispatch(const World& w, const DispatchRaysDesc& desc) {
  CommandList list = w.setup.device.CreateCommandList().value();
  Bind(w, list);
  list.DispatchRays(desc);
  CommandQueue queue = w.setup.queue;
  queue.ExecuteAndWait(list).value();
}

// The hit group table has the stride of records without arguments.
void Stride(World& w, bool mended) {
  Tables tables = CreateTables(w, 2);
  if (!mended) tables.desc.HitGroupTable.StrideInBytes = 32;
  Dispatch(w, tables.desc);
}

// There is one record for each instance, but the instance has two geometries.
void MissingRecord(World& w, bool mended) {
  const Tables tables = CreateTables(w, mended ? 2 : 1);
  Dispatch(w, tables.desc);
}

// The pipeline was created again, but the table still holds the old one's identifiers.
void OldIdentifier(World& w, bool mended) {
  World now = w;
  if (!mended) now.pipeline = w.other_pipeline;
  const Tables tables = CreateTables(w, 2);
  Dispatch(now, tables.desc);
}

// Records everything for a build, in the same list as whatever reads the result.
void RecordTopLevel(World& w, CommandList& list, const Buffer& instances, const Buffer& scratch) {
  BuildRaytracingAccelerationStructureInputs inputs;
  inputs.NumDescs = 1;
  inputs.InstanceDescs = instances.GetGPUVirtualAddress();
  list.BuildRaytracingAccelerationStructure(
      {.DestAccelerationStructureData = w.top_level.GetGPUVirtualAddress(),
       .Inputs = inputs,
       .ScratchAccelerationStructureData = scratch.GetGPUVirtualAddress()});
}

Buffer CreateScratch(const World& w) {
  return w.setup.device
      .CreateBuffer(
          {.SizeInBytes = 65536, .Flags = ResourceFlags::kAllowUnorderedAccess, .Name = "scratch"})
      .value();
}

// A dispatch directly after its top level's build.
void Barrier(World& w, bool mended) {
  const Tables tables = CreateTables(w, 2);
  const Buffer instances =
      CreateUploadBuffer(
          w.setup.device,
          std::vector<RaytracingInstanceDesc>{example::Instance(w.bottom_level, 0, 0, 0)},
          "instances")
          .value();
  const Buffer scratch = CreateScratch(w);
  CommandList list = w.setup.device.CreateCommandList().value();
  RecordTopLevel(w, list, instances, scratch);
  if (mended) list.ResourceBarrier(ResourceBarrier::Uav(w.top_level));
  Bind(w, list);
  list.DispatchRays(tables.desc);
  CommandQueue queue = w.setup.queue;
  queue.ExecuteAndWait(list).value();
}

// The bottom level is rebuilt, but its top level is not.
void StaleTopLevel(World& w, bool mended) {
  const Tables tables = CreateTables(w, 2);
  const RaytracingGeometryDesc geometries[] = {w.mesh.geometry, w.front.geometry};
  BuildRaytracingAccelerationStructureInputs inputs;
  inputs.Type = RaytracingAccelerationStructureType::kBottomLevel;
  inputs.Flags = RaytracingAccelerationStructureBuildFlags::kPreferFastTrace;
  inputs.NumDescs = 2;
  inputs.pGeometryDescs = geometries;
  const Buffer scratch = CreateScratch(w);
  const Buffer instances =
      CreateUploadBuffer(
          w.setup.device,
          std::vector<RaytracingInstanceDesc>{example::Instance(w.bottom_level, 0, 0, 0)},
          "instances")
          .value();
  CommandList list = w.setup.device.CreateCommandList().value();
  list.BuildRaytracingAccelerationStructure(
      {.DestAccelerationStructureData = w.bottom_level.GetGPUVirtualAddress(),
       .Inputs = inputs,
       .ScratchAccelerationStructureData = scratch.GetGPUVirtualAddress()});
  list.ResourceBarrier(ResourceBarrier::Uav());
  if (mended) {
    RecordTopLevel(w, list, instances, scratch);
    list.ResourceBarrier(ResourceBarrier::Uav());
  }
  Bind(w, list);
  list.DispatchRays(tables.desc);
  CommandQueue queue = w.setup.queue;
  queue.ExecuteAndWait(list).value();
}

struct Mistake {
  const char* title;
  void (*run)(World&, bool mended);
  const char* cure;
};

constexpr Mistake kMistakes[] = {
    {"the stride leaves no room for the local root arguments", Stride,
     "StrideInBytes is the size of a record: a 32-byte identifier and the arguments, rounded up to "
     "a multiple of 32. ShaderTable::GetTable() knows it."},
    {"a geometry has no record", MissingRecord,
     "one record for each geometry of an instance, times the ray types."},
    {"the table holds identifiers of another pipeline", OldIdentifier,
     "after CreateStateObject, write the tables again with the new object's GetShaderIdentifier."},
    {"no UAV barrier between a build and the dispatch", Barrier,
     "ResourceBarrier::Uav(top level) after the build."},
    {"a bottom level was rebuilt, but its top level was not", StaleTopLevel,
     "afterwards, build or update every top level that refers to it."},
};

}  // namespace

int main(int argc, char** argv) {
  const std::string backend =
      argc == 3 && std::strcmp(argv[1], "--backend") == 0 ? argv[2] : "embree";
  if (argc != 1 && argc != 3) {
    std::fprintf(stderr, "usage: %s [--backend embree|vulkan]\n", argv[0]);
    return 2;
  }
  try {
    // A list's messages arrive before ExecuteAndWait returns.
    std::vector<std::string> said;
    DeviceDesc desc;
    desc.Backend = backend;
    desc.Checked = true;
    desc.OnMessage = [&said](const Message& message) {
      if (message.Severity == MessageSeverity::kError) said.push_back(message.Text);
    };
    example::Setup setup;
    setup.device = CreateDevice(desc).value();
    setup.queue = setup.device.CreateCommandQueue().value();
    bool as_expected = true;
    int number = 0;
    for (const Mistake& mistake : kMistakes) {
      World world = CreateWorld(setup);
      said.clear();
      mistake.run(world, false);
      std::printf("%d. %s\n", ++number, mistake.title);
      for (const std::string& text : said) std::printf("   %s\n", text.c_str());
      as_expected = as_expected && !said.empty();
      world = CreateWorld(setup);
      said.clear();
      mistake.run(world, true);
      std::printf("   Cure: %s\n   Once fixed, checked mode says %s.\n\n", mistake.cure,
                  said.empty() ? "nothing" : said.front().c_str());
      as_expected = as_expected && said.empty();
    }
    return as_expected ? 0 : 1;
  } catch (const ResultError& error) {
    std::fprintf(stderr, "10-checked-mode: %s\n", error.what());
    return 1;
  }
}
