// SPDX-License-Identifier: MIT
// Typed buffers: elements are decoded from memory by their DXGI_FORMAT and encoded to it; the GLSL
// counterpart of runtime/shader/texture/format_codec.cpp, with the same formats and rounding.
// Access is by address, because Vulkan views have limits on size and alignment that D3D12 views do
// not.

// The memory layout of a format: bytes | kind << 8 | channels << 12 | bits << 16 | order << 24; 0:
// not supported. Kinds: 0 unorm, 1 snorm, 2 uint, 3 sint, 4 float, 5 sRGB, 6 R11G11B10, 7 R9G9B9E5.
// Order 0: that many channels with that many bits, red first; for others see k_typed_fields.
//@ k_typed_layout
uint k_typed_layout(uint f) {
  uint l = 0u;
  l = f == 2u ? 0x204410u : l; l = f == 3u ? 0x204210u : l;
  l = f == 4u ? 0x204310u : l; l = f == 6u ? 0x20340Cu : l;
  l = f == 7u ? 0x20320Cu : l; l = f == 8u ? 0x20330Cu : l;
  l = f == 10u ? 0x104408u : l; l = f == 11u ? 0x104008u : l;
  l = f == 12u ? 0x104208u : l; l = f == 13u ? 0x104108u : l;
  l = f == 14u ? 0x104308u : l; l = f == 16u ? 0x202408u : l;
  l = f == 17u ? 0x202208u : l; l = f == 18u ? 0x202308u : l;
  l = f == 24u ? 0x1000004u : l; l = f == 25u ? 0x1000204u : l;
  l = f == 26u ? 0x604u : l; l = f == 28u ? 0x84004u : l;
  l = f == 29u ? 0x84504u : l; l = f == 30u ? 0x84204u : l;
  l = f == 31u ? 0x84104u : l; l = f == 32u ? 0x84304u : l;
  l = f == 34u ? 0x102404u : l; l = f == 35u ? 0x102004u : l;
  l = f == 36u ? 0x102204u : l; l = f == 37u ? 0x102104u : l;
  l = f == 38u ? 0x102304u : l; l = f == 41u ? 0x201404u : l;
  l = f == 42u ? 0x201204u : l; l = f == 43u ? 0x201304u : l;
  l = f == 49u ? 0x82002u : l; l = f == 50u ? 0x82202u : l;
  l = f == 51u ? 0x82102u : l; l = f == 52u ? 0x82302u : l;
  l = f == 54u ? 0x101402u : l; l = f == 56u ? 0x101002u : l;
  l = f == 57u ? 0x101202u : l; l = f == 58u ? 0x101102u : l;
  l = f == 59u ? 0x101302u : l; l = f == 61u ? 0x81001u : l;
  l = f == 62u ? 0x81201u : l; l = f == 63u ? 0x81101u : l;
  l = f == 64u ? 0x81301u : l; l = f == 65u ? 0x7000001u : l;
  l = f == 67u ? 0x704u : l; l = f == 85u ? 0x2000002u : l;
  l = f == 86u ? 0x3000002u : l; l = f == 87u ? 0x4000004u : l;
  l = f == 88u ? 0x5000004u : l; l = f == 91u ? 0x4000504u : l;
  l = f == 93u ? 0x5000504u : l; l = f == 115u ? 0x6000002u : l;
  return l;
}
// Shifts and widths of the channels, one byte each; width 0: not stored.
//@ k_typed_fields
uvec2 k_typed_fields(uint l) {
  uint order = l >> 24;
  if (order == 0u) {
    uint bits = l >> 16 & 0xFFu, channels = l >> 12 & 0xFu;
    return uvec2(0x03020100u * bits, (0x01010101u * bits) >> 8u * (4u - channels));
  }
  uvec2 fields = uvec2(0x1E140A00u, 0x020A0A0Au);  // 1: 10 10 10 2
  fields = order == 2u ? uvec2(0x0000050Bu, 0x00050605u) : fields;  // B5G6R5
  fields = order == 3u ? uvec2(0x0F00050Au, 0x01050505u) : fields;  // B5G5R5A1
  fields = order == 4u ? uvec2(0x18000810u, 0x08080808u) : fields;  // B8G8R8A8
  fields = order == 5u ? uvec2(0x18000810u, 0x00080808u) : fields;  // B8G8R8X8
  fields = order == 6u ? uvec2(0x0C000408u, 0x04040404u) : fields;  // B4G4R4A4
  fields = order == 7u ? uvec2(0x00000000u, 0x08000000u) : fields;  // A8
  return fields;
}
// The address of an element, or 0 if it is out of bounds.
//@ k_typed_element
uint64_t k_typed_element(k_Descriptor d, uint element, uint bytes) {
  uint64_t at = uint64_t(element) * bytes;
  bool inside = (d.kind_access & 0xFFFFu) == 4u && bytes != 0u && d.size >= uint64_t(bytes) &&
                at <= d.size - uint64_t(bytes);
  return inside ? d.address + at : 0UL;
}

