// SPDX-License-Identifier: MIT
// Declarations that MIDL writes into the headers it makes.
#pragma once

#include <winerror.h>

typedef void* RPC_IF_HANDLE;
typedef long RPC_STATUS;
#define RPC_S_OK 0
