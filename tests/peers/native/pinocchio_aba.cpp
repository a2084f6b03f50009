// Pinocchio's articulated-body algorithm, its header templates instantiated here.
#include <pinocchio/algorithm/aba.hpp>

#include <boost/json/src.hpp>

#include "pinocchio_layout.hpp"
#include "pinocchio_model.hpp"
#include "runner.hpp"

class Aba {
 public:
  Aba(const Craft& craft, const std::string&)
      : model(pinocchio_model(craft)),
        data(model),
        q(column(configuration(craft))),
        v(column(velocities(craft))),
        tau(column(forces(craft))) {}

  double* angles() { return q.data() + 7; }
  double* rates() { return v.data() + 6; }
  void evaluate() { pinocchio::aba(model, data, q, v, tau); }
  std::vector<double> accelerations() const {
    return accelerations_of({data.ddq.begin(), data.ddq.end()}, v.data());
  }

 private:
  static Eigen::VectorXd column(const std::vector<double>& x) {
    return Eigen::Map<const Eigen::VectorXd>(x.data(), x.size());
  }

  pinocchio::Model model;
  pinocchio::Data data;
  Eigen::VectorXd q, v, tau;
};

int main(int count, char** words) { return run<Aba>(count, words); }
