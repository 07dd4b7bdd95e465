// SPDX-License-Identifier: MIT
// The page of --claims: everything that the sources say in numbers, beside what is measured here.
#pragma once

#include <string>

#include "effects/measure/claims/claims.h"

namespace kaamos::measure {

// Markdown: the claims about ratios, the deck's milliseconds per megapixel and per ray, and the
// survey's Table 1 with the share that each pass has of the sum.
std::string claims_page(const Options& options, const ClaimTable& table);

// Milliseconds over 1 000 000 pixels, and nanoseconds over rays.
struct Rate {
  double ms_per_megapixel = 0;
  double ns_per_ray = 0;
};
Rate rate_of(double ms, double pixels, double rays);

}  // namespace kaamos::measure
