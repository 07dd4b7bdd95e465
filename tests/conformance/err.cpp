// SPDX-License-Identifier: MIT
//
// What the runtime must say, and when: errors of calls, and the messages of checked mode. Each test
// spoils one thing of a small scene on a device in checked mode.
#include <shaders/errors.h>

#include <limits>
#include <memory>
#include <utility>

#include "tests/conformance/program.h"

namespace kaamos::conformance {

using namespace rtapi;

namespace {

using BuildFlags = RaytracingAccelerationStructureBuildFlags;

constexpr char kOneConstant[] =
    "RootFlags(LOCAL_ROOT_SIGNATURE), RootConstants(b0, space = 1, num32BitConstants = 4)";

using Messages = std::shared_ptr<std::vector<Message>>;

DeviceDesc in_checked_mode(const Context& t, const Messages& messages) {
  DeviceDesc desc = t.target().device_desc();
  desc.Checked = true;
  // Messages of a list come before ExecuteAndWait returns, one at a time.
  desc.OnMessage = [messages](const Message& message) { messages->push_back(message); };
  return desc;
}

// A context of its own whose failures go to the rule's.
struct Checked : Context {
  explicit Checked(Context& t) : Checked(t, std::make_shared<std::vector<Message>>()) {}
  ~Checked() {
    for (const std::string& failure : failures()) outer.fail(failure);
  }
  // The message must have been told since the last call.
  void told(const std::string& what, const char* id) {
    for (const Message& message : take_messages()) {
      if (message.Id == id) return;
    }
    fail(what + ": no message " + id);
  }
  void silent(const std::string& what) {
    for (const Message& message : take_messages()) {
      if (message.Id >= "KA0400" && message.Id < "KA0500") fail(what + ": " + message.Text);
    }
  }
  Status execute(CommandList& list) { return queue().ExecuteAndWait(list); }
  CommandList list() { return device().CreateCommandList().value(); }

  Context& outer;

 private:
  Checked(Context& t, Messages told)
      : Context(in_checked_mode(t, told), t.target()), outer(t), messages(std::move(told)) {}
  std::vector<Message> take_messages() { return std::exchange(*messages, {}); }

