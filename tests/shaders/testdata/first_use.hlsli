// SPDX-License-Identifier: MIT
// Values whose bits tell whether the same code computes them.
float angle_of(uint i) { return atan2(sin(0.37 * i), float(SCALE) + rsqrt(1.0 + i)); }
