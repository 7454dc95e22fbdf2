#include "bench/contact_kernels.hpp"

#include <fmt/format.h>

#include "bench/contact_reference.hpp"
#include "contact/cylinder.hpp"
#include "contact/field.hpp"
#include "contact/sphere.hpp"
#include "shape/library.hpp"

namespace packbed::bench {
namespace {

TouchAt field_kernel(const Shape& shape, double across) {
  FieldOptions options;
  options.spacing = shape.equivalent_diameter() / across;
  const auto body = std::make_shared<const FieldBody>(make_field_body(shape, options));
  return [body](const Pose& a, const Pose& b) { return touch_field({body.get(), a}, {body.get(), b}); };
}

/// The field kernel at several spacings of its points; the law is that of much finer ones.
void add_field_kernels(ContactSubject& subject, const SubjectWish& wish) {
  const Shape& shape = *subject.solid->shape;
  const TouchAt law = field_kernel(shape, wish.finest);
  for (const double across : wish.across)
    subject.kernels.push_back({"field", fmt::format("D/{:.0f}", across), field_kernel(shape, across), law});
}

Rod rod_at(const Shape& shape, const Pose& pose) {
  return {pose.position, pose.rotation * Vec3::UnitZ(), shape.radius, shape.half_height};
}

void add_cylinder_kernel(ContactSubject& subject) {
  const ShapePtr shape = subject.solid->shape;
  subject.kernels.push_back({"cylinder", "analytic",
                             [shape](const Pose& a, const Pose& b) {
                               return touch_cylinders(rod_at(*shape, a), rod_at(*shape, b));
                             },
                             [shape](const Pose& a, const Pose& b) {
                               return converged_cylinders(rod_at(*shape, a), rod_at(*shape, b));
                             }});
}

void add_sphere_kernel(ContactSubject& subject) {
  const double r = subject.solid->shape->radius;
  subject.kernels.push_back(
      {"sphere", "analytic",
       [r](const Pose& a, const Pose& b) { return touch_spheres(a.position, r, b.position, r); },
       [r](const Pose& a, const Pose& b) {  // the overlap, along the line of centres
         Touch t;
         const Vec3 apart = a.position - b.position;
         t.delta = std::max(0.0, 2 * r - apart.norm());
         t.gradient = apart.normalized();
         return t;
       }});
}

ContactSubject subject_of(const std::string& name, const ShapePtr& shape) {
  ContactSubject subject{name, std::make_shared<SolidShape>(shape), 0, {}};
  subject.size = subject.solid->convex ? shape->smallest_thickness : shape->equivalent_diameter();
  return subject;
}

ShapePtr make_cube() {
  LibrarySizes sizes;
  sizes.size = Vec3::Constant(3.2e-3);
  return make_box("cube", sizes);
}
ShapePtr make_tridecagram() {
  LibrarySizes sizes;
  sizes.diameter = 4.2e-3;
  sizes.inner_diameter = 3.0e-3;
  sizes.height = 3.5e-3;
  sizes.points = 13;
  return make_star("tridecagram", sizes);
}
ShapePtr make_a38() {
  return make_cylinder("A38", 3.42e-3, 3.46e-3);
}

struct Maker {
  std::string_view name;
  ShapePtr (*make)();
};
constexpr Maker kMakers[] = {
    {"A38", make_a38},
    {"A38 as a mesh", [] { return make_shape("A38", "mesh", make_a38()->surface, false); }},
    {"sphere", [] { return make_sphere("sphere", 1.9e-3); }},
    {"cube", make_cube},
    {"ring", [] { return make_ring("ring", 4.6e-3, 2.5e-3, 5.0e-3); }},
    {"tridecagram", make_tridecagram},
};

}  // namespace

Body ContactSubject::at(const Pose& pose) const {
  Pellet pellet;
  pellet.pose = pose;
  return Body(*solid, pellet);
}

void for_subjects(const SubjectWish& wish, const std::function<void(const ContactSubject&)>& visit) {
  for (const Maker& maker : kMakers) {
    if (!wish.only.empty() && wish.only != maker.name) continue;
    ContactSubject subject = subject_of(std::string(maker.name), maker.make());
    const ShapeClass kind = subject.solid->shape->kind;
    if (kind == ShapeClass::cylinder) add_cylinder_kernel(subject);
    if (kind == ShapeClass::sphere) add_sphere_kernel(subject);
    add_field_kernels(subject, wish);
    visit(subject);
  }
}

}  // namespace packbed::bench