//@ k_decode_channel
uint k_decode_channel(uint kind, uint bits, uint stored) {
  if (kind == 2u || (kind == 4u && bits == 32u)) return stored;
  if (kind == 4u) return floatBitsToUint(k_f16tof32(stored));
  int signed_value = int(stored << (32u - bits)) >> int(32u - bits);
  if (kind == 3u) return uint(signed_value);
  if (kind == 1u) {
    float x = float(signed_value) / float((1 << int(bits - 1u)) - 1);
    return floatBitsToUint(max(x, -1.0));
  }
  return floatBitsToUint(float(stored) / float((1u << bits) - 1u));
}
//@ k_srgb_to_linear
float k_srgb_to_linear(float x) {
  return x <= 0.04045 ? x / 12.92 : k_pow((x + 0.055) / 1.055, 2.4);
}
//@ k_decode_element
uvec4 k_decode_element(uint l, uvec4 words) {
  uint kind = l >> 8 & 0xFu;
  if (kind == 6u) {
    uint word = words.x;
    return uvec4(floatBitsToUint(k_f16tof32((word & 0x7FFu) << 4)),
                 floatBitsToUint(k_f16tof32((word >> 11 & 0x7FFu) << 4)),
                 floatBitsToUint(k_f16tof32((word >> 22) << 5)), 0x3F800000u);
  }
  if (kind == 7u) {
    float scale = uintBitsToFloat(((words.x >> 27) + 103u) << 23);  // 2^(e - 24)
    return uvec4(floatBitsToUint(float(words.x & 0x1FFu) * scale),
                 floatBitsToUint(float(words.x >> 9 & 0x1FFu) * scale),
                 floatBitsToUint(float(words.x >> 18 & 0x1FFu) * scale), 0x3F800000u);
  }
  uvec2 fields = k_typed_fields(l);
  bool integer = kind == 2u || kind == 3u;
  uvec4 texel = uvec4(0u, 0u, 0u, integer ? 1u : 0x3F800000u);
  for (int c = 0; c < 4; ++c) {
    uint bits = fields.y >> 8 * c & 0xFFu;
    if (bits != 0u) {
      uint shift = fields.x >> 8 * c & 0xFFu;
      uint stored = words[shift >> 5] >> (shift & 31u);
      if (bits < 32u) stored &= (1u << bits) - 1u;
      texel[c] = k_decode_channel(kind, bits, stored);
      if (kind == 5u && c < 3) {
        texel[c] = floatBitsToUint(k_srgb_to_linear(uintBitsToFloat(texel[c])));
      }
    }
  }
  return texel;
}
//@ k_load_typed
uvec4 k_load_typed(k_Descriptor d, uint element) {
  uint l = k_typed_layout(d.format);
  uint bytes = l & 0xFFu;
  uint64_t at = k_typed_element(d, element, bytes);
  if (at == 0UL) return uvec4(0u);
  uvec4 words = uvec4(0u);
  if (bytes == 16u) {
    words = k_Words4(at).v;
  } else if (bytes == 12u) {
    words.xyz = k_Words3(at).v;
  } else if (bytes == 8u) {
    words.xy = k_Words2(at).v;
  } else {
    words.x = k_Words1(at & ~3UL).v >> 8u * (uint(at) & 3u);
  }
  return k_decode_element(l, words);
}

