// SPDX-License-Identifier: MIT
//
// ptlas/...: operations on a partitioned top level over builds of a top level of the same 100,000
// instances, and rays through the one over rays through the other. [DXR 2.0: Partitioned TLAS]
#include <rtapi/rtas_operations.h>
#include <rtapi/upload.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>
#include <random>
#include <stdexcept>

#include "closest_rays.h"
#include "fixtures.h"
#include "tests/common/structures.h"

namespace kaamos::bench {
namespace {

using namespace rtapi;
using WriteArgs = RtasPartitionedTlasWriteInstanceArgs;
using TranslateArgs = RtasPartitionedTlasTranslatePartitionArgs;

enum class Change { kMove, kMoveScattered, kTranslate };

// Instances of a pyramid on a grid, in partitions that are blocks of it.
class Field {
 public:
  Field(const Options& options, uint32_t count) : count_(count) {
    DeviceDesc desc;
    desc.Threads = options.threads;
    desc.Precision = options.precision;
    desc.ShaderModel = ShaderModel::k6_10;
    desc.IndirectRtasOperations = true;
    device_ = CreateDevice(desc).value();
    queue_ = device_.CreateCommandQueue().value();
    edge_ = static_cast<uint32_t>(std::ceil(std::cbrt(count)));
    blocks_ = (edge_ + kBlock - 1) / kBlock;
    build_pyramid();
    for (uint32_t i = 0; i < count; ++i) writes_.push_back(write(i));
    inputs_.Flags = RtasPartitionedTlasFlags::kEnablePartitionTranslation;
    inputs_.InstanceCount = count;
    inputs_.PartitionCount = blocks_ * blocks_ * blocks_;
    inputs_.MaxInstancePerPartitionCount = kBlock * kBlock * kBlock;
    RtasOperationInputs in;
    in.Type = RtasOperationType::kPartitionedTlas;
    in.pPartitionedTLASInputsDesc = &inputs_;
    const auto sizes = device_.GetRTASOperationPrebuildInfo(in);
    partitioned_ = structure(sizes.ResultDataMaxSizeInBytes);
    scratch_ = structure(std::max<uint64_t>(sizes.ScratchDataSizeInBytes, 256));
    run(operation(writes_, false));
    build_classic();
  }

  // Two lists that change 1 % of the instances to and fro.
  void record(Change change) {
    for (int i = 0; i < 2; ++i) changes_[i] = list_of(change, 0.4f * static_cast<float>(i));
  }
  void run_change() { run(changes_[next_++ % 2]); }
  void run_classic() { run(classic_list_); }

  const Device& device() const { return device_; }
  void run(const CommandList& list) { queue_.ExecuteAndWait(list).value(); }
  const Buffer& partitioned() const { return partitioned_; }
  const Buffer& classic() const { return classic_; }
  CommandQueue& queue() { return queue_; }
  float size() const { return 3 * static_cast<float>(edge_); }

 private:
  static constexpr uint32_t kBlock = 7;

