// SPDX-License-Identifier: MIT
//
// The end of a check: the module is made, and what only shows then is reported.
#pragma once

#include "runtime/hlsl/check/stages/stage_part.h"

namespace kaamos::hlsl {

class Finish : StagePart {
 public:
  using StagePart::StagePart;

  void run();
  void check_payload_uses();
  // Bodies that nothing reaches were not checked.
  void warn_skipped();
  // Their points of coverage.
  void cover_unreached();

 private:
  void check_resources();
  void check_input_reads();
  void check_unreached();
  void lower_unreached();
};

}  // namespace kaamos::hlsl
