// SPDX-License-Identifier: MIT
//
// The triangle test of TraversalPrecision::kExact. A vertex is projected along the ray by a
// function of nothing but the vertex and the ray, so triangles that share the vertex agree on where
// it is. The rest is exact: on which side of an edge the ray passes, and, if it passes through the
// edge or a vertex, on which side it would pass if moved by an infinitely small (e, e * e). Exactly
// one of the triangles around a shared edge or vertex is hit. [DXR: Watertightness; Top-left rule]
//
// Needs IEEE arithmetic without contraction of products: compile whatever includes this with
// -ffp-contract=off. Results are then the same on every processor.
#pragma once

#include <cmath>

namespace kaamos::embree {

// A ray, with everything that is the same for all triangles.
struct ExactRay {
  double origin[3];
  double direction[3];
  int x, y, z;  // axes: z has the largest |direction|, and the three are a cycle
  double shear_x, shear_y;

  ExactRay() = default;
  // The direction must be finite and not zero.
  ExactRay(const double o[3], const double d[3])
      : origin{o[0], o[1], o[2]}, direction{d[0], d[1], d[2]} {
    z = std::fabs(d[0]) > std::fabs(d[1]) ? 0 : 1;
    if (std::fabs(d[2]) >= std::fabs(d[z])) z = 2;
    x = z == 2 ? 0 : z + 1;
    y = z == 0 ? 2 : z - 1;
    shear_x = d[x] / d[z];
    shear_y = d[y] / d[z];
  }
};

struct ExactHit {
  double t;        // the hit is at origin + t * direction; may be negative
  double u, v;     // weights of the second and third vertex, at least 0; u + v is at most about 1
  bool clockwise;  // as seen from the origin: a front face by default
};

// a * d - b * c. The sign is that of the exact value; the magnitude is right to 29 bits or more.
inline double difference_of_products(double a, double d, double b, double c) {
  const double p = a * d;
  const double q = b * c;
  const double difference = p - q;
  constexpr double kCancelled = 0x1p-24;
  if (std::fabs(difference) > kCancelled * (std::fabs(p) + std::fabs(q))) return difference;
  // Rounding is monotonic: where the rounded products differ, the exact ones differ the same way.
  const double rest = std::fma(a, d, -p) - std::fma(b, c, -q);
  if (difference == 0) return rest;
  const double sum = difference + rest;
  return (sum > 0) == (difference > 0) && sum != 0 ? sum : difference * 0x1p-60;
}

// A vertex as seen by the ray, which passes through (0, 0).
struct ProjectedVertex {
  double x, y;
  double z;  // distance along the axis z
};

inline ProjectedVertex project(const ExactRay& ray, const float vertex[3]) {
  const double z = static_cast<double>(vertex[ray.z]) - ray.origin[ray.z];
  return {static_cast<double>(vertex[ray.x]) - ray.origin[ray.x] - ray.shear_x * z,
          static_cast<double>(vertex[ray.y]) - ray.origin[ray.y] - ray.shear_y * z, z};
}

// On which side of the line from a to b the moved ray passes, given the side of the unmoved one.
// Swapping a and b changes the sign and nothing else. 0: a and b are one point.
inline int side_of_moved(double side, const ProjectedVertex& a, const ProjectedVertex& b) {
  if (side != 0) return side > 0 ? 1 : -1;
  if (a.y != b.y) return b.y > a.y ? -1 : 1;
  if (a.x != b.x) return b.x > a.x ? 1 : -1;
  return 0;
}

// Returns whether the line of the ray hits the triangle. Triangles seen edge-on are not hit.
inline bool intersect(const ExactRay& ray, const float a[3], const float b[3], const float c[3],
                      ExactHit& hit) {
  const ProjectedVertex pa = project(ray, a);
  const ProjectedVertex pb = project(ray, b);
  const ProjectedVertex pc = project(ray, c);
  const double ab = difference_of_products(pa.x, pb.y, pa.y, pb.x);
  const double bc = difference_of_products(pb.x, pc.y, pb.y, pc.x);
  if ((ab < 0 && bc > 0) || (ab > 0 && bc < 0)) return false;
  const double ca = difference_of_products(pc.x, pa.y, pc.y, pa.x);
  if (ab == 0 || bc == 0 || ca == 0) {
    const int side = side_of_moved(ab, pa, pb);
    if (side == 0 || side_of_moved(bc, pb, pc) != side || side_of_moved(ca, pc, pa) != side) {
      return false;
    }
  } else if ((ca > 0) != (ab > 0)) {
    return false;
  }
  // All three have the same sign, so nothing cancels here.
  const double area = ab + bc + ca;
  if (area == 0) return false;
  const double scale = 1 / area;
  hit.u = ca * scale;
  hit.v = ab * scale;
  hit.t = (bc * pa.z + ca * pb.z + ab * pc.z) * scale / ray.direction[ray.z];
  hit.clockwise = (area > 0) != (ray.direction[ray.z] > 0);
  return true;
}

// Returns whether the corners are collinear or coincide. [DXR: Degenerate primitives and instances]
inline bool is_degenerate(const float a[3], const float b[3], const float c[3]) {
  double e[3];
  double f[3];
  for (int i = 0; i < 3; ++i) {
    e[i] = static_cast<double>(b[i]) - a[i];
    f[i] = static_cast<double>(c[i]) - a[i];
  }
  return difference_of_products(e[1], f[2], e[2], f[1]) == 0 &&
         difference_of_products(e[2], f[0], e[0], f[2]) == 0 &&
         difference_of_products(e[0], f[1], e[1], f[0]) == 0;
}

}  // namespace kaamos::embree
