// SPDX-License-Identifier: MIT
#pragma once

#include <d3d11.h>
