// SPDX-License-Identifier: MIT
// Typed reads from the buffers of a glTF file. Files may be broken, so every read is checked
// against the size of its buffer view and buffer before a byte is touched.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "effects/assets/common/errors.h"

namespace tinygltf {
class Model;
}

namespace kaamos::effects {

/// Largest number of elements in an accessor.
inline constexpr std::size_t kMaxAccessorElements = std::size_t{1} << 27;
/// The limit for an accessor without a buffer view. Its elements are all zero, so without a limit a
/// file of 200 bytes could request any amount of memory.
inline constexpr std::size_t kMaxZeroElements = std::size_t{1} << 22;

/// Elements of an accessor as floats, `components` per element. Integers are converted, normalised
/// ones to 0..1 or -1..1 [glTF 2.0: Animations, normalised integers]. Sparse values are applied.
/// `where` names the user of the accessor in error texts.
/// Errors: index out of range, other component count, unknown component type, any byte outside the
/// buffer view or buffer, sparse index out of range.
Result<std::vector<float>> read_floats(const tinygltf::Model& model, int accessor,
                                       std::uint32_t components, const std::string& where);

/// Elements of a scalar accessor of unsigned type.
Result<std::vector<std::uint32_t>> read_indices(const tinygltf::Model& model, int accessor,
                                                const std::string& where);

/// The bytes of a buffer view.
Result<std::span<const std::uint8_t>> buffer_view_bytes(const tinygltf::Model& model, int view,
                                                        const std::string& where);

/// Components of an accessor's type: 1 for SCALAR .. 16 for MAT4; 0 if the id is out of range.
std::uint32_t accessor_components(const tinygltf::Model& model, int accessor);

}  // namespace kaamos::effects
