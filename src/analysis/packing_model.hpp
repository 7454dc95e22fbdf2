#pragma once
// What a mixture of spheres would fill, without packing it: the linear packing model of Yu, Zou & Standish
// (Ind. Eng. Chem. Res. 35, 3730, 1996), which measured mixtures have been fitted to.
#include <vector>

namespace packbed {

struct SizeShare {
  double diameter = 0;  // [m], greater than 0
  double volume = 0;    // share of the volume of all spheres
};

/// Porosity of a mixture whose components have the porosity `alone`, each by itself. The specific volume
/// (of the bed, over that of its spheres) is that of the component which asks for most room: larger ones
/// leave it less, by g of the ratio of the two diameters, and smaller ones need none where they fit in its
/// pores, by f. NaN for no sizes.
double mixture_porosity(const std::vector<SizeShare>& sizes, double alone);

}  // namespace packbed
