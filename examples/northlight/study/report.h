// SPDX-License-Identifier: MIT
// The report of --study: one HTML page that needs no other file.
#pragma once

#include <rtapi/rtapi.h>

#include <string>
#include <vector>

#include "result.h"

namespace northlight {

// What was found, in ten lines at most.
std::vector<std::string> study_findings(const std::vector<StudyResult>& results);

// The page. `folder`: of the pictures that the results name.
rtapi::Result<std::string> study_page(const std::string& scene, const std::string& folder,
                                      const std::vector<StudyResult>& results);

}  // namespace northlight