  void build_pyramid() {
    const std::vector<float> xyz = {-1, -1, -1, 1, -1, -1, 0, -1, 1, 0, 1, 0};
    vertices_ = CreateUploadBuffer(device_, xyz, "vertices").value();
    indices_ = CreateUploadBuffer(
                   device_, std::vector<uint32_t>{0, 1, 2, 0, 3, 1, 1, 3, 2, 2, 3, 0}, "indices")
                   .value();
    RaytracingGeometryDesc geometry;
    geometry.Flags = RaytracingGeometryFlags::kOpaque;
    geometry.Triangles.VertexFormat = Format::kR32G32B32Float;
    geometry.Triangles.VertexCount = 4;
    geometry.Triangles.VertexBuffer = {vertices_.GetGPUVirtualAddress(), 12};
    geometry.Triangles.IndexFormat = Format::kR32Uint;
    geometry.Triangles.IndexCount = 12;
    geometry.Triangles.IndexBuffer = indices_.GetGPUVirtualAddress();
    pyramid_ = test::build_bottom_level(device_, queue_, {geometry});
  }
  WriteArgs write(uint32_t i) const {
    const uint32_t x = i % edge_;
    const uint32_t y = i / edge_ % edge_;
    const uint32_t z = i / edge_ / edge_;
    const float c = std::cos(static_cast<float>(i));
    const float s = std::sin(static_cast<float>(i));
    const float rows[12] = {c,  0, s, 3 * static_cast<float>(x), 0, 1, 0, 3 * static_cast<float>(y),
                            -s, 0, c, 3 * static_cast<float>(z)};
    WriteArgs args;
    std::memcpy(args.Transform, rows, sizeof(rows));
    args.InstanceIndex = i;
    args.PartitionIndex = (z / kBlock * blocks_ + y / kBlock) * blocks_ + x / kBlock;
    args.AccelerationStructure = pyramid_.GetGPUVirtualAddress();
    return args;
  }
  Buffer structure(uint64_t bytes) {
    BufferDesc desc;
    desc.SizeInBytes = bytes;
    desc.Flags = ResourceFlags::kAllowUnorderedAccess;
    desc.InitialState = ResourceStates::kRaytracingAccelerationStructure;
    return device_.CreateBuffer(desc).value();
  }
  template <typename Args>
  CommandList operation(const std::vector<Args>& args, bool in_place) {
    constexpr bool kWrites = std::is_same_v<Args, WriteArgs>;
    kept_.push_back(CreateUploadBuffer(device_, args, "arguments").value());
    RtasPartitionedTlasOperation one;
    one.Type = kWrites ? RtasPartitionedTlasOperationType::kWriteInstance
                       : RtasPartitionedTlasOperationType::kTranslatePartition;
    one.ArgCount = static_cast<uint32_t>(args.size());
    one.ArgData = {kept_.back().GetGPUVirtualAddress(), 0};
    kept_.push_back(CreateUploadBuffer(device_, std::vector{one}, "operation").value());
    const Buffer& operations = kept_.back();
    kept_.push_back(CreateUploadBuffer(device_, std::vector<uint32_t>{1}, "count").value());
    RtasPartitionedTlasOperationData data;
    data.DestAccelerationStructureData = partitioned_.GetGPUVirtualAddress();
    if (in_place) data.SourceAccelerationStructureData = data.DestAccelerationStructureData;
    data.ScratchAccelerationStructureData = scratch_.GetGPUVirtualAddress();
    data.IndirectPartitionedTlasOps = operations.GetGPUVirtualAddress();
    data.IndirectPartitionedTlasOpCount = kept_.back().GetGPUVirtualAddress();
    RtasOperationInputs in;
    in.Type = RtasOperationType::kPartitionedTlas;
    in.pPartitionedTLASInputsDesc = &inputs_;
    RtasOperationDesc desc;
    desc.pInputs = &in;
    desc.pPartitionedTlasOperationData = &data;
    CommandList list = device_.CreateCommandList().value();
    list.ExecuteIndirectRTASOperations({&desc, 1});
    list.Close().value();
    return list;
  }
  CommandList list_of(Change change, float by) {
    if (change == Change::kTranslate) {
      std::vector<TranslateArgs> args;
      for (uint32_t i = 0; i < std::max(1u, inputs_.PartitionCount / 100); ++i) {
        args.push_back({i, {by, 0, 0}});
      }
      return operation(args, true);
    }
    std::vector<uint32_t> order(count_);
    std::iota(order.begin(), order.end(), 0u);
    if (change == Change::kMoveScattered) {
      std::shuffle(order.begin(), order.end(), std::mt19937(3));
    } else {
      std::stable_sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
        return writes_[a].PartitionIndex < writes_[b].PartitionIndex;
      });
    }
    std::vector<WriteArgs> args;
    for (uint32_t i = 0; i < count_ / 100; ++i) {
      args.push_back(writes_[order[i]]);
      args.back().Transform[0][3] += by;
    }
    return operation(args, true);
  }
  void build_classic() {
    std::vector<RaytracingInstanceDesc> descs(count_);
    for (uint32_t i = 0; i < count_; ++i) {
      std::memcpy(descs[i].Transform, writes_[i].Transform, sizeof(descs[i].Transform));
      descs[i].AccelerationStructure = writes_[i].AccelerationStructure;
    }
    kept_.push_back(CreateUploadBuffer(device_, descs, "instances").value());
    BuildRaytracingAccelerationStructureDesc build;
    build.Inputs.NumDescs = count_;
    build.Inputs.InstanceDescs = kept_.back().GetGPUVirtualAddress();
    const auto sizes = device_.GetRaytracingAccelerationStructurePrebuildInfo(build.Inputs).value();
    classic_ = structure(sizes.ResultDataMaxSizeInBytes);
    kept_.push_back(structure(std::max<uint64_t>(sizes.ScratchDataSizeInBytes, 256)));
    build.DestAccelerationStructureData = classic_.GetGPUVirtualAddress();
    build.ScratchAccelerationStructureData = kept_.back().GetGPUVirtualAddress();
    classic_list_ = device_.CreateCommandList().value();
    classic_list_.BuildRaytracingAccelerationStructure(build);
    classic_list_.Close().value();
    run(classic_list_);
  }

