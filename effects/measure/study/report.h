// SPDX-License-Identifier: MIT
// The report of --study: one HTML page that needs no other file.
#pragma once

#include <rtapi/rtapi.h>

#include <string>
#include <vector>

#include "effects/measure/study/result.h"
#include "effects/measure/study/tables.h"

namespace kaamos::measure {

// The page. `folder`: of the pictures that the results name.
rtapi::Result<std::string> study_page(const std::string& scene, const std::string& folder,
                                      const std::vector<StudyResult>& results,
                                      const std::vector<StudyTable>& tables);

}  // namespace kaamos::measure
