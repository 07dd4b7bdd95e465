// SPDX-License-Identifier: MIT
//
// The resources behind the registers of an HLSL test, and how to run it.
//
// `results` (u0) is 64 KiB of zeros. Every other buffer holds 256 words; word i is i.
//
// A texture is 8 x 8 with two mips; texel (x, y) of mip m of element e is (x, y, m, e). Its name
// says what it is, because bindings do not: "_1d", "_3d" (depth 2, e is z), "_cube" (12 faces),
// "_array" after these, or alone for a 2D array (2 elements); "_uint" makes each texel one integer,
// x + 10 y + 100 m + 1000 e, "_single" one float of that value, "_half" one of 16 bits, 1;
// "_pairs" two, that integer and 1, as R32G32_UINT ("_pairs_signed": SINT). The formats of
// "_single", "_half" and "_pairs" are those of a typed buffer of such a name, too. "counted" in a
// structured buffer's name gives it a counter that starts at 0, or at 8 with "_from_8". Samplers
// use point filtering and clamp, comparison samplers LESS.
//
// ResourceDescriptorHeap: slot 0 a Texture2D, 1 a ByteAddressBuffer, 2 a constant buffer, 3
// `results`. SamplerDescriptorHeap: slot 0 point and clamp, 1 point and wrap.
//
// Acceleration structures and hit groups: scene.h.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "runtime/hlsl/ir/result.h"

namespace kaamos::shader {
struct LibraryDesc;
}

namespace kaamos::test {

// Runs the compute export with `size` groups, or the ray generation export with `size` threads, and
// returns the contents of `results`. With `told`, uses a checked device and returns its errors and
// warnings there, except that the library was not compiled for the device (it may be checked
// already). `wave_lanes` is DeviceDesc::WaveLanes.
hlsl::Result<std::vector<std::byte>> run_on_device(const std::string& backend,
                                                   const shader::LibraryDesc& library,
                                                   const uint32_t (&size)[3],
                                                   std::vector<std::string>* told = nullptr,
                                                   uint32_t wave_lanes = 0);

}  // namespace kaamos::test
