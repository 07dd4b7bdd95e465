// SPDX-License-Identifier: MIT
// Microsoft's helper header in the folder that the Agility SDK gives it.
#pragma once

#include <d3dx12.h>
