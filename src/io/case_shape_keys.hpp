#pragma once
// The keys of [pellet] that name a shape of the library and its sizes.
#include "io/case_keys.hpp"

namespace packbed {

void shape_keys(Fields& fields, PelletRecord& pellet);
/// For STEP files and for shapes of the library that are curved and no exact primitive.
void chord_error_key(Fields& fields, PelletRecord& pellet);

}  // namespace packbed
