// SPDX-License-Identifier: MIT
//
// This file holds what a pass of draws needs from its caller: threads, and shaders that run on
// them.
#pragma once

#include <cstdint>

#include <kaamos/shader/graphics.h>

namespace kaamos::raster {

// Runs the shaders of a pass on one thread. `draw` counts the draws of the pass from 0.
class ShaderThread {
 public:
  virtual ~ShaderThread() = default;
  virtual void vertices(uint32_t draw, const shader::VertexLanes& lanes) = 0;
  virtual void primitive(uint32_t draw, const shader::GeometryInputs& inputs,
                         shader::GeometryStream& stream) = 0;
  virtual void pixels(uint32_t draw, shader::PixelLanes& lanes) = 0;
};

class Workers {
 public:
  using Task = void (*)(const void* context, uint32_t number, ShaderThread& thread);

  virtual ~Workers() = default;
  // Calls task(context, i, thread) for each i below `count`, on any threads and at the same time;
  // earlier numbers are better started first. No two calls that run at the same time have the same
  // thread. Each call sees what was written before, and the caller then sees what the calls wrote.
  //
  // Tasks run with denormals flushed (runtime/shader/float_mode.h).
  //
  // A task may be left by longjmp out of a shader, or not be called at all, if the caller then ends
  // the pass: nothing in a task's frame needs a destructor.
  virtual void run(uint32_t count, Task task, const void* context) = 0;

  template <class Body>
  void run(uint32_t count, const Body& body) {
    run(
        count,
        [](const void* context, uint32_t number, ShaderThread& thread) {
          (*static_cast<const Body*>(context))(number, thread);
        },
        &body);
  }
};

}  // namespace kaamos::raster
