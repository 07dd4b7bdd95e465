// SPDX-License-Identifier: MIT
// SPDX-License-Identifier: MIT
struct Payload{uint4 numbers}
RayDesc test_ray(float ){}Payload trace(uint ,uint ,RayDesc ){trace(RAY_FLAG_NONE,0x0f,test_ray(0)).numbers
