// SPDX-License-Identifier: MIT
#include "tests/conformance/states.h"

#include <rtapi/shader_table.h>
#include <shaders/states.h>
#include <shaders/subobjects.h>

namespace kaamos::conformance {

using namespace rtapi;

DxilLibraryDesc states(std::vector<ExportDesc> exports) {
  return {LoadShaderLibrary(kaamos_shaders_states()).value(), std::move(exports)};
}

DxilLibraryDesc subobjects(std::vector<ExportDesc> exports) {
  return {LoadShaderLibrary(kaamos_shaders_subobjects()).value(), std::move(exports)};
}

std::vector<ExportDesc> named(const std::vector<std::string>& names) {
  std::vector<ExportDesc> out;
  for (const std::string& name : names) out.push_back({name, ""});
  return out;
}

LocalRootSignature local(Context& t, uint32_t constants) {
  return {t.device()
              .CreateRootSignature("RootFlags(LOCAL_ROOT_SIGNATURE), RootConstants(b9, space = 1, "
                                   "num32BitConstants = " +
                                   std::to_string(constants) + ")")
              .value()};
}

GlobalRootSignature global(Context& t) {
  return {t.device().CreateRootSignature("UAV(u0)").value()};
}

StateObjectDesc configs(StateObjectType type, StateObjectFlags flags, uint32_t depth,
                        uint32_t payload_bytes) {
  StateObjectDesc desc;
  desc.Type = type;
  desc.Add(RaytracingShaderConfig{payload_bytes, 8});
  desc.Add(RaytracingPipelineConfig{depth});
  if (flags != kNoFlags) desc.Add(StateObjectConfig{flags});
  return desc;
}

StateObjectDesc complete(Context& t, std::vector<ExportDesc> exports, StateObjectType type,
                         StateObjectFlags flags) {
  StateObjectDesc desc = configs(type, flags);
  desc.Add(global(t));
  desc.Add(states(std::move(exports)));
  return desc;
}

HitGroupDesc triangles(const std::string& name, const std::string& closest,
                       const std::string& any) {
  HitGroupDesc out;
  out.HitGroupExport = name;
  out.ClosestHitShaderImport = closest;
  out.AnyHitShaderImport = any;
  return out;
}

Result<StateObject> make(Context& t, const StateObjectDesc& desc) {
  return t.device().CreateStateObject(desc);
}

bool has(const StateObject& object, const std::string& name) {
  return object.GetShaderIdentifier(name) != nullptr;
}

std::vector<uint32_t> local_bytes(const StateObject& object,
                                  const std::vector<std::string>& names) {
  std::vector<uint32_t> out;
  for (const std::string& name : names) {
    const RootSignature signature = object.GetLocalRootSignature(name);
    out.push_back(signature ? signature.GetArgumentBytes() : 0);
  }
  return out;
}

std::vector<uint32_t> call(Context& t, const StateObject& pipeline,
                           const std::vector<std::string>& callables,
                           const StateObject* identifiers) {
  ShaderTable start(pipeline, "start");
  start.AddRecord("Start").value();
  start.Build(t.device()).value();
  ShaderTable table(identifiers != nullptr ? *identifiers : pipeline, "callables");
  for (const std::string& name : callables) table.AddRecord(name).value();
  table.Build(t.device()).value();
  DispatchRaysDesc desc;
  desc.RayGenerationShaderRecord = start.GetRecord(0);
  desc.CallableShaderTable = table.GetTable();
  desc.Width = desc.Height = desc.Depth = 1;
  const Buffer words = t.zeros(256);
  CommandList list = t.device().CreateCommandList().value();
  list.SetComputeRootSignature(global(t).pGlobalRootSignature);
  list.SetPipelineState1(pipeline);
  list.SetComputeRootUnorderedAccessView(0, words.GetGPUVirtualAddress());
  list.DispatchRays(desc);
  t.queue().ExecuteAndWait(list).value();
  const auto found = t.read(words);
  return {found[0], found[1]};
}

}  // namespace kaamos::conformance
