#include "math/quadrature.hpp"

#include <cmath>

#include "math/types.hpp"

namespace packbed {

// Newton's method on the Legendre polynomial (Press et al., Numerical Recipes, 2007, section 4.6).
Quadrature gauss_legendre(int n) {
  Quadrature rule;
  for (int i = 0; i < n; ++i) {
    double x = std::cos(kPi * (i + 0.75) / (n + 0.5)), slope = 0;
    for (int k = 0; k < 100; ++k) {
      double p = 1, before = 0;
      for (int j = 0; j < n; ++j) {
        const double next = ((2 * j + 1) * x * p - j * before) / (j + 1);
        before = p;
        p = next;
      }
      slope = n * (x * p - before) / (x * x - 1);
      const double step = p / slope;
      x -= step;
      if (std::abs(step) < 1e-15) break;
    }
    rule.node.push_back(x);
    rule.weight.push_back(2 / ((1 - x * x) * slope * slope));
  }
  return rule;
}

Quadrature with_root_ends(int n) {
  Quadrature rule = gauss_legendre(n);
  for (std::size_t i = 0; i < rule.node.size(); ++i) {
    rule.weight[i] *= kPi / 2 * std::cos(kPi / 2 * rule.node[i]);
    rule.node[i] = std::sin(kPi / 2 * rule.node[i]);
  }
  return rule;
}

}  // namespace packbed
