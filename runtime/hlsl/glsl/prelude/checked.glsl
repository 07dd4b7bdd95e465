// SPDX-License-Identifier: MIT
// The checks in shaders of checked libraries, where other shaders trust the application; the GLSL
// counterpart of kaamos/shader/checked.h. The entry point defines g_check_shader and g_check_index.

//@ k_CheckEntry
// shader::spirv::CheckEntry
layout(buffer_reference, scalar, buffer_reference_align = 8) buffer k_CheckEntry {
  uint key;
  uint count;
  uint finding;
  uint site;
  uint binding;
  uint write;
  uint64_t local_arguments;
  uint64_t values[5];
  uint index[3];
  uint shader;
};
//@ k_CheckState
// shader::spirv::CheckState
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer k_CheckState {
  uint64_t ranges;
  uint64_t entries;
  uint range_count;
  uint max_recursion_depth;
  uint64_t reached;
};
//@ k_CheckResults
// From shader::spirv::CheckState::ran_nothing on.
layout(buffer_reference, scalar, buffer_reference_align = 8) buffer k_CheckResults {
  uint ran_nothing;
};
//@ k_ReachedEntry
// shader::spirv::ReachedEntry
layout(buffer_reference, scalar, buffer_reference_align = 8) buffer k_ReachedEntry {
  uint key;
  uint shader;
  uint64_t acceleration_structure;
  uint by;
  uint site;
  uint ray_flags;
  uint indices;
};
//@ k_CheckStatus
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer k_CheckStatus {
  uint64_t before[9];
  uint64_t checks;
};
//@ k_AddressRange
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer k_AddressRange {
  uint64_t address;
  uint64_t size;
};
//@ k_checks
uint64_t k_checks() { return k_CheckStatus(k_dispatch.status).checks; }

// There is one entry per kind of finding and place; of identical ones only the first is reported.
//@ k_tell
uint g_check_shader();
uvec3 g_check_index();
void k_tell(uint finding, uint site, uint origin, uint write, uint64_t a, uint64_t b, uint64_t c,
            uint64_t d) {
  uint64_t checks = k_checks();
  if (checks == 0UL) return;
  uint64_t entries = k_CheckState(checks).entries;
  uint key = ((site * 0x9E3779B1u ^ finding) * 0x85EBCA6Bu ^ (g_check_shader() << 10) ^ origin) | 1u;
  for (uint i = 0u; i < 32u; ++i) {
    k_CheckEntry entry = k_CheckEntry(entries + uint64_t(((key >> 1) + i) & 255u) * 96UL);
    uint old = atomicCompSwap(entry.key, 0u, key);
    if (old == 0u) {
      entry.finding = finding;
      entry.site = site;
      entry.binding = origin & 0x7FFFFFFFu;
      entry.write = write;
      entry.local_arguments = k_local_arguments();
      entry.values[0] = a;
      entry.values[1] = b;
      entry.values[2] = c;
      entry.values[3] = d;
      uvec3 index = g_check_index();
      entry.index[0] = index.x;
      entry.index[1] = index.y;
      entry.index[2] = index.z;
      entry.shader = g_check_shader();
    }
    if (old == 0u || old == key) {
      atomicAdd(entry.count, 1u);
      return;
    }
  }
}

// Records a call whose arguments are not constant: each distinct one once, as long as there is
// room.
//@ k_reached
uint g_check_shader();
void k_reached(uint by, uint site, uint64_t scene, uint flags, uint indices) {
  uint64_t checks = k_checks();
  if (checks == 0UL) return;
  uint64_t entries = k_CheckState(checks).reached;
  uvec2 address = unpackUint2x32(scene);
  uint key = (site * 0x9E3779B1u ^ flags) * 0x85EBCA6Bu ^ (indices * 0xC2B2AE35u) ^
             (address.x >> 8) * 0x27D4EB2Fu ^ address.y ^ (g_check_shader() << 4) ^ by;
  key = (key ^ key >> 15) | 1u;
  for (uint i = 0u; i < 16u; ++i) {
    k_ReachedEntry entry = k_ReachedEntry(entries + uint64_t(((key >> 1) + i) & 1023u) * 32UL);
    uint old = entry.key;
    if (old == 0u) old = atomicCompSwap(entry.key, 0u, key);
    if (old == key) return;
    if (old != 0u) continue;
    entry.shader = g_check_shader();
    entry.acceleration_structure = scene;
    entry.by = by;
    entry.site = site;
    entry.ray_flags = flags;
    entry.indices = indices;
    return;
  }
}
// Records a ray (1) or call (2) for which no closest-hit, miss or callable shader ran.
//@ k_ran_nothing
void k_ran_nothing(uint by) {
  uint64_t checks = k_checks();
  if (checks != 0UL) atomicOr(k_CheckResults(checks + 32UL).ran_nothing, by);
}
//@ k_structure_of
uint64_t k_structure_of(k_Descriptor scene) {
  return (scene.kind_access & 0xFFFFu) == 7u ? scene.address : 0UL;
}
// The same as checked::reached_inline.
//@ k_reached_inline
void k_reached_inline(uint site, bool unknown, k_Descriptor scene, uint flags, uint mask) {
  if (!unknown && flags >> 30 == 3u) return;
  k_reached(unknown ? 1u : 3u, site, k_structure_of(scene), flags, mask & 0xFFu);
}

