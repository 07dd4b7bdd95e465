// SPDX-License-Identifier: MIT
#pragma once

#include <handleapi.h>
