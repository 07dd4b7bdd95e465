// SPDX-License-Identifier: MIT
#include "tests/shaders/table_records.h"

#include <algorithm>

namespace kaamos::shader_tests {
namespace {

std::vector<SceneRecord> records_of(const std::vector<std::string>& exports,
                                    const SceneDescription& scene) {
  std::vector<SceneRecord> out;
  for (const std::string& name : exports) {
    const size_t before = out.size();
    for (const SceneRecord& record : scene.records) {
      if (record.export_name == name) out.push_back(record);
    }
    if (out.size() == before) out.push_back({name, {}});
  }
  return out;
}

void add_defines(const std::string& prefix, const std::vector<SceneRecord>& records,
                 std::vector<rtapi::ShaderDefine>& out) {
  for (size_t i = 0; i < records.size(); ++i) {
    const std::string& name = records[i].export_name;
    if (i > 0 && records[i - 1].export_name == name) continue;
    out.push_back({"KAAMOS_" + prefix + "_" + name, std::to_string(i)});
  }
}

}  // namespace

TableRecords table_records(const TestFile& tests, const SceneDescription& scene) {
  TableRecords out;
  out.hit_groups = records_of(tests.hit_groups, scene);
  out.miss_shaders = records_of(tests.miss_shaders, scene);
  out.callable_shaders = records_of(tests.callable_shaders, scene);
  for (const SceneRecord& record : scene.records) {
    const auto has = [&](const std::vector<std::string>& names) {
      return std::find(names.begin(), names.end(), record.export_name) != names.end();
    };
    if (has(tests.hit_groups) || has(tests.miss_shaders) || has(tests.callable_shaders)) continue;
    out.error = "'#pragma kaamos record " + record.export_name +
                "' names no hit group, miss or callable shader of the file";
    break;
  }
  return out;
}

std::vector<rtapi::ShaderDefine> record_defines(const TableRecords& records) {
  std::vector<rtapi::ShaderDefine> out;
  add_defines("HIT_GROUP", records.hit_groups, out);
  add_defines("MISS", records.miss_shaders, out);
  add_defines("CALLABLE", records.callable_shaders, out);
  out.push_back({"KAAMOS_MISS_none", std::to_string(records.miss_shaders.size())});
  return out;
}

}  // namespace kaamos::shader_tests
