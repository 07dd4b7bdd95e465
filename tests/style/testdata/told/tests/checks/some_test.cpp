// SPDX-License-Identifier: MIT
// KA0401 in a comment is no test.
const char* kId = "KA0400";
