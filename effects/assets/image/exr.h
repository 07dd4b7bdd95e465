// SPDX-License-Identifier: MIT
/// @file
/// OpenEXR files with named layers.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "effects/assets/common/errors.h"
#include "effects/assets/image/image.h"

namespace kaamos::effects {

/// One layer. The nameless layer is what viewers show first.
struct ExrLayer {
  std::string name;   ///< empty: the nameless layer
  FloatImage image;   ///< 1 to 4 channels, or as many as `channels` names
  bool half = false;  ///< stored with 16 bits: values above 65,504 become infinite
  /// One per channel of the image; empty: Y, then RGB and RGBA for 3 and 4 channels, XY for 2.
  std::vector<std::string> channels = {};
};

/// The contents that an OpenEXR file has here.
struct ExrFile {
  std::vector<ExrLayer> layers;  ///< all of the same width and height
  /// Text attributes: how the picture was made (seed, sample count, ...).
  std::map<std::string, std::string> attributes = {};
};

/// Writes all layers into one file; channels are named LAYER.CHANNEL as viewers expect. An earlier
/// file at `path` stays as it was on any error.
/// @errors KA3002 no layer, layers of different size, a layer name twice, names for another number
/// of channels than there are.
Status write_exr(const std::string& path, const ExrFile& file);

/// The bytes of such a file, compressed by so many threads [thread_count]. They are the same for
/// any number.
/// @errors KA3002 as above.
Result<std::vector<std::uint8_t>> encode_exr(const ExrFile& file, std::uint32_t threads = 1);

/// Reads every layer of a scan-line or tiled single-part file as floats. Channels of a layer stand
/// in the order RGBA, XYZ or else alphabetical.
/// @errors KA3000 a file that cannot be read; KA3002 one that is no OpenEXR file or a damaged one.
Result<ExrFile> read_exr(const std::string& path);

/// The layer of that name, or null.
const ExrLayer* find_layer(const ExrFile& file, const std::string& name);

}  // namespace kaamos::effects
