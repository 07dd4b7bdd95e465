// SPDX-License-Identifier: MIT
#include "runtime/hlsl/interpret/closure.h"

#include <ffi.h>

namespace kaamos::hlsl::interpret {

struct Closure::Call {
  ffi_cif interface;
  ffi_type* types[4] = {&ffi_type_pointer, &ffi_type_pointer, &ffi_type_pointer, &ffi_type_uint32};
  ffi_closure* closure = nullptr;
  Target target;
};

namespace {

using Handler = void (*)(ffi_cif*, void* result, void** arguments, void* target);

template <class T>
T* argument(void** arguments, size_t i) {
  return *static_cast<T**>(arguments[i]);
}

// Payload and attributes are the second and third argument in the stages that have them.
template <int Count>
void run_ray(ffi_cif*, void* result, void** arguments, void* target) {
  const auto& to = *static_cast<const Closure::Target*>(target);
  void* payload = nullptr;
  const void* attributes = nullptr;
  if constexpr (Count > 1) payload = argument<void>(arguments, 1);
  if constexpr (Count > 2) attributes = argument<const void>(arguments, 2);
  const shader::AnyHitResult decided = run_ray_entry(
      *to.program, *to.entry, *argument<shader::Invocation>(arguments, 0), payload, attributes);
  if (to.entry->entry->stage == ir::kStageAnyHit) {
    *static_cast<ffi_arg*>(result) = static_cast<ffi_arg>(decided);
  }
}

void run_thread(ffi_cif*, void*, void** arguments, void* target) {
  const auto& to = *static_cast<const Closure::Target*>(target);
  run_compute_thread(*to.program, *to.entry, *argument<shader::Invocation>(arguments, 0),
                     *argument<shader::ComputeGroup>(arguments, 1),
                     argument<const uint32_t>(arguments, 2));
}

void run_group(ffi_cif*, void*, void** arguments, void* target) {
  const auto& to = *static_cast<const Closure::Target*>(target);
  const uint32_t* size = to.entry->entry->thread_group;
  uint32_t thread[3];
  for (thread[2] = 0; thread[2] < size[2]; ++thread[2]) {
    for (thread[1] = 0; thread[1] < size[1]; ++thread[1]) {
      for (thread[0] = 0; thread[0] < size[0]; ++thread[0]) {
        run_compute_thread(*to.program, *to.entry, *argument<shader::Invocation>(arguments, 0),
                           *argument<shader::ComputeGroup>(arguments, 1), thread);
      }
    }
  }
}

void run_vertices(ffi_cif*, void*, void** arguments, void* target) {
  const auto& to = *static_cast<const Closure::Target*>(target);
  const auto& lanes = *argument<const shader::VertexLanes>(arguments, 1);
  for (uint32_t lane = 0; lane < shader::kGraphicsLanes; ++lane) {
    if ((lanes.active >> lane & 1u) == 0) continue;
    run_vertex(*to.program, *to.entry, *argument<shader::Invocation>(arguments, 0), lanes, lane);
  }
}

void run_primitive(ffi_cif*, void*, void** arguments, void* target) {
  const auto& to = *static_cast<const Closure::Target*>(target);
  run_geometry(*to.program, *to.entry, *argument<shader::Invocation>(arguments, 0),
               *argument<const shader::GeometryInputs>(arguments, 1),
               *argument<shader::GeometryStream>(arguments, 2));
}

void run_pixels(ffi_cif*, void*, void** arguments, void* target) {
  const auto& to = *static_cast<const Closure::Target*>(target);
  auto& lanes = *argument<shader::PixelLanes>(arguments, 1);
  for (uint32_t lane = 0; lane < shader::kGraphicsLanes; ++lane) {
    if ((lanes.live >> lane & 1u) == 0) continue;
    run_pixel(*to.program, *to.entry, *argument<shader::Invocation>(arguments, 0), lanes, nullptr,
              lane);
  }
}

void run_pixel_thread(ffi_cif*, void*, void** arguments, void* target) {
  const auto& to = *static_cast<const Closure::Target*>(target);
  run_pixel(*to.program, *to.entry, *argument<shader::Invocation>(arguments, 0),
            *argument<shader::PixelLanes>(arguments, 1),
            argument<shader::ComputeGroup>(arguments, 2), *static_cast<uint32_t*>(arguments[3]));
}

struct Signature {
  unsigned arguments;
  Handler handler;
};

Signature signature_of(const ir::EntryPoint& entry) {
  switch (entry.stage) {
    case ir::kStageMiss:
    case ir::kStageCallable:
      return {2, run_ray<2>};
    case ir::kStageClosestHit:
    case ir::kStageAnyHit:
      return {3, run_ray<3>};
    case ir::kStageCompute:
      return entry.function->has_barrier || entry.function->has_waves ? Signature{3, run_thread}
                                                                      : Signature{2, run_group};
    case ir::kStageVertex:
      return {2, run_vertices};
    case ir::kStageGeometry:
      return {3, run_primitive};
    case ir::kStagePixel:
      return entry.function->has_waves ? Signature{4, run_pixel_thread} : Signature{2, run_pixels};
    default:
      return {1, run_ray<1>};
  }
}

}  // namespace

std::unique_ptr<Closure> Closure::create(const Program& program, const EntryCode& entry) {
  std::unique_ptr<Closure> out(new Closure);
  out->call_ = std::make_unique<Call>();
  Call& call = *out->call_;
  call.target = {&program, &entry};
  const Signature signature = signature_of(*entry.entry);
  const bool decides = entry.entry->stage == ir::kStageAnyHit;
  void* code = nullptr;
  call.closure = static_cast<ffi_closure*>(ffi_closure_alloc(sizeof(ffi_closure), &code));
  if (call.closure == nullptr ||
      ffi_prep_cif(&call.interface, FFI_DEFAULT_ABI, signature.arguments,
                   decides ? &ffi_type_uint32 : &ffi_type_void, call.types) != FFI_OK ||
      ffi_prep_closure_loc(call.closure, &call.interface, signature.handler, &call.target, code) !=
          FFI_OK) {
    return nullptr;
  }
  out->function_ = reinterpret_cast<shader::AnyFn>(code);
  return out;
}

Closure::~Closure() {
  if (call_ != nullptr && call_->closure != nullptr) ffi_closure_free(call_->closure);
}

}  // namespace kaamos::hlsl::interpret
