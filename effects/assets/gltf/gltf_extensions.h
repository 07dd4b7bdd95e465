// SPDX-License-Identifier: MIT
// Tells which extensions of glTF are read, and what is lost without the others.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "effects/assets/common/errors.h"

namespace kaamos::effects {

/// True if the loader reads what the extension says.
bool is_gltf_extension_read(std::string_view name);

/// What follows the name of an extension that the build has no library for: " (install ...)", with
/// Debian's name of the library. Empty where the extension is read, or none would help.
std::string gltf_remedy(std::string_view name);

/// Refuses a file that requires an extension which is not read.
/// @errors KA3020.
Status check_required_extensions(const std::vector<std::string>& required);

/// A sentence for each extension that is not read: what the picture lacks. Names are not repeated.
void warn_of_extensions(const std::vector<std::string>& used, std::vector<std::string>& warnings);

}  // namespace kaamos::effects
