// SPDX-License-Identifier: MIT
// Grids, and dispatches whose arguments are in GPU memory.

RaytracingAccelerationStructure scene : register(t0);
ByteAddressBuffer numbers : register(t1);
RWByteAddressBuffer words : register(u0);

cbuffer Root : register(b0) {
  uint number;
  uint second;
};

cbuffer Record : register(b0, space1) {
  uint ordinal;
};

uint cellOf(uint3 at, uint3 size) {
  return at.x + size.x * (at.y + size.y * at.z);
}

// Adds one to the cell's word.
[shader("raygeneration")]
void CountCell() {
  words.InterlockedAdd(4 * cellOf(DispatchRaysIndex(), DispatchRaysDimensions()), 1u);
}

// Counts the invocations; the last cell notes its index and dimensions.
[shader("raygeneration")]
void LastCell() {
  words.InterlockedAdd(0, 1u);
  const uint3 at = DispatchRaysIndex();
  const uint3 size = DispatchRaysDimensions();
  if (all(at == size - 1)) {
    words.Store3(4, at);
    words.Store3(16, size);
  }
}

// Each command has 32 bytes from 32 on, in order of execution; each cell counts.
[shader("raygeneration")]
void Note() {
  const uint3 at = DispatchRaysIndex();
  if (any(at != 0)) return;
  uint slot;
  words.InterlockedAdd(0, 1u, slot);
  const uint base = 32 + 32 * slot;
  words.Store4(base, uint4(number, second, ordinal, 0));
  words.Store3(base + 12, DispatchRaysDimensions());
}

// The same for the first word of t1.
[shader("raygeneration")]
void NoteNumbers() {
  uint slot;
  words.InterlockedAdd(0, 1u, slot);
  words.Store(32 + 32 * slot, numbers.Load(0));
}

// Writes two commands of {constant, description}: dimensions 3x2x1 and 4x1x1, the ray generation
// record at the address in `numbers`.
[shader("compute")]
[numthreads(1, 1, 1)]
void WriteArguments() {
  for (uint i = 0; i < 2; ++i) {
    const uint base = 108 * i;
    words.Store(base, 70 + i);
    words.Store2(base + 4, numbers.Load2(0));
    words.Store2(base + 12, uint2(64, 0));
    words.Store3(base + 92, i == 0 ? uint3(3, 2, 1) : uint3(4, 1, 1));
  }
}

// Counts the threads that ran with this number.
[shader("compute")]
[numthreads(4, 1, 1)]
void CountThreads() {
  words.InterlockedAdd(4 * number, 1u);
}
