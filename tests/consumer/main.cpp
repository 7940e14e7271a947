// A program outside the project, built against an installed libstrutt.
#include <cmath>
#include <iostream>
#include <numbers>

#include "strutt/model/hill_equation.hpp"

int main() {
  const strutt::HillEquation equation = strutt::mathieu_a_q(1.0, 0.25);
  std::cout << "period " << equation.period() << ", delta " << equation.delta() << '\n';
  return std::abs(equation.period() - std::numbers::pi) < 1e-15 && equation.delta() == 0.25 ? 0 : 1;
}
