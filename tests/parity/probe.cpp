// SPDX-License-Identifier: MIT
#include "tests/parity/probe.h"

#include <rtapi/upload.h>
#include <shaders/probe.h>

#include <cmath>
#include <cstring>
#include <random>

#include "tests/common/structures.h"

namespace kaamos::parity {

using namespace rtapi;

namespace {

constexpr char kGlobalSignature[] = "SRV(t0), SRV(t1), UAV(u0)";
constexpr char kLocalSignature[] =
    "RootFlags(LOCAL_ROOT_SIGNATURE), SRV(t0, space = 1), SRV(t1, space = 1),"
    "RootConstants(b0, space = 1, num32BitConstants = 2)";
constexpr uint32_t kRayTypes = 2;

BufferDesc unordered(uint64_t bytes, ResourceStates state) {
  BufferDesc desc;
  desc.SizeInBytes = bytes;
  desc.Flags = ResourceFlags::kAllowUnorderedAccess;
  desc.InitialState = state;
  return desc;
}

// A sphere of `rings` by 2 * `rings` quads with the vertex layout of the effects' meshes.
void make_sphere(uint32_t rings, std::vector<effects::Vertex>& vertices,
                 std::vector<uint32_t>& indices) {
  const uint32_t columns = 2 * rings;
  for (uint32_t y = 0; y <= rings; ++y) {
    for (uint32_t x = 0; x <= columns; ++x) {
      const float a = 3.14159265f * static_cast<float>(y) / static_cast<float>(rings);
      const float b = 6.2831853f * static_cast<float>(x) / static_cast<float>(columns);
      effects::Vertex vertex;
      vertex.position = {std::sin(a) * std::cos(b), std::cos(a), std::sin(a) * std::sin(b)};
      vertices.push_back(vertex);
    }
  }
  for (uint32_t y = 0; y < rings; ++y) {
    for (uint32_t x = 0; x < columns; ++x) {
      const uint32_t i = y * (columns + 1) + x;
      const uint32_t below = i + columns + 1;
      indices.insert(indices.end(), {i, i + 1, below, below, i + 1, below + 1});
    }
  }
}

// A random rotation and stretch; every fifth one mirrors.
void random_transform(std::mt19937& random, uint32_t number, float (&transform)[3][4]) {
  std::uniform_real_distribution<float> unit(0, 1);
  const float a = 6.28f * unit(random);
  const float b = 6.28f * unit(random);
  const float rotation[3][3] = {
      {std::cos(a), -std::sin(a), 0},
      {std::sin(a) * std::cos(b), std::cos(a) * std::cos(b), -std::sin(b)},
      {std::sin(a) * std::sin(b), std::cos(a) * std::sin(b), std::cos(b)}};
  for (int column = 0; column < 3; ++column) {
    float scale = 0.4f + 1.2f * unit(random);
    if (column == 0 && number % 5 == 4) scale = -scale;
    for (int row = 0; row < 3; ++row) transform[row][column] = rotation[row][column] * scale;
  }
  for (int row = 0; row < 3; ++row) transform[row][3] = 14 * unit(random) - 7;
}

}  // namespace

void Probe::open(const std::string& backend) {
  DeviceDesc desc;
  desc.Backend = backend;
  desc.CollectStatistics = true;
  device_ = CreateDevice(desc).value();
  queue_ = device_.CreateCommandQueue().value();
}

Probe::Probe(const std::string& backend, const effects::Scene& scene) {
  open(backend);
  gpu_ =
      effects::create_gpu_scene(device_, queue_, scene, scene.cameras.front().position()).value();
  top_level_ = gpu_.top_level;
  for (const effects::GpuGeometry& geometry : gpu_.geometries) {
    geometries_.push_back({geometry.vertices, geometry.indices, geometry.constants.index_size_bytes,
                           geometry.alpha_tested ? "Tested" : "Opaque"});
  }
  create_pipeline();
}

Probe::Probe(const std::string& backend) {
  open(backend);
  build_mixed();
  create_pipeline();
}

Buffer Probe::upload(const void* data, size_t bytes) {
  const auto* begin = static_cast<const std::byte*>(data);
  keep_.push_back(CreateUploadBuffer(device_, std::span(begin, bytes), "probe").value());
  return keep_.back();
}

void Probe::build_mixed() {
  std::vector<effects::Vertex> vertices;
  std::vector<uint32_t> indices;
  make_sphere(12, vertices, indices);
  const Buffer vertex_buffer = upload(vertices.data(), vertices.size() * sizeof(vertices[0]));
  const Buffer index_buffer = upload(indices.data(), indices.size() * 4);
  const float box[6] = {-1, -1, -1, 1, 1, 1};
  const Buffer box_buffer = upload(box, sizeof box);

  // Two halves of the sphere as two geometries, the second one not opaque; and the ball.
  const auto half = static_cast<uint32_t>(indices.size() / 6 * 3);
  std::vector<RaytracingGeometryDesc> halves(2);
  for (uint32_t i = 0; i < 2; ++i) {
    const uint64_t first = index_buffer.GetGPUVirtualAddress() + uint64_t{i} * half * 4;
    halves[i].Flags = i == 0 ? RaytracingGeometryFlags::kOpaque : RaytracingGeometryFlags::kNone;
    halves[i].Triangles.VertexFormat = Format::kR32G32B32Float;
    halves[i].Triangles.VertexCount = static_cast<uint32_t>(vertices.size());
    halves[i].Triangles.VertexBuffer = {vertex_buffer.GetGPUVirtualAddress(), 48};
    halves[i].Triangles.IndexFormat = Format::kR32Uint;
    halves[i].Triangles.IndexCount = half;
    halves[i].Triangles.IndexBuffer = first;
    geometries_.push_back(
        {vertex_buffer.GetGPUVirtualAddress(), first, 4, i == 0 ? "Opaque" : "Tested"});
  }
  RaytracingGeometryDesc ball;
  ball.Type = RaytracingGeometryType::kProceduralPrimitiveAabbs;
  ball.AABBs.AABBCount = 1;
  ball.AABBs.AABBs = {box_buffer.GetGPUVirtualAddress(), 24};
  geometries_.push_back(
      {vertex_buffer.GetGPUVirtualAddress(), index_buffer.GetGPUVirtualAddress(), 4, "Ball"});

  const Buffer sphere =
      kaamos::test::build_bottom_level(device_, queue_, {std::begin(halves), std::end(halves)});
  const Buffer balls = kaamos::test::build_bottom_level(device_, queue_, {ball});
  keep_.insert(keep_.end(), {sphere, balls});

  std::mt19937 random(7);
  std::vector<RaytracingInstanceDesc> instances(60);
  for (uint32_t i = 0; i < instances.size(); ++i) {
    RaytracingInstanceDesc& instance = instances[i];
    random_transform(random, i, instance.Transform);
    const bool is_ball = i % 3 == 2;
    instance.InstanceID = 0xFFFFFF - i;
    instance.InstanceMask = 1u << (i % 8);
    instance.InstanceContributionToHitGroupIndex = is_ball ? 2 * kRayTypes : 0;
    // None, cull disable, front counter-clockwise, both, force opaque, force non-opaque.
    const uint32_t kinds[] = {0, 1, 2, 3, 4, 8};
    instance.Flags = is_ball ? 0 : kinds[i / 3 % 6];
    instance.AccelerationStructure = (is_ball ? balls : sphere).GetGPUVirtualAddress();
  }
  top_level_ = kaamos::test::build_top_level(device_, queue_, instances);
}

void Probe::create_pipeline() {
  global_ = device_.CreateRootSignature(kGlobalSignature).value();
  local_ = device_.CreateRootSignature(kLocalSignature).value();
  StateObjectDesc desc;
  DxilLibraryDesc library;
  library.DXILLibrary = LoadShaderLibrary(kaamos_shaders_probe()).value();
  for (const char* name :
       {"Probe", "ProbeMiss", "ProbeAnyHit", "ProbeHit", "ProbeBall", "ProbeBallHit"}) {
    library.Exports.push_back({name, ""});
  }
  desc.Add(library);
  HitGroupDesc group;
  group.HitGroupExport = "Opaque";
  group.ClosestHitShaderImport = "ProbeHit";
  desc.Add(group);
  group.HitGroupExport = "Tested";
  group.AnyHitShaderImport = "ProbeAnyHit";
  desc.Add(group);
  HitGroupDesc ball;
  ball.Type = HitGroupType::kProceduralPrimitive;
  ball.HitGroupExport = "Ball";
  ball.ClosestHitShaderImport = "ProbeBallHit";
  ball.IntersectionShaderImport = "ProbeBall";
  desc.Add(ball);
  desc.Add(RaytracingShaderConfig{sizeof(HitRecord), 8});
  desc.Add(RaytracingPipelineConfig{1});
  desc.Add(GlobalRootSignature{global_});
  desc.Associate(desc.Add(LocalRootSignature{local_}), {"Opaque", "Tested", "Ball"});
  pipeline_ = device_.CreateStateObject(desc).value();

  for (int i = 0; i < 3; ++i) tables_.emplace_back(pipeline_);
  tables_[0].AddRecord("Probe").value();
  tables_[1].AddRecord("ProbeMiss").value();
  for (const Geometry& geometry : geometries_) {
    for (uint32_t type = 0; type < kRayTypes; ++type) {
      const uint32_t constants[2] = {tables_[2].record_count(), geometry.index_bytes};
      tables_[2]
          .AddRecord(geometry.group, {LocalArgument::Address(geometry.vertices),
                                      LocalArgument::Address(geometry.indices),
                                      LocalArgument::Constants(constants)})
          .value();
    }
  }
  for (ShaderTable& table : tables_) table.Build(device_).value();
}

std::vector<HitRecord> Probe::trace(const std::vector<ProbeRay>& rays, uint32_t width) {
  const Buffer ray_buffer = CreateUploadBuffer(device_, rays, "rays").value();
  const Buffer hits = device_
                          .CreateBuffer(unordered(rays.size() * sizeof(HitRecord),
                                                  ResourceStates::kUnorderedAccess))
                          .value();
  CommandList list = device_.CreateCommandList().value();
  list.SetComputeRootSignature(global_);
  list.SetPipelineState1(pipeline_);
  list.SetComputeRootShaderResourceView(0, top_level_.GetGPUVirtualAddress());
  list.SetComputeRootShaderResourceView(1, ray_buffer.GetGPUVirtualAddress());
  list.SetComputeRootUnorderedAccessView(2, hits.GetGPUVirtualAddress());
  DispatchRaysDesc desc;
  desc.RayGenerationShaderRecord = tables_[0].GetRecord(0);
  desc.MissShaderTable = tables_[1].GetTable();
  desc.HitGroupTable = tables_[2].GetTable();
  desc.Width = width;
  desc.Height = static_cast<uint32_t>(rays.size() / width);
  list.DispatchRays(desc);
  queue_.ExecuteAndWait(list).value();
  const auto bytes = ReadbackBuffer(device_, queue_, hits).value();
  std::vector<HitRecord> out(rays.size());
  std::memcpy(out.data(), bytes.data(), bytes.size());
  for (HitRecord& record : out) {
    // Rays that skip the closest-hit shader only tell whether they hit.
    if (record.flags != 0xFFFFFFFFu) continue;
    record = {};
    record.hit = 1;
  }
  return out;
}

}  // namespace kaamos::parity
