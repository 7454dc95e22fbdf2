#pragma once
// Keys of [pellet.sizes].
#include "io/case_keys.hpp"

namespace packbed {

void size_keys(Fields& fields, SizesRecord& record);

}  // namespace packbed
