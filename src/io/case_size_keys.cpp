#include "io/case_size_keys.hpp"

#include "io/case_ranges.hpp"

namespace packbed {
namespace {

using D = Dimension;

void size_table_keys(Fields& f, SizesRecord& r) {
  f.path({.name = "csv", .meaning = "the table as a file; instead of diameters"}, r.csv);
  f.when(r.csv.empty(), "law = \"table\", no csv", [&] {
    f.numbers({.name = "diameters",
               .meaning = "of the spheres of the pellets' volume",
               .dimension = D::length,
               .range = kSize,
               .required = true},
              r.diameters);
    f.one_of({"fractions", "amounts"});
    f.numbers({.name = "fractions",
               .meaning = "of the whole that each diameter has; add up to 1",
               .range = between(0, 1)},
              r.fractions);
    f.numbers({.name = "amounts",
               .meaning = "of each diameter, in any unit; instead of fractions. By number and without an end "
                          "of feeding: how many pellets",
               .range = between(0, 1e12)},
              r.amounts);
  });
}

}  // namespace

void size_keys(Fields& f, SizesRecord& r) {
  f.choice({.name = "law",
            .meaning = "one = all as the shape; table = a few sizes, each with its amount; else the law's"},
           r.law, {"one", "table", "rosin_rammler", "gates_gaudin_schuhmann", "log_normal"});
  const bool table = r.law == "table", normal = r.law == "log_normal", one = r.law == "one";
  f.when(!one, "law not \"one\"", [&] {
    f.choice({.name = "by", .meaning = "what the law or the amounts count"}, r.by,
             {"number", "volume", "mass"});
  });
  f.when(table, "law = \"table\"", [&] { size_table_keys(f, r); });
  f.when(!table && !one, "law neither \"one\" nor \"table\"", [&] {
    f.real(
        {.name = "modulus",
         .meaning = "rosin_rammler: 63.2 % is smaller; gates_gaudin_schuhmann: all is smaller; log_normal: "
                    "half is smaller (before the cut-offs)",
         .dimension = D::length,
         .range = kSize,
         .required = true},
        r.modulus);
  });
  f.when(!table && !one && !normal, "law = \"rosin_rammler\" or \"gates_gaudin_schuhmann\"", [&] {
    f.real({.name = "exponent",
            .meaning = "the larger, the more alike",
            .range = above_zero_to(50),
            .required = true},
           r.exponent);
  });
  f.when(normal, "law = \"log_normal\"", [&] {
    f.real(
        {.name = "deviation",
         .meaning = "geometric standard deviation",
         .range = {.low = 1, .high = 10, .without_low = true, .why = "1 would be all alike: law = \"one\""},
         .required = true},
        r.deviation);
  });
  f.when(!one, "law not \"one\"", [&] {
    f.real({.name = "smallest",
            .meaning = "what is smaller is left out; needed by a law",
            .dimension = D::length,
            .range = kSize},
           r.smallest);
    f.real({.name = "largest",
            .meaning = "what is larger is left out; needed by a law but gates_gaudin_schuhmann",
            .dimension = D::length,
            .range = kSize},
           r.largest);
  });
}

}  // namespace packbed
