// SPDX-License-Identifier: MIT
// Access to buffers through descriptors, by address; the GLSL counterpart of
// kaamos/shader/memory.h. Bounds apply to each scalar: one at or past the window's end reads zero
// and is not written. A read or write that is completely inside is one access; the loop after it
// handles the scalars of an access that straddles the end. bool takes 4 bytes.

//@ k_Descriptor
struct k_Descriptor {
  uint kind_access;  // DescriptorKind | DescriptorAccess << 16
  uint stride;
  uint64_t address;
  uint64_t size;
  uint format;
  uint reserved;
};
//@ k_null
const k_Descriptor k_null = k_Descriptor(0u, 0u, 0UL, 0UL, 0u, 0u);
// Where a value is: `base` may be read in [0, bytes).
//@ k_Window
struct k_Window {
  uint64_t base;
  uint64_t bytes;
};

//@ k_buffer_bytes
uint64_t k_buffer_bytes(k_Descriptor d) {
  uint kind = d.kind_access & 0xFFFFu;
  return kind >= 1u && kind <= 4u ? d.size : 0UL;  // constant, raw, structured, typed
}
// Memory without bounds (a root descriptor) stays without: then the compiler sees a constant and
// removes every comparison with it.
//@ k_rest
uint64_t k_rest(uint64_t bytes, uint offset) {
  if (bytes == ~0UL) return bytes;
  return bytes > offset ? bytes - offset : 0UL;
}
// The caller clears the low bits of the offset that an access ignores: two, or one for 16-bit
// scalars.
//@ k_window
k_Window k_window(k_Descriptor d, uint offset) {
  uint64_t size = k_buffer_bytes(d);
  return k_Window(d.address + offset, k_rest(size, offset));
}
//@ k_element_window
k_Window k_element_window(k_Descriptor d, uint index, uint offset) {
  if ((d.kind_access & 0xFFFFu) != 3u || offset >= d.stride) return k_Window(0UL, 0UL);
  uint64_t at = uint64_t(index) * d.stride + offset;
  // An element ends at the view's stride, even if the shader takes it to be longer.
  uint64_t in_element = uint64_t(d.stride - offset);
  if (d.size == ~0UL) return k_Window(d.address + at, in_element);
  if (at >= d.size) return k_Window(0UL, 0UL);
  return k_Window(d.address + at, min(d.size - at, in_element));
}
// The part of a window that begins `offset` bytes into it.
//@ k_sub_window
k_Window k_sub_window(k_Window w, uint offset) {
  return k_Window(w.base + offset, k_rest(w.bytes, offset));
}
// For atomics; 0 if out of bounds or misaligned.
//@ k_atomic_address_32
uint64_t k_atomic_address_32(k_Window w) {
  return w.bytes >= 4UL && (w.base & 3UL) == 0UL ? w.base : 0UL;
}
//@ k_atomic_address_64
uint64_t k_atomic_address_64(k_Window w) {
  return w.bytes >= 8UL && (w.base & 7UL) == 0UL ? w.base : 0UL;
}
// The counter of a structured buffer; 0 if it has none.
//@ k_counter_address
uint64_t k_counter_address(k_Descriptor d) {
  if ((d.kind_access & 0xFFFFu) != 3u) return 0UL;
  return (uint64_t(d.kind_access >> 18) << 32 | uint64_t(d.format)) << 2;
}

//@ k_Words1
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer k_Words1 { uint v; };
//@ k_Words2
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer k_Words2 { uvec2 v; };
//@ k_Words3
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer k_Words3 { uvec3 v; };
//@ k_Words4
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer k_Words4 { uvec4 v; };
//@ k_Halfword
layout(buffer_reference, scalar, buffer_reference_align = 2) buffer k_Halfword { uint16_t v; };

