// SPDX-License-Identifier: MIT
// The report of --study: one HTML page that needs no other file.
#pragma once

#include <rtapi/rtapi.h>

#include <string>
#include <vector>

#include "effects/measure/run/options.h"
#include "effects/measure/study/result.h"
#include "effects/measure/study/tables.h"

namespace kaamos::measure {

// The page. The pictures that the results name are read from the study's folder.
rtapi::Result<std::string> study_page(const Options& options,
                                      const std::vector<StudyResult>& results,
                                      const std::vector<StudyTable>& tables);

}  // namespace kaamos::measure