  uint32_t count_;
  uint32_t edge_ = 0;
  uint32_t blocks_ = 0;
  Device device_;
  CommandQueue queue_;
  Buffer vertices_, indices_, pyramid_, partitioned_, scratch_, classic_;
  std::vector<WriteArgs> writes_;
  RtasPartitionedTlasInputsDesc inputs_;
  std::vector<Buffer> kept_;
  CommandList classic_list_;
  CommandList changes_[2];
  uint32_t next_ = 0;
};

uint32_t count_of(const Fixtures& fixtures) {
  return fixtures.options().quick ? 2000 : 100000;
}

Case change_case(const char* name, Change change) {
  return {name, [=](Fixtures& fixtures, const Measure& measure) {
            Field field(fixtures.options(), count_of(fixtures));
            field.record(change);
            const Pairs times = time_pairs(
                measure, [&] { field.run_change(); }, [&] { field.run_classic(); });
            return Line{name, times.ratio, 1e3 * times.ours, 1e3 * times.baseline, "ms", false};
          }};
}

// After moves to and fro, so that the level is one that was changed.
Line trace(Fixtures& fixtures, const Measure& measure) {
  Field field(fixtures.options(), count_of(fixtures));
  field.record(Change::kMoveScattered);
  field.run_change();
  field.run_change();
  field.record(Change::kMoveScattered);
  field.run_change();  // by 0: where the others are
  const float size = field.size();
  const ClosestRays rays(field.device(), field.queue(), fixtures.options(),
                         random_rays(fixtures.options(), {0, 0, 0}, {size, size, size}));
  const CommandList ours = rays.list_for(field.partitioned().GetGPUVirtualAddress());
  const CommandList classic = rays.list_for(field.classic().GetGPUVirtualAddress());
  field.run(ours);
  const auto found = rays.results();
  field.run(classic);
  const auto same = [](const ClosestResult& x, const ClosestResult& y) {
    return x.t == y.t && x.primitive == y.primitive;
  };
  const auto other = rays.results();
  if (!std::equal(found.begin(), found.end(), other.begin(), same))
    throw std::runtime_error("partitions change what rays hit");
  const Pairs times = time_pairs(
      measure, [&] { field.run(ours); }, [&] { field.run(classic); });
  return {"ptlas/trace", 1 / times.ratio, 1e3 * times.ours, 1e3 * times.baseline, "ms", true};
}

}  // namespace

std::vector<Case> partition_cases() {
  return {change_case("ptlas/move", Change::kMove),
          change_case("ptlas/move-scattered", Change::kMoveScattered),
          change_case("ptlas/translate", Change::kTranslate),
          {"ptlas/trace", trace}};
}

}  // namespace kaamos::bench
