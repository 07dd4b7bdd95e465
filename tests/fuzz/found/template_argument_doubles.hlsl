// SPDX-License-Identifier: MIT
// Each level has an argument twice as long as that of the level before.
template <typename A, typename B>
struct Pair {
  A a;
  B b;
};
template <typename T>
struct Grow {
  typedef Grow<Pair<T, T> > Next;
  Next next;
};
[shader("raygeneration")]
void Main() {
  Grow<uint> grow;
}