  Messages messages;
};

// One ray that hits a triangle.
struct Scene : Program {
  explicit Scene(Checked& t) : Program(t, kaamos_shaders_errors()), checked(t) {
    group("Plain", "Floor");
    group("Nested", "Deeper");
    group("Boxes", "", "", "Front");
    group("Odd", "", "", "Reports");
    local(kOneConstant, {"Plain", "Odd"});
    scene = t.scene({triangle(5)});
    rays = t.upload(std::vector<Ray>{Ray()});
  }
  void add(const std::string& hit_group, const Constants& constants = {}) {
    raygen("One");
    miss("Sky");
    if (hit_group == "Plain" || hit_group == "Odd") {
      hit(hit_group, {LocalArgument::Constants(constants)});
    } else {
      hit(hit_group);
    }
  }
  Checked& checked;
};

void recursion_and_stack(Context& t) {
  Checked c(t);
  Scene s(c);
  s.add("Nested");
  bool removed = false;
  try {
    s.run();
  } catch (const ResultError&) {
    removed = true;
  }
  c.holds("recursion past the declared depth removes the device", removed);
}

void structure_buffers(Context& t) {
  Checked c(t);
  const auto state = ResourceStates::kRaytracingAccelerationStructure;
  BufferDesc desc{.SizeInBytes = 1024, .InitialState = state};
  c.refused("no unordered access flag", c.device().CreateBuffer(desc), "KA0907");
  desc.Flags = ResourceFlags::kAllowUnorderedAccess;
  desc.Heap = HeapType::kUpload;
  c.refused("upload heap", c.device().CreateBuffer(desc));
  const Buffer level = c.bottom_level({triangle(5)});
  CommandList list = c.list();
  list.ResourceBarrier(ResourceBarrier::Transition(level, state, ResourceStates::kUnorderedAccess));
  c.refused("transition out of the state", list.Close());
}

BuildRaytracingAccelerationStructureInputs inputs_of(const RaytracingGeometryDesc& geometry,
                                                     BuildFlags flags = BuildFlags::kNone) {
  BuildRaytracingAccelerationStructureInputs inputs;
  inputs.Type = RaytracingAccelerationStructureType::kBottomLevel;
  inputs.Flags = flags;
  inputs.NumDescs = 1;
  inputs.pGeometryDescs = &geometry;
  return inputs;
}

RaytracingGeometryDesc geometry_of(Context& c, const std::vector<float>& vertices) {
  RaytracingGeometryDesc geometry;
  geometry.Triangles.VertexFormat = Format::kR32G32B32Float;
  geometry.Triangles.VertexCount = static_cast<uint32_t>(vertices.size() / 3);
  geometry.Triangles.VertexBuffer = {c.upload(vertices).GetGPUVirtualAddress(), 12};
  return geometry;
}

const std::vector<float> kTriangle = {0, 3, 5, 3, -3, 5, -3, -3, 5};

Status record_and_close(Checked& c, const BuildRaytracingAccelerationStructureDesc& desc) {
  CommandList list = c.list();
  list.BuildRaytracingAccelerationStructure(desc);
  return list.Close();
}

void misaligned_addresses(Context& t) {
  Checked c(t);
  RaytracingGeometryDesc geometry = geometry_of(c, kTriangle);
  const Buffer level = c.bottom_level({triangle(5)});
  BuildRaytracingAccelerationStructureDesc desc;
  desc.Inputs = inputs_of(geometry);
  desc.DestAccelerationStructureData = level.GetGPUVirtualAddress() + 64;
  desc.ScratchAccelerationStructureData = c.zeros(65536).GetGPUVirtualAddress();
  c.refused("destination at 64", record_and_close(c, desc));
  desc.DestAccelerationStructureData = level.GetGPUVirtualAddress();
  geometry.Triangles.VertexBuffer.StartAddress += 2;
  c.refused("vertices at 2", record_and_close(c, desc));
  Scene s(c);
  s.add("Plain");
  for (const uint64_t stride : {16u, 4128u}) {
    DispatchRaysDesc tables = s.tables();
    tables.HitGroupTable.StrideInBytes = stride;
    CommandList list = c.list();
    list.SetComputeRootSignature(s.global);
    list.SetPipelineState1(s.pipeline);
    list.DispatchRays(tables);
    c.refused("stride " + std::to_string(stride), list.Close());
  }
  DispatchRaysDesc tables = s.tables();
  tables.MissShaderTable.StartAddress += 32;
  CommandList list = c.list();
  list.SetComputeRootSignature(s.global);
  list.SetPipelineState1(s.pipeline);
  list.DispatchRays(tables);
  c.refused("a table at +32", list.Close());
}

void states_and_barriers(Context& t) {
  Checked c(t);
  const RaytracingGeometryDesc geometry = geometry_of(c, kTriangle);
  const Buffer level = c.bottom_level({triangle(5)});
  const Buffer top = c.top_level({instance(level)});
  c.silent("builds with barriers between them");
  BuildRaytracingAccelerationStructureDesc bottom;
  bottom.Inputs = inputs_of(geometry);
  bottom.DestAccelerationStructureData = level.GetGPUVirtualAddress();
  bottom.ScratchAccelerationStructureData = c.zeros(65536).GetGPUVirtualAddress();
  BuildRaytracingAccelerationStructureDesc upper;
  upper.Inputs.NumDescs = 1;
  upper.Inputs.InstanceDescs = c.upload(std::vector{instance(level)}).GetGPUVirtualAddress();
  upper.DestAccelerationStructureData = top.GetGPUVirtualAddress();
  upper.ScratchAccelerationStructureData = c.zeros(65536).GetGPUVirtualAddress();
  CommandList list = c.list();
  list.BuildRaytracingAccelerationStructure(bottom);
  list.BuildRaytracingAccelerationStructure(upper);
  c.accepted("builds", c.execute(list));
  c.told("bottom and top level without a barrier", "KA0450");
  const Buffer moved = c.zeros(36);
  RaytracingGeometryDesc other = geometry;
  other.Triangles.VertexBuffer.StartAddress = moved.GetGPUVirtualAddress();
  bottom.Inputs = inputs_of(other);
  CommandList copy = c.list();
  copy.CopyBufferRegion(moved, 0, c.upload(kTriangle), 0, 36);
  copy.BuildRaytracingAccelerationStructure(bottom);
  c.accepted("copy and build", c.execute(copy));
  c.told("vertices that are a copy destination", "KA0451");
}

void build_flags(Context& t) {
  Checked c(t);
  const RaytracingGeometryDesc geometry = geometry_of(c, kTriangle);
  const Buffer level = c.bottom_level({triangle(5)});
  BuildRaytracingAccelerationStructureDesc desc;
  desc.Inputs = inputs_of(geometry, BuildFlags::kPreferFastTrace | BuildFlags::kPreferFastBuild);
  desc.DestAccelerationStructureData = level.GetGPUVirtualAddress();
  desc.ScratchAccelerationStructureData = c.zeros(65536).GetGPUVirtualAddress();
  c.refused("fast trace and fast build", record_and_close(c, desc));
  desc.Inputs.Flags = BuildFlags::kNone;
  desc.SourceAccelerationStructureData = level.GetGPUVirtualAddress();
  c.refused("a source without an update", record_and_close(c, desc));
}

void updates(Context& t) {
  Checked c(t);
  RaytracingGeometryDesc geometry = geometry_of(c, kTriangle);
  Buffer indices = c.upload(std::vector<uint32_t>{0, 1, 2});
  geometry.Triangles.IndexFormat = Format::kR32Uint;
  geometry.Triangles.IndexCount = 3;
  geometry.Triangles.IndexBuffer = indices.GetGPUVirtualAddress();
  auto inputs = inputs_of(geometry, BuildFlags::kAllowUpdate);
  const Buffer level = c.build(inputs);
  indices.data<uint32_t>()[1] = 0;
  inputs.Flags = BuildFlags::kAllowUpdate | BuildFlags::kPerformUpdate;
  BuildRaytracingAccelerationStructureDesc desc;
  desc.Inputs = inputs;
  desc.DestAccelerationStructureData = level.GetGPUVirtualAddress();
  desc.SourceAccelerationStructureData = level.GetGPUVirtualAddress();
  desc.ScratchAccelerationStructureData = c.zeros(65536).GetGPUVirtualAddress();
  CommandList list = c.list();
  list.BuildRaytracingAccelerationStructure(desc);
  c.accepted("update", c.execute(list));
  c.told("other indices", "KA0470");
}

void sizes_and_overlaps(Context& t) {
  Checked c(t);
  const RaytracingGeometryDesc geometry = geometry_of(c, kTriangle);
  const Buffer level = c.bottom_level({triangle(5)});
  BuildRaytracingAccelerationStructureDesc desc;
  desc.Inputs = inputs_of(geometry);
  desc.DestAccelerationStructureData = level.GetGPUVirtualAddress();
  desc.ScratchAccelerationStructureData = level.GetGPUVirtualAddress();
  CommandList list = c.list();
  list.BuildRaytracingAccelerationStructure(desc);
  (void)c.execute(list);
  c.told("scratch in the destination", "KA0471");
  desc.DestAccelerationStructureData =
      level.GetGPUVirtualAddress() + level.size() / 256 * 256 - 256;
  desc.ScratchAccelerationStructureData = c.zeros(65536).GetGPUVirtualAddress();
  c.refused("destination too small", record_and_close(c, desc));
}

void geometry_descriptions(Context& t) {
  Checked c(t);
  RaytracingGeometryDesc geometry = geometry_of(c, kTriangle);
  const auto try_it = [&] {
    return c.device().GetRaytracingAccelerationStructurePrebuildInfo(inputs_of(geometry));
  };
  c.accepted("triangles", try_it());
  geometry.Triangles.VertexFormat = Format::kR32Uint;
  c.refused("vertex format", try_it());
  geometry.Triangles.VertexFormat = Format::kR32G32B32Float;
  geometry.Triangles.IndexFormat = Format::kR32Uint;
  geometry.Triangles.IndexCount = 3;
  c.refused("indices without a buffer", try_it());
  geometry.Triangles.IndexFormat = Format::kR8G8Unorm;
  c.refused("index format", try_it());
}

void indices_and_nans(Context& t) {
  Checked c(t);
  RaytracingGeometryDesc geometry = geometry_of(c, kTriangle);
  geometry.Triangles.IndexFormat = Format::kR32Uint;
  geometry.Triangles.IndexCount = 3;
  geometry.Triangles.IndexBuffer = c.upload(std::vector<uint32_t>{0, 1, 9}).GetGPUVirtualAddress();
  c.build(inputs_of(geometry));
  c.told("index 9 of 3 vertices", "KA0472");
  std::vector<float> vertices = kTriangle;
  vertices[4] = std::numeric_limits<float>::quiet_NaN();
  c.build(inputs_of(geometry_of(c, vertices)));
  c.told("NaN in Y alone", "KA0473");
  vertices[3] = vertices[4];
  c.build(inputs_of(geometry_of(c, vertices)));
  c.silent("NaN in X");
}

void postbuild_infos(Context& t) {
  Checked c(t);
  const RaytracingGeometryDesc geometry = geometry_of(c, kTriangle);
  const Buffer level = c.bottom_level({triangle(5)});
  const RaytracingAccelerationStructurePostbuildInfoDesc info = {
      c.zeros(64).GetGPUVirtualAddress(),
      RaytracingAccelerationStructurePostbuildInfoType::kCurrentSize};
  BuildRaytracingAccelerationStructureDesc desc;
  desc.Inputs = inputs_of(geometry);
  desc.DestAccelerationStructureData = level.GetGPUVirtualAddress();
  desc.ScratchAccelerationStructureData = c.zeros(65536).GetGPUVirtualAddress();
  CommandList list = c.list();
  list.BuildRaytracingAccelerationStructure(desc, std::vector{info, info});
  c.refused("one info twice", list.Close());
}

void lives_of_structures(Context& t) {
  Checked c(t);
  Scene s(c);
  s.add("Plain");
  const Buffer level = c.bottom_level({triangle(5)});
  const Buffer top = c.top_level({instance(level)});
  s.scene = level;
  s.run();
  c.told("a bottom level passed to TraceRay", "KA0464");
  s.scene = top;
  s.run();
  c.silent("a sound scene");
  CommandList bytes = c.list();
  bytes.CopyBufferRegion(c.top_level({instance(level)}), 0, top, 0, top.size());
  c.refused("a copy of bytes", bytes.Close());
  const RaytracingGeometryDesc geometry = geometry_of(c, kTriangle);
  BuildRaytracingAccelerationStructureDesc again;
  again.Inputs = inputs_of(geometry);
  again.DestAccelerationStructureData = level.GetGPUVirtualAddress();
  again.ScratchAccelerationStructureData = c.zeros(65536).GetGPUVirtualAddress();
  CommandList list = c.list();
  list.BuildRaytracingAccelerationStructure(again);
  c.accepted("build", c.execute(list));
  s.scene = top;
  s.run();
  c.told("a stale top level", "KA0463");
}

void count_limits(Context& t) {
  Checked c(t);
  BuildRaytracingAccelerationStructureInputs inputs;
  inputs.NumDescs = (1u << 24) + 1;
  c.refused("instances", c.device().GetRaytracingAccelerationStructurePrebuildInfo(inputs));
  RaytracingGeometryDesc geometry;
  geometry.Type = RaytracingGeometryType::kProceduralPrimitiveAabbs;
  geometry.AABBs = {(uint64_t{1} << 29) + 1, {0, 24}};
  c.refused("primitives",
            c.device().GetRaytracingAccelerationStructurePrebuildInfo(inputs_of(geometry)));
}

void instance_flags(Context& t) {
  Checked c(t);
  c.top_level({instance(c.bottom_level({triangle(5)}), 0, 0, 12)});
  c.told("force opaque and force non-opaque", "KA0474");
}

void illegal_rays(Context& t) {
  Checked c(t);
  Scene s(c);
  s.add("Plain");
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const auto run = [&](const std::string& what, void (*spoil)(Ray&, float), const char* id) {
    Ray ray;
    spoil(ray, nan);
    s.rays = c.upload(std::vector<Ray>{ray});
    s.run();
    if (id != nullptr) {
      c.told(what, id);
    } else {
      c.silent(what);
    }
  };
  run(
      "a sound ray", [](Ray&, float) {}, nullptr);
  run(
      "a ray of no length", [](Ray& ray, float) { ray.t_max = ray.t_min; }, nullptr);
  run(
      "NaN origin", [](Ray& ray, float n) { ray.origin[1] = n; }, "KA0401");
  run(
      "NaN direction", [](Ray& ray, float n) { ray.direction[2] = n; }, "KA0401");
  run(
      "NaN TMax", [](Ray& ray, float n) { ray.t_max = n; }, "KA0401");
  run(
      "negative TMin", [](Ray& ray, float) { ray.t_min = -1; }, "KA0402");
  run(
      "TMin above TMax", [](Ray& ray, float) { ray.t_min = 2000; }, "KA0402");
}

void parameters_of_other_types(Context& t) {
  Checked c(t);
  for (const bool right : {true, false}) {
    Scene s(c);
    s.raygen("One");
    s.miss(right ? "Sky" : "OtherSky");
    s.scene = c.scene({});
    s.run();
    if (right) {
      c.silent("payloads of one type");
    } else {
      c.told("a miss shader with another payload", "KA0407");
    }
  }
  for (const bool right : {true, false}) {
    Scene calls(c);
    calls.raygen("Calls");
    calls.callable(right ? "Takes" : "TakesOne");
    calls.run();
    if (right) {
      c.silent("callable data of one type");
    } else {
      c.told("callable data of another type", "KA0408");
    }
  }
  Scene large(c);
  for (StateSubobject& each : large.desc.Subobjects) {
    if (auto* config = std::get_if<RaytracingShaderConfig>(&each)) {
      config->MaxPayloadSizeInBytes = 12;
    }
  }
  c.refused("a payload of 16 bytes where 12 are declared", large.try_create(), "KA0522");
}

void reported_hits(Context& t) {
  Checked c(t);
  for (const uint32_t kind : {0u, 127u, 128u, 255u}) {
    Scene s(c);
    s.scene = c.scene({box(5)});
    Constants constants;
    constants.reported_kind = kind;
    s.add("Odd", constants);
    s.run();
    if (kind <= 127) {
      c.silent("hit kind " + std::to_string(kind));
    } else {
      c.told("hit kind " + std::to_string(kind), "KA0406");
    }
  }
  Scene s(c);
  s.raygen("Commits");
  s.scene = c.scene({box(5)});
  for (const float at : {5.0f, -1.0f, 2000.0f}) {
    Ray ray;
    std::memcpy(&ray.extra[0], &at, sizeof at);
    s.rays = c.upload(std::vector<Ray>{ray});
    s.run();
    if (at == 5) {
      c.silent("a hit inside of the ray");
    } else {
      c.told("a hit at " + std::to_string(at), "KA0411");
    }
  }
}

// An index times a stride needs 64 bits: in 32 record 2^20 + 1 of stride 4096 is record 1, which
// stands there.
void far_records(Context& t) {
  Checked c(t);
  Scene s(c);
  s.raygen("One");
  s.miss("Sky");
  for (uint32_t i = 0; i < 2; ++i) {
    s.hit("Plain", {LocalArgument::Constants(Constants{.ordinal = 70 + i})});
  }
  s.scene = c.scene({triangle(5)}, (1u << 20) + 1);
  DispatchRaysDesc desc = s.tables();
  std::vector<uint8_t> wide(2 * 4096);
  const auto narrow = s.shader_tables[2].buffer().data<const uint8_t>();
  for (size_t i = 0; i < 2; ++i) {
    std::memcpy(&wide[i * 4096], &narrow[i * desc.HitGroupTable.StrideInBytes], 48);
  }
  desc.HitGroupTable = {c.upload(wide).GetGPUVirtualAddress(), wide.size(), 4096};
  const Seen seen = seen_of(s.run(desc), 1)[0];
  c.equal("what ran of a record 4 GiB away", seen.end, uint32_t{kNothingRan});
  c.told("record 1048577 of 2, 4294971392 bytes into the table", "KA0430");
}

void tables_of_records(Context& t) {
  Checked c(t);
  {
    Scene s(c);
    s.add("Plain");
    s.run();
    c.silent("sound tables");
    s.scene = c.scene({triangle(5), triangle(6)});
    s.run();
    c.told("record 1 of 1", "KA0430");
    s.scene = c.scene({triangle(5)});
    const Buffer table = c.upload(std::vector<uint32_t>(64, 0xABABABABu));
    DispatchRaysDesc desc = s.tables();
    desc.HitGroupTable = {table.GetGPUVirtualAddress(), 256, 64};
    s.run(desc);
    c.told("no identifier", "KA0431");
    Scene other(c);
    other.add("Plain");
    desc.HitGroupTable = other.tables().HitGroupTable;
    s.run(desc);
    c.told("another pipeline's identifier", "KA0432");
    desc.HitGroupTable = desc.MissShaderTable;
    s.run(desc);
    c.told("a miss shader in the hit group table", "KA0433");
  }
  Scene s(c);
  s.add("Boxes");
  s.run();
  c.told("boxes' group for triangles", "KA0434");
}

void strides_of_records(Context& t) {
  Checked c(t);
  Scene s(c);
  s.add("Plain");
  DispatchRaysDesc desc = s.tables();
  desc.HitGroupTable.StrideInBytes = 32;
  s.run(desc);
  c.told("32 bytes for 48", "KA0435");
  desc.HitGroupTable.StrideInBytes = 0;
  desc.HitGroupTable.SizeInBytes = 40;
  s.run(desc);
  c.told("a table of 40 bytes", "KA0440");
}

void other_root_signature(Context& t) {
  Checked c(t);
  Scene s(c);
  const RootSignature other =
      c.device().CreateRootSignature("SRV(t0), SRV(t1), UAV(u0), SRV(t7)").value();
  s.desc.Associate(s.desc.Add(GlobalRootSignature{other}), {"Sky"});
  s.add("Plain");
  s.run();
  c.told("a miss shader with another global root signature", "KA0439");
}

void stack_size(Context& t) {
  Checked c(t);
  Scene s(c);
  s.create();
  const uint64_t before = s.pipeline.GetPipelineStackSize();
  c.refused("a stack of 2^32 - 1 bytes", s.pipeline.SetPipelineStackSize(0xFFFFFFFFu));
  c.equal("the stack size", s.pipeline.GetPipelineStackSize(), before);
}

void dispatch_calls(Context& t) {
  Checked c(t);
  Scene s(c);
  s.add("Plain");
  CommandList list = c.list();
  list.SetComputeRootSignature(s.global);
  list.DispatchRays(s.tables());
  c.refused("no pipeline", list.Close());
  CommandList large = c.list();
  large.SetComputeRootSignature(s.global);
  large.SetPipelineState1(s.pipeline);
  DispatchRaysDesc desc = s.tables();
  desc.Width = 1u << 16;
  desc.Height = (1u << 14) + 1;
  large.DispatchRays(desc);
  c.refused("2^30 + 2^16 threads", large.Close());
}

void local_root_signatures(Context& t) {
  Checked c(t);
  c.refused("local with another flag",
            c.device().CreateRootSignature(
                "RootFlags(LOCAL_ROOT_SIGNATURE | ALLOW_STREAM_OUTPUT), SRV(t0)"));
  c.refused("more than 4064 bytes",
            c.device().CreateRootSignature(
                "RootFlags(LOCAL_ROOT_SIGNATURE), RootConstants(b0, num32BitConstants = 1017)"));
}

void structure_views(Context& t) {
  Checked c(t);
  const Buffer top = c.top_level({});
  DescriptorHeapDesc heap;
  heap.NumDescriptors = 1;
  const DescriptorHeap views = c.device().CreateDescriptorHeap(heap).value();
  ShaderResourceViewDesc view;
  view.ViewDimension = SrvDimension::kRaytracingAccelerationStructure;
  view.RaytracingAccelerationStructure.Location = top.GetGPUVirtualAddress();
  c.accepted("without a resource",
             c.device().CreateShaderResourceView(Resource(), view,
                                                 views.GetCPUDescriptorHandleForHeapStart()));
  c.refused("with a resource", c.device().CreateShaderResourceView(
                                   top, view, views.GetCPUDescriptorHandleForHeapStart()));
}

}  // namespace

std::vector<RuleTest> err_tests() {
  return {
      {"ERR-01", recursion_and_stack},
      {"ERR-03, ERR-04", structure_buffers},
      {"ERR-07", misaligned_addresses},
      {"ERR-08", states_and_barriers},
      {"ERR-09", build_flags},
      {"ERR-10", updates},
      {"ERR-11", sizes_and_overlaps},
      {"ERR-12", geometry_descriptions},
      {"ERR-13", indices_and_nans},
      {"ERR-15", postbuild_infos},
      {"ERR-16", lives_of_structures},
      {"ERR-17", count_limits},
      {"ERR-18", instance_flags},
      {"ERR-19", illegal_rays},
      {"ERR-20, SBT-28", tables_of_records},
      {"ERR-20, SBT-07", far_records},
      {"ERR-21, SBT-16", strides_of_records},
      {"ERR-22", other_root_signature},
      {"ERR-23", parameters_of_other_types},
      {"ERR-24", reported_hits},
      {"ERR-27", stack_size},
      {"ERR-28", dispatch_calls},
      {"ERR-29", local_root_signatures},
      {"ERR-31", structure_views},
  };
}

}  // namespace kaamos::conformance