//@ k_read_words1
uint k_read_words1(k_Window w, uint at) {
  if (w.bytes < uint64_t(at) + 4UL) return 0u;
  return k_Words1(w.base + at).v;
}
//@ k_write_words1
void k_write_words1(k_Window w, uint at, uint value) {
  if (w.bytes >= uint64_t(at) + 4UL) k_Words1(w.base + at).v = value;
}
//@ k_read_words2
uvec2 k_read_words2(k_Window w, uint at) {
  if (w.bytes >= uint64_t(at) + 8UL) return k_Words2(w.base + at).v;
  uvec2 value = uvec2(0u);
  for (uint i = 0u; i < 1u && w.bytes >= uint64_t(at) + 4u * i + 4UL; ++i) {
    value[i] = k_Words1(w.base + at + 4u * i).v;
  }
  return value;
}
//@ k_write_words2
void k_write_words2(k_Window w, uint at, uvec2 value) {
  if (w.bytes >= uint64_t(at) + 8UL) {
    k_Words2(w.base + at).v = value;
    return;
  }
  for (uint i = 0u; i < 1u && w.bytes >= uint64_t(at) + 4u * i + 4UL; ++i) {
    k_Words1(w.base + at + 4u * i).v = value[i];
  }
}
//@ k_read_words3
uvec3 k_read_words3(k_Window w, uint at) {
  if (w.bytes >= uint64_t(at) + 12UL) return k_Words3(w.base + at).v;
  uvec3 value = uvec3(0u);
  for (uint i = 0u; i < 2u && w.bytes >= uint64_t(at) + 4u * i + 4UL; ++i) {
    value[i] = k_Words1(w.base + at + 4u * i).v;
  }
  return value;
}
//@ k_write_words3
void k_write_words3(k_Window w, uint at, uvec3 value) {
  if (w.bytes >= uint64_t(at) + 12UL) {
    k_Words3(w.base + at).v = value;
    return;
  }
  for (uint i = 0u; i < 2u && w.bytes >= uint64_t(at) + 4u * i + 4UL; ++i) {
    k_Words1(w.base + at + 4u * i).v = value[i];
  }
}
//@ k_read_words4
uvec4 k_read_words4(k_Window w, uint at) {
  if (w.bytes >= uint64_t(at) + 16UL) return k_Words4(w.base + at).v;
  uvec4 value = uvec4(0u);
  for (uint i = 0u; i < 3u && w.bytes >= uint64_t(at) + 4u * i + 4UL; ++i) {
    value[i] = k_Words1(w.base + at + 4u * i).v;
  }
  return value;
}
//@ k_write_words4
void k_write_words4(k_Window w, uint at, uvec4 value) {
  if (w.bytes >= uint64_t(at) + 16UL) {
    k_Words4(w.base + at).v = value;
    return;
  }
  for (uint i = 0u; i < 3u && w.bytes >= uint64_t(at) + 4u * i + 4UL; ++i) {
    k_Words1(w.base + at + 4u * i).v = value[i];
  }
}

//@ k_read_bool
bool k_read_bool(k_Window w, uint at) { return k_read_words1(w, at) != 0u; }
//@ k_write_bool
void k_write_bool(k_Window w, uint at, bool value) { k_write_words1(w, at, uint(value)); }
//@ k_read_boolx2
bvec2 k_read_boolx2(k_Window w, uint at) { return notEqual(k_read_words2(w, at), uvec2(0u)); }
//@ k_write_boolx2
void k_write_boolx2(k_Window w, uint at, bvec2 value) { k_write_words2(w, at, uvec2(value)); }
//@ k_read_boolx3
bvec3 k_read_boolx3(k_Window w, uint at) { return notEqual(k_read_words3(w, at), uvec3(0u)); }
//@ k_write_boolx3
void k_write_boolx3(k_Window w, uint at, bvec3 value) { k_write_words3(w, at, uvec3(value)); }
//@ k_read_boolx4
bvec4 k_read_boolx4(k_Window w, uint at) { return notEqual(k_read_words4(w, at), uvec4(0u)); }
//@ k_write_boolx4
void k_write_boolx4(k_Window w, uint at, bvec4 value) { k_write_words4(w, at, uvec4(value)); }
//@ k_read_i32
int k_read_i32(k_Window w, uint at) { return int(k_read_words1(w, at)); }
//@ k_write_i32
void k_write_i32(k_Window w, uint at, int value) { k_write_words1(w, at, uint(value)); }
//@ k_read_i32x2
ivec2 k_read_i32x2(k_Window w, uint at) { return ivec2(k_read_words2(w, at)); }
//@ k_write_i32x2
void k_write_i32x2(k_Window w, uint at, ivec2 value) { k_write_words2(w, at, uvec2(value)); }
//@ k_read_i32x3
ivec3 k_read_i32x3(k_Window w, uint at) { return ivec3(k_read_words3(w, at)); }
//@ k_write_i32x3
void k_write_i32x3(k_Window w, uint at, ivec3 value) { k_write_words3(w, at, uvec3(value)); }
//@ k_read_i32x4
ivec4 k_read_i32x4(k_Window w, uint at) { return ivec4(k_read_words4(w, at)); }
//@ k_write_i32x4
void k_write_i32x4(k_Window w, uint at, ivec4 value) { k_write_words4(w, at, uvec4(value)); }
//@ k_read_u32
uint k_read_u32(k_Window w, uint at) { return k_read_words1(w, at); }
//@ k_write_u32
void k_write_u32(k_Window w, uint at, uint value) { k_write_words1(w, at, value); }
//@ k_read_u32x2
uvec2 k_read_u32x2(k_Window w, uint at) { return k_read_words2(w, at); }
//@ k_write_u32x2
void k_write_u32x2(k_Window w, uint at, uvec2 value) { k_write_words2(w, at, value); }
//@ k_read_u32x3
uvec3 k_read_u32x3(k_Window w, uint at) { return k_read_words3(w, at); }
//@ k_write_u32x3
void k_write_u32x3(k_Window w, uint at, uvec3 value) { k_write_words3(w, at, value); }
//@ k_read_u32x4
uvec4 k_read_u32x4(k_Window w, uint at) { return k_read_words4(w, at); }
//@ k_write_u32x4
void k_write_u32x4(k_Window w, uint at, uvec4 value) { k_write_words4(w, at, value); }
//@ k_read_f32
float k_read_f32(k_Window w, uint at) { return uintBitsToFloat(k_read_words1(w, at)); }
//@ k_write_f32
void k_write_f32(k_Window w, uint at, float value) { k_write_words1(w, at, floatBitsToUint(value)); }
//@ k_read_f32x2
vec2 k_read_f32x2(k_Window w, uint at) { return uintBitsToFloat(k_read_words2(w, at)); }
//@ k_write_f32x2
void k_write_f32x2(k_Window w, uint at, vec2 value) { k_write_words2(w, at, floatBitsToUint(value)); }
//@ k_read_f32x3
vec3 k_read_f32x3(k_Window w, uint at) { return uintBitsToFloat(k_read_words3(w, at)); }
//@ k_write_f32x3
void k_write_f32x3(k_Window w, uint at, vec3 value) { k_write_words3(w, at, floatBitsToUint(value)); }
//@ k_read_f32x4
vec4 k_read_f32x4(k_Window w, uint at) { return uintBitsToFloat(k_read_words4(w, at)); }
//@ k_write_f32x4
void k_write_f32x4(k_Window w, uint at, vec4 value) { k_write_words4(w, at, floatBitsToUint(value)); }

