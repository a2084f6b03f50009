// The C that CasADi generated of Pinocchio's articulated-body algorithm, called as a function.
#include <map>

#include <boost/json/src.hpp>

#include "pinocchio_layout.hpp"
#include "runner.hpp"

using Aba = int(const double** arg, double** res, long long* iw, double* w, int mem);
extern "C" Aba aba_1, aba_2, aba_4, aba_8, aba_16;

class Generated {
 public:
  // Compiled into this program, parameters and all, for the spacecraft of these sizes.
  Generated(const Craft& craft, const std::string&)
      : aba(std::map<std::size_t, Aba*>{
            {1, aba_1}, {2, aba_2}, {4, aba_4}, {8, aba_8}, {16, aba_16}}
                .at(craft.devices.size())),
        q(configuration(craft)),
        v(velocities(craft)),
        tau(forces(craft)),
        a(v.size()),
        inputs{q.data(), v.data(), tau.data()},
        outputs{a.data()} {}
  Generated(const Generated&) = delete;

  double* angles() { return q.data() + 7; }
  double* rates() { return v.data() + 6; }
  void evaluate() { aba(inputs.data(), outputs.data(), nullptr, nullptr, 0); }
  std::vector<double> accelerations() const { return accelerations_of(a, v.data()); }

 private:
  Aba* aba;
  std::vector<double> q, v, tau, a;
  std::array<const double*, 3> inputs;
  std::array<double*, 1> outputs;
};

int main(int count, char** words) { return run<Generated>(count, words); }
