// SPDX-License-Identifier: MIT
#include "interpret_input.h"

#include <kaamos/shader/abi.h>

#include <vector>

#include "runtime/hlsl/interpret/interpret.h"

namespace kaamos::test {
namespace {

using namespace shader;

constexpr uint64_t kSteps = 5000;
constexpr uint32_t kBufferBytes = 256;
constexpr uint32_t kMaxStackBytes = 1 << 20;  // past this, a backend's guard page would end it
constexpr uint32_t kTableSlots = 4;           // for each binding

Services make_services() {
  Services out = {};
  out.trace_ray = [](Invocation&, const TraceRayArguments&, void*, RayLanes, RayLanes) {};
  out.report_hit = [](Invocation&, float t, uint32_t, const void*, uint32_t) {
    return t > 0 ? ReportHitResult::kEndSearch : ReportHitResult::kAccepted;
  };
  out.call_shader = [](Invocation&, uint32_t, void*, uint32_t) {};
  // Endless candidates of both kinds, so that loops end at the limit of steps.
  out.begin_query = [](Invocation&, RayQuery& query, const RayQueryArguments& arguments,
                       const RayDesc& ray) {
    query = RayQuery();
    query.ray = ray;
    query.ray_flags = arguments.ray_flags;
    query.committed.t = ray.t_max;
    query.ended = false;
  };
  out.proceed = [](Invocation&, RayQuery& query) {
    query.candidate.type ^= 1u;
    query.candidate.t = 1;
    return true;
  };
  const auto sample = [](const SampleArguments&) { return Texel{{0x3F000000, 0, 1, 2}}; };
  out.sample_level = sample;
  out.sample_gradient = sample;
  out.sample_compare_level = [](const SampleArguments&) { return 0.5f; };
  out.level_of_detail = [](const SampleArguments&) { return 0.5f; };
  out.gather = sample;
  out.gather_compare = sample;
  out.load_texel = [](const Descriptor&, const int32_t[4]) { return Texel{{7, 6, 5, 4}}; };
  out.store_texel = [](const Descriptor&, const int32_t[4], const Texel&) {};
  out.load_typed = [](const Descriptor&, uint32_t element) { return Texel{{element, 1, 2, 3}}; };
  out.store_typed = [](const Descriptor&, uint32_t, const Texel&) {};
  out.texel_address = [](const Descriptor&, const int32_t[4], uint32_t) -> void* {
    return nullptr;
  };
  out.typed_address = [](const Descriptor&, uint32_t, uint32_t) -> void* { return nullptr; };
  out.texture_dimensions = [](const Descriptor&, uint32_t) {
    return TextureDimensions{8, 8, 1, 2};
  };
  out.group_barrier = [](ComputeGroup&) {};
  out.wave = [](ComputeGroup&, const WaveCall&) {};
  out.remove_device = [](Invocation&, RemovalReason) {};
  return out;
}

DescriptorKind kind_of(BindingType type) {
  switch (type) {
    case BindingType::kConstantBuffer:
      return DescriptorKind::kConstantBuffer;
    case BindingType::kRawBuffer:
      return DescriptorKind::kRawBuffer;
    case BindingType::kStructuredBuffer:
      return DescriptorKind::kStructuredBuffer;
    case BindingType::kTypedBuffer:
      return DescriptorKind::kTypedBuffer;
    case BindingType::kTexture:
      return DescriptorKind::kTexture;
    case BindingType::kAccelerationStructure:
      return DescriptorKind::kAccelerationStructure;
    default:
      return DescriptorKind::kSampler;
  }
}

// The resources behind a library's bindings.
class World {
 public:
  explicit World(const LibraryDesc& library) : buffer_(kBufferBytes) {
    for (uint32_t i = 0; i < library.binding_count; ++i) {
      const BindingDesc& binding = library.bindings[i];
      Descriptor descriptor;
      descriptor.kind = kind_of(binding.type);
      descriptor.access = DescriptorAccess::kUnorderedAccess;
      descriptor.stride_bytes = binding.size_bytes != 0 ? binding.size_bytes : 4;
      descriptor.address = reinterpret_cast<uintptr_t>(buffer_.data());
      descriptor.size_bytes = kBufferBytes;
      heap_.insert(heap_.end(), kTableSlots, descriptor);
      BindingSlot slot;
      slot.source = SlotSource::kDescriptorTable;
      slot.descriptor_index = i * kTableSlots;
      slot.descriptor_count = binding.count;
      slots_.push_back(slot);
    }
    table_ = reinterpret_cast<uintptr_t>(heap_.data());
    dispatch_.services = &services_;
    dispatch_.root_arguments = reinterpret_cast<const uint8_t*>(&table_);
    dispatch_.dimensions[0] = dispatch_.dimensions[1] = dispatch_.dimensions[2] = 2;
    dispatch_.view_heap_begin = dispatch_.sampler_heap_begin = heap_.data();
    dispatch_.view_heap_end = dispatch_.sampler_heap_end = heap_.data() + heap_.size();
  }
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  void run(const ExportDesc& code) {
    if (code.import_count != 0) return;  // it has code only once other libraries are linked
    const float transform[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
    RaySystemValues ray = {};
    ray.object_to_world = ray.world_to_object = transform;
    Invocation invocation;
    invocation.dispatch = &dispatch_;
    invocation.slots = slots_.data();
    // On the heap and exactly as long as the library says, so that a sanitizer sees accesses past
    // the end.
    std::vector<uint64_t> payload((code.payload_storage_bytes + 7) / 8);
    const std::vector<uint64_t> attributes(4);
    switch (code.stage) {
      case Stage::kLibrary:
      case Stage::kVertex:  // these two run over columns of values, which draws alone have
      case Stage::kPixel:
        return;
      case Stage::kCompute:
        return run_compute(*code.compute, invocation);
      case Stage::kRayGeneration:
        return reinterpret_cast<RayGenerationFn>(code.entry)(invocation);
      case Stage::kCallable:
        return reinterpret_cast<CallableFn>(code.entry)(invocation, payload.data());
      default:
        break;
    }
    invocation.ray = &ray;
    switch (code.stage) {
      case Stage::kMiss:
        return reinterpret_cast<MissFn>(code.entry)(invocation, payload.data());
      case Stage::kClosestHit:
        return reinterpret_cast<ClosestHitFn>(code.entry)(invocation, payload.data(),
                                                          attributes.data());
      case Stage::kAnyHit:
        reinterpret_cast<AnyHitFn>(code.entry)(invocation, payload.data(), attributes.data());
        return;
      default:
        return reinterpret_cast<IntersectionFn>(code.entry)(invocation);
    }
  }

 private:
  void run_compute(const ComputeDesc& compute, Invocation& invocation) {
    if (compute.shared_bytes > kMaxStackBytes) return;
    std::vector<uint64_t> shared((compute.shared_bytes + 7) / 8);
    ComputeGroup group;
    group.shared = shared.data();
    const uint32_t last[3] = {compute.thread_group[0] - 1, compute.thread_group[1] - 1,
                              compute.thread_group[2] - 1};
    const uint64_t threads =
        uint64_t{compute.thread_group[0]} * compute.thread_group[1] * compute.thread_group[2];
    if (compute.group != nullptr && threads <= 64) compute.group(invocation, group);
    if (compute.thread != nullptr) compute.thread(invocation, group, last);
  }

  const Services services_ = make_services();
  std::vector<uint8_t> buffer_;
  std::vector<Descriptor> heap_;
  std::vector<BindingSlot> slots_;
  uint64_t table_ = 0;
  DispatchConstants dispatch_;
};

}  // namespace

std::string interpret_input(std::shared_ptr<const hlsl::ir::Module> module) {
  hlsl::InterpretOptions options;
  options.step_limit = kSteps;
  const auto interpreted = hlsl::InterpretedLibrary::create(std::move(module), options);
  // A value too large for the stack is an error of its own kind; no other error may occur here.
  if (!interpreted) {
    const std::string error = interpreted.error();
    return error.find("use a C++ compiler instead") != std::string::npos ? "" : error;
  }
  const shader::LibraryDesc& library = (*interpreted)->desc();
  World world(library);
  for (uint32_t i = 0; i < library.export_count; ++i) {
    const ExportDesc& code = library.exports[i];
    if (code.stack_bytes <= kMaxStackBytes) world.run(code);
  }
  return {};
}

}  // namespace kaamos::test
