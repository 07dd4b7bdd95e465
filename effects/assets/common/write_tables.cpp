// SPDX-License-Identifier: MIT
// write_tables FILE: writes the definitions of tables.h, as the build asks for.
#include <cstdio>

#include "effects/assets/common/albedo_integral.h"
#include "effects/assets/common/tables.h"
#include "effects/assets/common/void_and_cluster.h"

namespace kaamos::effects {
namespace {

void write_noise(std::FILE* file) {
  std::fputs(
      "const std::uint16_t kNoiseRanks[2][std::size_t{kBlueNoiseSize} * kBlueNoiseSize] = {\n",
      file);
  for (const std::uint32_t seed : {1u, 2u}) {
    std::fputs("{", file);
    for (const std::uint32_t rank : void_and_cluster(kBlueNoiseSize, seed))
      std::fprintf(file, "%u,\n", rank);
    std::fputs("},\n", file);
  }
  std::fputs("};\n", file);
}

void write_albedo(std::FILE* file) {
  std::fputs(
      "const std::array<float, 2>\n"
      "    kAlbedoSplits[std::size_t{kSpecularAlbedoCosines} * kSpecularAlbedoRoughnesses] = {\n",
      file);
  for (std::uint32_t y = 0; y < kSpecularAlbedoRoughnesses; ++y) {
    for (std::uint32_t x = 0; x < kSpecularAlbedoCosines; ++x) {
      const double root = x / (kSpecularAlbedoCosines - 1.0);
      const double roughness = y / (kSpecularAlbedoRoughnesses - 1.0);
      const glm::vec2 split(integrate_specular_albedo(root * root, roughness));
      std::fprintf(file, "{%af, %af},\n", double{split.x}, double{split.y});
    }
  }
  std::fputs("};\n", file);
}

bool write_tables(const char* path) {
  std::FILE* file = std::fopen(path, "w");
  if (file == nullptr) return false;
  std::fputs("#include \"effects/assets/common/tables.h\"\n\nnamespace kaamos::effects {\n", file);
  write_noise(file);
  write_albedo(file);
  std::fputs("}  // namespace kaamos::effects\n", file);
  const bool whole = std::ferror(file) == 0;
  return std::fclose(file) == 0 && whole;
}

}  // namespace
}  // namespace kaamos::effects

int main(int argc, char** argv) {
  if (argc == 2 && kaamos::effects::write_tables(argv[1])) return 0;
  std::fprintf(stderr, "write_tables: cannot write \"%s\"\n", argc == 2 ? argv[1] : "");
  return 1;
}
