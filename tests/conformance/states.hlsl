// SPDX-License-Identifier: MIT
// Small shaders to make state objects from. Only Start needs an argument, a global one.
RWByteAddressBuffer words : register(u0);

struct Payload {
  uint value;
};
struct Attributes {
  float2 barycentrics;
};

// Calls the callable shaders 0 and 1, which return one word each.
[shader("raygeneration")]
void Start() {
  for (uint i = 0; i < 2; ++i) {
    Payload payload;
    payload.value = 77;
    CallShader(i, payload);
    words.Store(4 * i, payload.value);
  }
}

[shader("raygeneration")]
void Idle() {}

[shader("callable")]
void CallA(inout Payload payload) {
  payload.value = 1;
}

[shader("callable")]
void CallB(inout Payload payload) {
  payload.value = 2;
}

[shader("miss")]
void MissA(inout Payload payload) {}

[shader("miss")]
void MissB(inout Payload payload) {}

export uint Scaled(uint value) {
  return 2 * value;
}

export float Scaled(float value) {
  return 2 * value;
}

[shader("closesthit")]
void HitA(inout Payload payload, Attributes attributes) {}

[shader("anyhit")]
void AnyA(inout Payload payload, Attributes attributes) {}

[shader("intersection")]
void BoxA() {
  Attributes attributes;
  attributes.barycentrics = float2(0, 0);
  ReportHit(1, 0, attributes);
}
