// SPDX-License-Identifier: MIT
// Interfaces, ComPtr and Event. Modules and activation are out.
#pragma once

#include <wrl/client.h>
#include <wrl/event.h>
#include <wrl/implements.h>
