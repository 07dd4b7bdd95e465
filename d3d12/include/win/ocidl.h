// SPDX-License-Identifier: MIT
#pragma once

#include <unknwnbase.h>
