// SPDX-License-Identifier: MIT
// A file of its own: a program that links the backend too takes volk's functions from there.
#define VOLK_IMPLEMENTATION
#define VK_NO_PROTOTYPES
#include <volk.h>
