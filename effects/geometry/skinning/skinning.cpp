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
  root.Parameters.push_back(RootParameter::Constants32(4, 0));
  for (std::uint32_t t = 0; t < 5; ++t) root.Parameters.push_back(RootParameter::Srv(t));
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
                                                     std::uint32_t joint_count,
                                                     GpuVirtualAddress morph) {
  SkinnedMesh out;
  out.vertex_count = static_cast<std::uint32_t>(mesh.vertices.size());
  out.has_more = mesh.has_more();
  out.bind_vertices = bind_vertices;
  out.skin = skin;
  auto joints = CreateUploadBuffer(
      device, std::vector<JointMatrix>(std::max(joint_count, 1u), JointMatrix(1.0f)),
      mesh.name + " joints");
  if (!joints) return joints.error();
  out.joints = *joints;
  out.morph = morph;
  out.morph_targets = morph == 0 ? 0 : mesh.morph_targets;
  auto weights = CreateUploadBuffer(
      device, std::vector<float>(std::max(out.morph_targets, 1u), 0.0f), mesh.name + " weights");
  if (!weights) return weights.error();
  out.weights = *weights;
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
  const std::uint32_t constants[4] = {mesh.vertex_count, keep_history ? 1u : 0u,
                                      mesh.has_more ? 1u : 0u, mesh.morph_targets};
  list.SetComputeRoot32BitConstants(0, 4, constants, 0);
  list.SetComputeRootShaderResourceView(1, mesh.bind_vertices);
  list.SetComputeRootShaderResourceView(2, mesh.skin);
  list.SetComputeRootShaderResourceView(3, mesh.joints.GetGPUVirtualAddress());
  const GpuVirtualAddress weights = mesh.weights.GetGPUVirtualAddress();
  list.SetComputeRootShaderResourceView(4, mesh.morph == 0 ? weights : mesh.morph);
  list.SetComputeRootShaderResourceView(5, weights);
  list.SetComputeRootUnorderedAccessView(6, mesh.vertices.GetGPUVirtualAddress());
  list.Dispatch((mesh.vertex_count + 63) / 64, 1, 1);
}

}  // namespace kaamos::effects
