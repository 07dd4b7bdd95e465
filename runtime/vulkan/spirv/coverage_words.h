// SPDX-License-Identifier: MIT
//
// The memory in which the shaders of a device say what ran, a word for each point of a library
// (spirv_interface.h: kCoverageLowConstant).
#pragma once

#include <map>
#include <memory>
#include <mutex>

#include "runtime/coverage/collector.h"
#include "runtime/vulkan/gpu/gpu.h"

namespace kaamos::vulkan {

class CoverageWords final : public coverage::Reader {
 public:
  explicit CoverageWords(Gpu& gpu);
  ~CoverageWords() override;
  CoverageWords(const CoverageWords&) = delete;
  CoverageWords& operator=(const CoverageWords&) = delete;

  // Makes a library's words, which live as long as the library. KA0990: there is no memory for
  // them.
  rtapi::Status provide(const shader::LibraryDesc& library);
  // The address of words that were made; 0: the library has no points.
  uint64_t address_of(const shader::LibraryDesc& library);

  // -- coverage::Reader
  void read(const shader::CoverageDesc& table, bool is_last) override;

 private:
  Gpu& gpu_;
  std::mutex mutex_;
  std::map<const shader::CoverageDesc*, std::unique_ptr<GpuBuffer>> buffers_;
};

}  // namespace kaamos::vulkan
