// Derivatives of accelerations from the matrices of an engine in Pinocchio's order: blocks by name, as printed.
#pragma once

#include <cstdio>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "craft.hpp"

// Rows and columns of one name.
using Places = std::pair<const char*, std::vector<std::size_t>>;

inline std::vector<Places> rows_of(std::size_t devices) {
  std::vector<Places> rows{{"r_b_n_ddot", {0, 1, 2}}, {"omega_dot", {3, 4, 5}}};
  const std::array<const char*, 3> joints{"gamma_o_ddot", "gamma_i_ddot", "spin_dot"};
  for (std::size_t k = 0; k < 3; ++k) {
    rows.push_back({joints[k], {}});
    for (std::size_t n = 0; n < devices; ++n) rows.back().second.push_back(6 + 3 * n + k);
  }
  return rows;
}

// The elements of a matrix by row and column, both in the order of the velocities.
using Matrix = std::function<double(std::size_t, std::size_t)>;

// By the motion and the forces, `{"derivatives": {"omega_dot by rates": [...], ...}}`. A free-flyer has a spatial
// acceleration along B, r_ddot - omega x r_dot, whose second part changes with omega.
inline void print_derivatives(const Craft& craft, const Matrix& by_q, const Matrix& by_v,
                              const Matrix& by_tau) {
  const std::size_t joints = craft.angles.size();
  std::vector<std::size_t> of_joints;
  for (std::size_t k = 0; k < joints; ++k) of_joints.push_back(6 + k);
  const Components& v = craft.r_b_n_dot;
  const Matrix corrected = [&](std::size_t row, std::size_t column) {
    const double found = by_v(row, column);
    if (row > 2 || column < 3 || column > 5) return found;
    // e x r_dot.
    const std::size_t e = column - 3, next = (e + 1) % 3, last = (e + 2) % 3;
    if (row == next) return found - v[last];
    return row == last ? found + v[next] : found;
  };
  struct Columns {
    const char* name;
    const Matrix& of;
    std::vector<std::size_t> places;
  };
  const std::vector<Columns> columns{
      {"angles", by_q, of_joints},    {"omega", corrected, {3, 4, 5}}, {"rates", corrected, of_joints},
      {"force", by_tau, {0, 1, 2}},   {"torque_b", by_tau, {3, 4, 5}}, {"motors", by_tau, of_joints},
  };
  const char* before = "{\"derivatives\": {";
  for (const auto& [row_name, rows] : rows_of(craft.devices.size()))
    for (const Columns& by : columns) {
      std::printf("%s\"%s by %s\": ", before, row_name, by.name);
      before = ", ";
      const char* comma = "[";
      for (const std::size_t column : by.places)
        for (const std::size_t row : rows) {
          std::printf("%s%.17g", comma, by.of(row, column));
          comma = ", ";
        }
      std::fputs("]", stdout);
    }
  std::puts("}}");
}
