// SPDX-License-Identifier: MIT
#include "triangle.h"

#include "CompiledShaders\triangle.hlsl.h"

Triangle::Triangle(const Options& options) : Program(options) {
  CreatePipeline();
  BuildAccelerationStructures();
  image_ = CreateTexture(DXGI_FORMAT_R8G8B8A8_UNORM, D3D12_RESOURCE_FLAG_ALLOW_UNORDERED_ACCESS,
                         D3D12_RESOURCE_STATE_UNORDERED_ACCESS, L"image");
  heap_ = CreateDescriptorHeap(D3D12_DESCRIPTOR_HEAP_TYPE_CBV_SRV_UAV, 1);
  D3D12_UNORDERED_ACCESS_VIEW_DESC view = {};
  view.ViewDimension = D3D12_UAV_DIMENSION_TEXTURE2D;
  device_->CreateUnorderedAccessView(image_.Get(), nullptr, &view, Slot(heap_.Get(), 0));
}

void Triangle::DispatchRays() {
  ID3D12DescriptorHeap* heaps[] = {heap_.Get()};
  list_->SetDescriptorHeaps(1, heaps);
  list_->SetComputeRootSignature(root_signature_.Get());
  list_->SetComputeRootShaderResourceView(0, top_level_->GetGPUVirtualAddress());
  list_->SetComputeRootDescriptorTable(1, heap_->GetGPUDescriptorHandleForHeapStart());
  list_->SetPipelineState1(pipeline_.Get());

  constexpr UINT kRecord = D3D12_SHADER_IDENTIFIER_SIZE_IN_BYTES;
  D3D12_DISPATCH_RAYS_DESC rays = {};
  rays.RayGenerationShaderRecord = {raygen_table_->GetGPUVirtualAddress(), kRecord};
  rays.MissShaderTable = {miss_table_->GetGPUVirtualAddress(), kRecord, kRecord};
  rays.HitGroupTable = {hit_table_->GetGPUVirtualAddress(), kRecord, kRecord};
  rays.Width = options_.width;
  rays.Height = options_.height;
  rays.Depth = 1;
  list_->DispatchRays(&rays);
}

void Triangle::CreatePipeline() {
  // The scene is a root SRV (t0), the image a table (u0).
  CD3DX12_DESCRIPTOR_RANGE1 image;
  image.Init(D3D12_DESCRIPTOR_RANGE_TYPE_UAV, 1, 0);
  CD3DX12_ROOT_PARAMETER1 parameters[2];
  parameters[0].InitAsShaderResourceView(0);
  parameters[1].InitAsDescriptorTable(1, &image);
  CD3DX12_VERSIONED_ROOT_SIGNATURE_DESC desc;
  desc.Init_1_1(2, parameters);
  root_signature_ = CreateRootSignature(desc);

  CD3DX12_STATE_OBJECT_DESC pipeline(D3D12_STATE_OBJECT_TYPE_RAYTRACING_PIPELINE);
  auto* library = pipeline.CreateSubobject<CD3DX12_DXIL_LIBRARY_SUBOBJECT>();
  const D3D12_SHADER_BYTECODE bytecode = CD3DX12_SHADER_BYTECODE(g_pTriangle, sizeof(g_pTriangle));
  library->SetDXILLibrary(&bytecode);
  library->DefineExport(L"RayGen");
  library->DefineExport(L"Miss");
  library->DefineExport(L"ClosestHit");
  auto* group = pipeline.CreateSubobject<CD3DX12_HIT_GROUP_SUBOBJECT>();
  group->SetHitGroupExport(L"TriangleGroup");
  group->SetHitGroupType(D3D12_HIT_GROUP_TYPE_TRIANGLES);
  group->SetClosestHitShaderImport(L"ClosestHit");
  pipeline.CreateSubobject<CD3DX12_RAYTRACING_SHADER_CONFIG_SUBOBJECT>()->Config(12, 8);
  pipeline.CreateSubobject<CD3DX12_RAYTRACING_PIPELINE_CONFIG_SUBOBJECT>()->Config(1);
  pipeline.CreateSubobject<CD3DX12_GLOBAL_ROOT_SIGNATURE_SUBOBJECT>()->SetRootSignature(
      root_signature_.Get());
  CHECK(device_->CreateStateObject(pipeline, IID_PPV_ARGS(&pipeline_)));
  raygen_table_ = CreateShaderTable(pipeline_.Get(), L"RayGen");
  miss_table_ = CreateShaderTable(pipeline_.Get(), L"Miss");
  hit_table_ = CreateShaderTable(pipeline_.Get(), L"TriangleGroup");
}

void Triangle::BuildAccelerationStructures() {
  const float vertices[] = {0.0f, 0.7f, 0.0f, 0.8f, -0.6f, 0.0f, -0.8f, -0.6f, 0.0f};
  vertices_ = Upload(vertices, sizeof(vertices));
  D3D12_RAYTRACING_GEOMETRY_DESC geometry = {};
  geometry.Type = D3D12_RAYTRACING_GEOMETRY_TYPE_TRIANGLES;
  geometry.Flags = D3D12_RAYTRACING_GEOMETRY_FLAG_OPAQUE;
  geometry.Triangles.VertexFormat = DXGI_FORMAT_R32G32B32_FLOAT;
  geometry.Triangles.VertexCount = 3;
  geometry.Triangles.VertexBuffer = {vertices_->GetGPUVirtualAddress(), 12};
  D3D12_BUILD_RAYTRACING_ACCELERATION_STRUCTURE_INPUTS bottom = {};
  bottom.Type = D3D12_RAYTRACING_ACCELERATION_STRUCTURE_TYPE_BOTTOM_LEVEL;
  bottom.Flags = D3D12_RAYTRACING_ACCELERATION_STRUCTURE_BUILD_FLAG_PREFER_FAST_TRACE;
  bottom.NumDescs = 1;
  bottom.pGeometryDescs = &geometry;
  bottom_level_ = BuildAccelerationStructure(bottom);

  D3D12_RAYTRACING_INSTANCE_DESC instance = {};
  instance.Transform[0][0] = instance.Transform[1][1] = instance.Transform[2][2] = 1;
  instance.InstanceMask = 0xFF;
  instance.AccelerationStructure = bottom_level_->GetGPUVirtualAddress();
  instances_ = Upload(&instance, sizeof(instance));
  D3D12_BUILD_RAYTRACING_ACCELERATION_STRUCTURE_INPUTS top = {};
  top.Type = D3D12_RAYTRACING_ACCELERATION_STRUCTURE_TYPE_TOP_LEVEL;
  top.Flags = D3D12_RAYTRACING_ACCELERATION_STRUCTURE_BUILD_FLAG_PREFER_FAST_TRACE;
  top.NumDescs = 1;
  top.InstanceDescs = instances_->GetGPUVirtualAddress();
  top_level_ = BuildAccelerationStructure(top);
  Execute();
}
