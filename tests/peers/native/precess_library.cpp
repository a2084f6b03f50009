// The C library of Precess: its accelerations, or its steps, called through `precess.h`.
//
//     precess_library evaluation check|time|turns DIR/N.json       reads DIR/steps/N.json
//     precess_library step check|time|turns DIR/steps/NAME.json
#include <boost/json/src.hpp>

#include "listed.hpp"
#include "runner.hpp"

// Short while it is timed, s, so that no turn runs into a state unlike the first.
constexpr double STEP = 1e-7;
// Steps over which motions are compared.
constexpr int CHECKED = 100;

class Library {
 public:
  explicit Library(const Listed& listed) : listed(listed) {
    need(precess_init(&craft, sizeof craft, &listed.hub, listed.devices.data(),
                      static_cast<uint32_t>(listed.devices.size()), &fault));
    need(precess_state_at_rest(&craft, &state));
    need(precess_inputs_none(&craft, &inputs));
    std::copy(listed.omega.begin(), listed.omega.end(), state.omega);
    std::copy(listed.force.begin(), listed.force.end(), inputs.force);
    std::copy(listed.torque_b.begin(), listed.torque_b.end(), inputs.torque);
    std::copy(&listed.coordinate[0][0], &listed.coordinate[0][0] + JOINTS, angles());
    std::copy(&listed.rate[0][0], &listed.rate[0][0] + JOINTS, rates());
    std::copy(&listed.motor[0][0], &listed.motor[0][0] + JOINTS, &inputs.motor[0][0]);
  }

  double* angles() { return &state.coordinate[0][0]; }
  double* rates() { return &state.rate[0][0]; }

 protected:
  static constexpr std::size_t JOINTS = PRECESS_MAX_DEVICES * PRECESS_MAX_JOINTS;

  static void need(int32_t code) {
    if (code == PRECESS_OK) return;
    std::fprintf(stderr, "%s\n", precess_error_name(code));
    std::exit(1);
  }

  // Of the joints that are there.
  std::vector<double> of_joints(const double (*values)[PRECESS_MAX_JOINTS]) const {
    std::vector<double> found;
    for (std::size_t k = 0; k < listed.joints.size(); ++k)
      found.insert(found.end(), values[k], values[k] + listed.joints[k]);
    return found;
  }

  const Listed& listed;
  precess_spacecraft craft;
  precess_state state;
  precess_inputs inputs;
  precess_fault fault;
};

class Evaluation : public Library {
 public:
  using Library::Library;
  void evaluate() { need(precess_accelerations_of(&craft, &state, &inputs, &found, &fault)); }
  void check() {
    evaluate();
    std::vector<double> all(found.linear, found.linear + 3);
    all.insert(all.end(), found.angular, found.angular + 3);
    const std::vector<double> joints = of_joints(found.joint);
    all.insert(all.end(), joints.begin(), joints.end());
    print_accelerations(all);
  }

 private:
  precess_accelerations found;
};

class Step : public Library {
 public:
  using Library::Library;
  void evaluate() { need(precess_step(&craft, &state, &inputs, STEP, 1, nullptr, &fault)); }
  void check() {
    need(precess_step(&craft, &state, &inputs, listed.step, CHECKED, nullptr, &fault));
    const auto vector = [](const double* x) { return std::vector<double>(x, x + 3); };
    // B starts at rest at the origin, its axes along the inertial ones.
    print_numbers("{\"motion\": {\"displacement\": [", vector(state.position));
    print_numbers(", \"velocity\": [", vector(state.velocity));
    std::vector<double> attitude = vector(state.attitude + 1);
    for (double& x : attitude) x = state.attitude[0] < 0.0 ? -x : x;
    print_numbers(", \"attitude\": [", attitude);
    print_numbers(", \"omega\": [", vector(state.omega));
    print_numbers(", \"coordinates\": [", of_joints(state.coordinate));
    print_numbers(", \"rates\": [", of_joints(state.rate));
    std::puts("}}");
  }
};

template <class Engine>
int run_library(const std::string& what, const std::string& path) {
  const Listed listed(path);
  Engine engine(listed);
  if (what == "check") {
    engine.check();
  } else {
    print_turns(engine, listed.joints.size() * listed.joints.front(), what == "turns");
  }
  return 0;
}

int main(int count, char** words) {
  const std::string service = count == 4 ? words[1] : "", what = count == 4 ? words[2] : "";
  if (what != "check" && what != "time" && what != "turns") {
    std::fprintf(stderr, "usage: %s evaluation|step check|time|turns FILE\n", words[0]);
    return 2;
  }
  const std::string path = words[3];
  const std::size_t name = path.find_last_of('/') + 1;
  return service == "step"
             ? run_library<Step>(what, path)
             : run_library<Evaluation>(what, path.substr(0, name) + "steps/" + path.substr(name));
}
