// SPDX-License-Identifier: MIT
// The path-traced references of a folder, such as those that come with the source tree, as the
// truth of studies.
#pragma once

#include <optional>
#include <string>
#include <utility>

#include "effects/measure/run/options.h"
#include "effects/reference/path_sums.h"

namespace kaamos::measure {

// The size of the scene's reference; nothing where the folder has none.
std::optional<std::pair<std::uint32_t, std::uint32_t>> committed_size(const Options& options);

// Sums whose means are those of the reference, and whose halves differ as its errors say, evenly
// over the picture. Nothing where it is of another size, moment or material, where an option
// changes what paths find, or where it has fewer samples than options.measure_truth.
std::optional<effects::PathSums> committed_truth(const Options& options);

}  // namespace kaamos::measure
