// SPDX-License-Identifier: MIT
#include "d3d12/container/checksum.h"

#include <bit>
#include <cmath>
#include <cstring>

namespace kaamos::d3d12 {

namespace {

constexpr size_t kBlock = 64;
using State = std::array<uint32_t, 4>;
constexpr State kStart = {0x67452301u, 0xEFCDAB89u, 0x98BADCFEu, 0x10325476u};

// The i-th constant is the integer part of 2^32 |sin(i + 1)|. [RFC 1321: 3.4]
const std::array<uint32_t, 64>& sines() {
  static const std::array<uint32_t, 64> table = [] {
    std::array<uint32_t, 64> out{};
    for (size_t i = 0; i < out.size(); ++i) {
      out[i] =
          static_cast<uint32_t>(std::fabs(std::sin(static_cast<double>(i + 1))) * 4294967296.0);
    }
    return out;
  }();
  return table;
}

void add_block(State& state, const std::byte* block) {
  constexpr int kShifts[4][4] = {{7, 12, 17, 22}, {5, 9, 14, 20}, {4, 11, 16, 23}, {6, 10, 15, 21}};
  std::array<uint32_t, 16> words;
  std::memcpy(words.data(), block, kBlock);
  auto [a, b, c, d] = state;
  for (uint32_t i = 0; i < 64; ++i) {
    const uint32_t round = i / 16;
    uint32_t mix = 0, word = 0;
    switch (round) {
      case 0:
        mix = (b & c) | (~b & d);
        word = i;
        break;
      case 1:
        mix = (d & b) | (~d & c);
        word = 5 * i + 1;
        break;
      case 2:
        mix = b ^ c ^ d;
        word = 3 * i + 5;
        break;
      default:
        mix = c ^ (b | ~d);
        word = 7 * i;
        break;
    }
    const uint32_t sum = a + mix + sines()[i] + words[word % 16];
    a = d;
    d = c;
    c = b;
    b += std::rotl(sum, kShifts[round][i % 4]);
  }
  state[0] += a;
  state[1] += b;
  state[2] += c;
  state[3] += d;
}

// Adds all whole blocks, and returns what is left.
std::span<const std::byte> add_blocks(State& state, std::span<const std::byte> bytes) {
  for (; bytes.size() >= kBlock; bytes = bytes.subspan(kBlock)) add_block(state, bytes.data());
  return bytes;
}

using Tail = std::array<std::byte, 2 * kBlock>;

void put_word(Tail& tail, size_t offset, uint32_t word) {
  std::memcpy(tail.data() + offset, &word, sizeof(word));
}

}  // namespace

std::array<uint32_t, 4> container_checksum(std::span<const std::byte> bytes) {
  const uint32_t bits = static_cast<uint32_t>(bytes.size() * 8);
  State state = kStart;
  const auto rest = add_blocks(state, bytes);
  Tail tail{};
  // Where the rest and the two lengths do not fit into one block, the rest has one of its own.
  const bool fits = rest.size() < kBlock - 8;
  const size_t start = fits ? 4 : 0;
  const size_t last = fits ? 0 : kBlock;
  if (!rest.empty()) std::memcpy(tail.data() + start, rest.data(), rest.size());
  tail[start + rest.size()] = std::byte{0x80};
  put_word(tail, last, bits);
  put_word(tail, last + kBlock - 4, (bits >> 2) | 1);
  add_blocks(state, std::span(tail).first(last + kBlock));
  return state;
}

std::array<uint32_t, 4> md5(std::span<const std::byte> bytes) {
  const uint64_t bits = uint64_t{bytes.size()} * 8;
  State state = kStart;
  const auto rest = add_blocks(state, bytes);
  Tail tail{};
  if (!rest.empty()) std::memcpy(tail.data(), rest.data(), rest.size());
  tail[rest.size()] = std::byte{0x80};
  const size_t size = rest.size() < kBlock - 8 ? kBlock : 2 * kBlock;
  put_word(tail, size - 8, static_cast<uint32_t>(bits));
  put_word(tail, size - 4, static_cast<uint32_t>(bits >> 32));
  add_blocks(state, std::span(tail).first(size));
  return state;
}

}  // namespace kaamos::d3d12
