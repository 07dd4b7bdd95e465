// SPDX-License-Identifier: MIT
//
// The functions of Vulkan, found at run time: nothing links libvulkan, so that a program runs
// without one and says so.
#define VOLK_IMPLEMENTATION
#include <volk.h>
