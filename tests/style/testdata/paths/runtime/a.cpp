// SPDX-License-Identifier: MIT
const char* kShader = "/home/somebody/shader.hlsl";
const char* kRelative = "examples/home/x";
// see /Users/Ada/output
