// SPDX-License-Identifier: MIT
//
// What an HLSL test finds behind its registers, and running it.
//
// `results` (u0) is 64 KiB of zeros. Every other buffer holds 256 words, word i is i. A texture is
// 8 x 8, two mips, texel (x, y) of mip m of element e is (x, y, m, e) as floats, or the same as
// integers. An acceleration structure is null: every ray misses it. Samplers are point and clamp,
// comparison samplers LESS.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace kaamos::shader {
struct LibraryDesc;
}

namespace kaamos::test {

// Runs the compute export `main` (or the only one) as one group, or the ray generation export as
// one thread, and returns what is in `results`.
std::vector<std::byte> run_on_device(const shader::LibraryDesc& library, std::string& error);

}  // namespace kaamos::test
