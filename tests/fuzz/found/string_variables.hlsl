// SPDX-License-Identifier: MIT
// Strings have no value in a shader.
string result() {}
string global;
struct Member {
  string text[2];
};
cbuffer Constants {
  string constant;
};
groupshared string shared_text;
[shader("raygeneration")]
void Main() {
  string local;
  Member member;
  member.text[0];
  local;
  global;
}
[shader("miss")]
void Miss(inout Member member) {}
