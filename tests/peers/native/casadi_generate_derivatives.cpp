// Writes C for derivatives of the accelerations of one spacecraft: Pinocchio over CasADi's symbols.
//
//     casadi_generate_derivatives FILE FOLDER/ jacobian    of CasADi's Jacobian of the articulated-body algorithm
//     casadi_generate_derivatives FILE FOLDER/ analytic    of Pinocchio's computeABADerivatives
//
// Writes FOLDER/WHAT_N.c, prints its operations. Masses, places and inertias are numbers of the generated code; q, v and
// tau are its inputs; its outputs are the derivatives by the angles of the joints, by v and by tau, dense.
#include <pinocchio/autodiff/casadi.hpp>
#include <pinocchio/algorithm/aba-derivatives.hpp>
#include <pinocchio/algorithm/aba.hpp>

#include <boost/json/src.hpp>

#include "pinocchio_model.hpp"

using Symbols = casadi::SX;
using Column = Eigen::Matrix<Symbols, Eigen::Dynamic, 1>;

casadi::Function derivatives(const pinocchio::Model& numeric, const std::string& name, bool analytic) {
  const auto model = numeric.cast<Symbols>();
  pinocchio::DataTpl<Symbols> data(model);
  const auto symbols = [](const char* of, Eigen::Index size) { return Symbols::sym(of, size); };
  const auto q = symbols("q", model.nq), v = symbols("v", model.nv), tau = symbols("tau", model.nv);
  const auto column = [](const Symbols& from) {
    Column to(from.size1());
    pinocchio::casadi::copy(from, to);
    return to;
  };
  std::vector<Symbols> found(3);
  if (analytic) {
    pinocchio::computeABADerivatives(model, data, column(q), column(v), column(tau));
    pinocchio::casadi::copy(data.ddq_dq, found[0]);
    pinocchio::casadi::copy(data.ddq_dv, found[1]);
    pinocchio::casadi::copy(data.Minv, found[2]);
    found[0] = found[0](casadi::Slice(), casadi::Slice(6, model.nv));
  } else {
    pinocchio::aba(model, data, column(q), column(v), column(tau));
    Symbols a(model.nv, 1);
    pinocchio::casadi::copy(data.ddq, a);
    const Symbols all = Symbols::jacobian(a, Symbols::vertcat({q, v, tau}));
    const int nq = model.nq, nv = model.nv;
    found[0] = all(casadi::Slice(), casadi::Slice(7, nq));
    found[1] = all(casadi::Slice(), casadi::Slice(nq, nq + nv));
    found[2] = all(casadi::Slice(), casadi::Slice(nq + nv, nq + 2 * nv));
  }
  for (Symbols& of : found) of = Symbols::densify(of);
  return casadi::Function(name, {q, v, tau}, found);
}

int main(int count, char** words) {
  const std::string what = count == 4 ? words[3] : "";
  if (what != "jacobian" && what != "analytic") {
    std::cerr << "usage: casadi_generate_derivatives FILE FOLDER/ jacobian|analytic\n";
    return 2;
  }
  const Craft craft(words[1]);
  const std::string name = what + "_" + std::to_string(craft.devices.size());
  const casadi::Function function =
      derivatives(pinocchio_model(craft), name, what == "analytic");
  casadi::CodeGenerator code(name);
  code.add(function);
  code.generate(words[2]);
  std::cout << "{\"operations\": " << function.n_instructions() << "}\n";
}
