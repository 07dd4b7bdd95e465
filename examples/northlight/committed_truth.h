// SPDX-License-Identifier: MIT
// The path-traced references that come with the source tree, as the truth of studies.
#pragma once

#include <optional>
#include <string>
#include <utility>

#include "effects/reference/path_sums.h"
#include "options.h"

namespace northlight {

// The size of the scene's reference; nothing where the tree has none.
std::optional<std::pair<std::uint32_t, std::uint32_t>> committed_size(const std::string& scene);

// Sums whose means are those of the reference, and whose halves differ as its errors say, evenly
// over the picture. Nothing where it is of another size, moment or material, where an option
// changes what paths find, or where it has fewer samples than options.measure_truth.
std::optional<kaamos::effects::PathSums> committed_truth(const Options& options);

}  // namespace northlight
