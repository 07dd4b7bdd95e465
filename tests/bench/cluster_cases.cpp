// SPDX-License-Identifier: MIT
//
// clusters/...: operations on clusters over what they stand in for: a bottom level of clusters over
// one of the same triangles, and instances of a template over clusters that are built one by one;
// and rays through both levels.
// [DXR 2.0: Clustered geometry]
#include <rtapi/rtas_operations.h>
#include <rtapi/upload.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "closest_rays.h"
#include "fixtures.h"

namespace kaamos::bench {
namespace {

using namespace rtapi;

constexpr uint32_t kQuads = 8;  // along a side of a tile
constexpr uint32_t kTriangles = 2 * kQuads * kQuads;
constexpr uint32_t kVertices = (kQuads + 1) * (kQuads + 1);

// Hills of square tiles with triangles of their own, a cluster each.
class Hills {
 public:
  Hills(const Options& options, uint32_t edge) : edge_(edge), count_(edge * edge) {
    DeviceDesc desc;
    desc.Threads = options.threads;
    desc.Precision = options.precision;
    desc.ShaderModel = ShaderModel::k6_10;
    desc.IndirectRtasOperations = true;
    device_ = CreateDevice(desc).value();
    queue_ = device_.CreateCommandQueue().value();
    make_triangles();
    tile_ = operation(template_inputs(), std::vector{template_args()}, 1);
    clusters_ = operation(cluster_inputs(), cluster_args(), count_);
    instances_ = operation(instance_inputs(), instance_args(), count_);
    level_ = operation(level_inputs(), std::vector{level_args()}, 1);
    record_classic();
  }

  void build_clusters() { run(clusters_.list); }
  void instantiate() { run(instances_.list); }
  void build_level() { run(level_.list); }
  void build_classic() { run(classic_); }

  const Device& device() const { return device_; }
  const CommandQueue& queue() const { return queue_; }
  float size() const { return static_cast<float>(edge_ * kQuads); }
  void run(const CommandList& list) { queue_.ExecuteAndWait(list).value(); }
  Buffer top_of_clusters() { return top_of(level_.results); }
  Buffer top_of_triangles() {
    build_classic();
    return top_of(classic_result_);
  }

 private:
  // An operation and its memory.
  struct Operation {
    Buffer results, addresses, scratch, arguments;
    CommandList list;
  };

  // A top level of one instance of the bottom level at the beginning of a buffer.
  Buffer top_of(const Buffer& bottom_level) {
    RaytracingInstanceDesc instance;
    instance.AccelerationStructure = bottom_level.GetGPUVirtualAddress();
    return BuildTopLevel(device_, queue_, {instance}, "top level").value();
  }

  void make_triangles() {
    std::vector<uint8_t> indices;
    for (uint32_t quad = 0; quad < kQuads * kQuads; ++quad) {
      const uint32_t first = quad / kQuads * (kQuads + 1) + quad % kQuads;
      for (const uint32_t corner : {0u, kQuads + 1, 1u, 1u, kQuads + 1, kQuads + 2}) {
        indices.push_back(static_cast<uint8_t>(first + corner));
      }
    }
    std::vector<float> positions;
    std::vector<uint32_t> all_indices;
    for (uint32_t tile = 0; tile < count_; ++tile) {
      for (const uint8_t index : indices) all_indices.push_back(tile * kVertices + index);
      for (uint32_t vertex = 0; vertex < kVertices; ++vertex) {
        const auto x = static_cast<float>(tile % edge_ * kQuads + vertex % (kQuads + 1));
        const auto z = static_cast<float>(tile / edge_ * kQuads + vertex / (kQuads + 1));
        positions.insert(positions.end(), {x, std::sin(0.31f * x) + std::cos(0.23f * z + x), z});
      }
    }
    indices_ = CreateUploadBuffer(device_, indices, "indices of a tile").value();
    all_indices_ = CreateUploadBuffer(device_, all_indices, "indices").value();
    positions_ = CreateUploadBuffer(device_, positions, "positions").value();
  }

  Buffer memory(uint64_t bytes, ResourceStates state) {
    BufferDesc desc;
    desc.SizeInBytes = std::max<uint64_t>(bytes, 256);
    desc.Flags = ResourceFlags::kAllowUnorderedAccess;
    desc.InitialState = state;
    return device_.CreateBuffer(desc).value();
  }

