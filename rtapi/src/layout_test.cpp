// SPDX-License-Identifier: MIT
//
// Compares rtapi's numbers, sizes and offsets with Microsoft's d3d12.h. Nearly all checks are
// static; the program itself only prints how many there are.
#include <cstdio>
#include <cstring>

#include "rtapi/testing/same_layout.h"

namespace {

// Bit fields have no offset, so their place in memory is checked by value.
bool instance_bit_fields_agree() {
  rtapi::RaytracingInstanceDesc ours;
  ours.InstanceID = 0x123456;
  ours.InstanceMask = 0x78;
  ours.InstanceContributionToHitGroupIndex = 0x9ABCDE;
  ours.Flags = 0x0F;
  D3D12_RAYTRACING_INSTANCE_DESC theirs = {};
  for (int i = 0; i < 3; ++i) theirs.Transform[i][i] = 1;
  theirs.InstanceID = 0x123456;
  theirs.InstanceMask = 0x78;
  theirs.InstanceContributionToHitGroupIndex = 0x9ABCDE;
  theirs.Flags = 0x0F;
  return std::memcmp(&ours, &theirs, sizeof ours) == 0;
}

}  // namespace

int main() {
  if (!instance_bit_fields_agree()) {
    std::puts("FAILED: bit fields of D3D12_RAYTRACING_INSTANCE_DESC");
    return 1;
  }
  using namespace rtapi::testing;
  std::printf("%d numbers, sizes and offsets agree with d3d12.h\n",
              layout_formats() + layout_graphics() + layout_numbers() + layout_structs());
  return 0;
}
