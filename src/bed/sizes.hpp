#pragma once
// How the sizes of one kind of pellet are spread, and how a whole number of pellets shares them out: exactly,
// not at random. A size is the diameter of the sphere of a pellet's volume.
#include <cstdint>
#include <span>
#include <vector>

namespace packbed {

enum class SizeLaw {
  one,                     // all alike
  table,                   // a few sizes, each with its amount (a sieve table)
  rosin_rammler,           // F(d) = 1 - exp(-(d / modulus)^exponent); Rosin & Rammler, J. Inst. Fuel 7, 1933
  gates_gaudin_schuhmann,  // F(d) = (d / modulus)^exponent; Schuhmann, AIME Tech. Publ. 1189, 1940
  log_normal               // ln d normal about ln modulus with standard deviation ln deviation
};
enum class SizeBasis { number, volume };  // what F(d) and the amounts count; mass goes like volume

/// All but a table is cut off at smallest and largest, and what lies between is the whole.
struct SizeDistribution {
  SizeLaw law = SizeLaw::one;
  SizeBasis by = SizeBasis::volume;
  std::vector<double> diameter;         // table [m]
  std::vector<double> amount;           // table: of each size, relative
  double modulus = 0;                   // [m]
  double exponent = 1, deviation = 1;   // [-]
  double smallest = 0, largest = 1e30;  // [m]
};

/// So many pellets of one size.
struct SizeClass {
  double scale = 1;  // of the shape [-]
  std::uint32_t count = 0;
  double asked = 0;  // share of its kind by number
};

/// Shares out `total` in whole numbers: each gets what its share is worth rounded down, and the largest
/// remainders one more (Hamilton's method; ties go to the first). Shares are relative, not all zero.
std::vector<std::uint32_t> largest_remainder(std::span<const double> shares, std::uint32_t total);

/// `count` pellets of the distribution, largest first; `reference` is the size that scale 1 stands for [m].
/// A table: its sizes by largest remainder. A law: count sizes, each standing for 1 / count of the pellets
/// and with their mean volume, so that the total volume is the law's.
std::vector<SizeClass> size_classes(const SizeDistribution& sizes, std::uint32_t count, double reference);

/// Of the pellets in the classes; 1 of an empty list, which stands for pellets that are all as their shape.
double smallest_scale(std::span<const SizeClass> classes);
double largest_scale(std::span<const SizeClass> classes);
double mean_cubed_scale(std::span<const SizeClass> classes);

/// Mean of d^3 over the pellets [m3].
double mean_cube(const SizeDistribution& sizes);
/// Share of the pellets under size d [m], by number or by volume: what is asked for.
double share_under(const SizeDistribution& sizes, double d, SizeBasis by);

}  // namespace packbed
