// Pinocchio's derivatives of the articulated-body algorithm, its header templates instantiated here.
#include <pinocchio/algorithm/aba-derivatives.hpp>

#include <boost/json/src.hpp>

#include "derivatives.hpp"
#include "pinocchio_layout.hpp"
#include "pinocchio_model.hpp"
#include "runner.hpp"

class AbaDerivatives {
 public:
  AbaDerivatives(const Craft& craft, const std::string&)
      : craft(craft),
        model(pinocchio_model(craft)),
        data(model),
        q(column(configuration(craft))),
        v(column(velocities(craft))),
        tau(column(forces(craft))) {}

  double* angles() { return q.data() + 7; }
  double* rates() { return v.data() + 6; }
  void evaluate() { pinocchio::computeABADerivatives(model, data, q, v, tau); }
  void print() const {
    const auto of = [](const auto& matrix) {
      return [&matrix](std::size_t row, std::size_t column) { return matrix(row, column); };
    };
    print_derivatives(craft, of(data.ddq_dq), of(data.ddq_dv), of(data.Minv));
  }

 private:
  static Eigen::VectorXd column(const std::vector<double>& x) {
    return Eigen::Map<const Eigen::VectorXd>(x.data(), x.size());
  }

  const Craft& craft;
  pinocchio::Model model;
  pinocchio::Data data;
  Eigen::VectorXd q, v, tau;
};

int main(int count, char** words) { return run<AbaDerivatives>(count, words); }