  // Records it, and runs it once.
  template <class Args>
  Operation operation(const RtasOperationInputs& inputs, const std::vector<Args>& arguments,
                      uint32_t results) {
    const auto sizes = device_.GetRTASOperationPrebuildInfo(inputs);
    Operation out;
    out.results =
        memory(sizes.ResultDataMaxSizeInBytes, ResourceStates::kRaytracingAccelerationStructure);
    out.addresses = memory(results * sizeof(uint64_t), ResourceStates::kUnorderedAccess);
    out.scratch = memory(sizes.ScratchDataSizeInBytes, ResourceStates::kUnorderedAccess);
    out.arguments = CreateUploadBuffer(device_, arguments, "arguments").value();
    RtasBatchedOperationData data;
    data.BatchResultData = out.results.GetGPUVirtualAddress();
    data.BatchScratchData = out.scratch.GetGPUVirtualAddress();
    data.ResultAddressArray = {out.addresses.GetGPUVirtualAddress(), 0};
    data.IndirectArgumentArray = {out.arguments.GetGPUVirtualAddress(), 0};
    RtasOperationDesc desc;
    desc.pInputs = &inputs;
    desc.pBatchedOperationData = &data;
    out.list = device_.CreateCommandList().value();
    out.list.ExecuteIndirectRTASOperations({&desc, 1});
    out.list.Close().value();
    run(out.list);
    return out;
  }

  static RtasClusterLimits limits(uint32_t count) {
    RtasClusterLimits limits;
    limits.MaxArgCount = count;
    limits.MaxTriangleCountPerCluster = kTriangles;
    limits.MaxVertexCountPerCluster = kVertices;
    limits.MaxTotalTriangleCount = count * kTriangles;
    limits.MaxTotalVertexCount = count * kVertices;
    return limits;
  }

  RtasBuildClasFromTrianglesArgs tile_args() const {
    RtasBuildClasFromTrianglesArgs args;
    args.TriangleCount = kTriangles;
    args.VertexCount = kVertices;
    args.BaseGeometryIndexAndFlags = kRtasClusteredGeometryOpaque;
    args.IndexBuffer = indices_.GetGPUVirtualAddress();
    return args;
  }
  GpuVirtualAddress positions_of(uint32_t tile) const {
    return positions_.GetGPUVirtualAddress() + uint64_t{tile} * kVertices * 3 * sizeof(float);
  }

  RtasOperationInputs template_inputs() {
    template_desc_.Limits = limits(1);
    RtasOperationInputs inputs;
    inputs.Type = RtasOperationType::kBuildClusterTemplatesFromTriangles;
    inputs.pClusterTemplateTrianglesDesc = &template_desc_;
    return inputs;
  }
  RtasBuildClusterTemplatesFromTrianglesArgs template_args() const {
    RtasBuildClusterTemplatesFromTrianglesArgs args;
    args.TrianglesArgs = tile_args();
    return args;
  }
  RtasOperationInputs cluster_inputs() {
    cluster_desc_.Limits = limits(count_);
    RtasOperationInputs inputs;
    inputs.Type = RtasOperationType::kBuildClasFromTriangles;
    inputs.pClusterTrianglesDesc = &cluster_desc_;
    return inputs;
  }
  std::vector<RtasBuildClasFromTrianglesArgs> cluster_args() const {
    std::vector<RtasBuildClasFromTrianglesArgs> args(count_, tile_args());
    for (uint32_t i = 0; i < count_; ++i) {
      args[i].ClusterID = i;
      args[i].VertexBuffer = positions_of(i);
    }
    return args;
  }
  RtasOperationInputs instance_inputs() {
    instance_desc_.Limits = limits(count_);
    RtasOperationInputs inputs;
    inputs.Type = RtasOperationType::kInstantiateClusterTemplates;
    inputs.pInstantiateClusterTemplateDesc = &instance_desc_;
    return inputs;
  }
  std::vector<RtasInstantiateClusterTemplatesArgs> instance_args() const {
    std::vector<RtasInstantiateClusterTemplatesArgs> args(count_);
    for (uint32_t i = 0; i < count_; ++i) {
      args[i].ClusterIdOffset = i;
      args[i].ClusterTemplate = tile_.results.GetGPUVirtualAddress();
      args[i].VertexBuffer = {positions_of(i), 3 * sizeof(float)};
    }
    return args;
  }
  RtasOperationInputs level_inputs() {
    level_desc_ = {RtasOperationFlags::kNone, 1, RtasOperationMode::kImplicitDestinations, count_,
                   count_};
    RtasOperationInputs inputs;
    inputs.Type = RtasOperationType::kBuildBlasFromClas;
    inputs.pClasDesc = &level_desc_;
    return inputs;
  }
  RtasBuildBlasFromClasArgs level_args() const {
    return {count_, 0, clusters_.addresses.GetGPUVirtualAddress()};
  }

