// SPDX-License-Identifier: MIT
// Measures how far a misspelt name is from what may have been meant.
#pragma once

#include <cstddef>
#include <string_view>

namespace kaamos::hlsl {

// The number of letters to change, insert, remove or swap with their neighbour to get from one to
// the other; more than `limit` if the lengths already differ by more.
size_t edit_distance(std::string_view a, std::string_view b, size_t limit);

}  // namespace kaamos::hlsl
