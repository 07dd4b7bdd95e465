// SPDX-License-Identifier: MIT
//
// Tests multisampled targets sample by sample. Expected values come from the places of the standard
// patterns.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <optional>

#include "multisample_canvas.h"
#include "on_backends.h"
#include "tests/vulkan/support.h"

namespace kaamos::draws {
namespace {

using namespace rtapi;

constexpr uint32_t kSide = MultisampleCanvas::kSide;

class Multisampling : public OnBackends {
 protected:
  void SetUp() override {
    OnBackends::SetUp();
    if (!can_run()) return;
    DeviceDesc desc;
    desc.Backend = GetParam();
    desc.OnMessage = [](const Message& m) { ADD_FAILURE() << m.Text; };
    device_ = CreateDevice(desc).value();
  }
  // Each of 2, 4 and 8 that the device has.
  void each_count(const std::function<void(uint32_t)>& test) const {
    uint32_t tested = 0;
    for (const uint32_t count : {2u, 4u, 8u}) {
      const Format formats[] = {Format::kR32G32B32A32Float, Format::kD32Float};
      if (device_.GetMultisampleQualityLevels(formats[0], count) == 0 ||
          device_.GetMultisampleQualityLevels(formats[1], count) == 0) {
        continue;
      }
      SCOPED_TRACE(std::to_string(count) + " samples");
      test(count);
      ++tested;
    }
    EXPECT_GE(tested, 1u);
  }

  Device device_;
};
INSTANTIATE_TEST_SUITE_P(Backends, Multisampling, ::testing::Values("embree", "vulkan"),
                         [](const auto& tested) { return std::string(tested.param); });

// A sample's place on the target, in pixels.
struct Place {
  double x, y;
};
Place place_of(uint32_t x, uint32_t y, SamplePlace sample) {
  return {x + 0.5 + sample.x / 16.0, y + 0.5 + sample.y / 16.0};
}

// No sample of any pattern lies on an edge: coordinates are odd multiples of 1/64.
struct Half {
  // Corners of a triangle, clockwise.
  double x[3] = {1 + 1 / 64.0, 14 + 5 / 64.0, 3 + 19 / 64.0};
  double y[3] = {2 + 3 / 64.0, 4 + 7 / 64.0, 15 + 23 / 64.0};

