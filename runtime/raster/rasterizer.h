// SPDX-License-Identifier: MIT
//
// Draws passes: draws that follow each other on the same targets, with results as if their
// primitives were drawn one after another. Start here.
#pragma once

#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "runtime/raster/draw.h"
#include "runtime/raster/workers.h"

namespace kaamos::raster {

struct Observation;  // observer.h

// Results depend on none of them.
struct RasterizerOptions {
  uint32_t batch_triangles = 2048;
  // Bytes that may wait for tiles to be drawn, roughly; a batch at least.
  uint64_t batch_bytes = uint64_t{64} << 20;
  bool any_processor = false;  // leaves what only some processors have unused
};

class Rasterizer {
 public:
  explicit Rasterizer(const RasterizerOptions& options = {});
  ~Rasterizer();
  Rasterizer(const Rasterizer&) = delete;
  Rasterizer& operator=(const Rasterizer&) = delete;

  // One pass at a time. Memory is kept for the next one. `observation` is null or has an element
  // for each draw.
  void draw(const Targets& targets, std::span<const Draw> draws, Workers& workers,
            Observation* observation = nullptr);

 private:
  struct Pass;
  struct Memory;
  std::unique_ptr<Memory> memory_;
};

}  // namespace kaamos::raster
