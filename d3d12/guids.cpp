// SPDX-License-Identifier: MIT
// The GUIDs that Microsoft's headers define where INITGUID is defined.
#define INITGUID
#include <windows.h>

#include <directx/d3d12.h>
#include <directx/d3d12sdklayers.h>
#include <directx/d3d12shader.h>
#include <directx/dxcore.h>
#include <dxgidebug.h>
