// SPDX-License-Identifier: MIT
// Microsoft's d3d12.h, and what programs use of newer ones.
#pragma once

#include <directx/d3d12.h>

#include <kaamos_d3d12_interfaces.h>
#include <kaamos_d3d12_newer.h>
