// SPDX-License-Identifier: MIT
//
// The names that messages of checked mode give to things.
#pragma once

#include <cstdint>
#include <string>

#include <rtapi/format.h>
#include <rtapi/raytracing.h>

#include "runtime/backend/address_map.h"
#include "runtime/backend/linked_pipeline.h"
#include "runtime/errors/text.h"

namespace kaamos::checks {

using errors::hex;
using errors::in_quotes;

// "buffer \"sofa.vb\" (416 bytes)", "an unnamed buffer (416 bytes)".
std::string buffer_name(const runtime::Allocation& allocation);
// "byte 416 of buffer \"sofa.vb\" (416 bytes)"; "address 0x1f, which is in no live buffer".
std::string address_name(const runtime::AddressMap& addresses, uint64_t address);
// "bytes 416..432 of buffer \"sofa.vb\" (416 bytes)". The range may end past the buffer.
std::string range_name(const runtime::AddressMap& addresses, uint64_t address, uint64_t size_bytes);

const char* stage_name(shader::Stage stage);             // "any-hit"
const char* record_kind_name(runtime::RecordKind kind);  // "ray generation", "hit group"

// The record of a dispatch that contains an address: "hit group table record 7"; "ray generation
// record"; "" if none does.
std::string record_name(const rtapi::DispatchRaysDesc& desc, uint64_t address);
// Names a binding as the shader declares it: "t1 \"vertices\"", "b0, space 1 \"material\"".
std::string binding_name(const shader::BindingDesc& binding);
// "Texture2DArray of uint", for shader::texture_shape().
std::string texture_name(uint32_t shape);
// "R8G8B8A8_UNORM"; "DXGI format 99" for formats that no draw writes to.
std::string format_name(rtapi::Format format);
std::string float_name(float value);  // "0.25"
// "pixel (812,440)", with a third index only where the dispatch has a depth.
std::string pixel_name(const uint32_t index[3], uint32_t depth);

}  // namespace kaamos::checks
