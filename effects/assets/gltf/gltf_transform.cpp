// SPDX-License-Identifier: MIT
#include "effects/assets/gltf/gltf_transform.h"

#include <algorithm>
#include <cmath>

namespace kaamos::effects {
namespace {

/// Two axes may be this far from a right angle, as a cosine.
constexpr double kSquare = 1e-7;

double worst_cosine(const glm::dmat3& m) {
  double worst = 0.0;
  for (int c = 0; c < 3; ++c) {
    const glm::dvec3 &a = m[c], &b = m[(c + 1) % 3];
    worst = std::max(worst, std::abs(glm::dot(a, b)) / (glm::length(a) * glm::length(b)));
  }
  return worst;
}

/// The rotation V for which the columns of m * V are perpendicular: Jacobi rotations of pairs of
/// columns from the right. [Hestenes 1958: one-sided Jacobi]
glm::dmat3 right_rotation(const glm::dmat3& m) {
  glm::dmat3 columns = m, v(1.0);
  for (int sweep = 0; sweep < 30; ++sweep) {
    if (worst_cosine(columns) < 1e-15) break;
    for (int c = 0; c < 3; ++c) {
      const int p = std::min(c, (c + 1) % 3), q = std::max(c, (c + 1) % 3);
      const double cross = glm::dot(columns[p], columns[q]);
      const double difference = glm::dot(columns[q], columns[q]) - glm::dot(columns[p], columns[p]);
      const double angle = 0.5 * std::atan2(2.0 * cross, -difference);
      const double cosine = std::cos(angle), sine = std::sin(angle);
      for (glm::dmat3* matrix : {&columns, &v}) {
        const glm::dvec3 first = (*matrix)[p], second = (*matrix)[q];
        (*matrix)[p] = cosine * first + sine * second;
        (*matrix)[q] = cosine * second - sine * first;
      }
    }
  }
  return v;
}

}  // namespace

std::vector<glm::dmat4> without_shear(const glm::dmat4& transform) {
  const glm::dmat3 linear(transform);
  if (!(worst_cosine(linear) > kSquare)) return {transform};
  const glm::dmat3 v = right_rotation(linear);
  glm::dmat4 outer(linear * v);
  outer[3] = transform[3];
  return {outer, glm::dmat4(glm::transpose(v))};
}

}  // namespace kaamos::effects
