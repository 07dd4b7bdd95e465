// SPDX-License-Identifier: MIT
// Random numbers of a path: each decision at each vertex has a pair of dimensions of its own, an
// Owen-scrambled and shuffled Sobol sequence over the samples of its pixel. [Burley 2020]
#ifndef KAAMOS_PATH_SAMPLER_HLSLI
#define KAAMOS_PATH_SAMPLER_HLSLI

#include "sampling.hlsli"

struct PathSampler {
  uint seed;   // of this pixel and this kind of path
  uint index;  // of the sample
};

// Decisions at a vertex.
static const uint kPairDirection = 0;
static const uint kPairLobe = 1;       // x: which lobe, y: Russian roulette
static const uint kPairSun = 2;
static const uint kPairChoice = 3;     // x: which lamp, y: which emitter
static const uint kPairLamp = 4;
static const uint kPairEmitter = 5;
static const uint kPairSky = 6;
static const uint kPairsPerVertex = 8;
// Decisions that a path makes once, or once for each lamp or pane.
static const uint kPairEachLamp = 0x10000;
static const uint kPairOcclusion = 0x20000;
static const uint kPairPane = 0x30000;

float2 PathRandom(PathSampler sampler, uint pair) {
  return SobolOwen(sampler.index, HashCombine(sampler.seed, pair));
}

float2 PathRandom(PathSampler sampler, uint vertex_number, uint decision) {
  return PathRandom(sampler, vertex_number * kPairsPerVertex + decision);
}

#endif
