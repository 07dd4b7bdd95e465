// SPDX-License-Identifier: MIT
//
// Local and global root arguments.
#include <shaders/calls.h>
#include <shaders/root.h>

#include <array>

#include "tests/conformance/program.h"

namespace kaamos::conformance {

using namespace rtapi;

namespace {

constexpr char kExampleSignature[] =
    "RootFlags(LOCAL_ROOT_SIGNATURE), RootConstants(b1, space = 1, num32BitConstants = 1),"
    "SRV(t2, space = 1), RootConstants(b2, space = 1, num32BitConstants = 3),"
    "DescriptorTable(SRV(t3, space = 1))";

// A record's bytes, written at offsets from its start.
struct RawRecord {
  explicit RawRecord(size_t size) : bytes(size) {}
  RawRecord& identifier(const StateObject& pipeline, const char* name, size_t offset = 0) {
    std::memcpy(&bytes[offset], pipeline.GetShaderIdentifier(name)->data(), 32);
    return *this;
  }
  template <class T>
  RawRecord& put(size_t offset, T value) {
    std::memcpy(&bytes[offset], &value, sizeof value);
    return *this;
  }
  std::vector<uint8_t> bytes;
};

DescriptorHeap make_heap(Context& t, uint32_t slots,
                         DescriptorHeapType type = DescriptorHeapType::kCbvSrvUav) {
  DescriptorHeapDesc desc;
  desc.Type = type;
  desc.NumDescriptors = slots;
  desc.Flags = DescriptorHeapFlags::kShaderVisible;
  return t.device().CreateDescriptorHeap(desc).value();
}

void put_raw_view(Context& t, const Buffer& buffer, const DescriptorHeap& heap, uint32_t slot) {
  ShaderResourceViewDesc view;
  view.ViewDimension = SrvDimension::kBuffer;
  view.Format = Format::kR32Typeless;
  view.Buffer.Flags = BufferSrvFlags::kRaw;
  t.device().CreateShaderResourceView(buffer, view, heap.GetCPUDescriptorHandle(slot)).value();
}

Buffer words_buffer(Context& t, uint32_t value) {
  return t.upload(std::vector<uint32_t>(64, value));
}

void worked_example_of_layout(Context& t) {
  const RootSignature signature = t.device().CreateRootSignature(kExampleSignature).value();
  const uint32_t offsets[] = {32, 40, 48, 64};
  for (uint32_t i = 0; i < 4; ++i) {
    t.equal("offset of argument " + std::to_string(i), 32 + signature.GetArgumentOffset(i),
            offsets[i]);
  }
  t.equal("bytes of a record", 32 + signature.GetArgumentBytes(), 72u);

  Program program(t, kaamos_shaders_root(), {"ReadExample"});
  program.local(kExampleSignature, {"ReadExample"});
  program.create();
  const DescriptorHeap heap = make_heap(t, 8);
  put_raw_view(t, words_buffer(t, 66), heap, 5);
  const RawRecord record = RawRecord(96)
                               .identifier(program.pipeline, "ReadExample")
                               .put(32, 11u)
                               .put(40, words_buffer(t, 22).GetGPUVirtualAddress())
                               .put(48, 33u)
                               .put(52, 44u)
                               .put(56, 55u)
                               .put(64, heap.GetGPUDescriptorHandle(5).ptr);
  program.bind = [&](CommandList& list) { list.SetDescriptorHeaps({heap}); };
  DispatchRaysDesc desc = program.tables();
  desc.RayGenerationShaderRecord = {t.upload(record.bytes).GetGPUVirtualAddress(), 96};
  const auto words = program.run(desc);
  t.equal("constant, SRV, three constants, table",
          std::vector<uint32_t>(words.begin(), words.begin() + 6), {11u, 22u, 33u, 44u, 55u, 66u});
  ShaderTable table(program.pipeline);
  t.accepted(
      "the record by arguments",
      table.AddRecord("ReadExample",
                      {LocalArgument::Constants(11u), LocalArgument::Address(words_buffer(t, 22)),
                       LocalArgument::Constants(std::array{33u, 44u, 55u}),
                       LocalArgument::Table(heap.GetGPUDescriptorHandle(5))}));
  t.equal("stride", table.stride_bytes() >= 96, true);
}

void constants_are_contiguous(Context& t) {
  Program program(t, kaamos_shaders_root(), {"ReadConstants"});
  program.local(
      "RootFlags(LOCAL_ROOT_SIGNATURE), RootConstants(b1, space = 1, num32BitConstants = 1),"
      "RootConstants(b2, space = 1, num32BitConstants = 3)",
      {"ReadConstants"});
  program.create();
  const RawRecord record = RawRecord(64)
                               .identifier(program.pipeline, "ReadConstants")
                               .put(32, 1u)
                               .put(36, 2u)
                               .put(40, 3u)
                               .put(44, 4u);
  DispatchRaysDesc desc = program.tables();
  desc.RayGenerationShaderRecord = {t.upload(record.bytes).GetGPUVirtualAddress(), 64};
  const auto words = program.run(desc);
  t.equal("constants", std::vector<uint32_t>(words.begin(), words.begin() + 4), {1u, 2u, 3u, 4u});
}

constexpr char kTwoArguments[] =
    "RootFlags(LOCAL_ROOT_SIGNATURE), RootConstants(b1, space = 1, num32BitConstants = 1),"
    "SRV(t2, space = 1)";

void offsets_count_from_the_record(Context& t) {
  Standard program(t, kaamos_shaders_root(), {"MissReads"});
  program.local(kTwoArguments, {"MissReads"});
  program.record("Plain");
  const Buffer zeroth = words_buffer(t, 700);
  const Buffer fifth = words_buffer(t, 705);
  // At a stride of 96, record 5 begins at 480, a multiple of 32 but not of 64.
  RawRecord table(6 * 96);
  for (const size_t i : {0, 5}) {
    table.identifier(program.pipeline, "MissReads", 96 * i)
        .put(96 * i + 32, static_cast<uint32_t>(10 + i))
        .put(96 * i + 40, (i == 0 ? zeroth : fifth).GetGPUVirtualAddress());
  }
  Ray ray;
  ray.miss = 5;
  program.prepare({Ray{}, ray});
  DispatchRaysDesc desc = program.tables();
  desc.Width = 2;
  desc.MissShaderTable = {t.upload(table.bytes).GetGPUVirtualAddress(), 6 * 96, 96};
  const auto seen = seen_of(program.run(desc), 2);
  t.equal("constant of record 0", seen[0].record, 10u);
  t.equal("buffer of record 0", seen[0].primitive, 700u);
  t.equal("constant of record 5", seen[1].record, 15u);
  t.equal("buffer of record 5", seen[1].primitive, 705u);
}

std::string local_of_constants(uint32_t count) {
  return "RootFlags(LOCAL_ROOT_SIGNATURE), RootConstants(b0, num32BitConstants = " +
         std::to_string(count) + ")";
}

void largest_local_signature(Context& t) {
  t.accepted("1016 constants", t.device().CreateRootSignature(local_of_constants(1016)));
  t.refused("1017 constants", t.device().CreateRootSignature(local_of_constants(1017)));
  std::string many = "RootFlags(LOCAL_ROOT_SIGNATURE)";
  for (uint32_t i = 0; i < 300; ++i) many += ", SRV(t" + std::to_string(i) + ")";
  t.accepted("300 root descriptors", t.device().CreateRootSignature(many));
}

void local_flag_stands_alone(Context& t) {
  RootSignatureDesc desc;
  desc.Flags =
      RootSignatureFlags::kLocalRootSignature | RootSignatureFlags::kAllowInputAssemblerInputLayout;
  t.refused("flags 0x81", t.device().CreateRootSignature(desc));
  desc.Flags = RootSignatureFlags::kLocalRootSignature;
  t.accepted("flag 0x80", t.device().CreateRootSignature(desc));
  Standard global_as_local(t);
  global_as_local.desc.Add(
      LocalRootSignature{t.device().CreateRootSignature("SRV(t0, space = 9)").value()});
  t.refused("a global root signature as a local one", global_as_local.try_create());
  Standard local_as_global(t);
  local_as_global.desc.Add(
      GlobalRootSignature{t.device().CreateRootSignature(local_of_constants(1)).value()});
  t.refused("a local root signature as the global one", local_as_global.try_create());
}

void visibility_is_all(Context& t) {
  t.refused("a local parameter of the pixel shader",
            t.device().CreateRootSignature("RootFlags(LOCAL_ROOT_SIGNATURE), CBV(b0, visibility = "
                                           "SHADER_VISIBILITY_PIXEL)"));
  const char* global = "SRV(t0), SRV(t1), UAV(u0, visibility = SHADER_VISIBILITY_PIXEL)";
  const auto signature = t.device().CreateRootSignature(global);
  if (!signature) return;
  Standard program(t, nullptr, {}, global);
  t.refused("a pipeline whose u0 only pixel shaders see", program.try_create());
}

// Compute and ray tracing on one list with one set of arguments and one heap.
void arguments_are_shared_with_compute(Context& t) {
  Program program(t, kaamos_shaders_root(), {"RaysShared"},
                  "SRV(t0), SRV(t1), UAV(u0), RootConstants(b0, space = 2, num32BitConstants = 2),"
                  "DescriptorTable(SRV(t0, space = 2))");
  program.raygen("RaysShared");
  ComputePipelineStateDesc compute;
  compute.pRootSignature = program.global;
  compute.CS = std::get<DxilLibraryDesc>(program.desc.Subobjects[0]).DXILLibrary;
  compute.EntryPoint = "ComputeShared";
  const PipelineState pipeline = t.device().CreateComputePipelineState(compute).value();
  const DescriptorHeap heap = make_heap(t, 4);
  put_raw_view(t, words_buffer(t, 1000), heap, 3);
  const DispatchRaysDesc desc = program.tables();
  program.bind = [&](CommandList& list) {
    list.SetDescriptorHeaps({heap});
    list.SetComputeRootDescriptorTable(4, heap.GetGPUDescriptorHandle(3));
  };
  const Buffer words = t.zeros(kWordBytes);
  CommandList list = t.device().CreateCommandList().value();
  list.SetComputeRootSignature(program.global);
  program.bind(list);
  list.SetComputeRootUnorderedAccessView(2, words.GetGPUVirtualAddress());
  for (uint32_t i = 0; i < 3; ++i) {
    list.SetComputeRoot32BitConstants(3, std::array{2 * i, 10 * i});
    list.SetPipelineState(pipeline);
    list.Dispatch(1, 1, 1);
    list.SetPipelineState1(program.pipeline);
    list.DispatchRays(desc);
  }
  t.queue().ExecuteAndWait(list).value();
  const auto found = t.read(words);
  t.equal("words of Dispatch and DispatchRays in turn",
          std::vector<uint32_t>(found.begin(), found.begin() + 6),
          {1000u, 1001u, 1010u, 1011u, 1020u, 1021u});
}

void registers_do_not_overlap(Context& t) {
  Standard overlap(t);
  overlap.group("Overlap", "ClosestB");
  DxilLibraryDesc again = std::get<DxilLibraryDesc>(overlap.desc.Subobjects[0]);
  again.Exports = {{"ClosestB", "Closest"}};
  overlap.desc.Add(again);
  overlap.local(
      "RootFlags(LOCAL_ROOT_SIGNATURE), RootConstants(b0, space = 1, num32BitConstants = 4),"
      "UAV(u0)",
      {"Overlap"});
  t.refused("u0 in the local and the global root signature", overlap.try_create());
  Standard missing(t);
  missing.group("Missing", "ClosestB");
  missing.desc.Add(again);
  t.refused("b0 of space 1 in no root signature", missing.try_create());
}

void each_shader_has_its_own(Context& t) {
  Standard program(t, kaamos_shaders_root(), {"ClosestBare", "ClosestWide"});
  program.group("Bare", "ClosestBare");
  program.group("Wide", "ClosestWide");
  program.local(
      "RootFlags(LOCAL_ROOT_SIGNATURE), SRV(t2, space = 1),"
      "RootConstants(b2, space = 1, num32BitConstants = 3)",
      {"Wide"});
  program.record("Plain");
  program.hit("Bare");
  program.hit("Wide", {LocalArgument::Address(words_buffer(t, 5000)),
                       LocalArgument::Constants(std::array{1u, 2u, 3u})});
  program.record("Plain");
  program.scene = t.scene({triangle(5), triangle(5, 10), triangle(5, 20), triangle(5, 30)});
  std::vector<Ray> rays;
  for (uint32_t i = 0; i < 4; ++i) {
    rays.push_back(ray_at(10.0f * static_cast<float>(i)));
    rays.back().multiplier = 1;
  }
  std::vector<uint32_t> found;
  for (const Seen& each : program.trace(rays)) found.push_back(each.record);
  t.equal("records of four layouts", found, {0u, 999u, 5003u, 3u});
}

constexpr char kFirstSignature[] =
    "RootFlags(LOCAL_ROOT_SIGNATURE), RootConstants(b1, space = 1, num32BitConstants = 1)";

// A pipeline of CallsFunctions. `function` gets the local root signature `of_function`, the shader
// gets `of_shader` unless that is empty.
Program calls_functions(Context& t, const std::string& function, const std::string& of_function,
                        const std::string& of_shader) {
  Program program(t, kaamos_shaders_root(), {"CallsFunctions", "firstOfRecord", "twiceFirst"});
  if (!of_shader.empty()) program.local(of_shader, {"CallsFunctions"});
  if (!of_function.empty()) program.local(of_function, {function});
  return program;
}

void call_graphs_have_one_signature(Context& t) {
  const std::string other =
      "RootFlags(LOCAL_ROOT_SIGNATURE), RootConstants(b1, space = 1, num32BitConstants = 2)";
  for (const char* function : {"firstOfRecord", "twiceFirst"}) {
    t.accepted(std::string(function) + " with its caller's local root signature",
               calls_functions(t, function, kFirstSignature, kFirstSignature).try_create());
    t.refused(std::string(function) + " with another than its caller",
              calls_functions(t, function, other, kFirstSignature).try_create(), "KA0543");
  }
  t.refused("a local root signature that the caller lacks",
            calls_functions(t, "twiceFirst", kFirstSignature, "").try_create());
  Program program = calls_functions(t, "", "", kFirstSignature);
  program.raygen("CallsFunctions", {LocalArgument::Constants(21u)});
  t.equal("what functions without one read in their caller's record", program.run()[0], 42u);
  for (const bool same : {true, false}) {
    Program globals(t, kaamos_shaders_root(), {"CallsFunctions", "firstOfRecord", "twiceFirst"});
    globals.local(kFirstSignature, {"CallsFunctions"});
    const RootSignature own = t.device().CreateRootSignature("SRV(t7), UAV(u0)").value();
    const auto index = globals.desc.Add(GlobalRootSignature{own});
    if (same) {
      globals.desc.Associate(index, {"CallsFunctions", "twiceFirst"});
      t.accepted("a function with its caller's global root signature", globals.try_create());
    } else {
      globals.desc.Associate(index, {"twiceFirst"});
      t.refused("a function with another global root signature", globals.try_create(), "KA0543");
    }
  }
}

void two_global_signatures(Context& t) {
  Program program(t, kaamos_shaders_root(), {"RaysShared", "WriteOrdinal"});
  const RootSignature other =
      t.device()
          .CreateRootSignature(
              "RootConstants(b0, space = 2, num32BitConstants = 2), UAV(u0), SRV(t0, space = 2)")
          .value();
  program.desc.Associate(program.desc.Add(GlobalRootSignature{other}), {"RaysShared"});
  program.local(kRecordSignature, {"WriteOrdinal"});
  program.raygen("WriteOrdinal", {LocalArgument::Constants(Constants{70})});
  program.raygen("RaysShared");
  const DispatchRaysDesc first = program.tables();
  DispatchRaysDesc second = first;
  second.RayGenerationShaderRecord = program.shader_tables[0].GetRecord(1);
  const Buffer words = t.zeros(kWordBytes);
  CommandList list = t.device().CreateCommandList().value();
  list.SetPipelineState1(program.pipeline);
  list.SetComputeRootSignature(program.global);
  list.SetComputeRootUnorderedAccessView(2, words.GetGPUVirtualAddress());
  list.DispatchRays(first);
  list.SetComputeRootSignature(other);
  list.SetComputeRoot32BitConstants(0, std::array{1u, 5u});
  list.SetComputeRootUnorderedAccessView(1, words.GetGPUVirtualAddress());
  list.SetComputeRootShaderResourceView(2, words_buffer(t, 300).GetGPUVirtualAddress());
  list.DispatchRays(second);
  t.queue().ExecuteAndWait(list).value();
  t.equal("word of the first dispatch", t.read(words)[0], 71u);
  t.equal("word of the second dispatch", t.read(words)[2], 306u);
}

void static_samplers_agree(Context& t) {
  const std::string start =
      "RootFlags(LOCAL_ROOT_SIGNATURE), RootConstants(b0, space = 1, num32BitConstants = 4),";
  const std::string point = "StaticSampler(s0, space = 1, filter = FILTER_MIN_MAG_MIP_POINT)";
  const std::string linear = "StaticSampler(s0, space = 1, filter = FILTER_MIN_MAG_MIP_LINEAR)";
  for (const bool equal : {true, false}) {
    Standard program(t);
    DxilLibraryDesc again = std::get<DxilLibraryDesc>(program.desc.Subobjects[0]);
    again.Exports = {{"ClosestA", "Closest"}, {"ClosestB", "Closest"}};
    program.desc.Add(again);
    program.group("A", "ClosestA");
    program.group("B", "ClosestB");
    program.local(start + point, {"A"});
    program.local(start + (equal ? point : linear), {"B"});
    if (equal) {
      t.accepted("equal static samplers", program.try_create());
    } else {
      t.refused("different static samplers of one register", program.try_create());
    }
  }
}

void handles_are_unique(Context& t) {
  std::vector<DescriptorHeap> heaps = {make_heap(t, 100), make_heap(t, 100),
                                       make_heap(t, 100, DescriptorHeapType::kSampler),
                                       make_heap(t, 1000)};
  for (size_t i = 0; i < heaps.size(); ++i) {
    for (size_t k = 0; k < heaps.size(); ++k) {
      if (i == k) continue;
      const uint64_t start = heaps[i].GetGPUDescriptorHandleForHeapStart().ptr;
      const uint64_t end = heaps[i].GetGPUDescriptorHandle(heaps[i].GetDesc().NumDescriptors).ptr;
      const uint64_t other = heaps[k].GetGPUDescriptorHandleForHeapStart().ptr;
      t.holds("handles of two heaps do not meet", other < start || other >= end);
    }
  }
}

void structures_by_table_and_address(Context& t) {
  Standard program(t, kaamos_shaders_root(), {"TraceBound"},
                   "SRV(t0), SRV(t1), UAV(u0), DescriptorTable(SRV(t1, space = 2)),"
                   "DescriptorTable(SRV(t0, space = 3, numDescriptors = unbounded))");
  program.raygen("TraceBound");
  program.record("Plain");
  const DescriptorHeap heap = make_heap(t, 8);
  for (const auto& [slot, z] : {std::pair{0u, 6.0f}, {2u, 7.0f}, {3u, 8.0f}}) {
    ShaderResourceViewDesc view;
    view.ViewDimension = SrvDimension::kRaytracingAccelerationStructure;
    view.RaytracingAccelerationStructure.Location = t.scene({triangle(z)}).GetGPUVirtualAddress();
    t.device().CreateShaderResourceView({}, view, heap.GetCPUDescriptorHandle(slot)).value();
  }
  program.bind = [&](CommandList& list) {
    list.SetDescriptorHeaps({heap});
    list.SetComputeRootDescriptorTable(3, heap.GetGPUDescriptorHandle(0));
    list.SetComputeRootDescriptorTable(4, heap.GetGPUDescriptorHandle(2));
  };
  program.scene = t.scene({triangle(5)});
  program.prepare({Ray{}});
  std::vector<float> found;
  for (const Seen& each : seen_of(program.run(), 4)) found.push_back(each.t);
  t.distance("t by root SRV, table, array[0], array[1]", found, {5.0f, 6.0f, 7.0f, 8.0f});
}

void calls_switch_local_arguments(Context& t) {
  Program calls(t, kaamos_shaders_calls());
  calls.local(kRecordSignature, {"CallOne", "Answer", "Forward"});
  calls.raygen("CallOne", {LocalArgument::Constants(Constants{5})});
  calls.callable("Forward", {LocalArgument::Constants(Constants{2, 0, 1})});
  calls.callable("Answer", {LocalArgument::Constants(Constants{9})});
  calls.rays = t.upload(std::vector<Ray>{Ray{}});
  auto words = calls.run();
  t.equal("answer of the inner callable and ordinal of the outer", words[0], 209u);
  t.equal("ordinal of the caller after CallShader", words[1], 5u);

  Standard program(t, kaamos_shaders_root(), {"OrdinalAroundTrace"});
  program.local(kRecordSignature, {"OrdinalAroundTrace"});
  program.raygen("OrdinalAroundTrace", {LocalArgument::Constants(Constants{80})});
  program.records("Plain", 4);
  program.scene = t.scene({triangle(5)}, 3);
  program.prepare({Ray{}});
  words = program.run();
  t.equal("ordinals of caller, callee, caller",
          std::vector<uint32_t>(words.begin(), words.begin() + 3), {80u, 3u, 80u});
}

void offsets_begin_behind_the_identifier(Context& t) {
  const auto signature = t.device().CreateRootSignature(kTwoArguments).value();
  t.equal("offset of the constant", signature.GetArgumentOffset(0), 0u);
  t.equal("offset of the descriptor", signature.GetArgumentOffset(1), 8u);
}

}  // namespace

std::vector<RuleTest> root_tests() {
  return {{"ROOT-01, ROOT-02, ROOT-03, ROOT-05", worked_example_of_layout},
          {"ROOT-04", constants_are_contiguous},
          {"ROOT-06", offsets_count_from_the_record},
          {"ROOT-07", largest_local_signature},
          {"ROOT-08", local_flag_stands_alone},
          {"ROOT-09", visibility_is_all},
          {"ROOT-10, ROOT-16", arguments_are_shared_with_compute},
          {"ROOT-11", registers_do_not_overlap},
          {"ROOT-12", each_shader_has_its_own},
          {"ROOT-13", call_graphs_have_one_signature},
          {"ROOT-14", two_global_signatures},
          {"ROOT-15", static_samplers_agree},
          {"ROOT-17", handles_are_unique},
          {"ROOT-18", structures_by_table_and_address},
          {"ROOT-19", calls_switch_local_arguments},
          {"ROOT-20", offsets_begin_behind_the_identifier}};
}

}  // namespace kaamos::conformance