//@ k_bytes_from
uint64_t k_bytes_from(uint64_t address) {
  uint64_t checks = k_checks();
  if (checks == 0UL) return ~0UL;
  uint64_t first = k_CheckState(checks).ranges;
  uint count = k_CheckState(checks).range_count;
  if (count == 0u) return ~0UL;
  while (count > 1u) {
    uint part = count / 2u;
    uint64_t middle = first + uint64_t(part) * 16UL;
    if (k_AddressRange(middle).address <= address) first = middle;
    count -= part;
  }
  uint64_t begin = k_AddressRange(first).address;
  uint64_t size = k_AddressRange(first).size;
  return address >= begin && address - begin < size ? size - (address - begin) : 0UL;
}

//@ k_explain_missing
void k_explain_missing(uint site, uint binding, uint source, uint offset, uint index, uint count,
                       uint array_index) {
  if (array_index >= count && count != 0xFFFFFFFFu) {
    k_tell(4u, site, binding, 0u, uint64_t(array_index), uint64_t(count), 0UL, 0UL);
    return;
  }
  bool local = (source & 0x100u) != 0u;
  uint64_t arguments = local ? k_local_arguments() : k_global_arguments();
  if (local && arguments == 0UL) return;
  uint kind = source >> 16 & 0xFFu;
  uint64_t table = k_read_argument(arguments + offset);
  uint64_t address = table + (uint64_t(index) + array_index) * 32UL;
  uint64_t begin = kind == 6u ? k_dispatch.sampler_heap_begin : k_dispatch.view_heap_begin;
  uint64_t end = kind == 6u ? k_dispatch.sampler_heap_end : k_dispatch.view_heap_end;
  uint64_t found = k_heap_slot(address, begin, end);
  if (found == 0UL) {
    k_tell(5u, site, binding, 0u, address, (end - begin) / 32UL, 1UL, table);
    return;
  }
  uint has = k_DescriptorSlot(found).d.kind_access;
  if ((has & 0xFFFFu) == 0u) return;
  k_tell(6u, site, binding, 0u, uint64_t(has & 0xFFFFu), uint64_t(has >> 16 & 3u), uint64_t(kind),
         uint64_t(source >> 24));
}

//@ k_resolve_checked
k_Descriptor k_resolve_checked(uint source, uint offset, uint index, uint count, uint array_index,
                               uint binding) {
  k_Descriptor d = k_resolve(source, offset, index, count, array_index);
  uint from = source & 0xFFu;
  uint kind = source >> 16 & 0xFFu;
  d.reserved = binding;
  if (from == 2u && kind != 7u) {
    d.kind_access = kind | (source >> 24) << 16;
    d.stride = count;
    d.reserved = binding | 0x80000000u;
    if (d.address != 0UL) d.size = k_bytes_from(d.address);
  }
  return d;
}
// A view whose resource is gone reads as a null descriptor; one whose texture is in a state that
// forbids its use is reported, but used. [kaamos/shader/checked.h]
//@ k_usable
k_Descriptor k_usable(k_Descriptor d, uint binding, uint index, uint site) {
  uint kind = d.kind_access & 0xFFFFu;
  if (kind == 0u || kind == 6u || d.address == 0UL) return d;
  uint64_t key = d.address | (d.kind_access == 0x10005u ? 1UL << 62 : 0UL);
  if (k_bytes_from(key) != 0UL) return d;
  bool wrong_state = kind == 5u && k_bytes_from(key | 1UL << 61) != 0UL;
  k_tell(17u, site, binding, 0u, wrong_state ? key : d.address, uint64_t(kind), uint64_t(index),
         wrong_state ? 1UL : 0UL);
  if (!wrong_state) {
    d.kind_access = 0u;
    d.address = 0UL;
    d.size = 0UL;
  }
  return d;
}
// Checks a descriptor at the moment it is used.
//@ k_used
k_Descriptor k_used(k_Descriptor d, uint source, uint offset, uint index, uint count,
                    uint array_index, uint binding, uint site) {
  uint from = source & 0xFFu;
  if (from == 3u && (d.kind_access & 0xFFFFu) == 0u) {
    k_explain_missing(site, binding, source, offset, index, count, array_index);
  }
  if (from == 3u && count != 1u) d = k_usable(d, binding, array_index, site);
  if (from == 2u && (source >> 16 & 0xFFu) == 1u && (d.address & 255UL) != 0UL) {
    k_tell(3u, site, binding, 0u, d.address, 0UL, 0UL, 256UL);
  }
  return d;
}
//@ k_resolve_used
k_Descriptor k_resolve_used(uint source, uint offset, uint index, uint count, uint array_index,
                            uint binding, uint site) {
  k_Descriptor d = k_resolve_checked(source, offset, index, count, array_index, binding);
  return k_used(d, source, offset, index, count, array_index, binding, site);
}

