// SPDX-License-Identifier: MIT
// Prints a hash for each layer of OpenEXR files. Frames with the same lines are equal to the bit.
#include <cinttypes>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <string>

#include "effects/assets/image/exr.h"

namespace {

// 64-bit FNV-1a over the bits of floats, so that -0 and NaN payloads count too.
class Hash {
 public:
  void add(std::uint32_t value) {
    for (int byte = 0; byte < 4; ++byte) {
      state_ = (state_ ^ (value >> (8 * byte) & 0xFF)) * 0x100000001B3ull;
    }
  }
  std::uint64_t value() const { return state_; }

 private:
  std::uint64_t state_ = 0xCBF29CE484222325ull;
};

std::uint64_t hash_layer(const kaamos::effects::FloatImage& image) {
  Hash hash;
  hash.add(image.width);
  hash.add(image.height);
  hash.add(image.channels);
  for (const float value : image.values) {
    std::uint32_t bits = 0;
    std::memcpy(&bits, &value, sizeof(bits));
    hash.add(bits);
  }
  return hash.value();
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: kaamos-layer-hashes FILE.exr...\n");
    return 2;
  }
  for (int i = 1; i < argc; ++i) {
    const auto file = kaamos::effects::read_exr(argv[i]);
    if (!file.ok()) {
      std::fprintf(stderr, "kaamos-layer-hashes: %s\n", file.error().message.c_str());
      return 1;
    }
    for (const kaamos::effects::ExrLayer& layer : file.value().layers) {
      std::printf("%016" PRIx64 " %s\n", hash_layer(layer.image),
                  layer.name.empty() ? "(picture)" : layer.name.c_str());
    }
  }
  return 0;
}
