// SPDX-License-Identifier: MIT
#include "effects/geometry/skinning/skinning.h"

#include <rtapi/upload.h>
#include <shaders/skinning.h>

#include <algorithm>
#include <vector>

namespace kaamos::effects {

using namespace rtapi;

rtapi::Result<SkinningPass> SkinningPass::create(const Device& device) {
  const auto library = rtapi::LoadShaderLibrary(kaamos_shaders_skinning());
  if (!library) return library.error();
  RootSignatureDesc root;
  root.Parameters.push_back(RootParameter::Constants32(3, 0));
  for (std::uint32_t t = 0; t < 3; ++t) root.Parameters.push_back(RootParameter::Srv(t));
  root.Parameters.push_back(RootParameter::Uav(0));
  const auto signature = device.CreateRootSignature(root);
  if (!signature) return signature.error();
  SkinningPass pass;
  pass.root_signature_ = *signature;
  ComputePipelineStateDesc desc;
  desc.pRootSignature = pass.root_signature_;
  desc.CS = *library;
  desc.EntryPoint = "SkinVertices";
  desc.Name = "skinning";
  const auto pipeline = device.CreateComputePipelineState(desc);
  if (!pipeline) return pipeline.error();
  pass.pipeline_ = *pipeline;
  return pass;
}

rtapi::Result<SkinnedMesh> SkinningPass::create_mesh(const Device& device, const Mesh& mesh,
                                                     GpuVirtualAddress bind_vertices,
                                                     GpuVirtualAddress skin,
                                                     std::uint32_t joint_count) {
  SkinnedMesh out;
  out.vertex_count = static_cast<std::uint32_t>(mesh.vertices.size());
  out.has_colors = !mesh.colors.empty();
  out.bind_vertices = bind_vertices;
  out.skin = skin;
  auto joints = CreateUploadBuffer(
      device, std::vector<JointMatrix>(std::max(joint_count, 1u), JointMatrix(0.0f)),
      mesh.name + " joints");
  if (!joints) return joints.error();
  out.joints = *joints;
  BufferDesc desc;
  desc.SizeInBytes = std::max<std::uint64_t>(mesh.vertices.size(), 1) * stride(mesh);
  desc.Flags = ResourceFlags::kAllowUnorderedAccess;
  desc.InitialState = kSkinnedVertexState;
  desc.Name = mesh.name + " skinned vertices";
  auto vertices = device.CreateBuffer(desc);
  if (!vertices) return vertices.error();
  out.vertices = *vertices;
  return out;
}

void SkinningPass::begin(CommandList& list) const {
  list.SetComputeRootSignature(root_signature_);
  list.SetPipelineState(pipeline_);
}

void SkinningPass::dispatch(CommandList& list, const SkinnedMesh& mesh, bool keep_history) const {
  const std::uint32_t constants[3] = {mesh.vertex_count, keep_history ? 1u : 0u,
                                      mesh.has_colors ? 1u : 0u};
  list.SetComputeRoot32BitConstants(0, 3, constants, 0);
  list.SetComputeRootShaderResourceView(1, mesh.bind_vertices);
  list.SetComputeRootShaderResourceView(2, mesh.skin);
  list.SetComputeRootShaderResourceView(3, mesh.joints.GetGPUVirtualAddress());
  list.SetComputeRootUnorderedAccessView(4, mesh.vertices.GetGPUVirtualAddress());
  list.Dispatch((mesh.vertex_count + 63) / 64, 1, 1);
}

}  // namespace kaamos::effects
