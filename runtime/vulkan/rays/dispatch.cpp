// SPDX-License-Identifier: MIT
#include "runtime/vulkan/rays/dispatch.h"

#include <algorithm>
#include <cstdio>
#include <cstring>

#include "runtime/backend/errors.h"
#include "runtime/backend/printing.h"
#include "runtime/backend/ray_flags.h"
#include "runtime/errors/text.h"
#include "runtime/vulkan/memory/fault_guard.h"
#include "runtime/vulkan/rays/checks.h"
#include "runtime/vulkan/rays/state_object.h"

namespace kaamos::vulkan {
namespace {

using shader::spirv::DispatchBlock;
using shader::spirv::DispatchFeedback;
using shader::spirv::TwinTables;

// One of the application's tables, where its copy in the driver's form goes, and how many records
// it has.
struct Table {
  const char* name;
  runtime::RecordKind kind;
  ApplicationTable source;
  uint64_t offset = 0;   // in the buffer
  uint64_t records = 0;  // records written: the application's, followed by null records
  uint64_t twins = 0;    // of the callable table: records of twins, which follow

  // With a stride of 0 every index means the first record.
  bool repeats() const { return source.count() == 1 && source.stride_bytes == 0; }
  // The shader compares its index with this limit; the record at this index is a null record.
  uint32_t limit() const {
    return repeats() ? UINT32_MAX
                     : static_cast<uint32_t>(std::min<uint64_t>(source.count(), UINT32_MAX));
  }
};

enum TableIndex { kRayGeneration, kMiss, kCallable, kHitGroup, kTableCount };

class RaysDispatch {
 public:
  RaysDispatch(const DispatchEnvironment& environment, const runtime::DispatchRaysCommand& command,
               const std::string& label)
      : environment_(environment),
        command_(command),
        pipeline_(static_cast<const RaytracingPipeline&>(*command.pipeline)),
        gpu_(environment.stream->gpu()),
        label_(label) {}

  CountedOutcome run() {
    result_.status = execute();
    return std::move(result_);
  }

 private:
  rtapi::Status execute();
  rtapi::Status find_tables();
  rtapi::Status find_table(TableIndex index, const char* name, runtime::RecordKind kind,
                           uint64_t address, uint64_t size_bytes, uint64_t stride_bytes);
  rtapi::Status check_stack() const;
  rtapi::Status place_tables(uint64_t start, uint64_t max_hit_record);
  void write_table(const Table& table);
  void place_twins();
  void write_twins();
  void warn_of_status();
  GridLimits limits() const;
  rtapi::Status trace(const std::vector<GridPart>& parts);
  VkStridedDeviceAddressRegionKHR region(TableIndex index) const;