  void record_classic() {
    RaytracingGeometryDesc geometry;
    geometry.Flags = RaytracingGeometryFlags::kOpaque;
    geometry.Triangles.VertexFormat = Format::kR32G32B32Float;
    geometry.Triangles.VertexCount = count_ * kVertices;
    geometry.Triangles.VertexBuffer = {positions_.GetGPUVirtualAddress(), 12};
    geometry.Triangles.IndexFormat = Format::kR32Uint;
    geometry.Triangles.IndexCount = count_ * kTriangles * 3;
    geometry.Triangles.IndexBuffer = all_indices_.GetGPUVirtualAddress();
    BuildRaytracingAccelerationStructureDesc build;
    build.Inputs.Type = RaytracingAccelerationStructureType::kBottomLevel;
    build.Inputs.NumDescs = 1;
    build.Inputs.pGeometryDescs = &geometry;
    const auto sizes = device_.GetRaytracingAccelerationStructurePrebuildInfo(build.Inputs).value();
    classic_result_ =
        memory(sizes.ResultDataMaxSizeInBytes, ResourceStates::kRaytracingAccelerationStructure);
    classic_scratch_ = memory(sizes.ScratchDataSizeInBytes, ResourceStates::kUnorderedAccess);
    build.DestAccelerationStructureData = classic_result_.GetGPUVirtualAddress();
    build.ScratchAccelerationStructureData = classic_scratch_.GetGPUVirtualAddress();
    classic_ = device_.CreateCommandList().value();
    classic_.BuildRaytracingAccelerationStructure(build);
    classic_.Close().value();
  }

  uint32_t edge_;
  uint32_t count_;
  Device device_;
  CommandQueue queue_;
  Buffer indices_, all_indices_, positions_, classic_result_, classic_scratch_;
  RtasClusterTemplateTrianglesInputsDesc template_desc_;
  RtasClusterTrianglesInputsDesc cluster_desc_;
  RtasInstantiateClusterTemplateInputsDesc instance_desc_;
  RtasClasInputsDesc level_desc_;
  Operation tile_, clusters_, instances_, level_;
  CommandList classic_;
};

using Step = void (Hills::*)();

Case hills_case(const char* name, Step ours, Step baseline) {
  return {name, [=](Fixtures& fixtures, const Measure& measure) {
            Hills hills(fixtures.options(), fixtures.options().quick ? 4 : 64);
            const Pairs times = time_pairs(
                measure, [&] { (hills.*ours)(); }, [&] { (hills.*baseline)(); });
            return Line{name, times.ratio, 1e3 * times.ours, 1e3 * times.baseline, "ms", false};
          }};
}

// Rays from above and below the hills. PrimitiveIndex differs: that of a cluster counts in it.
Line trace(Fixtures& fixtures, const Measure& measure) {
  Hills hills(fixtures.options(), fixtures.options().quick ? 4 : 64);
  const float size = hills.size();
  const ClosestRays rays(hills.device(), hills.queue(), fixtures.options(),
                         random_rays(fixtures.options(), {0, -9, 0}, {size, 9, size}));
  const Buffer clustered = hills.top_of_clusters();
  const Buffer plain = hills.top_of_triangles();
  const CommandList ours = rays.list_for(clustered.GetGPUVirtualAddress());
  const CommandList classic = rays.list_for(plain.GetGPUVirtualAddress());
  hills.run(ours);
  const auto found = rays.results();
  hills.run(classic);
  const auto expected = rays.results();
  for (size_t i = 0; i < found.size(); ++i) {
    if (std::fabs(found[i].t - expected[i].t) <= 1e-3f * std::fabs(expected[i].t)) continue;
    throw std::runtime_error("clusters change what rays hit");
  }
  const Pairs times = time_pairs(
      measure, [&] { hills.run(ours); }, [&] { hills.run(classic); });
  return {"clusters/trace", 1 / times.ratio, 1e3 * times.ours, 1e3 * times.baseline, "ms", true};
}

}  // namespace

std::vector<Case> cluster_cases() {
  return {hills_case("clusters/build", &Hills::build_level, &Hills::build_classic),
          hills_case("clusters/template", &Hills::instantiate, &Hills::build_clusters),
          {"clusters/trace", trace}};
}

}  // namespace kaamos::bench
