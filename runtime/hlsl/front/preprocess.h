// SPDX-License-Identifier: MIT
// From a main file to the tokens that the parser reads: the C preprocessor, with DXC's behaviour.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "runtime/hlsl/front/diagnostic.h"
#include "runtime/hlsl/front/source.h"
#include "runtime/hlsl/front/token.h"

namespace kaamos::hlsl {

// Values of __SHADER_TARGET_STAGE [DXIL: shader kind].
enum class ShaderStage : uint8_t {
  kPixel = 0,
  kVertex = 1,
  kGeometry = 2,
  kHull = 3,
  kDomain = 4,
  kCompute = 5,
  kLibrary = 6,
  kMesh = 13,
  kAmplification = 14,
};

struct PreprocessOptions {
  std::vector<std::string> include_folders;  // -I, in order.
  std::vector<std::string> defines;          // -D: "NAME" (becomes 1) or "NAME=VALUE".
  ShaderStage stage = ShaderStage::kLibrary;
  uint32_t shader_model_major = 6;
  uint32_t shader_model_minor = 6;
  uint32_t hlsl_version = 2021;  // -HV
  bool enable_16bit_types = false;

  uint32_t max_include_depth = 200;
  uint32_t max_inclusions = 20000;
  uint32_t max_macro_depth = 200;             // Macro calls nested in the arguments of macro calls.
  uint32_t max_expansion_tokens = 4'000'000;  // For all macro expansions together.
};

// Always returns a list that ends with kEndOfFile; errors are in `diagnostics`. Token texts live as
// long as `sources`.
TokenList preprocess_file(const std::string& path, const PreprocessOptions& options,
                          SourceManager& sources, DiagnosticEngine& diagnostics);
// The same for a text in memory; `name` is shown in diagnostics, and its folder is searched for
// quoted includes.
TokenList preprocess_text(std::string name, std::string text, const PreprocessOptions& options,
                          SourceManager& sources, DiagnosticEngine& diagnostics);

}  // namespace kaamos::hlsl