// Rounds toward zero, as formats do. [D3D11.3 3.2.2]
//@ k_encode_half
uint k_encode_half(uint bits) {
  uint sign = bits >> 16 & 0x8000u;
  uint magnitude = bits & 0x7FFFFFFFu;
  if (magnitude >= 0x7F800000u) return k_f32tof16(uintBitsToFloat(bits));
  if (magnitude >= 0x477FE000u) return sign | 0x7BFFu;
  if (magnitude >= 0x38800000u) return sign | (magnitude - 0x38000000u) >> 13;
  return sign | uint(uintBitsToFloat(magnitude) * 16777216.0);
}
// Clamped to the format's range; NaN becomes 0 in normalized formats.
//@ k_encode_channel
uint k_encode_channel(uint kind, uint bits, uint value) {
  if (kind == 4u) return bits == 32u ? value : k_encode_half(value);
  uint mask = bits == 32u ? 0xFFFFFFFFu : (1u << bits) - 1u;
  if (kind == 2u) return min(value, mask);
  int high = int(mask >> 1);
  if (kind == 3u) return uint(clamp(int(value), -high - 1, high)) & mask;
  float x = uintBitsToFloat(value);
  if (isnan(x)) return 0u;
  if (kind == 1u) {
    precise float scaled = clamp(x, -1.0, 1.0) * float(high);
    precise float moved = scaled + (scaled < 0.0 ? -0.5 : 0.5);
    return uint(int(moved)) & mask;
  }
  precise float scaled = clamp(x, 0.0, 1.0) * float(mask) + 0.5;
  return uint(scaled);
}
// Five exponent bits, no sign: negative numbers give 0, and others are rounded toward zero.
// [D3D11.3 3.1.3.3, 3.2.2]
//@ k_encode_unsigned_float
uint k_encode_unsigned_float(uint value, uint mantissa) {
  uint infinity = 31u << mantissa;
  float x = uintBitsToFloat(value);
  if (isnan(x)) return infinity | 1u << (mantissa - 1u);
  if (!(x > 0.0)) return 0u;
  if (value == 0x7F800000u) return infinity;
  if (value < 0x38800000u) return uint(x * float(1u << (14u + mantissa)));  // 2^-14
  uint shift = 23u - mantissa;
  return min((value >> shift) - (112u << mantissa), infinity - 1u);
}
//@ k_encode_element
uvec4 k_encode_element(uint l, uvec4 texel) {
  uint kind = l >> 8 & 0xFu;
  uvec4 words = uvec4(0u);
  if (kind == 6u) {
    words.x = k_encode_unsigned_float(texel.x, 6u) | k_encode_unsigned_float(texel.y, 6u) << 11 |
              k_encode_unsigned_float(texel.z, 5u) << 22;
    return words;
  }
  uvec2 fields = k_typed_fields(l);
  for (int c = 0; c < 4; ++c) {
    uint bits = fields.y >> 8 * c & 0xFFu;
    if (bits != 0u) {
      uint shift = fields.x >> 8 * c & 0xFFu;
      words[shift >> 5] |= k_encode_channel(kind, bits, texel[c]) << (shift & 31u);
    }
  }
  return words;
}
// Changes part of a word so that a store to a neighbouring part cannot get lost.
//@ k_store_part
void k_store_part(uint64_t at, uint bytes, uint value) {
  uint shift = 8u * (uint(at) & 3u);
  uint mask = ((1u << 8u * bytes) - 1u) << shift;
  k_Words1 word = k_Words1(at & ~3UL);
  uint expected = word.v;
  for (uint i = 0u; i < 1024u; ++i) {
    uint found = atomicCompSwap(word.v, expected, (expected & ~mask) | value << shift);
    if (found == expected) break;
    expected = found;
  }
}
//@ k_store_typed
void k_store_typed(k_Descriptor d, uint element, uvec4 texel) {
  uint l = k_typed_layout(d.format);
  uint bytes = l & 0xFFu, kind = l >> 8 & 0xFu;
  uint64_t at = k_typed_element(d, element, bytes);
  // sRGB and shared-exponent formats cannot be written, as in D3D.
  if (at == 0UL || d.kind_access >> 16 != 1u || kind == 5u || kind == 7u) return;
  uvec4 words = k_encode_element(l, texel);
  if (bytes == 16u) {
    k_Words4(at).v = words;
  } else if (bytes == 12u) {
    k_Words3(at).v = words.xyz;
  } else if (bytes == 8u) {
    k_Words2(at).v = words.xy;
  } else if (bytes == 4u) {
    k_Words1(at).v = words.x;
  } else {
    k_store_part(at, bytes, words.x);
  }
}
// For atomics: only 32-bit formats with one channel; 0 if out of bounds.
//@ k_typed_address
uint64_t k_typed_address(k_Descriptor d, uint element) {
  bool fits = d.format >= 41u && d.format <= 43u && d.kind_access >> 16 == 1u;
  uint64_t at = k_typed_element(d, element, fits ? 4u : 0u);
  return (at & 3UL) == 0UL ? at : 0UL;
}
// The same for 64 bits: R32G32_UINT and R32G32_SINT.
//@ k_typed_address_64
uint64_t k_typed_address_64(k_Descriptor d, uint element) {
  bool fits = (d.format == 17u || d.format == 18u) && d.kind_access >> 16 == 1u;
  uint64_t at = k_typed_element(d, element, fits ? 8u : 0u);
  return (at & 7UL) == 0UL ? at : 0UL;
}
