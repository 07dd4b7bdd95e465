// [coverage.hlsl]
uint from_include(uint x) {  //= 1
  return x + 1;  //= 1
}

uint not_from_include(uint x) {  //= 0
  return x + 2;  //= 0
}
