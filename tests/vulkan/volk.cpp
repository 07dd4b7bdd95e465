// SPDX-License-Identifier: MIT
// volk for programs that do not link the backend, which has its own copy.
#define VOLK_IMPLEMENTATION
#define VK_NO_PROTOTYPES
#include <volk.h>