//@ k_heap_resource_checked
k_Descriptor k_heap_resource_checked(uint index, uint kind, uint access, uint site) {
  bool of_samplers = kind == 6u;
  uint64_t begin = of_samplers ? k_dispatch.sampler_heap_begin : k_dispatch.view_heap_begin;
  uint64_t end = of_samplers ? k_dispatch.sampler_heap_end : k_dispatch.view_heap_end;
  uint64_t count = (end - begin) / 32UL;
  k_Descriptor d = k_heap_resource(index, of_samplers);
  if (uint64_t(index) >= count) {
    k_tell(5u, site, 0u, 0u, uint64_t(index), count, 0UL, 0UL);
  } else if ((d.kind_access & 0xFFFFu) != 0u && !k_matches(d, kind, access)) {
    k_tell(6u, site, 0u, 0u, uint64_t(d.kind_access & 0xFFFFu), uint64_t(d.kind_access >> 16 & 3u),
           uint64_t(kind), uint64_t(access));
  } else {
    d = k_usable(d, 0u, index, site);
  }
  return d;
}

// `at` is counted from the start of the buffer.
//@ k_check_access
void k_check_access(k_Descriptor d, uint64_t at, uint bytes, uint alignment, uint write, uint site) {
  if ((d.reserved & 0x80000000u) != 0u && at + bytes > d.size) {
    k_tell(d.address == 0UL || d.size == 0UL ? 2u : 1u, site, d.reserved, write, d.address, at,
           uint64_t(bytes), d.size);
  }
  if (((d.address + at) & uint64_t(alignment - 1u)) != 0UL) {
    k_tell(3u, site, d.reserved, write, d.address, at, uint64_t(bytes), uint64_t(alignment));
  }
}
//@ k_window_checked
k_Window k_window_checked(k_Descriptor d, uint offset, uint bytes, uint alignment, uint write,
                          uint site) {
  k_check_access(d, uint64_t(offset), bytes, alignment, write, site);
  return k_window(d, offset & ~(alignment - 1u));
}
//@ k_element_window_checked
k_Window k_element_window_checked(k_Descriptor d, uint index, uint offset, uint bytes,
                                  uint alignment, uint write, uint site) {
  k_check_access(d, uint64_t(index) * d.stride + offset, bytes, alignment, write, site);
  return k_element_window(d, index, offset);
}

//@ k_legal_ray_flags
bool k_legal_ray_flags(uint flags) {
  return bitCount(flags & 0xC3u) <= 1 && (flags & 0x30u) != 0x30u &&
         ((flags & 0x100u) == 0u || (flags & 0x230u) == 0u) && (flags & ~0x7FFu) == 0u;
}
//@ k_check_ray
void k_check_ray(vec3 origin, float t_min, vec3 direction, float t_max, uint flags, bool inline_ray,
                 uint site) {
  bool nan = any(isnan(origin)) || any(isnan(direction)) || isnan(t_min) || isnan(t_max);
  if (nan || t_min < 0.0 || t_min > t_max) {
    k_tell(nan ? 7u : 8u, site, 0u, 0u, packUint2x32(floatBitsToUint(origin.xy)),
           packUint2x32(floatBitsToUint(vec2(origin.z, t_min))),
           packUint2x32(floatBitsToUint(direction.xy)),
           packUint2x32(floatBitsToUint(vec2(direction.z, t_max))));
  }
  // A query's flags may have kRayQueryPermissions of kaamos/shader/query_permissions.h.
  uint own = inline_ray ? flags & 0x3FFFFFFFu : flags;
  if (!k_legal_ray_flags(own) || (inline_ray && (flags & 8u) != 0u)) {
    k_tell(inline_ray ? 10u : 9u, site, 0u, 0u, uint64_t(flags), 0UL, 0UL, 0UL);
  }
}
//@ k_check_depth
void k_check_depth(uint depth, uint site) {
  uint64_t checks = k_checks();
  if (checks == 0UL) return;
  uint most = k_CheckState(checks).max_recursion_depth;
  if (depth >= most) k_tell(11u, site, 0u, 0u, uint64_t(depth), uint64_t(most), 0UL, 0UL);
}
