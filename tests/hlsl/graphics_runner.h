// SPDX-License-Identifier: MIT
//
// Calls vertex and pixel shaders of a library on columns of 8 lanes (kaamos/shader/graphics.h),
// without a rasteriser. Shaders that need fibers get them.
#pragma once

#include <kaamos/shader/abi.h>
#include <kaamos/shader/texture_view.h>

#include <array>
#include <bit>
#include <string>
#include <vector>

namespace kaamos::test {

class GraphicsRunner {
 public:
  using Lanes = std::array<uint32_t, shader::kGraphicsLanes>;

  GraphicsRunner(const shader::LibraryDesc& library, const std::string& name);

  const shader::ExportDesc& desc() const { return *desc_; }
  const shader::GraphicsDesc& graphics() const { return *desc_->graphics; }

  std::vector<Lanes> inputs;   // by column, zeros at first
  std::vector<Lanes> outputs;  // a sentinel at first
  uint32_t active = 0xFF;
  uint32_t live = 0xFF;  // pixel shaders; run() changes it
  // The words of every RWByteAddressBuffer and RWStructuredBuffer<uint> binding.
  std::vector<uint32_t> memory = std::vector<uint32_t>(64);
  shader::TextureView texture;  // every texture binding
  shader::SamplerState sampler;

  // The columns of an element.
  Lanes& in(const std::string& semantic, uint32_t number, uint32_t component = 0);
  const Lanes& out(const std::string& semantic, uint32_t number, uint32_t component = 0) const;
  void set(const std::string& semantic, uint32_t number, uint32_t component,
           const std::array<float, shader::kGraphicsLanes>& values);
  // Pixel centres of the quads at (10, 20) and (12, 20).
  void set_position();
  std::array<float, shader::kGraphicsLanes> floats(const std::string& semantic, uint32_t number,
                                                   uint32_t component = 0) const;

  void run();

 private:
  const shader::SignatureElement* find(bool output, const std::string& semantic,
                                       uint32_t number) const;

  const shader::LibraryDesc& library_;
  const shader::ExportDesc* desc_ = nullptr;
};

}  // namespace kaamos::test
