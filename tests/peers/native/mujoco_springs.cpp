// Trees with springs and dampers in MuJoCo.
#include <boost/json/src.hpp>

#include "mujoco_smooth.hpp"

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

int main(int count, char** words) { return run<Smooth<Tree, true>, Tree>(count, words); }
