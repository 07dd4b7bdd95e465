// SPDX-License-Identifier: MIT
/// @file
/// All of the API, but for what few programs need: names of errors, `<rtapi/error_ids.h>`, runtime
/// compilation of HLSL, `<rtapi/shader_compiler.h>`, and what shows tables and pixels to people,
/// `<rtapi/table_description.h>`, `<rtapi/explain.h>` and `<rtapi/explain_draw.h>`.
#pragma once

#include <rtapi/barrier.h>            // IWYU pragma: export
#include <rtapi/build_structure.h>    // IWYU pragma: export
#include <rtapi/command_list.h>       // IWYU pragma: export
#include <rtapi/command_queue.h>      // IWYU pragma: export
#include <rtapi/command_signature.h>  // IWYU pragma: export
#include <rtapi/descriptor.h>         // IWYU pragma: export
#include <rtapi/device.h>             // IWYU pragma: export
#include <rtapi/device_level.h>       // IWYU pragma: export
#include <rtapi/format.h>             // IWYU pragma: export
#include <rtapi/heap.h>               // IWYU pragma: export
#include <rtapi/pipeline_state.h>     // IWYU pragma: export
#include <rtapi/query.h>              // IWYU pragma: export
#include <rtapi/raytracing.h>         // IWYU pragma: export
#include <rtapi/resource.h>           // IWYU pragma: export
#include <rtapi/result.h>             // IWYU pragma: export
#include <rtapi/root_signature.h>     // IWYU pragma: export
#include <rtapi/rtas_operations.h>    // IWYU pragma: export
#include <rtapi/shader_library.h>     // IWYU pragma: export
#include <rtapi/shader_table.h>       // IWYU pragma: export
#include <rtapi/state_object.h>       // IWYU pragma: export
#include <rtapi/types.h>              // IWYU pragma: export
#include <rtapi/upload.h>             // IWYU pragma: export
#include <rtapi/version.h>            // IWYU pragma: export
