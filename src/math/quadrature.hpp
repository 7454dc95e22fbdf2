#pragma once
// Rules for integrals over [-1, 1].
#include <vector>

namespace packbed {

struct Quadrature {
  std::vector<double> node, weight;
};

/// Exact for polynomials up to degree 2 n - 1.
Quadrature gauss_legendre(int n);
/// For functions that end like a square root: x = sin(pi t / 2) over Gauss-Legendre t.
Quadrature with_root_ends(int n);

}  // namespace packbed
