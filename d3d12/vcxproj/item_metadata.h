// SPDX-License-Identifier: MIT
//
// The metadata that every item has: %(Filename), %(FullPath) and so on.
#pragma once

#include <string>

namespace kaamos::vcxproj {

struct Item;

// Whether items have it without being given it.
bool is_well_known(const std::string& name);

// Its value, in terms of the item's file; %(RelativeDir) and %(Directory) end in a slash.
std::string well_known_value(const Item& item, const std::string& name);

}  // namespace kaamos::vcxproj
