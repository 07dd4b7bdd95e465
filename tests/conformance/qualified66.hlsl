// SPDX-License-Identifier: MIT
// The same in lib_6_6 with -enable-payload-qualifiers.
#define ENABLED_IN_6_6
#include "qualified.hlsl"
