// What handles hold of a shape in the plane, with a deformation that leaves everything else at rest.
#include "core/skinning/held_deformation.hpp"

#include <doctest/doctest.h>

#include <memory>

#include "plane_meshes.hpp"

using namespace handlebody;

namespace {

/** Free vertices stay where they are. */
class StillDeformation final : public HeldDeformation {
 public:
  static Result<std::unique_ptr<StillDeformation>> create(SimplexMesh mesh, HeldVertices held) {
    auto setup = set_up(std::move(mesh), std::move(held));
    if (!setup) return setup.error();
    return std::unique_ptr<StillDeformation>(new StillDeformation(std::move(*setup)));
  }

  const Indices& owners() const { return owner_of_; }

  static hb_status solver_code(const SparseMatrix& q, const Indices& owners) {
    const auto made = free_solver(q, owners);
    return made ? HB_OK : made.error().code;
  }

 private:
  using HeldDeformation::HeldDeformation;
  void minimize() override {}
};

/** Four columns of squares, two rows, all cut alike: vertex i + 5 j is at (i, j). */
SimplexMesh strip() {
  SimplexMesh mesh{Matrix(15, 2), Simplices(16, 3)};
  Index t = 0;
  for (std::uint32_t j = 0; j < 3; ++j)
    for (std::uint32_t i = 0; i < 5; ++i) {
      mesh.positions.row(i + 5 * j) << i, j;
      if (i == 4 || j == 2) continue;
      const std::uint32_t a = i + 5 * j;
      mesh.simplices.row(t++) << a, a + 1, a + 6;
      mesh.simplices.row(t++) << a, a + 6, a + 5;
    }
  return mesh;
}

}  // namespace

TEST_CASE("twice a triangle's area has its sign, and moves with displacements") {
  const double p[] = {0, 0, 2, 0, 0, 3}, u[] = {0, 0, -4, 0, 0, 0};
  const std::uint32_t forth[] = {0, 1, 2}, back[] = {0, 2, 1};
  CHECK(doubled_area(forth, p) == 6);
  CHECK(doubled_area(back, p) == -6);
  CHECK(doubled_area(forth, p, u) == -6);
}

TEST_CASE("a handle of one vertex holds those around it too; one of several holds its own alone; between two nobody does") {
  auto alone = StillDeformation::create(strip(), {{7}, {0}, 1});  // the middle
  REQUIRE(alone);
  for (std::uint32_t v = 0; v < 15; ++v) {
    const bool around = v == 7 || v == 1 || v == 2 || v == 6 || v == 8 || v == 12 || v == 13;
    CHECK(((*alone)->owners()[v] == 0) == around);
  }
  auto several = StillDeformation::create(strip(), {{0, 5, 10}, {0, 0, 0}, 1});
  REQUIRE(several);
  for (std::uint32_t v = 0; v < 15; ++v) CHECK(((*several)->owners()[v] == 0) == (v % 5 == 0));
  auto two = StillDeformation::create(strip(), {{5, 7}, {0, 1}, 2});
  REQUIRE(two);
  CHECK((*two)->owners()[6] == no_index);  // next to both
  CHECK((*two)->owners()[10] == 0);
  CHECK((*two)->owners()[8] == 1);
}

TEST_CASE("held vertices go where the transform takes them, free ones stay, flips are counted") {
  auto made = StillDeformation::create(strip(), {{0, 5, 10}, {0, 0, 0}, 1});
  REQUIRE(made);
  StillDeformation& skin = **made;
  const Matrix rest = strip().positions;
  CHECK(test::apart(test::deformed(skin), rest) == 0);
  CHECK(skin.report().flips == 0);
  Matrix far(2, 3);
  far << 1, 0, 3, 0, 1, 0.25;
  test::set_transform(skin, 0, far);
  const Matrix moved = test::deformed(skin);
  for (Index v = 0; v < 15; ++v) {
    const double x = v % 5 == 0 ? 3 : 0, y = v % 5 == 0 ? 0.25 : 0;
    CHECK(moved(v, 0) == doctest::Approx(rest(v, 0) + x));
    CHECK(moved(v, 1) == doctest::Approx(rest(v, 1) + y));
  }
  CHECK(skin.report().flips == 4);  // the first column's triangles
}

TEST_CASE("what is no mesh of the plane, or does not determine the shape, is refused") {
  SimplexMesh space{Matrix::Random(4, 3), Simplices(1, 3)};
  space.simplices << 0, 1, 2;
  const auto made = StillDeformation::create(space, {{0}, {0}, 1});
  REQUIRE(!made);
  CHECK(made.error().code == HB_ERROR_INVALID_SHAPE);

  SparseMatrix identity(3, 3), singular(3, 3);
  identity.setIdentity();
  const Indices owners{0, no_index, no_index};
  CHECK(StillDeformation::solver_code(identity, owners) == HB_OK);
  singular.insert(0, 0) = 1;
  singular.insert(1, 1) = 1;
  singular.insert(2, 2) = 0;
  singular.makeCompressed();
  CHECK(StillDeformation::solver_code(singular, owners) == HB_ERROR_SYSTEM_SINGULAR);
}
