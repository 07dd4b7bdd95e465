// SPDX-License-Identifier: MIT
cbuffer:register(b0){int u0
float3 row[u0
