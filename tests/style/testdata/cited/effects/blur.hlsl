// Blurs what is far away. [gone-spec B4.7: no contact hardening]
// What is near stays sharp (gone-spec 0.1: E4). [Valient 2014; D3D11.3 3.4.1; gone-spec part A: S3]
// No texel is read twice. [gone-spec
// B4.8]
// Its weights have 8 bits [SOURCES.md: E4] and follow from depth (on both sides, in half-steps).
