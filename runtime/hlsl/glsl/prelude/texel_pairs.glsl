// SPDX-License-Identifier: MIT
// Interlocked operations on texels of R32G32_UINT and R32G32_SINT as one number of 64 bits. Each
// returns the previous value; if there is no such texel, it does nothing and returns 0. Not every
// driver has image atomics of that size, so a lock in the dispatch's status guards the texels.

//@ k_Lock
layout(buffer_reference, scalar, buffer_reference_align = 8) buffer k_Lock {
  uint removal_reason;
  uint held;
};
//@ k_pair_images_$D_$C 1d 1d_array 2d 2d_array 3d i u
layout(set = 0, binding = 1) coherent uniform $Pimage$DIM k_pair_images_$D_$C[];
//@ k_pair_image_$D_$C 1d 1d_array 2d 2d_array 3d i u
#define k_pair_image_$D_$C(t) k_pair_images_$D_$C[nonuniformEXT(uint(t.address))]
//@ k_pair_format_i
const uint k_pair_format_i = 18u;
//@ k_pair_format_u
const uint k_pair_format_u = 17u;
// `operation` is AtomicOp of the IR.
//@ k_pair_result_u
uint64_t k_pair_result_u(uint operation, uint64_t old, uint64_t compare, uint64_t value) {
  switch (operation) {
    case 0u: return old + value;
    case 1u: return old & value;
    case 2u: return old | value;
    case 3u: return old ^ value;
    case 4u: return min(old, value);
    case 5u: return max(old, value);
    case 6u: return value;
    default: return old == compare ? value : old;
  }
}
//@ k_pair_result_i
uint64_t k_pair_result_i(uint operation, uint64_t old, uint64_t compare, uint64_t value) {
  switch (operation) {
    case 4u: return uint64_t(min(int64_t(old), int64_t(value)));
    case 5u: return uint64_t(max(int64_t(old), int64_t(value)));
    default: return k_pair_result_u(operation, old, compare, value);
  }
}
//@ k_image_atomic_64_$D_$C 1d 1d_array 2d 2d_array 3d i u
uint64_t k_image_atomic_64_$D_$C(k_Descriptor t, $X at, uint operation, uint64_t compare,
                                 uint64_t value) {
  if (!k_can_write(t, $Ru, k_class_$C) || t.format != k_pair_format_$C ||
      !k_inside(at, imageSize(k_pair_image_$D_$C(t)))) {
    return 0UL;
  }
  k_Lock lock = k_Lock(k_dispatch.status);
  uint64_t old = 0UL;
  bool done = false;
  while (!done) {
    if (atomicCompSwap(lock.held, 0u, 1u) == 0u) {
      memoryBarrier();
      old = packUint2x32(uvec2(imageLoad(k_pair_image_$D_$C(t), at).xy));
      uvec2 next = unpackUint2x32(k_pair_result_$C(operation, old, compare, value));
      imageStore(k_pair_image_$D_$C(t), at, $V(next, 0u, 0u));
      memoryBarrier();
      atomicExchange(lock.held, 0u);
      done = true;
    }
  }
  return old;
}
