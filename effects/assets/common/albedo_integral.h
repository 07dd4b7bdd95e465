// SPDX-License-Identifier: MIT
/// @file
/// The integral of which specular_albedo.h keeps a table. The build makes the table with it
/// (write_tables.cpp).
#pragma once

#include <glm/glm.hpp>

namespace kaamos::effects {

/// Integral over the hemisphere, split into what F0 is multiplied by (x) and what is added (y).
/// `cosine` is that of the view direction with the normal, 0 to 1; `roughness` is perceptual, 0
/// (a mirror) to 1. Single scattering: what facets reflect onto other facets is lost. The error is
/// below 0.0025, and below 0.001 where the cosine is at least 0.1.
glm::dvec2 integrate_specular_albedo(double cosine, double roughness);

}  // namespace kaamos::effects
