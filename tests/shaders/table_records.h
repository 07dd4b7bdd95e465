// SPDX-License-Identifier: MIT
//
// The records of the shader tables of a test file: every hit group, miss and callable shader in the
// file's order, with the local arguments of its "record" lines, one record for each of them.
#pragma once

#include <rtapi/shader_compiler.h>

#include <string>
#include <vector>

#include "tests/shaders/scene.h"
#include "tests/shaders/test_file.h"

namespace kaamos::shader_tests {

struct TableRecords {
  std::vector<SceneRecord> hit_groups;
  std::vector<SceneRecord> miss_shaders;
  std::vector<SceneRecord> callable_shaders;
  std::string error;  // a record of what the file does not have
};
TableRecords table_records(const TestFile& tests, const SceneDescription& scene);

// What HIT_GROUP(name), MISS(name) and CALLABLE(name) of kaamos/test.hlsli stand for: the first
// record of that name. MISS(none) is the record behind all others, which is NULL.
std::vector<rtapi::ShaderDefine> record_defines(const TableRecords& records);

}  // namespace kaamos::shader_tests
