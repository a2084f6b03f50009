// State and forces in Pinocchio's order, and back from its accelerations.
#pragma once

#include "craft.hpp"

// Position, quaternion with its scalar last, then the joints.
inline std::vector<double> configuration(const Craft& craft) {
  std::vector<double> q{0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0};
  q.insert(q.end(), craft.angles.begin(), craft.angles.end());
  return q;
}

inline std::vector<double> stacked(const Components& first, const Components& second,
                                   const std::vector<double>& joints) {
  std::vector<double> all(first.begin(), first.end());
  all.insert(all.end(), second.begin(), second.end());
  all.insert(all.end(), joints.begin(), joints.end());
  return all;
}

inline std::vector<double> velocities(const Craft& craft) {
  return stacked(craft.r_b_n_dot, craft.omega, craft.rates);
}

inline std::vector<double> forces(const Craft& craft) {
  return stacked(craft.force, craft.torque_b, craft.motors);
}

// A free-flyer has a spatial acceleration along B: r_ddot - omega x r_dot.
inline std::vector<double> accelerations_of(std::vector<double> a, const double* v) {
  a[0] += v[4] * v[2] - v[5] * v[1];
  a[1] += v[5] * v[0] - v[3] * v[2];
  a[2] += v[3] * v[1] - v[4] * v[0];
  return a;
}
