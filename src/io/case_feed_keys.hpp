#pragma once
// Keys of [feed] and [[feed.placed]].
#include "io/case_keys.hpp"

namespace packbed {

void feed_keys(Fields& fields, CaseRecord& record);

}  // namespace packbed
