// SPDX-License-Identifier: MIT
// The name of a call without its A or W: a reference to one of the two, not a macro, so that
// methods of COM interfaces keep theirs (ID3D12InfoQueue::GetMessage).
#pragma once

#ifdef UNICODE
#define KAAMOS_TEXT_CALL(name) inline constexpr auto& name = name##W
#define KAAMOS_TEXT_TYPE(name) typedef name##W name
#else
#define KAAMOS_TEXT_CALL(name) inline constexpr auto& name = name##A
#define KAAMOS_TEXT_TYPE(name) typedef name##A name
#endif
