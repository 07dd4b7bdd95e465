// SPDX-License-Identifier: MIT
//
// Vulkan's functions, found at run time. Nothing links libvulkan, so a program can run without it
// and report that.
#define VOLK_IMPLEMENTATION
#include <volk.h>
