// SPDX-License-Identifier: MIT
// The files of a finished frame.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "effects/assets/scene/scene.h"
#include "frame_result.h"
#include "options.h"

namespace northlight {

// Files that wait beside the results until all of them are complete: a full disk or Ctrl-C must not
// leave half of a new run over the old one. The destructor deletes what was not published.
class StagedFiles {
 public:
  explicit StagedFiles(const std::string& folder);
  ~StagedFiles();
  StagedFiles(const StagedFiles&) = delete;
  StagedFiles& operator=(const StagedFiles&) = delete;

  // These return an error text, empty on success.
  std::string create();
  std::string add(const std::string& name, const std::vector<std::uint8_t>& bytes);
  std::string add(const std::string& name, const kaamos::effects::ByteImage& image);
  // For code that writes its own file: the path to use before publishing.
  std::string add_path(const std::string& name);
  // Renames all files into the folder.
  std::string publish();

 private:
  std::string folder_, staging_;  // staging_ is of this run alone
  int lock_ = -1;                 // held while it is
  std::vector<std::string> names_;
};

// Makes the folder and checks that files can be written there, before hours of rendering. Returns
// an error text, empty on success.
std::string prepare_folder(const std::string& folder);

// Writes frame.png, frame.exr, a PNG for each layer and stats.json into options.out. Either writes
// all of them or touches none; returns an error text, empty on success.
std::string write_results(const Options& options, const kaamos::effects::Scene& scene,
                          const kaamos::effects::FrameRenderer& renderer,
                          const FrameResult& result);
// Adds the same to `files`, which may hold others; `sequence` becomes a part of stats.json.
std::string add_results(const Options& options, const kaamos::effects::Scene& scene,
                        const kaamos::effects::FrameRenderer& renderer, const FrameResult& result,
                        const nlohmann::ordered_json& sequence, StagedFiles& files);
// The picture in frame.png.
kaamos::effects::ByteImage frame_picture(const kaamos::effects::FloatImage& radiance,
                                         float exposure);

// Each layer's value at a pixel, one per line.
std::string describe_pixel(const FrameResult& result, std::uint32_t x, std::uint32_t y);

// One line for each device of each backend; its first word is the value for --backend.
std::string list_devices();

// The table printed at the end.
std::string describe(const kaamos::effects::FrameRenderer& renderer, const FrameResult& result);

// How drawn surfaces differ from what rays see, and what both took; empty where rays found them.
std::string describe_primary(const FrameResult& result);

}  // namespace northlight