//@ k_read_u16
uint16_t k_read_u16(k_Window w, uint at) {
  if (w.bytes < uint64_t(at) + 2UL) return uint16_t(0);
  return k_Halfword(w.base + at).v;
}
//@ k_write_u16
void k_write_u16(k_Window w, uint at, uint16_t value) {
  if (w.bytes >= uint64_t(at) + 2UL) k_Halfword(w.base + at).v = value;
}
//@ k_read_i16
int16_t k_read_i16(k_Window w, uint at) { return int16_t(k_read_u16(w, at)); }
//@ k_write_i16
void k_write_i16(k_Window w, uint at, int16_t value) { k_write_u16(w, at, uint16_t(value)); }
//@ k_read_f16
float16_t k_read_f16(k_Window w, uint at) { return uint16BitsToFloat16(k_read_u16(w, at)); }
//@ k_write_f16
void k_write_f16(k_Window w, uint at, float16_t value) {
  k_write_u16(w, at, float16BitsToUint16(value));
}

// A 64-bit scalar is either completely in bounds or out of bounds.
//@ k_read_u64
uint64_t k_read_u64(k_Window w, uint at) {
  if (w.bytes < uint64_t(at) + 8UL) return 0UL;
  return packUint2x32(k_Words2(w.base + at).v);
}
//@ k_write_u64
void k_write_u64(k_Window w, uint at, uint64_t value) {
  if (w.bytes >= uint64_t(at) + 8UL) k_Words2(w.base + at).v = unpackUint2x32(value);
}
//@ k_read_i64
int64_t k_read_i64(k_Window w, uint at) { return int64_t(k_read_u64(w, at)); }
//@ k_write_i64
void k_write_i64(k_Window w, uint at, int64_t value) { k_write_u64(w, at, uint64_t(value)); }
//@ k_read_f64
double k_read_f64(k_Window w, uint at) {
  return packDouble2x32(unpackUint2x32(k_read_u64(w, at)));
}
//@ k_write_f64
void k_write_f64(k_Window w, uint at, double value) {
  k_write_u64(w, at, packUint2x32(unpackDouble2x32(value)));
}

// {elements or bytes, stride, 0, 0}. A root descriptor has no size, so the largest number is
// returned.
//@ k_clamped_size
uint k_clamped_size(uint64_t n) { return n > 0xFFFFFFFFUL ? 0xFFFFFFFFu : uint(n); }
//@ k_buffer_dimensions
uvec4 k_buffer_dimensions(k_Descriptor d) {
  if (d.address == 0UL) return uvec4(0u);
  uint kind = d.kind_access & 0xFFFFu;
  if (kind == 2u) return uvec4(k_clamped_size(d.size), 1u, 0u, 0u);
  if (kind == 3u) {
    return uvec4(d.stride != 0u ? k_clamped_size(d.size / d.stride) : 0u, d.stride, 0u, 0u);
  }
  if (kind == 4u) {
    uint bytes = k_typed_layout(d.format) & 0xFFu;
    return uvec4(bytes != 0u ? k_clamped_size(d.size / bytes) : 0u, 0u, 0u, 0u);
  }
  return uvec4(0u);
}
