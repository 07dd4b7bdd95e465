// SPDX-License-Identifier: MIT
// HLSL's operators on scalars and vectors of one type; the GLSL counterpart of
// kaamos/shader/operators.h. Nothing is undefined: shift counts are masked, x / 0 and x % 0 on
// integers have all bits set, the lowest integer / -1 is itself, and % has the dividend's sign.
// [D3D11.3: ishl, udiv]

//@ k_add ints floats any
$T k_add($T a, $T b) { return a + b; }
//@ k_subtract ints floats any
$T k_subtract($T a, $T b) { return a - b; }
//@ k_multiply ints floats any
$T k_multiply($T a, $T b) { return a * b; }
//@ k_divide floats any
$T k_divide($T a, $T b) { return a / b; }
//@ k_divide u16 u32 u64 each
$T k_divide($T a, $T b) { return b == $0 ? ~$0 : a / b; }
// Both sides of a choice may be computed, and on a CPU driver the lowest integer / -1 would trap.
//@ k_divide i16 i32 i64 each
$T k_divide($T a, $T b) {
  $T quotient = a / (b == $0 || b == ~$0 ? $1 : b);
  return b == $0 ? ~$0 : b == ~$0 ? -a : quotient;
}
//@ k_modulo floats each
$T k_modulo($T a, $T b) { return k_fmod(a, b); }
//@ k_modulo u16 u32 u64 each
$T k_modulo($T a, $T b) { return b == $0 ? ~$0 : a % b; }
//@ k_modulo i16 i32 i64 each
$T k_modulo($T a, $T b) {
  // GLSL's % is undefined if an operand is negative.
  $T divisor = b == $0 || b == ~$0 ? $1 : b;
  $T rest = a - a / divisor * divisor;
  return b == $0 ? ~$0 : rest;
}

//@ k_bit_and ints any
$T k_bit_and($T a, $T b) { return a & b; }
//@ k_bit_or ints any
$T k_bit_or($T a, $T b) { return a | b; }
//@ k_bit_xor ints any
$T k_bit_xor($T a, $T b) { return a ^ b; }
//@ k_bit_and b each
bool k_bit_and(bool a, bool b) { return a && b; }
//@ k_bit_or b each
bool k_bit_or(bool a, bool b) { return a || b; }
//@ k_bit_xor b each
bool k_bit_xor(bool a, bool b) { return a != b; }
//@ k_bit_not ints any
$T k_bit_not($T a) { return ~a; }
//@ k_bit_not b each
bool k_bit_not(bool a) { return !a; }

//@ k_shift_left i16 u16 any
$T k_shift_left($T a, $T b) { return a << (b & $T(15)); }
//@ k_shift_left i32 u32 any
$T k_shift_left($T a, $T b) { return a << (b & $T(31)); }
//@ k_shift_left i64 u64 any
$T k_shift_left($T a, $T b) { return a << (b & $T(63)); }
//@ k_shift_right i16 u16 any
$T k_shift_right($T a, $T b) { return a >> (b & $T(15)); }
//@ k_shift_right i32 u32 any
$T k_shift_right($T a, $T b) { return a >> (b & $T(31)); }
//@ k_shift_right i64 u64 any
$T k_shift_right($T a, $T b) { return a >> (b & $T(63)); }

//@ k_less ints floats scalar
bool k_less($T a, $T b) { return a < b; }
//@ k_less ints floats vector
$B k_less($T a, $T b) { return lessThan(a, b); }
//@ k_less_equal ints floats scalar
bool k_less_equal($T a, $T b) { return a <= b; }
//@ k_less_equal ints floats vector
$B k_less_equal($T a, $T b) { return lessThanEqual(a, b); }
//@ k_greater ints floats scalar
bool k_greater($T a, $T b) { return a > b; }
//@ k_greater ints floats vector
$B k_greater($T a, $T b) { return greaterThan(a, b); }
//@ k_greater_equal ints floats scalar
bool k_greater_equal($T a, $T b) { return a >= b; }
//@ k_greater_equal ints floats vector
$B k_greater_equal($T a, $T b) { return greaterThanEqual(a, b); }
//@ k_equal b ints floats scalar
bool k_equal($T a, $T b) { return a == b; }
//@ k_equal b ints floats vector
$B k_equal($T a, $T b) { return equal(a, b); }
//@ k_not_equal b ints floats scalar
bool k_not_equal($T a, $T b) { return a != b; }
//@ k_not_equal b ints floats vector
$B k_not_equal($T a, $T b) { return notEqual(a, b); }

//@ k_negate ints floats any
$T k_negate($T a) { return -a; }
//@ k_not b each
bool k_not(bool a) { return !a; }
//@ k_not ints floats each
bool k_not($T a) { return a == $0; }

// A scalar condition can also select a whole vector.
//@ k_select b ints floats each
$T k_select(bool condition, $T a, $T b) { return condition ? a : b; }
//@ k_select b ints floats vector
$T k_select(bool condition, $T a, $T b) { return condition ? a : b; }

// Denormal floats count as zero of the same sign, as arguments and as results [D3D11.3: fp32]. The
// driver may do that in arithmetic; this is for functions that work on bits.
//@ k_flushed
float k_flushed(float x) {
  uint bits = floatBitsToUint(x);
  return (bits & 0x7F800000u) != 0u ? x : uintBitsToFloat(bits & 0x80000000u);
}
