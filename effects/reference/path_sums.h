// SPDX-License-Identifier: MIT
/// @file
/// The results of a reference so far: sums over samples in two independent halves, which tell its
/// error, and can be saved and gone on with.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "effects/assets/common/errors.h"
#include "effects/assets/image/image.h"

namespace kaamos::effects {

/// Halves of the samples, with seeds of their own.
inline constexpr std::uint32_t kPathHalves = 2;

/// Sums of layers over the samples of both halves, in doubles.
struct PathSums {
  /// A picture of sums.
  struct Layer {
    std::string name;            ///< in files
    std::uint32_t channels = 3;  ///< of a pixel, 1 to 4
    /// width * height * channels, for each half.
    std::array<std::vector<double>, kPathHalves> sums;
  };

  std::uint32_t width = 0;   ///< pixels
  std::uint32_t height = 0;  ///< pixels
  /// Fingerprint of what is rendered: the scene, the camera, the options that change the picture.
  std::uint64_t fingerprint = 0;
  std::uint32_t seed = 0;                                ///< of the first half
  std::array<std::uint32_t, kPathHalves> samples{0, 0};  ///< of each pixel, in each half
  std::vector<Layer> layers;                             ///< in the order of the files

  /// Adds a layer of zeros.
  void add_layer(std::string name, std::uint32_t channels);
  /// The mean of all samples. Precondition: there are samples.
  FloatImage mean(const Layer& layer) const;
  /// Root of the mean, over pixels and channels, of the squared standard error of the mean, as the
  /// difference of the two halves tells it.
  double error(const Layer& layer) const;
  /// The layer of that name, or null.
  const Layer* find(const std::string& name) const;
};

/// Writes sums to a file that load_path_sums reads.
/// @errors KA3000 a file that cannot be written.
Status save_path_sums(const std::string& path, const PathSums& sums);

/// Reads sums that fit `wanted`: its size, seed, fingerprint and layers, to go on with them.
/// @errors KA3000 a file that cannot be read; KA3048 a damaged one, or one of another scene, size,
/// seed or other options.
Status load_path_sums(const std::string& path, PathSums& wanted);

}  // namespace kaamos::effects
