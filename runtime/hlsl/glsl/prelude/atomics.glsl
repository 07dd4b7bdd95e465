// SPDX-License-Identifier: MIT
// The Interlocked operations on memory; the GLSL counterpart of kaamos/shader/atomics.h. Each
// returns the previous value; at address 0 (out of bounds) it does nothing and returns zero.
// Relaxed order: HLSL orders memory only by barriers.

//@ k_Atomic_u32
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer k_Atomic_u32 { uint v; };
//@ k_atomic_add_u32
uint k_atomic_add_u32(uint64_t address, uint value) {
  if (address == 0UL) return uint(0);
  return atomicAdd(k_Atomic_u32(address).v, value);
}
//@ k_atomic_and_u32
uint k_atomic_and_u32(uint64_t address, uint value) {
  if (address == 0UL) return uint(0);
  return atomicAnd(k_Atomic_u32(address).v, value);
}
//@ k_atomic_or_u32
uint k_atomic_or_u32(uint64_t address, uint value) {
  if (address == 0UL) return uint(0);
  return atomicOr(k_Atomic_u32(address).v, value);
}
//@ k_atomic_xor_u32
uint k_atomic_xor_u32(uint64_t address, uint value) {
  if (address == 0UL) return uint(0);
  return atomicXor(k_Atomic_u32(address).v, value);
}
//@ k_atomic_min_u32
uint k_atomic_min_u32(uint64_t address, uint value) {
  if (address == 0UL) return uint(0);
  return atomicMin(k_Atomic_u32(address).v, value);
}
//@ k_atomic_max_u32
uint k_atomic_max_u32(uint64_t address, uint value) {
  if (address == 0UL) return uint(0);
  return atomicMax(k_Atomic_u32(address).v, value);
}
//@ k_atomic_exchange_u32
uint k_atomic_exchange_u32(uint64_t address, uint value) {
  if (address == 0UL) return uint(0);
  return atomicExchange(k_Atomic_u32(address).v, value);
}
//@ k_atomic_compare_exchange_u32
uint k_atomic_compare_exchange_u32(uint64_t address, uint compare, uint value) {
  if (address == 0UL) return uint(0);
  return atomicCompSwap(k_Atomic_u32(address).v, compare, value);
}
//@ k_Atomic_i32
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer k_Atomic_i32 { int v; };
//@ k_atomic_add_i32
int k_atomic_add_i32(uint64_t address, int value) {
  if (address == 0UL) return int(0);
  return atomicAdd(k_Atomic_i32(address).v, value);
}
//@ k_atomic_and_i32
int k_atomic_and_i32(uint64_t address, int value) {
  if (address == 0UL) return int(0);
  return atomicAnd(k_Atomic_i32(address).v, value);
}
//@ k_atomic_or_i32
int k_atomic_or_i32(uint64_t address, int value) {
  if (address == 0UL) return int(0);
  return atomicOr(k_Atomic_i32(address).v, value);
}
//@ k_atomic_xor_i32
int k_atomic_xor_i32(uint64_t address, int value) {
  if (address == 0UL) return int(0);
  return atomicXor(k_Atomic_i32(address).v, value);
}
//@ k_atomic_min_i32
int k_atomic_min_i32(uint64_t address, int value) {
  if (address == 0UL) return int(0);
  return atomicMin(k_Atomic_i32(address).v, value);
}
//@ k_atomic_max_i32
int k_atomic_max_i32(uint64_t address, int value) {
  if (address == 0UL) return int(0);
  return atomicMax(k_Atomic_i32(address).v, value);
}
//@ k_atomic_exchange_i32
int k_atomic_exchange_i32(uint64_t address, int value) {
  if (address == 0UL) return int(0);
  return atomicExchange(k_Atomic_i32(address).v, value);
}
//@ k_atomic_compare_exchange_i32
int k_atomic_compare_exchange_i32(uint64_t address, int compare, int value) {
  if (address == 0UL) return int(0);
  return atomicCompSwap(k_Atomic_i32(address).v, compare, value);
}
//@ k_Atomic_u64
layout(buffer_reference, scalar, buffer_reference_align = 8) buffer k_Atomic_u64 { uint64_t v; };
//@ k_atomic_add_u64
uint64_t k_atomic_add_u64(uint64_t address, uint64_t value) {
  if (address == 0UL) return uint64_t(0);
  return atomicAdd(k_Atomic_u64(address).v, value);
}
//@ k_atomic_and_u64
uint64_t k_atomic_and_u64(uint64_t address, uint64_t value) {
  if (address == 0UL) return uint64_t(0);
  return atomicAnd(k_Atomic_u64(address).v, value);
}
//@ k_atomic_or_u64
uint64_t k_atomic_or_u64(uint64_t address, uint64_t value) {
  if (address == 0UL) return uint64_t(0);
  return atomicOr(k_Atomic_u64(address).v, value);
}
//@ k_atomic_xor_u64
uint64_t k_atomic_xor_u64(uint64_t address, uint64_t value) {
  if (address == 0UL) return uint64_t(0);
  return atomicXor(k_Atomic_u64(address).v, value);
}
//@ k_atomic_min_u64
uint64_t k_atomic_min_u64(uint64_t address, uint64_t value) {
  if (address == 0UL) return uint64_t(0);
  return atomicMin(k_Atomic_u64(address).v, value);
}
//@ k_atomic_max_u64
uint64_t k_atomic_max_u64(uint64_t address, uint64_t value) {
  if (address == 0UL) return uint64_t(0);
  return atomicMax(k_Atomic_u64(address).v, value);
}
//@ k_atomic_exchange_u64
uint64_t k_atomic_exchange_u64(uint64_t address, uint64_t value) {
  if (address == 0UL) return uint64_t(0);
  return atomicExchange(k_Atomic_u64(address).v, value);
}
//@ k_atomic_compare_exchange_u64
uint64_t k_atomic_compare_exchange_u64(uint64_t address, uint64_t compare, uint64_t value) {
  if (address == 0UL) return uint64_t(0);
  return atomicCompSwap(k_Atomic_u64(address).v, compare, value);
}
//@ k_Atomic_i64
layout(buffer_reference, scalar, buffer_reference_align = 8) buffer k_Atomic_i64 { int64_t v; };
//@ k_atomic_add_i64
int64_t k_atomic_add_i64(uint64_t address, int64_t value) {
  if (address == 0UL) return int64_t(0);
  return atomicAdd(k_Atomic_i64(address).v, value);
}
//@ k_atomic_and_i64
int64_t k_atomic_and_i64(uint64_t address, int64_t value) {
  if (address == 0UL) return int64_t(0);
  return atomicAnd(k_Atomic_i64(address).v, value);
}
//@ k_atomic_or_i64
int64_t k_atomic_or_i64(uint64_t address, int64_t value) {
  if (address == 0UL) return int64_t(0);
  return atomicOr(k_Atomic_i64(address).v, value);
}
//@ k_atomic_xor_i64
int64_t k_atomic_xor_i64(uint64_t address, int64_t value) {
  if (address == 0UL) return int64_t(0);
  return atomicXor(k_Atomic_i64(address).v, value);
}
//@ k_atomic_min_i64
int64_t k_atomic_min_i64(uint64_t address, int64_t value) {
  if (address == 0UL) return int64_t(0);
  return atomicMin(k_Atomic_i64(address).v, value);
}
//@ k_atomic_max_i64
int64_t k_atomic_max_i64(uint64_t address, int64_t value) {
  if (address == 0UL) return int64_t(0);
  return atomicMax(k_Atomic_i64(address).v, value);
}
//@ k_atomic_exchange_i64
int64_t k_atomic_exchange_i64(uint64_t address, int64_t value) {
  if (address == 0UL) return int64_t(0);
  return atomicExchange(k_Atomic_i64(address).v, value);
}
//@ k_atomic_compare_exchange_i64
int64_t k_atomic_compare_exchange_i64(uint64_t address, int64_t compare, int64_t value) {
  if (address == 0UL) return int64_t(0);
  return atomicCompSwap(k_Atomic_i64(address).v, compare, value);
}

// Floats are exchanged as bits.
//@ k_atomic_exchange_f32
float k_atomic_exchange_f32(uint64_t address, float value) {
  return uintBitsToFloat(k_atomic_exchange_u32(address, floatBitsToUint(value)));
}
//@ k_atomic_compare_exchange_f32
float k_atomic_compare_exchange_f32(uint64_t address, float compare, float value) {
  return uintBitsToFloat(k_atomic_compare_exchange_u32(address, floatBitsToUint(compare),
                                                       floatBitsToUint(value)));
}
