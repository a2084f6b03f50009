// Writes C for the articulated-body algorithm of one spacecraft: Pinocchio over CasADi's symbols.
//
//     casadi_generate FILE FOLDER/    writes FOLDER/aba_N.c, prints its operations
//
// Masses, places and inertias are numbers of the generated code; q, v and tau are its inputs.
#include <pinocchio/autodiff/casadi.hpp>
#include <pinocchio/algorithm/aba.hpp>

#include <boost/json/src.hpp>

#include "pinocchio_model.hpp"

using Symbols = casadi::SX;

// Arithmetic operations of the graph, then sines and cosines.
std::pair<int, int> operations(const casadi::Function& function) {
  int arithmetic = 0, trigonometric = 0;
  for (casadi_int k = 0; k < function.n_instructions(); ++k) {
    switch (function.instruction_id(k)) {
      case casadi::OP_INPUT:
      case casadi::OP_OUTPUT:
      case casadi::OP_CONST:
        break;
      case casadi::OP_SIN:
      case casadi::OP_COS:
        ++trigonometric;
        break;
      default:
        ++arithmetic;
    }
  }
  return {arithmetic, trigonometric};
}

casadi::Function aba(const pinocchio::Model& numeric, const std::string& name) {
  const auto model = numeric.cast<Symbols>();
  pinocchio::DataTpl<Symbols> data(model);
  const auto symbols = [](const char* of, Eigen::Index size) { return Symbols::sym(of, size); };
  const auto q = symbols("q", model.nq), v = symbols("v", model.nv), tau = symbols("tau", model.nv);
  using Column = Eigen::Matrix<Symbols, Eigen::Dynamic, 1>;
  const auto column = [](const Symbols& from) {
    Column to(from.size1());
    pinocchio::casadi::copy(from, to);
    return to;
  };
  pinocchio::aba(model, data, column(q), column(v), column(tau));
  Symbols a(model.nv, 1);
  pinocchio::casadi::copy(data.ddq, a);
  return casadi::Function(name, {q, v, tau}, {a});
}

int main(int count, char** words) {
  if (count != 3) {
    std::cerr << "usage: casadi_generate FILE FOLDER/\n";
    return 2;
  }
  const Craft craft(words[1]);
  const std::string name = "aba_" + std::to_string(craft.devices.size());
  const casadi::Function function = aba(pinocchio_model(craft), name);
  casadi::CodeGenerator code(name);
  code.add(function);
  code.generate(words[2]);
  const auto [arithmetic, trigonometric] = operations(function);
  std::cout << "{\"arithmetic\": " << arithmetic << ", \"trigonometric\": " << trigonometric
            << "}\n";
}
