#include "io/case_shape_keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>

#include "io/case_ranges.hpp"

namespace packbed {
namespace {

/// Keys of the shapes that have them.
class ShapeKeys {
 public:
  ShapeKeys(Fields& fields, const std::string& shape) : f_(fields), shape_(shape) {}

  using Shapes = std::initializer_list<std::string_view>;

  void length(std::string_view name, std::string_view meaning, const Shapes& shapes, double& value) {
    only(shapes, [&] {
      f_.real({.name = name,
               .meaning = meaning,
               .dimension = Dimension::length,
               .range = kSize,
               .required = !nameless()},
              value);
    });
  }
  void count(std::string_view name, std::string_view meaning, std::string_view shape, const Range& range,
             int& value) {
    only({shape}, [&] {
      f_.whole({.name = name, .meaning = meaning, .range = range, .required = !nameless()}, value);
    });
  }
  bool nameless() const { return f_.reading() && shape_.empty(); }
  void only(const Shapes& shapes, const std::function<void()>& keys) {
    f_.when(has(shapes), fmt::format("shape = \"{}\"", fmt::join(shapes, "\" or \"")), keys);
  }
  /// Where the case names no shape, which is told once, its sizes are neither wanted nor wrong.
  bool has(const Shapes& shapes) const {
    return nameless() || std::find(shapes.begin(), shapes.end(), shape_) != shapes.end();
  }

 private:
  Fields& f_;
  const std::string& shape_;
};

}  // namespace

void shape_keys(Fields& f, PelletRecord& r) {
  f.choice({.name = "shape", .meaning = "instead of a file; docs/shapes.md draws them", .required = true},
           r.shape, library_shapes());
  LibrarySizes& s = r.sizes;
  ShapeKeys keys(f, r.shape);
  keys.length("diameter", "of the pellet, or of the circle round it",
              {"sphere", "cylinder", "ring", "star", "lobed", "holed", "dished"}, s.diameter);
  keys.length("height", "of the pellet", {"cylinder", "ring", "star", "lobed", "holed", "dished"}, s.height);
  keys.length("inner_diameter", "of the hole, or of the circle through a star's valleys", {"ring", "star"},
              s.inner_diameter);
  keys.count("points", "of the star", "star", between(3, 100), s.points);
  keys.count("lobes", "of the section", "lobed", between(2, 100), s.lobes);
  keys.length("lobe_diameter", "of each lobe", {"lobed"}, s.lobe_diameter);
  keys.count("holes", "along the axis", "holed", between(1, 100), s.holes);
  keys.length("hole_diameter", "of each hole", {"holed"}, s.hole_diameter);
  keys.length("hole_circle", "diameter of the circle through the holes' centres", {"holed"}, s.hole_circle);
  keys.length("dish_diameter", "of the rim of the dish in either end", {"dished"}, s.dish_diameter);
  keys.length("dish_depth", "of the dish in either end", {"dished"}, s.dish_depth);
  keys.length("edge", "of the tetrahedron", {"tetrahedron"}, s.edge);
  keys.only({"box", "ellipsoid"}, [&] {
    f.vector({.name = "size",
              .meaning = "three edges, or three axes from end to end",
              .dimension = Dimension::length,
              .range = kSize,
              .required = !keys.nameless()},
             s.size);
  });
}

void chord_error_key(Fields& f, PelletRecord& r) {
  const bool curved =
      !r.file.empty() || ShapeKeys(f, r.shape).has({"ring", "lobed", "holed", "dished", "ellipsoid"});
  f.when(curved, "file = ... or shape = \"ring\", \"lobed\", \"holed\", \"dished\" or \"ellipsoid\"", [&] {
    f.real({.name = "chord_error",
            .meaning = "how deep facets may lie under a curved surface, fraction of its radius",
            .range = {.low = 1e-5, .high = 0.05, .why = "coarser facets are another body"}},
           r.sizes.chord_error);
  });
}

}  // namespace packbed
