// SPDX-License-Identifier: MIT
// From an HLSL resource variable to its descriptor; the GLSL counterpart of
// kaamos/shader/bindings.h. Anything unbound, out of bounds or of the wrong kind becomes the null
// descriptor, which reads as zeros. The structures are those of kaamos/shader/spirv_interface.h.

//@ k_DispatchBlock
layout(buffer_reference, scalar, buffer_reference_align = 16) readonly buffer k_DispatchBlock {
  uint64_t view_heap_begin;
  uint64_t view_heap_end;
  uint64_t sampler_heap_begin;
  uint64_t sampler_heap_end;
  uint64_t instances;
  uint64_t top_levels;
  uint64_t empty_top_level;
  uint64_t status;
  uint top_level_mask;
  uint miss_count;
  uint callable_count;
  uint hit_group_count;
  uint dimensions[3];
  uint base[3];
  uint rows;
  uint reserved;
};
//@ k_dispatch_address
layout(push_constant, scalar) uniform k_PushConstants { uint64_t k_dispatch_address; };
//@ k_dispatch
#define k_dispatch k_DispatchBlock(k_dispatch_address)

// A shader with a shader record defines KAAMOS_SHADER_RECORD before the prelude.
//@ k_local_arguments
#ifdef KAAMOS_SHADER_RECORD
layout(shaderRecordEXT, scalar) buffer k_ShaderRecord { uint64_t k_record_arguments; };
uint64_t k_local_arguments() { return k_record_arguments; }
#else
uint64_t k_local_arguments() { return 0UL; }
#endif
//@ k_global_arguments
uint64_t k_global_arguments() { return k_dispatch_address + 112UL; }

//@ k_DescriptorSlot
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer k_DescriptorSlot {
  k_Descriptor d;
};
// Arguments are only aligned to 4 bytes.
//@ k_read_argument
uint64_t k_read_argument(uint64_t address) { return packUint2x32(k_Words2(address).v); }

//@ k_matches
bool k_matches(k_Descriptor d, uint kind, uint access) {
  if (kind == 0u) return true;  // the slot does not specify
  if ((d.kind_access & 0xFFFFu) != kind) return false;
  // The access of constant buffers, samplers and acceleration structures is not compared.
  return kind == 1u || kind == 6u || kind == 7u || access == 2u ||
         (d.kind_access >> 16 & 3u) == access;
}
// The address if it is the start of a slot in [begin, end), else 0: a handle can hold any value.
//@ k_heap_slot
uint64_t k_heap_slot(uint64_t address, uint64_t begin, uint64_t end) {
  bool inside = address >= begin && address < end && ((address - begin) & 31UL) == 0UL;
  return inside ? address : 0UL;
}
//@ k_from_table
k_Descriptor k_from_table(uint kind, uint access, uint64_t handle, uint index) {
  uint64_t address = handle + uint64_t(index) * 32UL;
  uint64_t found = 0UL;
  if (kind != 6u) {
    found = k_heap_slot(address, k_dispatch.view_heap_begin, k_dispatch.view_heap_end);
  }
  if (kind == 6u || (found == 0UL && kind == 0u)) {
    found = k_heap_slot(address, k_dispatch.sampler_heap_begin, k_dispatch.sampler_heap_end);
  }
  if (found == 0UL) return k_null;
  k_Descriptor d = k_DescriptorSlot(found).d;
  if (k_matches(d, kind, access)) return d;
  return k_null;
}

// Resolves a binding from its four constants and an array index, which is 0 unless it is an array.
// The constants are known when a pipeline is created, so only one of these branches remains. A root
// descriptor's kind and size are constant too, except for the size of a null one, so the compiler
// removes the comparisons in k_window and the like.
//@ k_resolve
k_Descriptor k_resolve(uint source, uint offset, uint index, uint count, uint array_index) {
  uint from = source & 0xFFu;
  uint kind = source >> 16 & 0xFFu;
  uint access = source >> 24;
  if (from == 0u) return k_null;
  if (from == 4u) {  // static sampler, for any index
    return k_Descriptor(6u | 2u << 16, 0u, uint64_t(offset), 0UL, 0u, 0u);
  }
  bool local = (source & 0x100u) != 0u;
  uint64_t arguments = local ? k_local_arguments() : k_global_arguments();
  bool there = !local || arguments != 0UL;
  if (from == 3u) {  // descriptor table
    if (!there || (array_index >= count && count != 0xFFFFFFFFu)) return k_null;
    uint64_t handle = k_read_argument(arguments + offset) + uint64_t(index) * 32UL;
    return k_from_table(kind, access, handle, array_index);
  }
  if (array_index != 0u) return k_null;  // root parameters are not arrays
  if (from == 1u) {
    return k_Descriptor(1u | 2u << 16, 0u, arguments + offset, there ? uint64_t(count) : 0UL, 0u,
                        0u);
  }
  uint64_t address = 0UL;
  if (there) address = k_read_argument(arguments + offset);
  // No device has such addresses, and a driver that runs on the CPU would crash.
  if (uint(address >> 32) > 0x00FFFFFFu) address = 0UL;
  // A root descriptor has no bounds. [D3D12]
  return k_Descriptor(kind | access << 16, count, address, address != 0UL ? ~0UL : 0UL, 0u, 0u);
}

// ResourceDescriptorHeap[index], SamplerDescriptorHeap[index]
//@ k_heap_resource
k_Descriptor k_heap_resource(uint index, bool of_samplers) {
  uint64_t begin = of_samplers ? k_dispatch.sampler_heap_begin : k_dispatch.view_heap_begin;
  uint64_t end = of_samplers ? k_dispatch.sampler_heap_end : k_dispatch.view_heap_end;
  if (uint64_t(index) >= (end - begin) / 32UL) return k_null;
  return k_DescriptorSlot(begin + uint64_t(index) * 32UL).d;
}
