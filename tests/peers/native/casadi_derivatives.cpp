// The C that CasADi generated of derivatives of the articulated-body algorithm, called as a function.
#include <map>

#include <boost/json/src.hpp>

#include "derivatives.hpp"
#include "pinocchio_layout.hpp"
#include "runner.hpp"

using Generated = int(const double** arg, double** res, long long* iw, double* w, int mem);
#define PASTED(what, n) what##_##n
#define NAMED(what, n) PASTED(what, n)
extern "C" Generated NAMED(WHAT, 1), NAMED(WHAT, 4);

class Derivatives {
 public:
  // Compiled into this program, parameters and all, for the spacecraft of these sizes.
  Derivatives(const Craft& craft, const std::string&)
      : craft(craft),
        generated(std::map<std::size_t, Generated*>{{1, NAMED(WHAT, 1)}, {4, NAMED(WHAT, 4)}}.at(
            craft.devices.size())),
        q(configuration(craft)),
        v(velocities(craft)),
        tau(forces(craft)),
        by_angles(v.size() * craft.angles.size()),
        by_v(v.size() * v.size()),
        by_tau(v.size() * v.size()),
        inputs{q.data(), v.data(), tau.data()},
        outputs{by_angles.data(), by_v.data(), by_tau.data()} {}
  Derivatives(const Derivatives&) = delete;

  double* angles() { return q.data() + 7; }
  double* rates() { return v.data() + 6; }
  void evaluate() { generated(inputs.data(), outputs.data(), nullptr, nullptr, 0); }
  void print() const {
    const auto of = [this](const std::vector<double>& matrix, std::size_t first) {
      return [&matrix, first, rows = v.size()](std::size_t row, std::size_t column) {
        return matrix[row + rows * (column - first)];
      };
    };
    print_derivatives(craft, of(by_angles, 6), of(by_v, 0), of(by_tau, 0));
  }

 private:
  const Craft& craft;
  Generated* generated;
  std::vector<double> q, v, tau, by_angles, by_v, by_tau;
  std::array<const double*, 3> inputs;
  std::array<double*, 3> outputs;
};

int main(int count, char** words) { return run<Derivatives>(count, words); }
