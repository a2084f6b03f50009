// MuJoCo's smooth dynamics of a tree with springs and dampers, by the shortest path of public calls.
//
// The same calls as in mujoco_smooth.cpp, and mj_passive. The model stands beside FILE.
#include <mujoco/mujoco.h>

#include <boost/json/src.hpp>

#include "runner.hpp"

// Only what is no part of the model.
struct Tree {
  std::vector<double> angles, rates, motors;
  Components r_b_n_dot, omega, force, torque_b;

  explicit Tree(const std::string& path) {
    const boost::json::value whole = craft_json::parsed(path);
    const auto row = [&](const char* name) {
      return boost::json::value_to<std::vector<double>>(whole.at(name));
    };
    angles = row("angles"), rates = row("rates"), motors = row("motors");
    const auto components = [&](const char* name) { return craft_json::components(whole.at(name)); };
    r_b_n_dot = components("r_b_n_dot"), omega = components("omega");
    force = components("force"), torque_b = components("torque_b");
  }
};

class Sprung {
 public:
  Sprung(const Tree& tree, const std::string& file)
      : model(mj_loadModel((file.substr(0, file.rfind('.')) + ".mjb").c_str(), nullptr)) {
    if (!model) std::exit(1);
    data = mj_makeData(model);
    std::copy(tree.angles.begin(), tree.angles.end(), angles());
    std::copy(tree.rates.begin(), tree.rates.end(), rates());
    std::copy(tree.motors.begin(), tree.motors.end(), data->qfrc_applied + 6);
    std::copy(tree.r_b_n_dot.begin(), tree.r_b_n_dot.end(), data->qvel);
    std::copy(tree.omega.begin(), tree.omega.end(), data->qvel + 3);
    std::copy(tree.force.begin(), tree.force.end(), data->qfrc_applied);
    std::copy(tree.torque_b.begin(), tree.torque_b.end(), data->qfrc_applied + 3);
  }
  ~Sprung() {
    mj_deleteData(data);
    mj_deleteModel(model);
  }
  Sprung(const Sprung&) = delete;

  double* angles() { return data->qpos + 7; }
  double* rates() { return data->qvel + 6; }
  void evaluate() {
    mj_kinematics(model, data);
    mj_comPos(model, data);
    mj_crb(model, data);
    mj_factorM(model, data);
    mj_comVel(model, data);
    mj_passive(model, data);
    mj_rne(model, data, 0, data->qfrc_bias);
    mju_sub(data->qfrc_smooth, data->qfrc_applied, data->qfrc_bias, model->nv);
    mju_addTo(data->qfrc_smooth, data->qfrc_passive, model->nv);
    mj_solveM(model, data, data->qacc_smooth, data->qfrc_smooth, 1);
  }
  std::vector<double> accelerations() const {
    return {data->qacc_smooth, data->qacc_smooth + model->nv};
  }

 private:
  mjModel* model;
  mjData* data;
};

int main(int count, char** words) { return run<Sprung, Tree>(count, words); }
