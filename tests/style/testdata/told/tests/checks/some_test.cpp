// SPDX-License-Identifier: MIT
// KA0401 in a comment is no test.
const char* kId = "KA0400";
void Something() {
  told("KA0400");
}
