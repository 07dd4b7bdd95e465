// SPDX-License-Identifier: MIT
/// @file
/// Explains one pixel of draws: every triangle that covered it, with its depth, its depth test,
/// what the pixel shader gave and what was stored. And counts, for every pixel, how many triangles
/// covered it: overdraw.
///
/// Both execute a list once, and note what its draws do while they do it; the results are those of
/// any other execution. The embree backend can, others cannot.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <rtapi/command_list.h>
#include <rtapi/command_queue.h>
#include <rtapi/explain.h>
#include <rtapi/graphics_pipeline.h>

namespace rtapi {

/// The draws of a list that are noted. They are numbered from 0 in the order of execution; each
/// draw of an ExecuteIndirect has a number. Of these draws, those whose targets have the size that
/// the first of them has are noted, as one pixel stands for one place only in targets of one size;
/// draws without targets are not.
struct DrawRange {
  uint32_t FirstDraw = 0;           ///< number of the first
  uint32_t DrawCount = 0xFFFFFFFF;  ///< how many; all that follow by default
  uint32_t Slice = 0;               ///< array slice, counted from the first of the bound views
};

/// Selects what ExplainDrawPixel explains.
struct ExplainDrawDesc {
  DrawRange Draws = {};  ///< which draws
  /// The pixel of the targets; (0, 0) is the upper left one.
  ///@{
  uint32_t X = 0;
  uint32_t Y = 0;
  ///@}
};

/// The outcome of a triangle at a pixel that it covers.
enum class TriangleOutcome : uint32_t {
  kWritten,        ///< passed everything
  kCulledByFace,   ///< CullMode: nothing was drawn of it
  kFailedDepth,    ///< the depth test
  kDiscarded,      ///< by the pixel shader
  kFailedStencil,  ///< the stencil test
};

/// A texel of a render target.
struct ExplainedTexel {
  uint32_t Slot = 0;                        ///< of OMSetRenderTargets
  rtapi::Format Format = Format::kUnknown;  ///< of the view
  std::string Before = {};                  ///< "0 0 0 1"
  std::string After = {};                   ///< after the write, blended and converted
};

/// A triangle that covers the pixel.
struct ExplainedTriangle {
  uint32_t Draw = 0;           ///< its number
  std::string Command = {};    ///< "DrawInstanced, command 3"
  std::string Pipeline = {};   ///< name of the pipeline state
  uint32_t InstanceID = 0;     ///< SV_InstanceID
  uint32_t PrimitiveID = 0;    ///< SV_PrimitiveID
  bool FrontFace = false;      ///< SV_IsFrontFace
  float Weights[3] = {};       ///< of its corners on the screen, at the pixel's centre
  float Z = 0;                 ///< at the pixel's centre, with depth bias
  bool StencilTested = false;  ///< whether there is a stencil test, before that of depth
  bool StencilPassed = true;   ///< what it gave
  uint8_t StoredStencil = 0;   ///< before the test
  bool DepthTested = false;    ///< whether there is a depth test; the next members are its
  bool TestedLate = false;     ///< both tests: after the pixel shader
  ComparisonFunc DepthFunc = ComparisonFunc::kAlways;  ///< TestedDepth DepthFunc StoredDepth
  float TestedDepth = 0;         ///< z or SV_Depth, clamped to the viewport, in the target's format
  float StoredDepth = 0;         ///< before the test
  bool DepthPassed = true;       ///< what the test gave
  bool DepthWritten = false;     ///< whether TestedDepth was stored
  std::string PixelShader = {};  ///< empty: none ran
  std::vector<ExplainedValue> Outputs = {};  ///< as the shader gave them; empty if it discarded
  std::vector<ExplainedTexel> Texels = {};   ///< what was written
  TriangleOutcome Outcome = TriangleOutcome::kWritten;  ///< in one word
};

/// The result of ExplainDrawPixel.
struct DrawPixelExplanation {
  uint32_t X = 0;                                 ///< the pixel
  uint32_t Y = 0;                                 ///< the pixel
  uint32_t Slice = 0;                             ///< its array slice
  uint32_t Width = 0;                             ///< of the targets
  uint32_t Height = 0;                            ///< of the targets
  std::string Backend = {};                       ///< that executes the list
  uint32_t Draws = 0;                             ///< how many were noted
  uint32_t DrawsLeftOut = 0;                      ///< to targets of another size, or to none
  std::vector<ExplainedTriangle> Triangles = {};  ///< in the order of drawing
};

/// Counts of the triangles at a pixel, by what they did.
struct PixelOverdraw {
  uint32_t Covered = 0;  ///< those that cover it and are not culled
  uint32_t Shaded = 0;   ///< calls of the pixel shader, without helper lanes
  uint32_t Written = 0;  ///< those that passed stencil test, depth test and discard
};

/// The counts of CollectOverdraw.
struct OverdrawStatistics {
  uint32_t Width = 0;                      ///< of the targets; 0: no draw was noted
  uint32_t Height = 0;                     ///< of the targets
  uint32_t Draws = 0;                      ///< how many were noted
  uint32_t DrawsLeftOut = 0;               ///< to targets of another size, or to none
  std::vector<PixelOverdraw> Pixels = {};  ///< Width x Height, row by row
};

/// Executes a list as CommandQueue::ExecuteAndWait does (it is closed if it is open), and notes
/// what its draws do at one pixel.
/// @errors KA0903, KA0904 an empty handle or a list of another device; the first error of
/// recording; KA0856 memory that the list uses was freed; KA0916 a pixel outside of the targets, no
/// such draw, or a backend that cannot; what Device::GetDeviceRemovedReason says.
Result<DrawPixelExplanation> ExplainDrawPixel(const CommandQueue& queue, const CommandList& list,
                                              const ExplainDrawDesc& desc);
/// Executes a list in the same way and counts what its draws do at every pixel.
/// @errors as of ExplainDrawPixel, but a list without draws is none: KA0856, KA0903, KA0904,
/// KA0916, recording, removal.
Result<OverdrawStatistics> CollectOverdraw(const CommandQueue& queue, const CommandList& list,
                                           const DrawRange& draws = {});

/// An explanation as lines of text for a terminal, what is nested indented.
std::string ToText(const DrawPixelExplanation& explanation);
/// An explanation as JSON: UTF-8, indented by two.
std::string ToJson(const DrawPixelExplanation& explanation);

}  // namespace rtapi