  bool covers(Place at) const {
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3;
      const double side = (x[j] - x[i]) * (at.y - y[i]) - (y[j] - y[i]) * (at.x - x[i]);
      if (side < 0) return false;
    }
    return true;
  }
  uint32_t mask(uint32_t px, uint32_t py, const std::vector<SamplePlace>& pattern) const {
    uint32_t out = 0;
    for (size_t s = 0; s < pattern.size(); ++s) {
      if (covers(place_of(px, py, pattern[s]))) out |= 1u << s;
    }
    return out;
  }
  // `value` is where the pixel is, so that it tells where it was interpolated.
  std::vector<MultisampleVertex> vertices(float z = 0.5f) const {
    std::vector<MultisampleVertex> out;
    for (int i = 0; i < 3; ++i) {
      const auto at_x = static_cast<float>(x[i]);
      const auto at_y = static_cast<float>(y[i]);
      out.push_back(corner(at_x, at_y, z, at_x, at_y));
    }
    return out;
  }
};

uint32_t bits_of(const MultisampleCanvas& canvas, uint32_t x, uint32_t y, uint32_t component = 0) {
  uint32_t out = 0;
  for (uint32_t s = 0; s < canvas.samples; ++s) {
    if (canvas.sample(x, y, s, component) != 0) out |= 1u << s;
  }
  return out;
}

void each_pixel(const std::function<void(uint32_t, uint32_t)>& test) {
  for (uint32_t y = 0; y < kSide; ++y) {
    for (uint32_t x = 0; x < kSide; ++x) test(x, y);
  }
}

TEST_P(Multisampling, RAS_153_EachSampleIsCoveredByItself) {
  each_count([&](uint32_t count) {
    MultisampleCanvas canvas(device_, count);
    const PipelineState pipeline = canvas.make(canvas.desc("Corners", "Tint"));
    const Half triangle;
    canvas.run([&](CommandList& list) {
      canvas.use(list, pipeline);
      canvas.draw(list, triangle.vertices());
    });
    const auto pattern = standard_pattern(count);
    uint32_t partly = 0;
    each_pixel([&](uint32_t x, uint32_t y) {
      const uint32_t expected = triangle.mask(x, y, pattern);
      EXPECT_EQ(bits_of(canvas, x, y), expected) << x << ", " << y;
      partly += expected != 0 && expected != (1u << count) - 1;
    });
    EXPECT_GT(partly, 15u);
  });
}

TEST_P(Multisampling, TrianglesBetweenTheMiddlesOfPixelsCoverSamples) {
  MultisampleCanvas canvas(device_, 4);
  const PipelineState pipeline = canvas.make(canvas.desc("Corners", "Tint"));
  canvas.run([&](CommandList& list) {
    canvas.use(list, pipeline);
    // Around sample 1 of pixel (5, 7), and of a pixel in the upper left corner.
    for (const auto& [x, y] : {std::pair(5.875f, 7.375f), std::pair(0.875f, 0.375f)}) {
      canvas.draw(list,
                  {corner(x - 0.1f, y - 0.1f), corner(x + 0.1f, y - 0.1f), corner(x, y + 0.12f)});
    }
  });
  each_pixel([&](uint32_t x, uint32_t y) {
    const bool hit = (x == 5 && y == 7) || (x == 0 && y == 0);
    EXPECT_EQ(bits_of(canvas, x, y), hit ? 2u : 0u) << x << ", " << y;
  });
}

TEST_P(Multisampling, ResolvesAverage) {
  each_count([&](uint32_t count) {
    MultisampleCanvas canvas(device_, count);
    const PipelineState pipeline = canvas.make(canvas.desc("Corners", "Tint"));
    const Half triangle;
    canvas.run([&](CommandList& list) {
      canvas.use(list, pipeline, {1, 0.5f, 0, 1});
      canvas.draw(list, triangle.vertices());
    });
    const auto bytes = canvas.resolved(Format::kR32G32B32A32Float);
    const auto pattern = standard_pattern(count);
    each_pixel([&](uint32_t x, uint32_t y) {
      float texel[4];
      std::memcpy(texel, bytes.data() + (size_t{y} * kSide + x) * sizeof texel, sizeof texel);
      const auto covered = static_cast<float>(__builtin_popcount(triangle.mask(x, y, pattern)));
      EXPECT_FLOAT_EQ(texel[0], covered / static_cast<float>(count)) << x << ", " << y;
      EXPECT_FLOAT_EQ(texel[1], covered / static_cast<float>(2 * count)) << x << ", " << y;
    });
  });
}

// [RAS-153: UNORM in float, sRGB in linear space]
TEST_P(Multisampling, ResolvesOfBytesAverageWhatTheyMean) {
  for (const Format format : {Format::kR8G8B8A8Unorm, Format::kR8G8B8A8UnormSrgb}) {
    SCOPED_TRACE(static_cast<uint32_t>(format));
    MultisampleCanvas canvas(device_, 4, format);
    const PipelineState pipeline = canvas.make(canvas.desc("Corners", "Tint"));
    const Half triangle;
    canvas.run([&](CommandList& list) {
      canvas.use(list, pipeline);
      canvas.draw(list, triangle.vertices());
    });
    const auto bytes = canvas.resolved(format);
    const auto pattern = standard_pattern(4);
    each_pixel([&](uint32_t x, uint32_t y) {
      const double part = __builtin_popcount(triangle.mask(x, y, pattern)) / 4.0;
      const double curve =
          part <= 0.0031308 ? part * 12.92 : 1.055 * std::pow(part, 1 / 2.4) - 0.055;
      const double expected = (format == Format::kR8G8B8A8Unorm ? part : curve) * 255;
      EXPECT_NEAR(static_cast<double>(bytes[(size_t{y} * kSide + x) * 4]), expected, 0.75)
          << x << ", " << y;
    });
  }
}

// Where two triangles cut each other, each sample has the nearer one.
TEST_P(Multisampling, DepthIsTestedAtEachSample) {
  each_count([&](uint32_t count) {
    MultisampleCanvas canvas(device_, count);
    GraphicsPipelineStateDesc desc = canvas.desc("Corners", "Tint");
    desc.DepthStencilState.DepthEnable = true;
    const PipelineState pipeline = canvas.make(desc);
    canvas.run([&](CommandList& list) {
      canvas.use(list, pipeline, {1, 0, 0, 1});
      const auto flat = [](float x, float y) { return corner(x, y, 0.5f); };
      canvas.draw(list, {flat(0, 0), flat(32, 0), flat(0, 32)});
      // As near as the first one where x is 8 + 1/32.
      const auto slope = [](float x, float y) { return corner(x, y, 0.5f - (x - 8.03125f) / 64); };
      canvas.use(list, pipeline, {2, 0, 0, 1});
      canvas.draw(list, {slope(0, 0), slope(16, 0), slope(0, 16), slope(0, 16), slope(16, 0),
                         slope(16, 16)});
    });
    const auto pattern = standard_pattern(count);
    each_pixel([&](uint32_t x, uint32_t y) {
      for (uint32_t s = 0; s < count; ++s) {
        const bool nearer = place_of(x, y, pattern[s]).x > 8.03125;
        EXPECT_EQ(canvas.sample(x, y, s), nearer ? 2.0f : 1.0f) << x << ", " << y << ": " << s;
      }
    });
  });
}

TEST_P(Multisampling, PixelShadersRunOncePerPixelInItsMiddle) {
  each_count([&](uint32_t count) {
    MultisampleCanvas canvas(device_, count);
    const PipelineState pipeline = canvas.make(canvas.desc("Corners", "Value"));
    const Half triangle;
    canvas.run([&](CommandList& list) {
      canvas.use(list, pipeline);
      canvas.draw(list, triangle.vertices());
    });
    const auto pattern = standard_pattern(count);
    uint32_t pixels = 0;
    each_pixel([&](uint32_t x, uint32_t y) {
      const uint32_t mask = triangle.mask(x, y, pattern);
      pixels += mask != 0;
      for (uint32_t s = 0; s < count; ++s) {
        if ((mask >> s & 1) == 0) continue;
        EXPECT_NEAR(canvas.sample(x, y, s, 0), static_cast<float>(x) + 0.5f, 1e-4f);
        EXPECT_NEAR(canvas.sample(x, y, s, 1), static_cast<float>(y) + 0.5f, 1e-4f);
        EXPECT_EQ(canvas.sample(x, y, s, 2), static_cast<float>(x) + 0.5f);
        EXPECT_EQ(canvas.sample(x, y, s, 3), static_cast<float>(y) + 0.5f);
      }
    });
    EXPECT_EQ(canvas.invocations(), pixels);
  });
}

TEST_P(Multisampling, SampleInputsRunTheShaderForEachSample) {
  each_count([&](uint32_t count) {
    MultisampleCanvas canvas(device_, count);
    const PipelineState pipeline = canvas.make(canvas.desc("Corners", "Samples"));
    const Half triangle;
    canvas.run([&](CommandList& list) {
      canvas.use(list, pipeline);
      canvas.draw(list, triangle.vertices());
    });
    const auto pattern = standard_pattern(count);
    uint32_t covered = 0;
    each_pixel([&](uint32_t x, uint32_t y) {
      const uint32_t mask = triangle.mask(x, y, pattern);
      for (uint32_t s = 0; s < count; ++s) {
        if ((mask >> s & 1) == 0) continue;
        ++covered;
        const Place at = place_of(x, y, pattern[s]);
        EXPECT_NEAR(canvas.sample(x, y, s, 0), at.x, 1e-4) << x << ", " << y << ": " << s;
        EXPECT_NEAR(canvas.sample(x, y, s, 1), at.y, 1e-4) << x << ", " << y << ": " << s;
        EXPECT_EQ(canvas.sample(x, y, s, 2), static_cast<float>(s) + 1);
      }
    });
    EXPECT_EQ(canvas.invocations(), covered);
  });
}

// Without the modifier SV_Position stays in the middle.
TEST_P(Multisampling, PositionsDoNotFollowTheSample) {
  each_count([&](uint32_t count) {
    MultisampleCanvas canvas(device_, count);
    const PipelineState pipeline = canvas.make(canvas.desc("Whole", "SamplePlace"));
    canvas.run([&](CommandList& list) {
      canvas.use(list, pipeline, {1, 1, 1, 0.5f});
      list.DrawInstanced(3, 1, 0, 0);
    });
    each_pixel([&](uint32_t x, uint32_t y) {
      for (uint32_t s = 0; s < count; ++s) {
        EXPECT_EQ(canvas.sample(x, y, s, 0), static_cast<float>(x) + 0.5f);
        EXPECT_EQ(canvas.sample(x, y, s, 1), static_cast<float>(y) + 0.5f);
        EXPECT_EQ(canvas.sample(x, y, s, 2), static_cast<float>(s));
      }
    });
  });
}

// Where a pixel is covered partly, its centroid is a covered place.
TEST_P(Multisampling, CentroidInputsStayInTheTriangle) {
  each_count([&](uint32_t count) {
    MultisampleCanvas canvas(device_, count);
    const PipelineState pipeline = canvas.make(canvas.desc("Corners", "Centroid"));
    const Half triangle;
    canvas.run([&](CommandList& list) {
      canvas.use(list, pipeline);
      canvas.draw(list, triangle.vertices());
    });
    const auto pattern = standard_pattern(count);
    each_pixel([&](uint32_t x, uint32_t y) {
      const uint32_t mask = triangle.mask(x, y, pattern);
      if (mask == 0) return;
      const auto first = static_cast<uint32_t>(__builtin_ctz(mask));
      const Place at = {canvas.sample(x, y, first, 0), canvas.sample(x, y, first, 1)};
      if (mask == (1u << count) - 1) {
        EXPECT_NEAR(at.x, x + 0.5, 1e-4) << x << ", " << y;
        EXPECT_NEAR(at.y, y + 0.5, 1e-4) << x << ", " << y;
        return;
      }
      EXPECT_TRUE(triangle.covers(at)) << x << ", " << y << ": " << at.x << ", " << at.y;
      EXPECT_LE(std::fabs(at.x - (x + 0.5)), 0.5001);
      EXPECT_LE(std::fabs(at.y - (y + 0.5)), 0.5001);
    });
  });
}

// Whatever the triangle covers, a shader that runs once for a pixel finds each sample's value.
TEST_P(Multisampling, RAS_162_ShadersEvaluateInputsAtSamples) {
  each_count([&](uint32_t count) {
    MultisampleCanvas canvas(device_, count);
    const Half triangle;
    const auto pattern = standard_pattern(count);
    // Inputs that are linear, and ones that are centroid.
    for (const char* shader : {"Evaluated", "EvaluatedOfCentroid"}) {
      SCOPED_TRACE(shader);
      const PipelineState pipeline = canvas.make(canvas.desc("Corners", shader));
      for (uint32_t number = 0; number < count; ++number) {
        canvas.run([&](CommandList& list) {
          canvas.use(list, pipeline, {static_cast<float>(number), 0, 0, 0});
          canvas.draw(list, triangle.vertices());
        });
        each_pixel([&](uint32_t x, uint32_t y) {
          const uint32_t mask = triangle.mask(x, y, pattern);
          if (mask == 0) return;
          const auto first = static_cast<uint32_t>(__builtin_ctz(mask));
          const Place at = place_of(x, y, pattern[number]);
          EXPECT_NEAR(canvas.sample(x, y, first, 0), at.x, 1e-3)
              << x << ", " << y << ": " << number;
          EXPECT_NEAR(canvas.sample(x, y, first, 1), at.y, 1e-3)
              << x << ", " << y << ": " << number;
          EXPECT_EQ(canvas.sample(x, y, first, 2), static_cast<float>(pattern[number].x) / 16);
          EXPECT_EQ(canvas.sample(x, y, first, 3), static_cast<float>(pattern[number].y) / 16);
        });
      }
    }
  });
}

TEST_P(Multisampling, RAS_162_EvaluatedCentroidsAreThoseOfCentroidInputs) {
  each_count([&](uint32_t count) {
    MultisampleCanvas canvas(device_, count);
    const Half triangle;
    const auto values = [&](const char* shader) {
      const PipelineState pipeline = canvas.make(canvas.desc("Corners", shader));
      canvas.run([&](CommandList& list) {
        canvas.use(list, pipeline);
        canvas.draw(list, triangle.vertices());
      });
      std::vector<float> out;
      each_pixel([&](uint32_t x, uint32_t y) {
        for (uint32_t s = 0; s < count; ++s) {
          for (uint32_t c = 0; c < 2; ++c) out.push_back(canvas.sample(x, y, s, c));
        }
      });
      return out;
    };
    const std::vector<float> declared = values("Centroid");
    EXPECT_EQ(values("EvaluatedCentroid"), declared);
    uint32_t covered = 0;
    each_pixel([&](uint32_t x, uint32_t y) {
      for (uint32_t s = 0; s < count; ++s) {
        const float found = canvas.sample(x, y, s, 2);
        if (found == 0) continue;
        ++covered;
        EXPECT_EQ(found, static_cast<float>(count));
      }
    });
    EXPECT_GT(covered, 15u);
  });
}

TEST_P(Multisampling, ShadersReadTheCoverage) {
  each_count([&](uint32_t count) {
    MultisampleCanvas canvas(device_, count);
    const PipelineState pipeline = canvas.make(canvas.desc("Corners", "CoverageIn"));
    const Half triangle;
    canvas.run([&](CommandList& list) {
      canvas.use(list, pipeline);
      canvas.draw(list, triangle.vertices());
    });
    const auto pattern = standard_pattern(count);
    each_pixel([&](uint32_t x, uint32_t y) {
      const uint32_t mask = triangle.mask(x, y, pattern);
      for (uint32_t s = 0; s < count; ++s) {
        const float expected = (mask >> s & 1) != 0 ? static_cast<float>(mask) : 0;
        EXPECT_EQ(canvas.sample(x, y, s), expected) << x << ", " << y << ": " << s;
      }
    });
  });
}

// Samples that the shader takes out write neither colour nor depth.
TEST_P(Multisampling, ShadersTakeSamplesOut) {
  each_count([&](uint32_t count) {
    MultisampleCanvas canvas(device_, count);
    GraphicsPipelineStateDesc desc = canvas.desc("Whole", "CoverageOut");
    desc.DepthStencilState.DepthEnable = true;
    const PipelineState mask = canvas.make(desc);
    desc = canvas.desc("Whole", "Tint");
    desc.DepthStencilState.DepthEnable = true;
    const PipelineState behind = canvas.make(desc);
    canvas.run([&](CommandList& list) {
      canvas.use(list, mask, {1, 0, 0, 0.25f});
      list.DrawInstanced(3, 1, 0, 0);
      canvas.use(list, behind, {2, 0, 0, 0.5f});
      list.DrawInstanced(3, 1, 0, 0);
    });
    each_pixel([&](uint32_t x, uint32_t y) {
      for (uint32_t s = 0; s < count; ++s) {
        EXPECT_EQ(canvas.sample(x, y, s), (x >> s & 1) != 0 ? 1.0f : 2.0f)
            << x << ", " << y << ": " << s;
      }
    });
  });
}

TEST_P(Multisampling, DiscardedPixelsLoseEverySample) {
  each_count([&](uint32_t count) {
    MultisampleCanvas canvas(device_, count);
    GraphicsPipelineStateDesc desc = canvas.desc("Whole", "DiscardOdd");
    desc.DepthStencilState.DepthEnable = true;
    const PipelineState half = canvas.make(desc);
    desc.PS.EntryPoint = "Tint";
    const PipelineState behind = canvas.make(desc);
    canvas.run([&](CommandList& list) {
      canvas.use(list, half, {1, 0, 0, 0.25f});
      list.DrawInstanced(3, 1, 0, 0);
      canvas.use(list, behind, {2, 0, 0, 0.5f});
      list.DrawInstanced(3, 1, 0, 0);
    });
    each_pixel([&](uint32_t x, uint32_t y) {
      for (uint32_t s = 0; s < count; ++s) {
        EXPECT_EQ(canvas.sample(x, y, s), (x & 1) != 0 ? 2.0f : 1.0f);
      }
    });
  });
}

TEST_P(Multisampling, DepthOfTheShaderIsThatOfEverySample) {
  each_count([&](uint32_t count) {
    MultisampleCanvas canvas(device_, count);
    GraphicsPipelineStateDesc desc = canvas.desc("Corners", "OwnDepth");
    desc.DepthStencilState.DepthEnable = true;
    const PipelineState own = canvas.make(desc);
    desc = canvas.desc("Whole", "Tint");
    desc.DepthStencilState.DepthEnable = true;
    const PipelineState behind = canvas.make(desc);
    const Half triangle;
    canvas.run([&](CommandList& list) {
      canvas.use(list, own, {1, 0, 0, 1});
      canvas.draw(list, triangle.vertices(0.75f));
      canvas.use(list, behind, {2, 0, 0, 0.5f});
      list.DrawInstanced(3, 1, 0, 0);
    });
    const auto pattern = standard_pattern(count);
    each_pixel([&](uint32_t x, uint32_t y) {
      const uint32_t mask = triangle.mask(x, y, pattern);
      for (uint32_t s = 0; s < count; ++s) {
        EXPECT_EQ(canvas.sample(x, y, s), (mask >> s & 1) != 0 ? 1.0f : 2.0f);
      }
    });
  });
}

// None at 0, all at 1, and never more than one off in between. [D3D11.3: 17.5]
TEST_P(Multisampling, AlphaBecomesCoverage) {
  each_count([&](uint32_t count) {
    MultisampleCanvas canvas(device_, count);
    GraphicsPipelineStateDesc desc = canvas.desc("Whole", "Alpha");
    desc.BlendState.AlphaToCoverageEnable = true;
    const PipelineState pipeline = canvas.make(desc);
    canvas.run([&](CommandList& list) {
      canvas.use(list, pipeline, {1, 0, 0, 0.5f});
      list.DrawInstanced(3, 1, 0, 0);
    });
    int before = 0;
    for (uint32_t x = 0; x < kSide; ++x) {
      const int covered = __builtin_popcount(bits_of(canvas, x, 3));
      const double alpha = std::min(x / 8.0, 1.0);
      EXPECT_NEAR(covered, alpha * count, 1) << x;
      EXPECT_GE(covered, before) << x;
      if (x == 0) {
        EXPECT_EQ(covered, 0);
      }
      if (x >= 8) {
        EXPECT_EQ(covered, static_cast<int>(count)) << x;
      }
      before = covered;
    }
  });
}

TEST_P(Multisampling, TheSampleMaskTakesSamplesOut) {
  each_count([&](uint32_t count) {
    MultisampleCanvas canvas(device_, count);
    GraphicsPipelineStateDesc desc = canvas.desc("Whole", "Tint");
    desc.DepthStencilState.DepthEnable = true;
    const PipelineState behind = canvas.make(desc);
    desc.SampleMask = 0xAAAAAAAA;
    const PipelineState odd = canvas.make(desc);
    canvas.run([&](CommandList& list) {
      canvas.use(list, odd, {1, 0, 0, 0.25f});
      list.DrawInstanced(3, 1, 0, 0);
      canvas.use(list, behind, {2, 0, 0, 0.5f});
      list.DrawInstanced(3, 1, 0, 0);
    });
    each_pixel([&](uint32_t x, uint32_t y) {
      for (uint32_t s = 0; s < count; ++s) {
        EXPECT_EQ(canvas.sample(x, y, s), (s & 1) != 0 ? 1.0f : 2.0f);
      }
    });
  });
}

TEST_P(Multisampling, SamplesBlendByThemselves) {
  each_count([&](uint32_t count) {
    MultisampleCanvas canvas(device_, count);
    GraphicsPipelineStateDesc desc = canvas.desc("Corners", "Tint");
    desc.BlendState.RenderTarget[0].BlendEnable = true;
    desc.BlendState.RenderTarget[0].DestBlend = Blend::kOne;
    const PipelineState add = canvas.make(desc);
    const Half triangle;
    canvas.run([&](CommandList& list) {
      canvas.use(list, add, {1, 0, 0, 1});
      canvas.draw(list, triangle.vertices());
      canvas.use(list, add, {2, 0, 0, 1});
      canvas.draw(list, {corner(0, 0), corner(32, 0), corner(0, 32)});
    });
    const auto pattern = standard_pattern(count);
    each_pixel([&](uint32_t x, uint32_t y) {
      const uint32_t mask = triangle.mask(x, y, pattern);
      for (uint32_t s = 0; s < count; ++s) {
        EXPECT_EQ(canvas.sample(x, y, s), (mask >> s & 1) != 0 ? 3.0f : 2.0f);
      }
    });
  });
}

TEST_P(Multisampling, ShadersReadWhatATextureIs) {
  each_count([&](uint32_t count) {
    MultisampleCanvas canvas(device_, count);
    const PipelineState pipeline = canvas.make(canvas.desc("Whole", "SamplePlace"));
    canvas.run([&](CommandList& list) {
      canvas.use(list, pipeline);
      list.DrawInstanced(3, 1, 0, 0);
    });
    const std::vector<float> out = canvas.compute("Describe", 14 * 4);
    EXPECT_EQ(out[0], kSide);
    EXPECT_EQ(out[1], kSide);
    EXPECT_EQ(out[2], static_cast<float>(count));
    const auto pattern = standard_pattern(count);
    for (uint32_t s = 0; s < 8; ++s) {
      const SamplePlace place = s < count ? pattern[s] : SamplePlace{0, 0};
      EXPECT_EQ(out[4 + 4 * s], static_cast<float>(place.x) / 16) << s;
      EXPECT_EQ(out[5 + 4 * s], static_cast<float>(place.y) / 16) << s;
    }
    for (const uint32_t outside : {9u, 10u}) {
      for (uint32_t c = 0; c < 4; ++c) EXPECT_EQ(out[outside * 4 + c], 0) << outside;
    }
    const float expected[3][4] = {{2.5f, 1.5f, 1, 1}, {2.5f, 1.5f, 1, 1}, {2.5f, 1.5f, 0, 1}};
    for (uint32_t i = 0; i < 3; ++i) {
      for (uint32_t c = 0; c < 4; ++c) EXPECT_EQ(out[(11 + i) * 4 + c], expected[i][c]) << i;
    }
  });
}

TEST_P(Multisampling, ElementsOfArraysAreDrawnReadAndResolved) {
  each_count([&](uint32_t count) {
    MultisampleCanvas canvas(device_, count, Format::kR32G32B32A32Float, 3);
    const PipelineState pipeline = canvas.make(canvas.desc("Corners", "Tint"));
    const Half triangle;
    canvas.run([&](CommandList& list) {
      canvas.use(list, pipeline, {1, 0, 0, 0});
      canvas.draw(list, triangle.vertices());
    });
    const auto pattern = standard_pattern(count);
    const auto bytes = canvas.resolved(Format::kR32G32B32A32Float);
    each_pixel([&](uint32_t x, uint32_t y) {
      const uint32_t mask = triangle.mask(x, y, pattern);
      EXPECT_EQ(bits_of(canvas, x, y), mask) << x << ", " << y;
      EXPECT_EQ(canvas.sample(x, y, 0, 3), 3.0f);  // elements
      float red;
      std::memcpy(&red, bytes.data() + (size_t{y} * kSide + x) * 16, sizeof red);
      EXPECT_FLOAT_EQ(red,
                      static_cast<float>(__builtin_popcount(mask)) / static_cast<float>(count));
    });
  });
}

TEST_P(Multisampling, CopiesKeepEverySample) {
  MultisampleCanvas from(device_, 4);
  MultisampleCanvas to(device_, 4);
  const PipelineState pipeline = from.make(from.desc("Corners", "Tint"));
  const Half triangle;
  from.run([&](CommandList& list) {
    from.use(list, pipeline);
    from.draw(list, triangle.vertices());
  });
  to.run([&](CommandList& list) {
    const auto change = [&](const Texture& texture, ResourceStates before, ResourceStates after) {
      list.ResourceBarrier(ResourceBarrier::Transition(texture, before, after));
    };
    constexpr ResourceStates kDrawn = ResourceStates::kRenderTarget;
    change(from.target, kDrawn, ResourceStates::kCopySource);
    change(to.target, kDrawn, ResourceStates::kCopyDest);
    list.CopyResource(to.target, from.target);
    change(from.target, ResourceStates::kCopySource, kDrawn);
    change(to.target, ResourceStates::kCopyDest, kDrawn);
  });
  const auto pattern = standard_pattern(4);
  each_pixel([&](uint32_t x, uint32_t y) {
    EXPECT_EQ(bits_of(to, x, y), triangle.mask(x, y, pattern)) << x << ", " << y;
  });
}

}  // namespace
}  // namespace kaamos::draws
