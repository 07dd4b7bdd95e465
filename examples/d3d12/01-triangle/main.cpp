// SPDX-License-Identifier: MIT
// The triangle of ../../01-triangle as a D3D12 program without a window.
#include "triangle.h"

int main(int argc, char** argv) {
  return RunProgram(argc, argv, [](const Options& options) {
    Triangle triangle(options);
    triangle.DispatchRays();
    triangle.WritePicture(triangle.image(), D3D12_RESOURCE_STATE_UNORDERED_ACCESS);
  });
}
