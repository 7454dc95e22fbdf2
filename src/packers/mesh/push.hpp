#pragma once
// From what a kernel says of a touch to the forces on its bodies.
#include "packers/mesh/model.hpp"

namespace packbed::mesh {

/// Adds the forces of one touch to the pair's, and what it stores and loses to the pair's record. Returns the
/// energy in its springs of friction [J].
double push(const Model& model, const Bodies& bodies, const BodyPair& pair, const Touch& touch,
            Spring& spring, Load& load, PairRecord& record);
/// Counts a look at a pair that touches, `depth` deep [m].
void count_touch(const Model& model, const Bodies& bodies, const BodyPair& pair, double depth,
                 PairRecord& record);
/// The pair has come apart.
void part(Load& load, PairRecord& record);

}  // namespace packbed::mesh
