#pragma once
// [pellet.sizes]: from what a case says to how many pellets of which size are fed.
#include <string>

#include "io/case_keys.hpp"

namespace packbed {

/// Whether a table counts its pellets, so that the case needs no other end of feeding.
bool counts_itself(const SizesRecord& record);

/// What the keys ask for, with a CSV table read (from `folder`). Throws InputError that names the key.
SizeDistribution size_distribution(const SizesRecord& record, const std::string& folder);

/// Fills PelletKind::sizes and Feed::count of a scene in which some kind has sizes (PelletKind::asked): the
/// count given, or as many as make up the mass, or as many as the table counts, shared out among kinds and
/// sizes in whole numbers. Throws InputError that names the key.
void share_out_sizes(const CaseRecord& record, Scene& scene);

}  // namespace packbed
