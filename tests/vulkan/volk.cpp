// SPDX-License-Identifier: MIT
// Of programs that do not link the backend, which has its own.
#define VOLK_IMPLEMENTATION
#define VK_NO_PROTOTYPES
#include <volk.h>