  const DispatchEnvironment& environment_;
  const runtime::DispatchRaysCommand& command_;
  const RaytracingPipeline& pipeline_;
  Gpu& gpu_;
  const std::string& label_;
  TableLayout layout_;
  Table tables_[kTableCount];
  uint64_t bytes_ = 0;  // size of everything in the buffer
  TwinTables twins_;
  uint64_t twin_tables_ = 0;  // where TwinTables is in it; 0: no shader uses hit objects
  const GpuBuffer* buffer_ = nullptr;
  CountedOutcome result_;
};

rtapi::Status RaysDispatch::find_table(TableIndex index, const char* name, runtime::RecordKind kind,
                                       uint64_t address, uint64_t size_bytes,
                                       uint64_t stride_bytes) {
  Table& table = tables_[index];
  table.name = name;
  table.kind = kind;
  if (address == 0 || size_bytes < kIdentifierBytes) return {};
  table.source = {environment_.memory->host(address, size_bytes), address, size_bytes,
                  stride_bytes};
  if (table.source.host != nullptr) return {};
  return runtime::make_error(runtime::Id::kShaderFault,
                             "the " + std::string(name) + " table at address " +
                                 errors::hex(address) + ", " + std::to_string(size_bytes) +
                                 " bytes, is not inside a live buffer (" + label_ + ").");
}

rtapi::Status RaysDispatch::find_tables() {
  const rtapi::DispatchRaysDesc& desc = command_.desc;
  const auto& ray_generation = desc.RayGenerationShaderRecord;
  // A single record, of any size, without a stride. [DXR: Shader tables]
  auto s = find_table(kRayGeneration, "ray generation", runtime::RecordKind::kRayGeneration,
                      ray_generation.StartAddress,
                      std::max<uint64_t>(ray_generation.SizeInBytes, kIdentifierBytes), 0);
  if (!s) return s;
  const auto find = [&](TableIndex index, const char* name, runtime::RecordKind kind,
                        const rtapi::GpuVirtualAddressRangeAndStride& range) {
    return find_table(index, name, kind, range.StartAddress, range.SizeInBytes,
                      range.StrideInBytes);
  };
  s = find(kMiss, "miss", runtime::RecordKind::kMiss, desc.MissShaderTable);
  if (s) s = find(kCallable, "callable", runtime::RecordKind::kCallable, desc.CallableShaderTable);
  if (s) s = find(kHitGroup, "hit group", runtime::RecordKind::kHitGroup, desc.HitGroupTable);
  return s;
}

// In Vulkan the application cannot choose the stack size. What the ray generation shader takes is
// known before anything runs; deeper calls end at kMaxCallableDepth.
rtapi::Status RaysDispatch::check_stack() const {
  const uint8_t* identifier = tables_[kRayGeneration].source.host;
  const auto* record = pipeline_.linked().identifiers.find(identifier);
  if (command_.pipeline_stack_bytes == 0 || record == nullptr || record->shader == nullptr ||
      record->shader->stack_bytes <= command_.pipeline_stack_bytes) {
    return {};
  }
  return runtime::make_error(
      runtime::Id::kShaderStack,
      "\"" + record->name + "\" takes " + std::to_string(record->shader->stack_bytes) +
          " bytes of stack, but SetPipelineStackSize set " +
          std::to_string(command_.pipeline_stack_bytes) + " (" + label_ + ").");
}

// A driver computes the index of the hit record itself, so there must be null records up to the
// largest index that is possible. For miss and callable indices the shader checks the range.
rtapi::Status RaysDispatch::place_tables(uint64_t start, uint64_t max_hit_record) {
  const auto& properties = gpu_.properties().ray_tracing;
  layout_ = {properties.shaderGroupHandleSize, properties.shaderGroupHandleAlignment,
             properties.shaderGroupBaseAlignment};
  const uint64_t stride = layout_.stride();
  uint64_t offset = start;
  for (Table& table : tables_) {
    table.records = table.source.count() + 1;
    if (table.kind == runtime::RecordKind::kHitGroup && !table.repeats()) {
      table.records = std::max(table.records, max_hit_record + 1);
    }
    table.offset = layout_.aligned(offset);
    // Drivers compute offsets in tables in 32 bits.
    if (table.records > UINT32_MAX / stride) {
      return runtime::make_error(
          runtime::Id::kVulkanTableLimit,
          "the " + std::string(table.name) + " table needs " + std::to_string(table.records) +
              " records, but at most " + std::to_string(UINT32_MAX / stride) +
              " are possible on Vulkan; lower InstanceContributionToHitGroupIndex "
              "or the number of geometries (" +
              label_ + ").");
    }
    offset = table.offset + table.records * stride;
  }
  bytes_ = offset;
  return {};
}

// The records of twins follow those of callables. Their table has a stride, so that a table that
// repeats its record is one of a single record here, with 0 as the largest index.
void RaysDispatch::place_twins() {
  const uint64_t stride = layout_.stride();
  const Table& hits = tables_[kHitGroup];
  const Table& misses = tables_[kMiss];
  Table& callables = tables_[kCallable];
  const auto last = [](const Table& table) { return table.repeats() ? 0 : table.source.count(); };
  TwinTables& twins = twins_;
  twins.first = static_cast<uint32_t>(callables.records);
  twins.last_hit = static_cast<uint32_t>(last(hits));
  twins.last_miss = static_cast<uint32_t>(last(misses));
  twins.ray_flags = runtime::ray_flags_of(pipeline_.linked().flags) & runtime::kAllRayFlags;
  for (int i = 0; i < 2; ++i) {
    const ApplicationTable& source = (i == 0 ? hits : misses).source;
    twins.address[i] = source.address;
    twins.size_bytes[i] = source.host != nullptr ? source.size_bytes : 0;
    twins.stride_bytes[i] = source.stride_bytes;
  }
  callables.offset = layout_.aligned(bytes_);
  const uint64_t records = twins_of(hits.kind) * (last(hits) + 1) + last(misses) + 1;
  twin_tables_ = layout_.aligned(callables.offset + (callables.records + records) * stride);
  bytes_ = twin_tables_ + sizeof(twins);
  callables.twins = records;
}

void RaysDispatch::write_twins() {
  const uint64_t stride = layout_.stride();
  const Table& callables = tables_[kCallable];
  uint8_t* out = buffer_->host() + callables.offset + callables.records * stride;
  std::memset(out, 0, callables.twins * stride);
  for (const TableIndex index : {kHitGroup, kMiss}) {
    const Table& table = tables_[index];
    translate_twins(table.source, table.kind, pipeline_.linked().identifiers, pipeline_.groups(),
                    layout_, out);
    out += twins_of(table.kind) * (uint64_t{twins_.last_hit} + 1) * stride;
  }
  std::memcpy(buffer_->host() + twin_tables_, &twins_, sizeof(twins_));
}

void RaysDispatch::write_table(const Table& table) {
  const uint64_t stride = layout_.stride();
  uint8_t* out = buffer_->host() + table.offset;
  const uint64_t count = table.source.count();
  const uint64_t unknown = translate_table(table.source, table.kind, pipeline_.linked().identifiers,
                                           pipeline_.groups(), layout_, out);
  std::memset(out + count * stride, 0, (table.records - count) * stride);
  if (unknown == kNoRecord) return;
  result_.warnings.push_back(
      {runtime::Id::kRecordUnknown,
       std::string(table.name) + " table: record " + std::to_string(unknown) +
           " holds no identifier of this kind from this pipeline; nothing runs for it (" + label_ +
           "). Was it written, and with an identifier of this state object?"});
}

void RaysDispatch::warn_of_status() {
  DispatchFeedback status;
  std::memcpy(&status, buffer_->host(), sizeof(status));
  if (status.reordered != 0) {
    const uint32_t found = status.reordered - 1;
    const Table& table = tables_[(found & 1) != 0 ? kMiss : kHitGroup];
    result_.warnings.push_back({runtime::Id::kRecordOutOfBounds,
                                std::string(table.name) +
                                    " table: MaybeReorderThread got a hit object with record " +
                                    std::to_string(found >> 1) + ", but the table has " +
                                    std::to_string(table.source.count()) + " (" + label_ +
                                    "). Do SizeInBytes, StrideInBytes and the index terms agree?"});
  }
  if (status.unknown_structure == 0) return;
  result_.warnings.push_back(
      {runtime::Id::kNoTopLevel, "there is no top level at address " +
                                     errors::hex(status.unknown_structure) + "; the rays missed (" +
                                     label_ + "). Was one built, and not overwritten or freed?"});
}

GridLimits RaysDispatch::limits() const {
  const VkPhysicalDeviceLimits& core = gpu_.properties().core.limits;
  GridLimits result;
  for (int axis = 0; axis < 3; ++axis) {
    result.size[axis] =
        uint64_t{core.maxComputeWorkGroupCount[axis]} * core.maxComputeWorkGroupSize[axis];
  }
  if (gpu_.workarounds().has(Workaround::kLimitDepth)) {
    result.size[2] = std::min<uint64_t>(result.size[2], UINT16_MAX);
  }
  result.cells = gpu_.properties().ray_tracing.maxRayDispatchInvocationCount;
  return smaller(result, environment_.limits);
}

VkStridedDeviceAddressRegionKHR RaysDispatch::region(TableIndex index) const {
  const Table& table = tables_[index];
  const uint64_t stride = layout_.stride();
  if (index == kRayGeneration) return {buffer_->address() + table.offset, stride, stride};
  if (table.twins != 0) {
    return {buffer_->address() + table.offset, stride, (table.records + table.twins) * stride};
  }
  return {buffer_->address() + table.offset, table.repeats() ? 0 : stride, table.records * stride};
}

rtapi::Status RaysDispatch::execute() {
  // Earlier commands may write the tables and arguments.
  if (auto s = environment_.stream->flush(); !s) return s;
  if (auto s = find_tables(); !s) return s;
  const auto& desc = command_.desc;
  const auto parts = split_grid({desc.Width, desc.Height, desc.Depth}, limits());
  if (parts.empty()) return {};
  auto scene = environment_.structures->tables();
  if (!scene) return scene.error();
  if (auto s = place_tables(bytes_of_blocks(parts.size()), scene->max_hit_record); !s) return s;
  if (pipeline_.has_twins()) place_twins();
  auto buffer = environment_.scratch->get(gpu_, bytes_);
  if (!buffer) return buffer.error();
  buffer_ = *buffer;
  for (const Table& table : tables_) write_table(table);
  if (pipeline_.has_twins()) write_twins();
  const uint8_t* ray_generation = buffer_->host() + tables_[kRayGeneration].offset;
  const bool nothing = std::all_of(ray_generation, ray_generation + layout_.handle_bytes,
                                   [](uint8_t byte) { return byte == 0; });
  // A NULL ray generation shader runs nothing.
  if (nothing || pipeline_.handle() == VK_NULL_HANDLE) return {};
  if (auto s = check_stack(); !s) return s;
  DispatchBlock block = dispatch_block(command_.state, *scene);
  block.miss_count = tables_[kMiss].limit();
  block.callable_count = tables_[kCallable].limit();
  if (pipeline_.has_twins()) {
    block.twin_tables = buffer_->address() + twin_tables_;
    if (tables_[kCallable].repeats()) block.callable_count = 0;
  }
  block.hit_group_count = tables_[kHitGroup].limit();
  block.dimensions[0] = desc.Width;
  block.dimensions[1] = desc.Height;
  block.dimensions[2] = desc.Depth;
  auto checks = begin_checks(environment_, pipeline_.linked().max_recursion_depth);
  if (!checks) return checks.error();
  write_blocks(block, parts, *buffer_, *checks);
  return trace(parts);
}

rtapi::Status RaysDispatch::trace(const std::vector<GridPart>& parts) {
  auto commands = environment_.stream->record(label_);
  if (!commands) return commands.error();
  const PipelineLayout& layout = pipeline_.layout();
  pipeline_.bind(*commands);
  const auto ray_generation = region(kRayGeneration);
  const auto miss = region(kMiss);
  const auto hit_group = region(kHitGroup);
  const auto callable = region(kCallable);
  for (size_t i = 0; i < parts.size(); ++i) {
    layout.push(*commands, address_of_block(*buffer_, i));
    gpu_.vk().vkCmdTraceRaysKHR(*commands, &ray_generation, &miss, &hit_group, &callable,
                                parts[i].size[0], parts[i].size[1], parts[i].size[2]);
  }
  auto status = run_dispatch(*environment_.stream, *buffer_, pipeline_.linked().max_recursion_depth,
                             pipeline_.max_trace_depth(), label_);
  add_counts(buffer_->host(), result_.statistics);
  const rtapi::DispatchRaysDesc& desc = command_.desc;
  checks::CodePlace place;
  place.dimensions[0] = desc.Width;
  place.dimensions[1] = desc.Height;
  place.dimensions[2] = desc.Depth;
  place.tables = &desc;
  result_.reached = tell_checks(environment_, pipeline_.stage_shaders(), place);
  result_.missing = missing_records(environment_);
  warn_of_status();
  return status;
}

constexpr char kWhoseAddress[] =
    ", where there is no memory. Check root descriptors, table handles and record arguments";

rtapi::Error fault_at(uint64_t address, const std::string& label) {
  return runtime::make_error(
      runtime::Id::kShaderFault,
      "it accessed address " + errors::hex(address) + kWhoseAddress + " (" + label + ").");
}

}  // namespace

rtapi::Result<const GpuBuffer*> DispatchMemory::get(Gpu& gpu, uint64_t size_bytes) {
  if (buffer_ != nullptr && buffer_->size_bytes() >= size_bytes) return buffer_.get();
  const uint64_t wanted =
      buffer_ == nullptr ? size_bytes : std::max(size_bytes, buffer_->size_bytes() * 3 / 2);
  buffer_.reset();
  auto made = gpu.create_buffer(wanted, "tables of a dispatch");
  if (!made) return made.error();
  buffer_ = std::move(*made);
  return buffer_.get();
}

DispatchBlock dispatch_block(const runtime::RootBindings& state, const SceneTables& scene) {
  DispatchBlock block;
  const auto range = [](const std::shared_ptr<runtime::BackendBuffer>& heap, uint64_t& begin,
                        uint64_t& end) {
    if (heap == nullptr) return;
    begin = heap->address();
    end = begin + heap->size_bytes() / sizeof(shader::Descriptor) * sizeof(shader::Descriptor);
  };
  range(state.view_heap, block.view_heap_begin, block.view_heap_end);
  range(state.sampler_heap, block.sampler_heap_begin, block.sampler_heap_end);
  const shader::Descriptor prints = runtime::view_of_prints(state);
  block.prints = prints.address;
  block.print_bytes = prints.size_bytes;
  block.instances = scene.instances;
  block.position_tables = scene.position_tables;
  block.top_levels = scene.top_levels;
  block.top_level_mask = scene.top_level_mask;
  block.empty_top_level = scene.empty_top_level;
  static_assert(sizeof(block.root_arguments) == runtime::kRootArgumentBytes);
  std::memcpy(block.root_arguments, state.root_arguments->bytes.data(),
              sizeof(block.root_arguments));
  return block;
}

uint64_t bytes_of_blocks(size_t part_count) {
  return kStatusBytes + part_count * kBlockBytes;
}

uint64_t address_of_block(const GpuBuffer& buffer, size_t part) {
  return buffer.address() + kStatusBytes + part * kBlockBytes;
}

void write_blocks(const DispatchBlock& block, const std::vector<GridPart>& parts,
                  const GpuBuffer& buffer, uint64_t checks) {
  DispatchFeedback status;
  status.checks = checks;
  std::memcpy(buffer.host(), &status, sizeof(status));
  DispatchBlock own = block;
  own.status = buffer.address();
  for (size_t i = 0; i < parts.size(); ++i) {
    std::copy(parts[i].base.begin(), parts[i].base.end(), own.base);
    own.rows = parts[i].size[1];
    std::memcpy(buffer.host() + kStatusBytes + i * kBlockBytes, &own, sizeof(own));
  }
}

void add_counts(const uint8_t* feedback, rtapi::RaytracingStatistics& statistics) {
  DispatchFeedback status;
  std::memcpy(&status, feedback, sizeof(status));
  const auto count = [&](uint32_t what) {
    return uint64_t{status.counts[what][1]} << 32 | status.counts[what][0];
  };
  statistics.TraceRayCalls += count(shader::spirv::kTraceRayCalls);
  statistics.VisibilityRays += count(shader::spirv::kVisibilityRays);
  statistics.AnyHitInvocations += count(shader::spirv::kAnyHitInvocations);
  statistics.IntersectionInvocations += count(shader::spirv::kIntersectionInvocations);
  statistics.ClosestHitInvocations += count(shader::spirv::kClosestHitInvocations);
  statistics.MissInvocations += count(shader::spirv::kMissInvocations);
  statistics.CallableInvocations += count(shader::spirv::kCallableInvocations);
  statistics.Misses = statistics.MissInvocations;
  statistics.Hits = statistics.TraceRayCalls - statistics.Misses;
}

rtapi::Status flush_guarded(CommandStream& stream, const std::string& label) {
  const bool processor = stream.gpu().properties().core.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU;
  const FaultGuard guard(processor);
  if (auto s = stream.flush(); !s) return s;
  if (guard.faulted()) return fault_at(guard.address(), label);
  return {};
}

rtapi::Status status_of(const uint8_t* feedback, uint32_t declared_depth, uint32_t depth_limit,
                        const std::string& label) {
  DispatchFeedback status;
  std::memcpy(&status, feedback, sizeof(status));
  if (status.removal_reason == 0) return {};
  const auto reason = static_cast<shader::RemovalReason>(status.removal_reason - 1);
  std::string text = "the shader asked for it";
  switch (reason) {
    case shader::RemovalReason::kRecursionDepth:
      text = "the pipeline declares MaxTraceRecursionDepth " + std::to_string(declared_depth) +
             ", but a shader at that depth called TraceRay";
      if (depth_limit < declared_depth) {
        text = "with such payloads this Vulkan device allows only a depth of " +
               std::to_string(depth_limit) +
               ", but a shader at that depth called TraceRay; the pipeline declares "
               "MaxTraceRecursionDepth " +
               std::to_string(declared_depth);
      }
      break;
    case shader::RemovalReason::kStackOverflow:
      text = "calls nest too deep";
      break;
    case shader::RemovalReason::kFault:
      text = std::string("it accessed an address") + kWhoseAddress;
      break;
    case shader::RemovalReason::kMultisampled:
      text = runtime::kMultisampledUse;
      break;
    case shader::RemovalReason::kOther:
    case shader::RemovalReason::kStepLimit:
      break;
  }
  return runtime::make_error(runtime::removal_id(reason), text + " (" + label + ").");
}

rtapi::Status run_dispatch(CommandStream& stream, const GpuBuffer& buffer, uint32_t declared_depth,
                           uint32_t depth_limit, const std::string& label) {
  if (auto s = flush_guarded(stream, label); !s) return s;
  return status_of(buffer.host(), declared_depth, depth_limit, label);
}

CountedOutcome dispatch_rays(const DispatchEnvironment& environment,
                             const runtime::DispatchRaysCommand& command,
                             const std::string& label) {
  return RaysDispatch(environment, command, label).run();
}

}  // namespace kaamos::vulkan
