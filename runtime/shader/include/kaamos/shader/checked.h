// SPDX-License-Identifier: MIT
//
// Shaders of a checked library (kaamos-hlsl -check-access) call this where others trust the
// application: they give the same results wherever DXR defines them, and send a CheckReport to the
// backend where it does not. Root descriptors end with their allocation here, so nothing outside is
// read or written.
#pragma once

#include "kaamos/shader/bindings.h"
#include "kaamos/shader/hit_object.h"
#include "kaamos/shader/memory.h"
#include "kaamos/shader/query_permissions.h"
#include "kaamos/shader/ray_query.h"
#include "kaamos/shader/stage.h"
#include "kaamos/shader/views.h"

namespace kaamos::shader::checked {

// Out of line, because errors are rare and should not bloat the code around them.
[[gnu::noinline, gnu::cold]] inline void report(Invocation& invocation, Finding finding,
                                                uint32_t site, uint32_t origin, uint32_t write,
                                                uint64_t value0, uint64_t value1 = 0,
                                                uint64_t value2 = 0, uint64_t value3 = 0) {
  const auto tell = invocation.dispatch->services->report;
  if (tell == nullptr) return;
  const CheckReport text = {finding,
                            site,
                            origin & ~kFromRoot,
                            write,
                            reinterpret_cast<uintptr_t>(invocation.local_arguments),
                            {value0, value1, value2, value3, 0}};
  tell(invocation, text);
}

// Bytes from `address` to the end of its allocation; 0 if it is in none.
inline uint64_t bytes_from(const DispatchConstants& dispatch, uint64_t address) {
  const AddressRange* first = dispatch.ranges_begin;
  uint64_t count = static_cast<uint64_t>(dispatch.ranges_end - first);
  if (count == 0) return ~uint64_t{0};
  while (count > 1) {  // finds the last range that starts at or before the address
    const uint64_t half = count / 2;
    first = first[half].address <= address ? first + half : first;
    count -= half;
  }
  const uint64_t into = address - first->address;
  return into < first->size_bytes ? first->size_bytes - into : 0;
}

// ---------------------------------------------------------------------------------------------
// Descriptors

// For Finding::kWrongDescriptor: an access and, for a texture, its shape.
constexpr uint64_t with_shape(DescriptorAccess access, DescriptorKind kind, uint32_t shape) {
  return static_cast<uint64_t>(access) |
         (kind == DescriptorKind::kTexture ? uint64_t{shape} << 8 : 0);
}

[[gnu::noinline, gnu::cold]] inline void explain_missing(Invocation& invocation, uint32_t site,
                                                         uint32_t slot, uint32_t index) {
  const BindingSlot& binding = invocation.slots[slot];
  if (index >= binding.descriptor_count && binding.descriptor_count != kUnbounded) {
    return report(invocation, Finding::kOutsideBinding, site, slot + 1, 0, index,
                  binding.descriptor_count);
  }
  const uint8_t* arguments = bindings::arguments_of(invocation, binding);
  if (arguments == nullptr) return;
  const uint64_t table = bindings::read_address(arguments + binding.argument_offset);
  const uint64_t first = static_cast<uint64_t>(binding.descriptor_index) + index;
  const uint64_t address = table + first * sizeof(Descriptor);
  const DispatchConstants& dispatch = *invocation.dispatch;
  const Descriptor* begin = dispatch.view_heap_begin;
  const Descriptor* end = dispatch.view_heap_end;
  if (binding.kind == DescriptorKind::kSampler) {
    begin = dispatch.sampler_heap_begin;
    end = dispatch.sampler_heap_end;
  }
  const Descriptor* found = bindings::heap_slot(address, begin, end);
  if (found == nullptr) {
    return report(invocation, Finding::kOutsideHeap, site, slot + 1, 0, address,
                  static_cast<uint64_t>(end - begin), 1, table);
  }
  if (found->kind == DescriptorKind::kNull) return;  // a null descriptor: legal
  report(invocation, Finding::kWrongDescriptor, site, slot + 1, 0,
         static_cast<uint64_t>(found->kind),
         with_shape(view_access(*found), found->kind, found->stride_bytes),
         static_cast<uint64_t>(binding.kind),
         with_shape(binding.access, binding.kind, binding.stride_bytes));
}

// A view whose resource no longer exists reads as a null descriptor. One whose texture is in a
// state that forbids its use is reported, but used; such a view has bit 61 set in its key. Null
// descriptors and samplers are exempt.
[[gnu::noinline]] inline Descriptor usable(Invocation& invocation, uint32_t site, uint32_t binding,
                                           const Descriptor& found, uint32_t index) {
  if (found.kind == DescriptorKind::kNull || found.kind == DescriptorKind::kSampler ||
      found.address == 0) {
    return found;
  }
  const bool texture = found.kind == DescriptorKind::kTexture;
  const bool writable_texture = texture && found.access == DescriptorAccess::kUnorderedAccess;
  const uint64_t key = view_key(found.address, writable_texture);
  if (bytes_from(*invocation.dispatch, key) != 0) return found;
  const bool wrong_state =
      texture && bytes_from(*invocation.dispatch, key | uint64_t{1} << 61) != 0;
  report(invocation, Finding::kStaleView, site, binding, 0, wrong_state ? key : found.address,
         static_cast<uint64_t>(found.kind), index, wrong_state ? 1 : 0);
  return wrong_state ? found : Descriptor();
}

[[gnu::noinline]] inline Descriptor resource(Invocation& invocation, uint32_t site, uint32_t slot,
                                             uint32_t index) {
  const BindingSlot& binding = invocation.slots[slot];
  Descriptor found = shader::resource(invocation, slot, index);
  found.origin = slot + 1;
  if (binding.source == SlotSource::kRootDescriptor) {
    if (binding.kind == DescriptorKind::kAccelerationStructure) return found;
    found.origin |= kFromRoot;
    if (found.address != 0) found.size_bytes = bytes_from(*invocation.dispatch, found.address);
    if (binding.kind == DescriptorKind::kConstantBuffer && found.address % 256 != 0) {
      report(invocation, Finding::kMisaligned, site, found.origin, 0, found.address, 0, 0, 256);
    }
  } else if (binding.source == SlotSource::kDescriptorTable &&
             found.kind == DescriptorKind::kNull) {
    explain_missing(invocation, site, slot, index);
  } else if (binding.source == SlotSource::kDescriptorTable && binding.descriptor_count != 1) {
    return usable(invocation, site, slot + 1, found, index);
  }
  return found;
}

// ResourceDescriptorHeap[index] or SamplerDescriptorHeap[index], as a resource of that kind.
[[gnu::noinline]] inline Descriptor heap_resource(Invocation& invocation, uint32_t site,
                                                  uint32_t index, DescriptorKind kind,
                                                  DescriptorAccess access, uint32_t shape = 0) {
  const DispatchConstants& dispatch = *invocation.dispatch;
  const bool sampler = kind == DescriptorKind::kSampler;
  const Descriptor* begin = sampler ? dispatch.sampler_heap_begin : dispatch.view_heap_begin;
  const Descriptor* end = sampler ? dispatch.sampler_heap_end : dispatch.view_heap_end;
  const uint64_t count = static_cast<uint64_t>(end - begin);
  const Descriptor held = shader::heap_resource(invocation, index, sampler);
  const Descriptor found = shape != 0 ? shader::heap_texture(invocation, index, shape) : held;
  if (index >= count) {
    report(invocation, Finding::kOutsideHeap, site, 0, 0, index, count);
  } else if (held.kind != DescriptorKind::kNull && !bindings::matches(held, kind, access, shape)) {
    report(invocation, Finding::kWrongDescriptor, site, 0, 0, static_cast<uint64_t>(held.kind),
           with_shape(view_access(held), held.kind, held.stride_bytes), static_cast<uint64_t>(kind),
           with_shape(access, kind, shape));
  } else {
    return usable(invocation, site, 0, found, index);
  }
  return found;
}

// ---------------------------------------------------------------------------------------------
// Memory. These functions return the descriptor that they are given.

[[gnu::noinline, gnu::cold]] inline void explain_bounds(Invocation& invocation, uint32_t site,
                                                        const Descriptor& buffer, uint64_t offset,
                                                        uint32_t bytes, uint32_t write) {
  const bool nowhere = buffer.address == 0 || buffer.size_bytes == 0;
  report(invocation, nowhere ? Finding::kNotAllocated : Finding::kOutOfBounds, site, buffer.origin,
         write, buffer.address, offset, bytes, buffer.size_bytes);
}

KAAMOS_INLINE bool leaves(const Descriptor& buffer, uint64_t offset, uint32_t bytes) {
  return (buffer.origin & kFromRoot) != 0 && offset + bytes > buffer.size_bytes;
}

// Raw and constant buffers: access `bytes` at byte `offset`, in scalars aligned to `alignment` (up
// to 4).
KAAMOS_INLINE const Descriptor& access(Invocation& invocation, uint32_t site,
                                       const Descriptor& buffer, uint32_t offset, uint32_t bytes,
                                       uint32_t alignment, uint32_t write) {
  if (__builtin_expect(leaves(buffer, offset, bytes), 0)) {
    explain_bounds(invocation, site, buffer, offset, bytes, write);
  }
  if (__builtin_expect(((buffer.address + offset) & (alignment - 1)) != 0, 0)) {
    report(invocation, Finding::kMisaligned, site, buffer.origin, write, buffer.address, offset,
           bytes, alignment);
  }
  return buffer;
}

// Structured buffers: access `bytes` at byte `offset` of element `index`.
KAAMOS_INLINE const Descriptor& access_element(Invocation& invocation, uint32_t site,
                                               const Descriptor& buffer, uint32_t index,
                                               uint32_t offset, uint32_t bytes, uint32_t alignment,
                                               uint32_t write) {
  const uint64_t at = static_cast<uint64_t>(index) * buffer.stride_bytes + offset;
  if (__builtin_expect(leaves(buffer, at, bytes), 0)) {
    explain_bounds(invocation, site, buffer, at, bytes, write);
  }
  if (__builtin_expect(((buffer.address + at) & (alignment - 1)) != 0, 0)) {
    report(invocation, Finding::kMisaligned, site, buffer.origin, write, buffer.address, at, bytes,
           alignment);
  }
  return buffer;
}

// Returns where the accessed value is: the view that emitted code reads or writes at offset 0.
KAAMOS_INLINE MemoryView access_view(Invocation& invocation, uint32_t site,
                                     const Descriptor& buffer, uint32_t offset, uint32_t bytes,
                                     uint32_t alignment, uint32_t write) {
  access(invocation, site, buffer, offset, bytes, alignment, write);
  const memory::Window window = memory::window(buffer, offset & ~(alignment - 1));
  return {reinterpret_cast<uintptr_t>(window.base), window.bytes};
}
KAAMOS_INLINE MemoryView access_element_view(Invocation& invocation, uint32_t site,
                                             const Descriptor& buffer, uint32_t index,
                                             uint32_t offset, uint32_t bytes, uint32_t alignment,
                                             uint32_t write) {
  access_element(invocation, site, buffer, index, offset, bytes, alignment, write);
  const memory::Window window = memory::element_window(buffer, index, offset);
  return {reinterpret_cast<uintptr_t>(window.base), window.bytes};
}

// ---------------------------------------------------------------------------------------------
// Rays

// At most one opacity flag, at most one facing to cull, and no flags for triangles when triangles
// are skipped. [DXR: Ray flags]
constexpr bool legal_ray_flags(uint32_t flags) {
  const uint32_t opacity = flags & 0xC3u;
  if ((opacity & (opacity - 1)) != 0) return false;
  if ((flags & 0x30u) == 0x30u) return false;
  if ((flags & 0x100u) != 0 && (flags & 0x230u) != 0) return false;
  return (flags & ~0x7FFu) == 0;
}

inline void check_ray(Invocation& invocation, uint32_t site, const RayDesc& ray) {
  const auto tell = [&](Finding finding) {
    uint64_t words[4];
    __builtin_memcpy(words, &ray, sizeof(words));
    report(invocation, finding, site, 0, 0, words[0], words[1], words[2], words[3]);
  };
  bool nan = false;
  for (int i = 0; i < 3; ++i) {
    nan |= ray.origin[i] != ray.origin[i] || ray.direction[i] != ray.direction[i];
  }
  if (nan || ray.t_min != ray.t_min || ray.t_max != ray.t_max) {
    tell(Finding::kRayNotANumber);
  } else if (ray.t_min < 0 || ray.t_min > ray.t_max) {
    tell(Finding::kRayInterval);
  }
}

// For TraceRay and HitObject::Invoke.
inline void check_depth(Invocation& invocation, uint32_t site) {
  const uint32_t depth = invocation.dispatch->max_recursion_depth;
  if (invocation.depth >= depth) {
    report(invocation, Finding::kRecursion, site, 0, 0, invocation.depth, depth);
  }
}

inline void check_trace(Invocation& invocation, uint32_t site, uint32_t flags, const RayDesc& ray) {
  check_ray(invocation, site, ray);
  if (!legal_ray_flags(flags)) report(invocation, Finding::kRayFlags, site, 0, 0, flags);
  check_depth(invocation, site);
}

// Payloads and callable data begin with a header that says what the caller passes, for the shader
// that gets them to check. After them there is room for a shader that expects more.
struct PayloadHeader {
  uint32_t magic;
  uint32_t type;  // hash of the type's scalars in order
  uint32_t bytes;
  uint32_t reserved;
};
inline constexpr uint32_t kPayloadMagic = 0x504C4431u;
inline constexpr uint32_t kPayloadSlack = 64;
template <class T>
struct alignas(16) PayloadBox {
  PayloadHeader header;
  T value;
  uint8_t slack[kPayloadSlack];
};

inline void check_payload(Invocation& invocation, uint32_t site, const void* payload, uint32_t type,
                          uint32_t bytes, bool callable) {
  PayloadHeader header;
  __builtin_memcpy(&header, static_cast<const uint8_t*>(payload) - sizeof(header), sizeof(header));
  // The caller's library may not be a checked one.
  if (header.magic != kPayloadMagic || header.type == type) return;
  report(invocation, Finding::kPayloadMismatch, site, 0, 0, header.bytes, bytes, callable ? 1 : 0);
}

// Reports a call that is `unknown` (not all of its arguments are constants), before it runs.
[[gnu::noinline]] inline void reached(Invocation& invocation, ReachedBy by, uint32_t site,
                                      uint64_t acceleration_structure, uint32_t ray_flags,
                                      uint32_t indices) {
  const auto tell = invocation.dispatch->services->reached;
  if (tell != nullptr) tell(invocation, {acceleration_structure, by, site, ray_flags, indices});
}
constexpr uint32_t trace_indices(uint32_t mask, uint32_t ray_contribution, uint32_t multiplier,
                                 uint32_t miss_index) {
  return (mask & 0xFFu) | (ray_contribution & 15u) << 8 | (multiplier & 15u) << 12 |
         miss_index << 16;
}
inline uint64_t structure_of(const Descriptor& scene) {
  return scene.kind == DescriptorKind::kAccelerationStructure ? scene.address : 0;
}

// What TraceRay checks before it traces, from the shader itself or for a hit object.
template <class Ray>
inline void check_trace_of(Invocation& invocation, uint32_t site, bool unknown,
                           const Descriptor& acceleration_structure, uint32_t flags,
                           uint32_t indices, const Ray& ray) {
  if (unknown) {
    reached(invocation, ReachedBy::kTraceRay, site, structure_of(acceleration_structure), flags,
            indices);
  }
  RayDesc plain;
  __builtin_memcpy(&plain, &ray, sizeof(plain));
  check_trace(invocation, site, flags, plain);
}

template <class Ray, class Payload>
inline void trace_ray(Invocation& invocation, uint32_t site, uint32_t type, bool unknown,
                      const Descriptor& acceleration_structure, uint32_t flags, uint32_t mask,
                      uint32_t ray_contribution, uint32_t multiplier, uint32_t miss_index,
                      const Ray& ray, Payload& payload) {
  check_trace_of(invocation, site, unknown, acceleration_structure, flags,
                 trace_indices(mask, ray_contribution, multiplier, miss_index), ray);
  PayloadBox<Payload> box = {{kPayloadMagic, type, sizeof(Payload), 0}, payload, {}};
  shader::trace_ray(invocation, acceleration_structure, flags, mask, ray_contribution, multiplier,
                    miss_index, ray, box.value);
  payload = box.value;
}

template <class Hit, class Ray, class Payload>
inline Hit trace_hit_object(Invocation& invocation, uint32_t site, uint32_t type, bool unknown,
                            const Descriptor& acceleration_structure, uint32_t flags, uint32_t mask,
                            uint32_t ray_contribution, uint32_t multiplier, uint32_t miss_index,
                            const Ray& ray, Payload& payload) {
  check_trace_of(invocation, site, unknown, acceleration_structure, flags,
                 trace_indices(mask, ray_contribution, multiplier, miss_index), ray);
  PayloadBox<Payload> box = {{kPayloadMagic, type, sizeof(Payload), 0}, payload, {}};
  const Hit hit =
      shader::trace_hit_object<Hit>(invocation, acceleration_structure, flags, mask,
                                    ray_contribution, multiplier, miss_index, ray, box.value);
  payload = box.value;
  return hit;
}

template <class Hit, class Payload>
inline void invoke_hit_object(Invocation& invocation, uint32_t site, uint32_t type, const Hit& hit,
                              Payload& payload) {
  check_depth(invocation, site);
  PayloadBox<Payload> box = {{kPayloadMagic, type, sizeof(Payload), 0}, payload, {}};
  shader::invoke_hit_object(invocation, hit, box.value);
  payload = box.value;
}

template <class Data>
inline void call_shader(Invocation& invocation, uint32_t site, uint32_t type, bool unknown,
                        uint32_t shader_index, Data& data) {
  if (unknown) reached(invocation, ReachedBy::kCallShader, site, 0, 0, shader_index);
  PayloadBox<Data> box = {{kPayloadMagic, type, sizeof(Data), 0}, data, {}};
  shader::call_shader(invocation, shader_index, box.value);
  data = box.value;
}

inline void check_hit_kind(Invocation& invocation, uint32_t site, uint32_t hit_kind) {
  if (hit_kind > 127) report(invocation, Finding::kHitKind, site, 0, 0, hit_kind);
}

template <class Attributes>
inline bool report_hit(Invocation& invocation, uint32_t site, bool& ended, float t,
                       uint32_t hit_kind, const Attributes& attributes) {
  check_hit_kind(invocation, site, hit_kind);
  return shader::report_hit(invocation, ended, t, hit_kind, attributes);
}

// ---------------------------------------------------------------------------------------------
// RayQuery

inline void check_query_trace(Invocation& invocation, uint32_t site, uint32_t flags,
                              const RayDesc& ray) {
  check_ray(invocation, site, ray);
  constexpr uint32_t kSkipClosestHitShader = 8;
  if (!legal_ray_flags(flags & ~kRayQueryPermissions) || (flags & kSkipClosestHitShader) != 0) {
    report(invocation, Finding::kQueryFlags, site, 0, 0, flags);
  }
}

// `unknown`: the structure is none that the shader names.
inline void reached_inline(Invocation& invocation, uint32_t site, bool unknown,
                           const Descriptor& scene, uint32_t flags, uint32_t mask) {
  if (!unknown && (flags & kRayQueryPermissions) == kRayQueryPermissions) return;
  reached(invocation, unknown ? ReachedBy::kTraceRayInline : ReachedBy::kTraceRayInlineKnown, site,
          structure_of(scene), flags, mask & 0xFFu);
}

template <class Ray>
inline void trace_ray_inline(Invocation& invocation, uint32_t site, bool unknown, RayQuery& query,
                             const Descriptor& scene, uint32_t flags, uint32_t mask,
                             const Ray& ray) {
  reached_inline(invocation, site, unknown, scene, flags, mask);
  RayDesc plain;
  __builtin_memcpy(&plain, &ray, sizeof(plain));
  check_query_trace(invocation, site, flags, plain);
  begin_query(invocation, query, scene, flags, mask, plain);
}

inline constexpr uint32_t kAnyType = ~0u;

// To be called before something of the candidate is read or committed that only a candidate of
// `type` has.
inline const RayQuery& candidate(Invocation& invocation, uint32_t site, const RayQuery& query,
                                 uint32_t type, uint32_t what) {
  if (!query.has_candidate || (type != kAnyType && query.candidate.type != type)) {
    report(invocation, Finding::kNoCandidate, site, 0, 0, what, query.has_candidate ? 1 : 0,
           query.candidate.type, type);
  }
  return query;
}
inline const RayQuery& committed(Invocation& invocation, uint32_t site, const RayQuery& query,
                                 uint32_t type, uint32_t what) {
  const uint32_t status = query.committed.type;
  if (status == 0 || (type != kAnyType && status != type)) {
    report(invocation, Finding::kNoCommittedHit, site, 0, 0, what, status, type);
  }
  return query;
}

inline void query_commit_triangle(Invocation& invocation, uint32_t site, RayQuery& query) {
  candidate(invocation, site, query, kQueryTriangle, kAnyType);
  shader::query_commit_triangle(query);
}
inline void query_commit_procedural(Invocation& invocation, uint32_t site, RayQuery& query,
                                    float t) {
  candidate(invocation, site, query, kQueryProcedural, kAnyType);
  if (query.has_candidate && !(t >= query.ray.t_min && t <= query.committed.t)) {
    report(invocation, Finding::kCommitOutOfRange, site, 0, 0, __builtin_bit_cast(uint32_t, t),
           __builtin_bit_cast(uint32_t, query.ray.t_min),
           __builtin_bit_cast(uint32_t, query.committed.t));
  }
  shader::query_commit_procedural(query, t);
}

}  // namespace kaamos::shader::checked
