// SPDX-License-Identifier: MIT
// The parts of the report that are the same for every study.
#pragma once

namespace kaamos::measure {

extern const char* const kPageStyle;   // CSS
extern const char* const kPageScript;  // JavaScript; reads the global `study`

}  // namespace kaamos::measure
