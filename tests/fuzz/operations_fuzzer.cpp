// SPDX-License-Identifier: MIT
#include "tests/fuzz/operations_fuzzer.h"

#include <rtapi/upload.h>
#include <shaders/operations.h>

#include <algorithm>
#include <array>
#include <bit>

namespace kaamos::test {

using namespace rtapi;
using Resolution = RtasOperationAddressResolutionFlags;

namespace {

// Of this size buffers are mapped: what reads past the end of one faults at once.
constexpr uint64_t kBytes = 1 << 20;
constexpr uint64_t kUsed = 24 << 10;  // the end of data_, where everything is
constexpr uint64_t kFirst = kBytes - kUsed;
constexpr uint64_t kFloats = kFirst;               // 8 KiB of positions
constexpr uint64_t kIndices = kFirst + (8 << 10);  // 4 KiB of small indices, of 8 bits
constexpr uint64_t kNoise = kIndices + (4 << 10);  // 2 KiB
constexpr uint64_t kArguments = kNoise + (2 << 10);
constexpr uint64_t kPlaces = 96;  // for structures, 2 KiB apart from each other
constexpr uint64_t kPlaceBytes = 2048;
constexpr uint64_t kFirstPlace = kBytes - kPlaces * kPlaceBytes;
constexpr uint64_t kKnown = 24;           // places that operations look for structures at
constexpr uint64_t kSlotBytes = 1 << 10;  // of kNoise: addresses of what is written
constexpr uint64_t kPartitionedBytes = 96 << 10;
constexpr uint64_t kFirstPartitioned = 0;  // three of them
constexpr uint32_t kInstances = 8;         // of look()

}  // namespace

OperationsFuzzer::OperationsFuzzer(const std::string& backend, bool checked, uint64_t seed)
    : random_(seed) {
  DeviceDesc desc;
  desc.Backend = backend;
  desc.Checked = checked;
  desc.ShaderModel = kExperimentalShaderModel;
  desc.IndirectRtasOperations = true;
  desc.OnMessage = [this](const Message& message) { notes_ += message.Id.number == 788 ? 1 : 0; };
  device_ = CreateDevice(desc).value();
  queue_ = device_.CreateCommandQueue().value();
  root_signature_ = device_.CreateRootSignature("SRV(t0), UAV(u0)").value();
  const ShaderLibrary library = LoadShaderLibrary(kaamos_shaders_operations()).value();
  pipeline_ =
      device_.CreateComputePipelineState({root_signature_, library, "Look", "look"}).value();
  const auto buffer = [&](uint64_t bytes, bool structure, const char* name) {
    return device_
        .CreateBuffer({.SizeInBytes = bytes,
                       .Flags = ResourceFlags::kAllowUnorderedAccess,
                       .InitialState = structure ? ResourceStates::kRaytracingAccelerationStructure
                                                 : ResourceStates::kUnorderedAccess,
                       .Name = name})
        .value();
  };
  data_ = CreateUploadBuffer(device_, std::vector<std::byte>(kBytes), "data").value();
  structures_ = buffer(kBytes, true, "structures");
  results_ = buffer(kBytes, false, "results");
  scratch_ = buffer(256, false, "scratch");
  hits_buffer_ = buffer(16, false, "hits");
  readback_ = device_.CreateBuffer({.SizeInBytes = 16, .Heap = HeapType::kReadback}).value();
  BuildRaytracingAccelerationStructureInputs inputs;
  inputs.Type = RaytracingAccelerationStructureType::kTopLevel;
  inputs.NumDescs = kInstances;
  inputs.InstanceDescs = data_.GetGPUVirtualAddress();
  const auto sizes = device_.GetRaytracingAccelerationStructurePrebuildInfo(inputs).value();
  top_ = buffer(sizes.ResultDataMaxSizeInBytes, true, "top level");
  top_scratch_ = buffer(std::max<uint64_t>(sizes.ScratchDataSizeInBytes, 256), false, "scratch");
  host_ = data_.Map().value().data();
  build_micromaps();
}

// Three of level 1, with other states each.
void OperationsFuzzer::build_micromaps() {
  constexpr uint32_t kCount = 3;
  const RaytracingOpacityMicromapHistogramEntry histogram = {
      kCount, 1, RaytracingOpacityMicromapFormat::kOc1_4State};
  const std::vector<RaytracingOpacityMicromapDesc> descs = {{0, 1, 2}, {1, 1, 2}, {2, 1, 2}};
  const std::vector<uint32_t> states = {0x1BE400};
  const Buffer desc_buffer = CreateUploadBuffer(device_, descs).value();
  const Buffer state_buffer = CreateUploadBuffer(device_, states).value();
  RaytracingOpacityMicromapArrayDesc array;
  array.NumOmmHistogramEntries = 1;
  array.pOmmHistogram = &histogram;
  array.InputBuffer = state_buffer.GetGPUVirtualAddress();
  array.PerOmmDescs = {desc_buffer.GetGPUVirtualAddress(), sizeof(descs[0])};
  BuildRaytracingAccelerationStructureInputs inputs;
  inputs.Type = RaytracingAccelerationStructureType::kOpacityMicromapArray;
  inputs.NumDescs = 1;
  inputs.pOpacityMicromapArrayDesc = &array;
  micromaps_ = BuildAccelerationStructure(device_, queue_, inputs, "micromaps").value();
}

uint64_t OperationsFuzzer::wild_address() {
  switch (below(6)) {
    case 0:
      return 0;
    case 1:
      return random_();
    case 2:  // about the end of a buffer
      return one_of({data_, results_, structures_}).GetGPUVirtualAddress() + kBytes - 64 +
             8 * below(16);
    case 3:
      return structures_.GetGPUVirtualAddress() + kFirstPlace + below(kPlaces * kPlaceBytes);
    default:
      return data_.GetGPUVirtualAddress() + kFirst + below(kUsed);
  }
}

uint64_t OperationsFuzzer::readable(uint64_t usual) {
  return rarely() ? wild_address() : usual;
}

uint64_t OperationsFuzzer::put(const void* bytes, size_t count) {
  constexpr size_t kRoom = kBytes - kArguments;
  size_t at = (used_ + 31) / 32 * 32;
  if (at + count > kRoom || rarely()) at = kRoom - std::min(kRoom, (count + 7) / 8 * 8);
  if (rarely()) at = std::min(kRoom, at + 8 * below(8));  // the end is cut off
  std::memcpy(host_ + kArguments + at, bytes, std::min(count, kRoom - at));
  used_ = at + count < kRoom ? at + count : 0;
  return data_.GetGPUVirtualAddress() + kArguments + at;
}

uint64_t OperationsFuzzer::target() {
  const uint64_t first = results_.GetGPUVirtualAddress();
  switch (below(12)) {
    case 0:
      return first + kBytes - 64 + 8 * below(16);
    case 1:
      return 0;
    case 2:
      return structures_.GetGPUVirtualAddress() + kFirstPlace +
             8 * below(kPlaces * kPlaceBytes / 8);
    default:
      return first + 8 * below(512);
  }
}

uint64_t OperationsFuzzer::structure() {
  if (known_.empty() || rarely()) return wild_address();
  return known_[below(known_.size())];
}

uint64_t OperationsFuzzer::place() {
  const uint64_t address =
      structures_.GetGPUVirtualAddress() + kFirstPlace + kPlaceBytes * below(kPlaces);
  if (known_.size() < kKnown) known_.push_back(address);
  known_[below(known_.size())] = address;
  return rarely() ? address + 128 * below(16) : address;
}

// Apart from the others, since they take more bytes.
uint64_t OperationsFuzzer::partitioned_place() {
  return structures_.GetGPUVirtualAddress() + kFirstPartitioned + kPartitionedBytes * below(3);
}

void OperationsFuzzer::resolve(uint64_t& address, Resolution flag, Operation& operation) {
  if (below(8) != 0) return;
  operation.batch.AddressResolutionFlags |= flag;
  // In a place of its own: what arguments overwrite might be taken for where results go.
  const uint64_t at = kNoise + slots_ * sizeof(address);
  slots_ = (slots_ + 1) % (kSlotBytes / sizeof(address));
  std::memcpy(host_ + at, &address, sizeof(address));
  address = rarely() ? one_of({uint64_t{0}, random_(), data_.GetGPUVirtualAddress() + kBytes})
                     : data_.GetGPUVirtualAddress() + at;
}

void OperationsFuzzer::fill_data() {
  const auto store = [&](uint64_t offset, auto value) {
    std::memcpy(host_ + offset, &value, sizeof(value));
  };
  for (uint64_t at = kFloats; at < kIndices; at += 4) {
    const bool wild = below(64) == 0;
    const float usual = static_cast<float>(below(4001)) / 1000 - 2;
    store(at, wild ? static_cast<uint32_t>(random_()) : std::bit_cast<uint32_t>(usual));
  }
  for (uint64_t at = kIndices; at < kNoise; ++at) {
    store(at, static_cast<uint8_t>(below(64) == 0 ? random_() : below(12)));
  }
  for (uint64_t at = kNoise + kSlotBytes; at < kArguments; at += 8) store(at, random_());
}

RtasClusterLimits OperationsFuzzer::limits() {
  RtasClusterLimits limits;
  limits.MaxArgCount = mostly<uint32_t>(static_cast<uint32_t>(1 + below(6)));
  limits.MaxGeometryIndexValue = kRtasMaximumGeometryIndex;
  limits.MaxUniqueGeometryIndexAndFlagsCountPerCluster = static_cast<uint32_t>(below(8));
  limits.MaxTriangleCountPerCluster = static_cast<uint32_t>(below(257));
  limits.MaxVertexCountPerCluster = static_cast<uint32_t>(below(257));
  limits.MaxTotalTriangleCount = mostly<uint32_t>(300);
  limits.MaxTotalVertexCount = mostly<uint32_t>(300);
  limits.MaxOpacityMicromapIndicesPerCluster = static_cast<uint32_t>(below(64));
  return limits;
}

RtasOperationFlags OperationsFuzzer::flags() {
  using Flags = RtasOperationFlags;
  return one_of({Flags::kNone, Flags::kFastTrace, Flags::kFastOperation, Flags::kAllowDataAccess,
                 Flags::kAllowOmm, Flags::kAllowOmm | Flags::kAllowDataAccess});
}

RtasOperationMode OperationsFuzzer::mode() {
  return static_cast<RtasOperationMode>(std::min<uint64_t>(below(5), 2) % 3);
}

RtasVertexFormat OperationsFuzzer::vertex_format() {
  return below(3) == 0 ? static_cast<RtasVertexFormat>(1 + below(14))
                       : RtasVertexFormat::kFloat32x3;
}

RtasIndexFormat OperationsFuzzer::index_format(bool may_be_none) {
  if (may_be_none && below(2) == 0) return RtasIndexFormat::kNone;
  return below(2) == 0 ? RtasIndexFormat::kUint8 : static_cast<RtasIndexFormat>(1u << below(3));
}

RtasBuildClasFromTrianglesArgs OperationsFuzzer::triangles() {
  const uint64_t data = data_.GetGPUVirtualAddress();
  const auto number = [&](uint64_t n) { return static_cast<uint16_t>(below(n)); };
  RtasBuildClasFromTrianglesArgs args;
  args.ClusterID = static_cast<uint32_t>(random_());
  args.ClusterFlags = static_cast<RtasClusterFlags>(mostly(static_cast<uint32_t>(below(4))));
  args.TriangleCount = mostly(rarely() ? number(300) : number(12));
  args.VertexCount = mostly(rarely() ? number(300) : static_cast<uint16_t>(8 + below(8)));
  args.BaseGeometryIndexAndFlags =
      below(2) == 0 ? kRtasClusteredGeometryOpaque : mostly(static_cast<uint32_t>(below(4)));
  args.OpacityMicromapBaseLocation = mostly<uint32_t>(0);
  args.VertexBufferStride = mostly(one_of<uint16_t>({0, 0, 12, 16}));
  args.IndexBufferStride = mostly(one_of<uint16_t>({0, 0, 4}));
  args.OpacityMicromapIndexBufferStride = mostly<uint16_t>(0);
  args.GeometryIndexAndFlagsArrayStride = mostly(one_of<uint16_t>({0, 4, 8}));
  args.PositionTruncateBitCount = mostly<uint16_t>(0);
  args.VertexBuffer = readable(data + kFloats + 12 * below(128));
  args.IndexBuffer = readable(data + kIndices + 4 * below(512));
  if (below(3) == 0)
    args.GeometryIndexAndFlagsArray = readable(data + kNoise + kSlotBytes + 4 * below(128));
  if (below(3) == 0) {
    args.GeometryIndexAndFlagsIndexBuffer = readable(data + kIndices + 4 * below(512));
  }
  if (below(3) == 0) {
    args.OpacityMicromapArray = rarely() ? structure() : micromaps_.GetGPUVirtualAddress();
  }
  if (below(4) == 0) args.OpacityMicromapIndexBuffer = readable(data + kIndices + 4 * below(512));
  return args;
}

template <class Args>
void OperationsFuzzer::make_batch(Operation& operation, RtasOperationMode mode,
                                  const std::vector<Args>& args) {
  RtasBatchedOperationData& batch = operation.batch;
  operation.desc.pBatchedOperationData = &batch;
  batch.BatchResultData = place();
  batch.BatchScratchData = scratch_.GetGPUVirtualAddress();
  std::vector<uint64_t> places(args.size());
  for (uint64_t& each : places) each = rarely() ? wild_address() : place();
  const bool reads = mode == RtasOperationMode::kExplicitDestinations;
  batch.ResultAddressArray = {reads ? readable(put(places)) : target(), 8 * below(3)};
  batch.ResultSizeArray = {target(), mostly(8 * below(3)) / 8 * 8};
  batch.IndirectArgumentArray = {readable(put(args)), rarely() ? 8 * below(32) : 0};
  if (below(2) == 0) {
    batch.IndirectArgumentArraySize =
        put(std::vector<uint32_t>{mostly(static_cast<uint32_t>(args.size()))});
  }
  if (below(4) == 0) batch.ToolsInfo = target();
  resolve(batch.BatchResultData, Resolution::kIndirectedBatchResult, operation);
  resolve(batch.BatchScratchData, Resolution::kIndirectedBatchScratch, operation);
  resolve(batch.ResultAddressArray.StartAddress, Resolution::kIndirectedDestinationAddressArray,
          operation);
  resolve(batch.ResultSizeArray.StartAddress, Resolution::kIndirectedResultSizeArray, operation);
  resolve(batch.IndirectArgumentArray.StartAddress, Resolution::kIndirectedIndirectArgumentArray,
          operation);
  if (batch.IndirectArgumentArraySize != 0) {
    resolve(batch.IndirectArgumentArraySize, Resolution::kIndirectedIndirectArgumentCount,
            operation);
  }
}

void OperationsFuzzer::make_triangles(Operation& operation) {
  RtasClusterTrianglesInputsDesc& desc = operation.triangles;
  desc.Limits = limits();
  desc.Flags = flags();
  desc.Mode = mode();
  desc.VertexFormat = vertex_format();
  desc.IndexFormat = index_format(false);
  desc.GeometryIndexAndFlagsIndexFormat = index_format(true);
  desc.OpacityMicromapIndexFormat = index_format(true);
  desc.MinPositionTruncateBitCount = mostly(0u);
  operation.inputs.Type = RtasOperationType::kBuildClasFromTriangles;
  operation.inputs.pClusterTrianglesDesc = &desc;
  std::vector<RtasBuildClasFromTrianglesArgs> args(1 + below(5));
  for (auto& each : args) each = triangles();
  make_batch(operation, desc.Mode, args);
}

void OperationsFuzzer::make_templates(Operation& operation) {
  RtasClusterTemplateTrianglesInputsDesc& desc = operation.templates;
  desc.Limits = limits();
  desc.Flags = flags();
  desc.Mode = mode();
  desc.VertexInstantiationFormat = vertex_format();
  desc.IndexFormat = index_format(false);
  desc.GeometryIndexAndFlagsIndexFormat = index_format(true);
  desc.OpacityMicromapIndexFormat = index_format(true);
  operation.inputs.Type = RtasOperationType::kBuildClusterTemplatesFromTriangles;
  operation.inputs.pClusterTemplateTrianglesDesc = &desc;
  std::vector<RtasBuildClusterTemplatesFromTrianglesArgs> args(1 + below(5));
  for (auto& each : args) {
    each.TrianglesArgs = triangles();
    if (desc.VertexInstantiationFormat == RtasVertexFormat::kCompressed1) {
      each.Compressed1TemplateHeader = static_cast<uint32_t>(random_());
    } else if (below(3) == 0) {
      each.InstantiationBoundingBoxLimit =
          readable(data_.GetGPUVirtualAddress() + kFloats + 32 * below(64));
    }
  }
  make_batch(operation, desc.Mode, args);
}

void OperationsFuzzer::make_instances(Operation& operation) {
  RtasInstantiateClusterTemplateInputsDesc& desc = operation.instances;
  desc.Limits = limits();
  desc.Flags = flags();
  desc.Mode = mode();
  desc.VertexSourceFormat = vertex_format();
  operation.inputs.Type = RtasOperationType::kInstantiateClusterTemplates;
  operation.inputs.pInstantiateClusterTemplateDesc = &desc;
  std::vector<RtasInstantiateClusterTemplatesArgs> args(1 + below(5));
  for (auto& each : args) {
    each.GeometryIndexOffset = mostly(static_cast<int32_t>(below(3)));
    each.ClusterIdOffset = static_cast<uint32_t>(random_());
    each.ClusterTemplate = structure();
    each.VertexBuffer = {readable(data_.GetGPUVirtualAddress() + kFloats + 12 * below(128)),
                         mostly(one_of<uint64_t>({0, 12, 16}))};
  }
  make_batch(operation, desc.Mode, args);
}

void OperationsFuzzer::make_levels(Operation& operation) {
  RtasClasInputsDesc& desc = operation.levels;
  desc.Flags = one_of({RtasOperationFlags::kNone, RtasOperationFlags::kAllowOmm});
  desc.MaxArgCount = mostly(static_cast<uint32_t>(1 + below(4)));
  desc.Mode = mode();
  desc.MaxTotalClasCount = mostly(static_cast<uint32_t>(8 + below(32)));
  desc.MaxClasCountPerArg = mostly(static_cast<uint32_t>(1 + below(16)));
  operation.inputs.Type = RtasOperationType::kBuildBlasFromClas;
  operation.inputs.pClasDesc = &desc;
  std::vector<RtasBuildBlasFromClasArgs> args(1 + below(3));
  for (auto& each : args) {
    std::vector<uint64_t> clusters(1 + below(6));
    for (uint64_t& cluster : clusters) cluster = structure();
    each.ClasAddressCount = mostly(static_cast<uint32_t>(clusters.size()));
    each.ClasAddressStride = mostly(0u);
    const uint64_t results = results_.GetGPUVirtualAddress() + 8 * below(512);
    each.ClasAddressArray = readable(below(2) == 0 ? put(clusters) : results);
  }
  make_batch(operation, desc.Mode, args);
}

void OperationsFuzzer::make_moves(Operation& operation) {
  RtasClusterMovesDesc& desc = operation.moves;
  using Flags = RtasClusterMoveOperationFlags;
  desc.Flags = one_of({Flags::kNone, Flags::kNoOverlap, Flags::kAllowOmm});
  desc.MaxArgCount = mostly(static_cast<uint32_t>(1 + below(4)));
  desc.Mode = mode();
  desc.Type = static_cast<RtasMoveOperationType>(below(3));
  desc.MaxBytesMoved = mostly<uint64_t>(4096);
  operation.inputs.Type = RtasOperationType::kMoveClusterObjects;
  operation.inputs.pClusterMovesDesc = &desc;
  std::vector<RtasMoveClusterObjectsArgs> args(1 + below(5));
  for (auto& each : args) each.SourceAccelerationStructure = structure();
  make_batch(operation, desc.Mode, args);
}

void OperationsFuzzer::make(Operation& operation) {
  operation.desc.pInputs = &operation.inputs;
  using Make = void (OperationsFuzzer::*)(Operation&);
  static constexpr Make kMakes[] = {
      &OperationsFuzzer::make_triangles, &OperationsFuzzer::make_triangles,
      &OperationsFuzzer::make_templates, &OperationsFuzzer::make_instances,
      &OperationsFuzzer::make_levels,    &OperationsFuzzer::make_levels,
      &OperationsFuzzer::make_moves,     &OperationsFuzzer::make_partitioned};
  (this->*kMakes[below(std::size(kMakes))])(operation);
}

std::string OperationsFuzzer::execute(CommandList& list) {
  if (const Status closed = list.Close(); !closed) {
    ++refused_;
    return {};
  }
  const Status done = queue_.ExecuteAndWait(list);
  return done ? std::string() : done.error().message;
}

std::string OperationsFuzzer::round() {
  if (below(64) == 0) fill_data();
  used_ = 0;
  std::array<Operation, 3> operations;
  std::vector<RtasOperationDesc> descs;
  const size_t count = 1 + below(operations.size());
  for (size_t i = 0; i < count; ++i) {
    make(operations[i]);
    descs.push_back(operations[i].desc);
  }
  std::vector<std::byte> expected(host_ + kFirst, host_ + kBytes);
  CommandList list = device_.CreateCommandList().value();
  list.ExecuteIndirectRTASOperations(descs);
  std::string wrong = execute(list);
  if (wrong.empty() && std::memcmp(expected.data(), host_ + kFirst, kUsed) != 0) {
    wrong = "arguments were written to";
  }
  return wrong;
}

void OperationsFuzzer::trace(CommandList& list, uint64_t top_level) {
  list.SetComputeRootSignature(root_signature_);
  list.SetPipelineState(pipeline_);
  list.SetComputeRootShaderResourceView(0, top_level);
  list.SetComputeRootUnorderedAccessView(1, hits_buffer_.GetGPUVirtualAddress());
  list.Dispatch(1, 1, 1);
  list.ResourceBarrier(ResourceBarrier::Uav(hits_buffer_));
}

std::string OperationsFuzzer::look() {
  std::vector<RaytracingInstanceDesc> instances(kInstances);
  for (auto& each : instances) each.AccelerationStructure = structure();
  BuildRaytracingAccelerationStructureDesc build;
  build.Inputs.Type = RaytracingAccelerationStructureType::kTopLevel;
  build.Inputs.NumDescs = kInstances;
  used_ = 0;
  std::memcpy(host_ + kArguments, instances.data(), kInstances * sizeof(instances[0]));
  build.Inputs.InstanceDescs = data_.GetGPUVirtualAddress() + kArguments;
  build.DestAccelerationStructureData = top_.GetGPUVirtualAddress();
  build.ScratchAccelerationStructureData = top_scratch_.GetGPUVirtualAddress();
  CommandList list = device_.CreateCommandList().value();
  list.BuildRaytracingAccelerationStructure(build);
  list.ResourceBarrier(ResourceBarrier::Uav(top_));
  trace(list, top_.GetGPUVirtualAddress());
  trace(list, partitioned_place());
  list.ResourceBarrier(ResourceBarrier::Transition(hits_buffer_, ResourceStates::kUnorderedAccess,
                                                   ResourceStates::kCopySource));
  list.CopyBufferRegion(readback_, 0, hits_buffer_, 0, 16);
  list.ResourceBarrier(ResourceBarrier::Transition(hits_buffer_, ResourceStates::kCopySource,
                                                   ResourceStates::kUnorderedAccess));
  const uint64_t refused = refused_;
  std::string wrong = execute(list);
  if (refused_ != refused) return "rays were refused";
  uint32_t hits = 0;
  std::memcpy(&hits, readback_.Map().value().data(), sizeof(hits));
  hits_ = hits;
  return wrong;
}

}  // namespace kaamos::test
