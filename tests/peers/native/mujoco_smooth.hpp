// MuJoCo's smooth dynamics, by the shortest path of public calls to `qacc_smooth`.
//
// Of `mj_forward` this leaves out what a free spacecraft without contacts, limits, actuators and
// sensors does not need: collision, constraints, transmission, energy; and, unless they are asked for,
// passive forces.
#pragma once

#include <mujoco/mujoco.h>

#include "runner.hpp"

template <class Given, bool PASSIVE>
class Smooth {
 public:
  // The model stands beside FILE, compiled from the same spacecraft.
  Smooth(const Given& craft, const std::string& file)
      : model(mj_loadModel((file.substr(0, file.rfind('.')) + ".mjb").c_str(), nullptr)) {
    if (!model) std::exit(1);
    data = mj_makeData(model);
    std::copy(craft.angles.begin(), craft.angles.end(), angles());
    std::copy(craft.rates.begin(), craft.rates.end(), rates());
    std::copy(craft.motors.begin(), craft.motors.end(), data->qfrc_applied + 6);
    std::copy(craft.r_b_n_dot.begin(), craft.r_b_n_dot.end(), data->qvel);
    std::copy(craft.omega.begin(), craft.omega.end(), data->qvel + 3);
    std::copy(craft.force.begin(), craft.force.end(), data->qfrc_applied);
    std::copy(craft.torque_b.begin(), craft.torque_b.end(), data->qfrc_applied + 3);
  }
  ~Smooth() {
    mj_deleteData(data);
    mj_deleteModel(model);
  }
  Smooth(const Smooth&) = delete;

  double* angles() { return data->qpos + 7; }
  double* rates() { return data->qvel + 6; }
  void evaluate() {
    mj_kinematics(model, data);
    mj_comPos(model, data);
    mj_crb(model, data);
    mj_factorM(model, data);
    mj_comVel(model, data);
    if constexpr (PASSIVE) mj_passive(model, data);
    mj_rne(model, data, 0, data->qfrc_bias);
    mju_sub(data->qfrc_smooth, data->qfrc_applied, data->qfrc_bias, model->nv);
    if constexpr (PASSIVE) mju_addTo(data->qfrc_smooth, data->qfrc_passive, model->nv);
    mj_solveM(model, data, data->qacc_smooth, data->qfrc_smooth, 1);
  }
  std::vector<double> accelerations() const {
    return {data->qacc_smooth, data->qacc_smooth + model->nv};
  }

 private:
  mjModel* model;
  mjData* data;
};
