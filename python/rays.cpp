// SPDX-License-Identifier: MIT
#include "python/rays.h"

#include <rtapi/explain.h>
#include <rtapi/shader_table.h>
#include <rtapi/upload.h>

#include <algorithm>
#include <cstring>

namespace kaamos::python {
namespace {

// An array of these columns, as floats or indices.
template <class T>
py::array_t<T, py::array::c_style | py::array::forcecast> rows_of(const py::object& object,
                                                                  py::ssize_t columns,
                                                                  const char* what) {
  auto array = py::array_t<T, py::array::c_style | py::array::forcecast>::ensure(object);
  if (!array || array.ndim() != 2 || array.shape(1) != columns) {
    throw py::type_error(std::string(what) + " has the shape (n, " + std::to_string(columns) + ")");
  }
  return array;
}

template <class Array>
rtapi::Buffer upload(const Session& session, const Array& array, const char* name) {
  return rtapi::CreateUploadBuffer(session.device(), bytes_of(array), name).value();
}

rtapi::StateObject make_pipeline(const Session& session, const Library& library,
                                 const rtapi::RootSignature& signature, const RayDispatch& what) {
  rtapi::StateObjectDesc desc;
  desc.Subobjects.emplace_back(rtapi::DxilLibraryDesc{library.library, {}});
  desc.Subobjects.emplace_back(rtapi::GlobalRootSignature{signature});
  desc.Subobjects.emplace_back(
      rtapi::RaytracingShaderConfig{what.payload_bytes, what.attribute_bytes});
  desc.Subobjects.emplace_back(rtapi::RaytracingPipelineConfig{what.recursion});
  for (const auto& [name, closest_hit, any_hit, intersection] : what.groups) {
    rtapi::HitGroupDesc group;
    group.HitGroupExport = name;
    group.ClosestHitShaderImport = closest_hit;
    group.AnyHitShaderImport = any_hit;
    group.IntersectionShaderImport = intersection;
    if (!intersection.empty()) group.Type = rtapi::HitGroupType::kProceduralPrimitive;
    desc.Subobjects.emplace_back(group);
  }
  return session.device().CreateStateObject(desc).value();
}

rtapi::ShaderTable make_table(const Session& session, const rtapi::StateObject& pipeline,
                              const std::vector<Record>& records, const char* name) {
  rtapi::ShaderTable table(pipeline, name);
  for (const auto& [export_name, constants] : records) {
    if (export_name.empty()) {
      table.AddNullRecord();
      continue;
    }
    std::vector<rtapi::LocalArgument> arguments;
    if (!constants.empty()) {
      constexpr size_t kMost = 4064;  // bytes behind the identifier in the largest record
      if (constants.size() > kMost) {
        throw py::value_error("a record of \"" + export_name + "\" has " +
                              std::to_string(constants.size()) + " bytes of constants; " +
                              std::to_string(kMost) + " are possible");
      }
      std::vector<uint32_t> words(constants.size() / 4 + 1);
      std::memcpy(words.data(), constants.data(), constants.size());
      words.resize((constants.size() + 3) / 4);
      arguments.push_back(rtapi::LocalArgument::Constants(std::span<const uint32_t>(words)));
    }
    table.AddRecord(export_name, arguments).value();
  }
  if (!records.empty()) table.Build(session.device()).value();
  return table;
}

}  // namespace

Structure build_bottom_level(Session& session, const BottomLevelOptions& options) {
  Structure out;
  rtapi::RaytracingGeometryDesc desc;
  desc.Flags = options.opaque ? rtapi::RaytracingGeometryFlags::kOpaque
                              : rtapi::RaytracingGeometryFlags::kNone;
  if (!options.boxes.is_none()) {
    const auto boxes = rows_of<float>(options.boxes, 6, "boxes");
    out.inputs.push_back(upload(session, boxes, "boxes"));
    desc.Type = rtapi::RaytracingGeometryType::kProceduralPrimitiveAabbs;
    desc.AABBs = {static_cast<uint64_t>(boxes.shape(0)),
                  {out.inputs[0].GetGPUVirtualAddress(), sizeof(rtapi::RaytracingAabb)}};
  } else {
    const auto vertices = rows_of<float>(options.vertices, 3, "vertices");
    out.inputs.push_back(upload(session, vertices, "vertices"));
    desc.Triangles.VertexFormat = rtapi::Format::kR32G32B32Float;
    desc.Triangles.VertexCount = static_cast<uint32_t>(vertices.shape(0));
    desc.Triangles.VertexBuffer = {out.inputs[0].GetGPUVirtualAddress(), 12};
    if (!options.indices.is_none()) {
      const auto indices = rows_of<uint32_t>(options.indices, 3, "indices");
      out.inputs.push_back(upload(session, indices, "indices"));
      desc.Triangles.IndexFormat = rtapi::Format::kR32Uint;
      desc.Triangles.IndexCount = static_cast<uint32_t>(indices.size());
      desc.Triangles.IndexBuffer = out.inputs[1].GetGPUVirtualAddress();
    }
  }
  const py::gil_scoped_release released;
  out.buffer =
      rtapi::BuildBottomLevel(session.device(), session.queue(), {desc}, "bottom level").value();
  return out;
}

Structure build_top_level(Session& session, const std::vector<Instance>& instances) {
  Structure out;
  std::vector<rtapi::RaytracingInstanceDesc> descs;
  for (const Instance& from : instances) {
    rtapi::RaytracingInstanceDesc desc;
    if (!from.transform.is_none()) {
      auto matrix =
          py::array_t<float, py::array::c_style | py::array::forcecast>::ensure(from.transform);
      const bool fits = matrix && matrix.ndim() == 2 && matrix.shape(1) == 4 &&
                        (matrix.shape(0) == 3 || matrix.shape(0) == 4);
      if (!fits) throw py::type_error("a transform has the shape (3, 4) or (4, 4)");
      std::memcpy(desc.Transform, matrix.data(), sizeof desc.Transform);
    }
    desc.InstanceID = from.id & 0xFFFFFF;
    desc.InstanceMask = from.mask & 0xFF;
    desc.InstanceContributionToHitGroupIndex = from.hit_group & 0xFFFFFF;
    desc.Flags = from.flags & 0xFF;
    desc.AccelerationStructure = from.bottom_level.buffer.GetGPUVirtualAddress();
    descs.push_back(desc);
    out.inputs.push_back(from.bottom_level.buffer);
    out.inputs.insert(out.inputs.end(), from.bottom_level.inputs.begin(),
                      from.bottom_level.inputs.end());
  }
  const py::gil_scoped_release released;
  out.buffer = rtapi::BuildTopLevel(session.device(), session.queue(), descs, "top level").value();
  return out;
}

namespace {

// All that a pipeline depends on.
std::string name_of(const RayDispatch& what) {
  std::string out = std::to_string(what.payload_bytes) + "," +
                    std::to_string(what.attribute_bytes) + "," + std::to_string(what.recursion);
  for (const auto& group : what.groups) {
    for (const std::string& part : group) out += "," + part;
  }
  out += ";";
  for (const std::string& one : what.local) out += "," + one;
  return out;
}

const RayPipeline& pipeline_for(const Session& session, const Library& library,
                                const RayDispatch& what) {
  auto& made = session.made_of(library).of_rays;
  const std::string name = name_of(what);
  const auto found = made.find(name);
  if (found != made.end()) return found->second;
  RayPipeline pipeline;
  pipeline.root_signature = session.root_signature(library, what.local);
  pipeline.state_object = make_pipeline(session, library, pipeline.root_signature, what);
  return made.emplace(name, std::move(pipeline)).first->second;
}

// A recorded dispatch, and what must live until it has run.
struct Recorded {
  rtapi::CommandList list;
  BoundResources bound;
  std::vector<rtapi::ShaderTable> tables;
};

Recorded record(Session& session, const Library& library, const RayDispatch& what,
                const Bindings& given) {
  const RayPipeline& made = pipeline_for(session, library, what);
  const rtapi::StateObject& pipeline = made.state_object;
  const auto table = [&](const std::vector<Record>& records, const char* name) {
    return make_table(session, pipeline, records, name);
  };
  const rtapi::ShaderTable start = table({{what.ray_generation, ""}}, "ray generation");
  const rtapi::ShaderTable miss = table(what.miss, "miss");
  const rtapi::ShaderTable hit = table(what.hit_groups, "hit_groups");
  const rtapi::ShaderTable callable = table(what.callable, "callable");
  rtapi::DispatchRaysDesc desc;
  desc.RayGenerationShaderRecord = start.GetRecord(0);
  if (!what.miss.empty()) desc.MissShaderTable = miss.GetTable();
  if (!what.hit_groups.empty()) desc.HitGroupTable = hit.GetTable();
  if (!what.callable.empty()) desc.CallableShaderTable = callable.GetTable();
  desc.Width = what.size[0];
  desc.Height = what.size[1];
  desc.Depth = what.size[2];
  rtapi::CommandList list = session.device().CreateCommandList().value();
  BoundResources bound =
      session.bind(list, Root::kCompute, library, made.root_signature, given, what.local);
  list.SetPipelineState1(pipeline);
  list.DispatchRays(desc);
  return {std::move(list), std::move(bound), {start, miss, hit, callable}};
}

}  // namespace

void dispatch_rays(Session& session, const Library& library, const RayDispatch& what,
                   const Bindings& given) {
  Recorded recorded = record(session, library, what, given);
  session.execute(recorded.list, recorded.bound);
}

Explanation explain_rays(Session& session, const Library& library, const RayDispatch& what,
                         std::array<uint32_t, 3> at, const Bindings& given) {
  Recorded recorded = record(session, library, what, given);
  if (!recorded.bound.undo.empty()) recorded.list.ResourceBarrier(recorded.bound.undo);
  const py::gil_scoped_release released;
  const rtapi::PixelExplanation found =
      rtapi::ExplainPixel(session.queue(), recorded.list, {.X = at[0], .Y = at[1], .Z = at[2]})
          .value();
  return {rtapi::ToText(found), rtapi::ToJson(found)};
}

}  // namespace kaamos::python
