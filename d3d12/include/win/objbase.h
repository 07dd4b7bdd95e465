// SPDX-License-Identifier: MIT
#pragma once

#include <combaseapi.h>
#include <objidlbase.h>
