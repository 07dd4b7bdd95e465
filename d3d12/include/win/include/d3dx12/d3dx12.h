// SPDX-License-Identifier: MIT
// As programs name it that have the Agility SDK's package itself as an include folder.
#pragma once

#include <d3dx12.h>
