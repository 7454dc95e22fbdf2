#pragma once
// Wider vectors chosen at run time: a function marked PACKBED_WIDE is compiled for AVX-512, AVX2 and the base
// machine, and the loader takes the one that the processor has. Only for loops whose result does not depend
// on the width: element by element, integer or bit operations; -ffp-contract=off keeps their rounding the
// same in all three. Empty elsewhere, and under sanitizers, whose start-up does not get on with indirect
// functions.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(PACKBED_SANITIZED)
#define PACKBED_WIDE __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define PACKBED_WIDE
#endif
